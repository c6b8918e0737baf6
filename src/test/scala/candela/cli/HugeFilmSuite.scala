package candela.cli

import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** A window of a film of more than 2³¹ pixels, which no array could hold, costs what it costs. */
class HugeFilmSuite extends AnyFunSuite:

  private def run(args: String*): Captured =
    val (code, captured) = Captured.run(args*)
    assert(code == 0, captured.err)
    captured

  private val (width, height) = (12, 8)

  private def scene(film: String, integrator: String): String =
    s"""LookAt 0 0 5 0 0 0 0 1 0
       |Camera "perspective" "float fov" 40
       |Film "$film" "integer xresolution" 60000 "integer yresolution" 66000
       |  "integer pixelbounds" [ 28000 28012 32000 32008 ] "string filename" "a.exr"
       |Sampler "sobol" "integer pixelsamples" 4
       |Integrator "$integrator"
       |WorldBegin
       |LightSource "infinite" "rgb L" [ 0.5 0.5 0.5 ]
       |LightSource "point" "rgb I" [ 9 9 9 ] "point3 from" [ 0 3 3 ]
       |Shape "sphere"
       |""".stripMargin

  private def withScene[A](film: String, integrator: String = "path")(body: (Path, String) => A) =
    TempFolder.use: folder =>
      val text = scene(film, integrator)
      body(folder, Files.writeString(folder.resolve("s.pbrt"), text).toString)

  /** The whole film would be 4,000 times as large. */
  private val MaxBytes = 1_000_000L

  private def read(file: Path): Image =
    assert(Files.size(file) < MaxBytes)
    val image = ImageFiles.read(file)
    assert((image.width, image.height) == (width, height))
    image

  test("images of every format have the pixels of the window"):
    withScene("rgb"): (folder, file) =>
      val names = Vector("exr", "png", "pfm", "tga", "qoi", "jpg").map(e => s"$folder/a.$e")
      run(file, "--outfile", names.mkString(","))
      names.foreach(n => read(Path.of(n)))

  test("films of all types, and methods that splat, or take the samples in passes"):
    for film <- Vector("gbuffer", "spectral") do
      withScene(film): (folder, file) =>
        run(file, "--outfile", s"$folder/a.exr")
        read(folder.resolve("a.exr")): Unit
    for integrator <- Vector("bdpt", "mlt", "sppm") do
      withScene("rgb", integrator): (folder, file) =>
        run(file, "--spp", "1", "--outfile", s"$folder/a.exr")
        read(folder.resolve("a.exr")): Unit

  test("a saved rendering goes on, and shards add up to the same image"):
    withScene("rgb"): (folder, file) =>
      def path(name: String) = s"$folder/$name"
      run(file, "--outfile", path("whole.exr"))
      val parts = Vector.tabulate(2)(i => path(s"$i.film"))
      for (part, i) <- parts.zipWithIndex do run(file, "--shard", s"$i/2", "--outfile", part)
      run("merge" +: parts :+ "--outfile" :+ path("merged.exr")*)
      run(file, "--spp", "2", "--outfile", s"${path("a.film")},${path("a.exr")}")
      run("resume", path("a.film"), "--spp", "4")
      for film <- "a.film" +: Vector("0.film", "1.film") do
        assert(Files.size(folder.resolve(film)) < MaxBytes)
      val whole = read(folder.resolve("whole.exr")).data
      assert(whole.sameElements(read(folder.resolve("merged.exr")).data))
      assert(whole.sameElements(read(folder.resolve("a.exr")).data))

  test("without a window, one error says so"):
    withScene("rgb"): (_, file) =>
      val (code, captured) = Captured.run(file, "--cropwindow", "0,1,0,1")
      assert(code == 1 && captured.err.contains("can't render 60000×66000 pixels at once"))
      assert("error".r.findAllIn(captured.err).size == 1, captured.err)

  test("commands on images count pixels as the whole film does, or from the window"):
    withScene("rgb"): (folder, file) =>
      run(file, "--outfile", s"$folder/a.exr")
      run(file, "--pixelbounds", "28000,28012,32000,32008", "--outfile", s"$folder/b.exr")
      assert(read(folder.resolve("a.exr")).data.sameElements(read(folder.resolve("b.exr")).data))
      val part = "0.4667,0.4674,0.4849,0.4852"
      run(file, "--cropwindow", part, "--outfile", s"$folder/c.exr")
      assert(Files.size(folder.resolve("c.exr")) < MaxBytes)
      run("view", s"$folder/a.exr", "--outfile", s"$folder/v.png")
      run("image", s"$folder/a.exr", "--crop", "2,6,2,6", "--outfile", s"$folder/d.exr")
      val cut = ImageFiles.read(folder.resolve("d.exr"))
      assert((cut.width, cut.height) == (4, 4))
      run("compare", s"$folder/a.exr", s"$folder/b.exr", "--crop", "2,6,2,6"): Unit
