package candela.cli

import candela.render.storage.FilmLock
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.nio.file.{Files, Path}

/** Two renderings never write one film file. */
class FilmLockSuite extends AnyFunSuite:

  private def withScene[A](body: FilmFilesSuite.Folder => A): A =
    TempFolder.use: folder =>
      val text = FilmFilesSuite.text(FilmFilesSuite.Paths, "independent")
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      body(FilmFilesSuite.Folder(folder, scene))

  test("a missing film resembles no lock, but a film"):
    TempFolder.use: folder =>
      def missing() = Captured.run("resume", s"$folder/nothere.film")._2.err
      assert(missing().contains("nothere.film") && !missing().contains("did you mean"), missing())
      val _ = Files.createFile(folder.resolve("nowhere.film"))
      assert(missing().contains("did you mean `nowhere.film`?"), missing())

  test("the right to write a film has one owner, who leaves nothing behind"):
    TempFolder.use: folder =>
      val film = folder.resolve("a.film")
      val first = FilmLock.acquire(film)
      assert(first.isDefined && FilmLock.acquire(film).isEmpty)
      assert(FilmLock.acquire(folder.resolve("b.film")).map(_.close()).isDefined)
      first.foreach(_.close())
      assert(TempFolder.names(folder).isEmpty)
      assert(FilmLock.acquire(film).map(_.close()).isDefined)

  test("a film that is being written is refused by render and resume"):
    withScene: f =>
      f.render("--outfile", f("one.film"))
      val film = Files.readAllBytes(Path.of(f("one.film"))).toVector
      for lock <- FilmLock.acquire(Path.of(f("one.film"))) do
        val others = Vector(
          Vector(f.scene, "--outfile", f("one.film")),
          Vector("resume", f("one.film"), "--spp", "8")
        )
        for command <- others do
          assert(
            f.fail(command) ==
              s"error: `${f("one.film")}` is being written by another rendering [E1003]\n" +
              " wait for it, or stop it\n",
            command
          )
        lock.close()
      assert(f.bytes("one.film") == film)
      f.run(Vector("resume", f("one.film"), "--spp", "8"))
      assert(f.bytes("one.film") != film)

  test("a process that is killed no longer owns its film", Slow):
    withScene: f =>
      val words = Vector("s.pbrt", "--spp", "1000000", "--outfile", "a.film")
      val process = KilledRenderings.candela(f.folder, words :+ "--checkpoint-every" :+ "0.05s")
      try
        while process.isAlive && !Files.exists(Path.of(f("a.film"))) do Thread.sleep(5)
        val why = f.fail(Vector("resume", f("a.film"), "--time", "0.01s"))
        assert(why.contains("is being written by another rendering"))
      finally
        val _ = process.destroyForcibly().waitFor()
      assert(f.run(Vector("resume", f("a.film"), "--time", "0.01s")).contains("continuing"))
