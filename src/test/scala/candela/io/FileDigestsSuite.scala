package candela.io

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.testing.TempFolder

class FileDigestsSuite extends AnyFunSuite:

  /** As of another process. */
  private def digests(cache: Path) = FileDigests(Some(parts(cache)), Rest)
  private def parts(cache: Path) = PartFiles(CacheFolder(cache, Long.MaxValue))

  private def rows(cache: Path, folder: Path) =
    parts(cache).read(FileDigests.TableForm, folder.toString)

  /** A file's digest as it is known; `new` if it is not. */
  private def known(of: FileDigests, file: InputFile): String = of(file)("new")

  private val Rest = 1000L
  private def rest(): Unit = Thread.sleep(Rest + 100)

  /** Files of these names, at rest, in a folder; and the folder of the cache. */
  private def withFiles(names: String*)(body: (Path, Vector[InputFile]) => Any): Unit =
    TempFolder.use: folder =>
      val files =
        for name <- names.toVector
        yield InputFile.named(Files.writeString(folder.resolve(name), name))
      assume(FileStamp.of(folder.resolve(names.head), rest = 0).nonEmpty, "needs Unix files")
      assume(FileDigests.isTimed(folder), "needs a file system whose kernel sets the times")
      rest()
      body(folder.resolve("cache"), files): Unit

  test("what one process has read, another need not read while the file is not touched", Slow):
    withFiles("a", "b"): (cache, files) =>
      val first = digests(cache)
      assert(files.map(f => first(f)(f.digest())) == Vector(Sha256.of("a"), Sha256.of("b")))
      assert(files.map(known(first, _)) == Vector(Sha256.of("a"), Sha256.of("b")))
      assert(known(digests(cache), files(0)) == "new", "nothing is written before it is saved")
      first.save()
      assert(files.map(known(digests(cache), _)) == Vector(Sha256.of("a"), Sha256.of("b")))
      val time = Files.getLastModifiedTime(files(0).path)
      Files.writeString(files(0).path, "c"): Unit
      Files.setLastModifiedTime(files(0).path, time): Unit
      rest()
      assert(known(digests(cache), files(0)) == "new", "its clock is set back")

  test("a file that was written just now is read again"):
    TempFolder.use: folder =>
      val file = InputFile.named(Files.writeString(folder.resolve("a"), "a"))
      val first = digests(folder.resolve("cache"))
      assert(first(file)("first") == "first")
      first.save()
      assert(known(first, file) == "new" && known(digests(folder.resolve("cache")), file) == "new")

  test("processes that save at the same time keep each other's, and files that are gone, go", Slow):
    withFiles("a", "b", "c"): (cache, files) =>
      val both = Vector.fill(2)(digests(cache))
      for (d, i) <- both.zipWithIndex do assert(d(files(i))(s"of $i") == s"of $i")
      both.foreach(_.save())
      assert(files.map(known(digests(cache), _)) == Vector("of 0", "of 1", "new"))
      val third = digests(cache)
      Files.delete(files(0).path)
      assert(third(files(2))("of 2") == "of 2")
      third.save()
      assert(rows(cache, files(1).path.getParent).map(_.keySet).contains(Set("b", "c")))
      assert(known(digests(cache), files(2)) == "of 2")

  test("a name that is none here is left out", Slow):
    withFiles("a"): (cache, files) =>
      val folder = files(0).path.getParent
      val strange = Map("\u0000" -> (FileStamp("1"), "x"), "a" -> (FileStamp("2"), "y"))
      parts(cache).write(FileDigests.TableForm, folder.toString, strange)
      val all = digests(cache)
      assert(all(files(0))("new") == "new")
      all.save()
      assert(rows(cache, folder).map(_.keySet).contains(Set("a")))

  test("a cache that can't be written is no trouble", Slow):
    withFiles("a"): (_, files) =>
      val store = parts(Files.writeString(files(0).path.resolveSibling("file"), ""))
      val all = FileDigests(Some(store), Rest)
      assert(all(files(0))("first") == "first")
      all.save()
      assert(store.trouble().isEmpty && known(all, files(0)) == "first")

  test("a damaged table is as none, and is written again", Slow):
    withFiles("a"): (cache, files) =>
      def save(what: String) =
        val all = digests(cache)
        assert(all(files(0))(what) == what)
        all.save()
      save("first")
      val table = cache.resolve(TempFolder.names(cache).head)
      val bytes = Files.readAllBytes(table)
      Files.write(
        table,
        bytes.updated(bytes.length / 2, (bytes(bytes.length / 2) ^ 1).toByte)
      ): Unit
      save("second")
      assert(known(digests(cache), files(0)) == "second")

  test("without a cache, a process remembers its own", Slow):
    withFiles("a"): (_, files) =>
      val own = FileDigests(None, Rest)
      assert(own(files(0))("first") == "first")
      own.save()
      assert(known(own, files(0)) == "first" && known(FileDigests(None, Rest), files(0)) == "new")
