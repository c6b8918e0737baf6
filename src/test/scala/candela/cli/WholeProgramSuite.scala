package candela.cli

import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** From a scene's text to image files, through everything. */
class WholeProgramSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run(args*)

  private val scene =
    """LookAt 0 0 -4  0 0 0  0 1 0
      |Camera "perspective" "float fov" 40
      |Film "rgb" "integer xresolution" 48 "integer yresolution" 32 "string filename" "sphere.exr"
      |Sampler "independent" "integer pixelsamples" 4
      |Integrator "path" "integer maxdepth" 3
      |WorldBegin
      |LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
      |LightSource "point" "point3 from" [ 3 4 -5 ] "rgb I" [ 40 40 40 ]
      |Material "diffuse" "rgb reflectance" [ 0.8 0.4 0.2 ]
      |Shape "sphere" "float radius" 1
      |Translate 0 -1 0
      |Shape "disk" "float radius" 3
      |""".stripMargin

  private def withScene[A](body: (Path, String) => A): A =
    TempFolder.use: folder =>
      body(folder, Files.writeString(folder.resolve("sphere.pbrt"), scene).toString)

  private def image(folder: Path, args: String*): Image =
    val file = folder.resolve("out.exr")
    val (code, captured) = run(args ++ Vector("--outfile", file.toString)*)
    assert(code == 0, captured.err)
    ImageFiles.read(file)

  test("check says what the scene holds and writes nothing"):
    withScene: (folder, file) =>
      val (code, captured) = run("check", file)
      assert((code, captured.err) == (0, ""))
      assert(captured.out == s"$file: v4, 48x32, 4 spp, 2 shapes, 2 lights\n")
      assert(TempFolder.names(folder) == Set("sphere.pbrt"))

  test("the image is the same, bit for bit, for any number of threads"):
    withScene: (folder, file) =>
      val one = image(folder, file, "--nthreads", "1")
      assert((one.width, one.height) == (48, 32))
      assert(one.data.forall(v => java.lang.Float.isFinite(v)) && one.data.exists(_ > 0.3f))
      assert(image(folder, file, "--nthreads", "3").data.toVector == one.data.toVector)

  test("another seed is another image"):
    withScene: (folder, file) =>
      assert(image(folder, file).data.toVector != image(folder, file, "--seed", "1").data.toVector)

  test("--cropwindow renders just that part of the same image"):
    withScene: (folder, file) =>
      val all = image(folder, file)
      val part = image(folder, file, "--cropwindow", "0.25,0.75,0.5,1")
      assert((part.width, part.height) == (24, 16))
      for y <- 0 until 16; x <- 0 until 24; c <- 0 until 3 do
        assert(part(x, y, c) == all(x + 12, y + 16, c))

  test("--spp takes the place of the scene's count, --quick makes a small image"):
    withScene: (folder, file) =>
      val out = folder.resolve("out.exr").toString
      val (_, counted) = run(file, "--outfile", out, "--spp", "7")
      assert(counted.out.startsWith(s"wrote $out  48x32, 7 spp, "))
      val (_, quick) = run(file, "--outfile", out, "--quick")
      assert(quick.out.startsWith(s"wrote $out  12x8, 1 spp, "))
