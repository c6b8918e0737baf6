package candela.cli

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

/** The files of the strategies that bidirectional path tracing tells apart. */
class StrategyImagesSuite extends AnyFunSuite:
  private val names =
    Vector("d00_s00_t02", "d01_s00_t03", "d01_s01_t02", "d01_s02_t01").map(n => s"a_bdpt_$n.exr")

  private def withScene(body: FilmFilesSuite.Folder => Any): Any =
    TempFolder.use: folder =>
      val integrator = "\"bdpt\" \"integer maxdepth\" 1 \"bool visualizeweights\" true"
      val text = FilmFilesSuite.text(integrator, "independent")
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      body(FilmFilesSuite.Folder(folder, scene))

  test("they are beside the image, which has colours only, and are told of"):
    withScene: f =>
      val out = f.render("--outfile", f("a.exr"))
      assert(out.contains(s"wrote ${f("a.exr")}, ${f("a_bdpt_d*_s*_t*.exr")} (4 files)  "), out)
      assert(TempFolder.names(f.folder) == names.toSet ++ Set("a.exr", "s.pbrt", "part.pbrt"))
      val (image, parts) = (f.image("a.exr"), names.map(f.image))
      for i <- image.data.indices do
        // Each file has numbers of 16 bits
        assert(Math.abs(parts.map(_.data(i)).sum - image.data(i)) < 4e-3 * (1 + image.data(i)))
      assert((image +: parts).forall(_.channelNames.toSet == Set("R", "G", "B")))

  test("a picture has them, too"):
    withScene: f =>
      f.render("--outfile", f("a.png"))
      assert(names.forall(TempFolder.names(f.folder)))

  test("a rendering that goes on and shards that are merged have the same"):
    withScene: f =>
      f.render("--outfile", f("a.exr"))
      val expected = names.map(f.bytes)
      def check(): Unit =
        assert(names.map(f.bytes) == expected)
        names.foreach(name => Files.delete(f.folder.resolve(name)))
      f.render("--outfile", f("a.exr"), "--checkpoint", f("a.film"), "--spp", "2")
      f.run(Vector("resume", f("a.film"), "--spp", "4"))
      check()
      for i <- 0 to 1 do f.render("--shard", s"$i/2", "--outfile", f(s"$i.film"))
      f.run(Vector("merge", f("0.film"), f("1.film"), "--outfile", f("a.exr")))
      check()

  test("none takes the place of a file that was read, or asked for"):
    withScene: f =>
      val asked = f.fail(Vector(f.scene, "--outfile", f("a.exr"), "--outfile", f(names(1))))
      assert(asked.contains(s"`${f(names(1))}` is the file of a strategy of bdpt"), asked)
      val _ = Files.move(f.folder.resolve("part.pbrt"), f.folder.resolve(names(1)))
      f.rewrite("s.pbrt")(_.replace("part.pbrt", names(1)))
      val why = f.fail(Vector(f.scene, "--outfile", f("a.exr")))
      assert(why.contains(s"`${f(names(1))}` is an input file"), why)
