package candela.cli

import candela.fuzz.{FilmValue, FilmValues}
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** What is merged of films that are unfinished, damaged or forged. */
class MergedFilmsSuite extends AnyFunSuite:
  import MergedFilmsSuite.*

  private def withScene(body: FilmFilesSuite.Folder => Any): Any =
    TempFolder.use: folder =>
      val text = FilmFilesSuite.text(FilmFilesSuite.Paths, "independent")
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      body(FilmFilesSuite.Folder(folder, scene))

  private def shards(f: FilmFilesSuite.Folder, count: Int, taken: Int*): Unit =
    for i <- taken do f.render("--shard", s"$i/$count", "--outfile", f(s"$i.film"))

  test("an image without samples takes the place of none"):
    withScene: f =>
      shards(f, 2147483647, 7)
      f.render("--spp", "1", "--outfile", f("a.exr"))
      val before = f.bytes("a.exr")
      val outfiles = s"${f("a.exr")},${f("b.png")}"
      val words = Vector("merge", "--partial", f("7.film"), "--outfile", outfiles)
      val (code, captured) = f.captured(words)
      assert(code == 1 && f.bytes("a.exr") == before)
      val why = "the new image has less than 1 sample per pixel"
      assert(captured.err == s"kept ${f("a.exr")}: $why\n")
      assert(captured.out == s"wrote ${f("b.png")}  24x16, less than 1 spp\n")

  test("a film whose state is damaged behind a right checksum is left out on request"):
    withScene: f =>
      shards(f, 3, 0, 1, 2)
      f.run(Vector("merge", "--partial", f("0.film"), f("2.film"), "--outfile", f("two.exr")))
      // An absurd number of samples of the last tile, after the number of tiles
      forge(f("1.film")): values =>
        values.map:
          case FilmValue.State(all) => FilmValue.State(all.patch(12, Array.fill[Byte](8)(-1), 8))
          case other => other
      val all = Vector("0", "1", "2").map(n => f(s"$n.film"))
      assert(f.fail(Vector("merge", "--outfile", f("x.exr")) ++ all).contains(s"`${all(1)}`"))
      val words = Vector("merge", "--partial", "--outfile", f("x.exr"))
      val (code, captured) = f.captured(words ++ all)
      assert(code == 0, captured.err)
      assert(captured.err.startsWith(s"warning: can't read `${all(1)}`: it is damaged: "))
      assert(captured.err.endsWith("; it is omitted [E1001]\n"))
      assert(f.bytes("x.exr") == f.bytes("two.exr"))
      for other <- Vector(0, 2) do
        val _ = Files.delete(Path.of(all(other)))
      val none = f.fail(Vector("merge", "--partial", "--outfile", f("y.exr"), all(1)))
      assert(none.startsWith(s"error: can't read `${all(1)}`"))
      assert(!Files.exists(Path.of(f("y.exr"))))

  test("a film that says more samples than it has is damaged"):
    withScene: f =>
      for integrator <- Vector("path", "mlt") do
        val text = FilmFilesSuite.text(s"\"$integrator\" \"integer maxdepth\" 3", "independent")
        val _ = Files.writeString(Path.of(f.scene), text)
        f.render("--checkpoint", f(s"$integrator.film"), "--outfile", f("a.exr"))
        forgeDone(f(s"$integrator.film"), Int.MaxValue)
        for words <- Vector(Vector("resume"), Vector("merge", "--outfile", f("b.exr"))) do
          val (code, captured) = f.captured(words :+ f(s"$integrator.film"))
          assert(code == 1, captured.out)
          assert(captured.err.contains("it has fewer than 2147483647 samples"), captured.err)

  test("a merger of unfinished shards is completed by its shards"):
    withScene: f =>
      shards(f, 3, 0, 1, 2)
      for i <- 0 to 1 do forgeDone(f(s"$i.film"), 2)
      f.run(Vector("merge", "--partial", f("0.film"), f("1.film"), "--outfile", f("m.film")))
      val why = f.fail(Vector("merge", f("m.film"), f("2.film"), "--outfile", f("x.exr")))
      val advice = "`candela resume` completes the film of each shard, from which it was merged"
      assert(why == "error: shards 0/3, 1/3 are unfinished, with 2 of 4 samples per pixel: " +
        s"`${f("m.film")}` [E1005]\n $advice; --partial merges the samples so far\n")

private object MergedFilmsSuite:
  /** Changes values of a film file, whose checksum stays right. */
  def forge(film: String)(change: Vector[FilmValue] => Vector[FilmValue]): Unit =
    val values = FilmValues.of(Files.readAllBytes(Path.of(film)))
    val _ = Files.write(Path.of(film), FilmValues.bytes(change(values)))

  /** Changes the number of samples done, which the footprint follows. */
  def forgeDone(film: String, done: Int): Unit = forge(film): values =>
    val footprint = values.indexWhere(_.isInstanceOf[FilmValue.Real])
    values.updated(footprint - 1, FilmValue.Number(done))
