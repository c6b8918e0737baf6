package candela.io

import java.nio.file.attribute.FileTime
import java.nio.file.{Files, Path}
import java.time.Instant

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.testing.TempFolder

class KeepSuite extends AnyFunSuite:
  private val Words = Keep.Shelf[String]()
  private val Others = Keep.Shelf[String]()

  private def written(file: Path, text: String): InputFile =
    InputFile.named(Files.writeString(file, text))

  /** What is kept of a file; `made`, if nothing is. */
  private def of(keep: Keep, file: InputFile, made: String, way: String = "") =
    keep.ofFile(Words, file, way)(made)._1

  test("what is kept is made once for each key of a shelf"):
    val keep = Keep()
    assert(keep(Words, "a")("first") == "first")
    assert(keep(Words, "a")("second") == "first")
    assert(keep(Words, "b")("third") == "third")
    assert(keep(Others, "a")("fourth") == "fourth")

  test("what the scene before the latest has not used is given up"):
    val keep = Keep()
    for scene <- 1 to 5 do
      keep.startScene()
      assert(keep(Words, "each")(s"$scene") == "1")
      if scene == 1 then assert(keep(Words, "first")("1") == "1"): Unit
      if scene % 2 == 0 then assert(keep(Words, "even")(s"$scene") == s"$scene"): Unit
    assert(keep(Words, "first")("5") == "5")

  test("nothing is kept where nothing is to be kept"):
    TempFolder.use: folder =>
      val file = written(folder.resolve("a"), "text")
      assert(Keep.Nothing(Words, "a")("first") == "first")
      assert(Keep.Nothing(Words, "a")("second") == "second")
      assert(Keep.Nothing.ofFile(Words, file, "")("first") == ("first", None))
      assert(Keep.Nothing.ofFile(Words, file, "")("second") == ("second", None))

  test("files are told apart by content, not by name, size or age"):
    TempFolder.use: folder =>
      val keep = Keep()
      val path = folder.resolve("a")
      assert(of(keep, written(path, "aaa"), "first") == "first")
      assert(of(keep, written(path, "aaa"), "second") == "first")
      assert(of(keep, written(path, "aab"), "third") == "third")
      assert(of(keep, written(folder.resolve("b"), "aaa"), "fourth") == "first")
      assert(of(keep, written(folder.resolve("b"), "aaa"), "fifth", way = "other") == "fifth")

  test("a file that is changed keeps no digest, even if its time is set back"):
    TempFolder.use: folder =>
      val keep = Keep()
      val path = folder.resolve("a")
      val old = FileTime.from(Instant.ofEpochSecond(1_000_000))
      for (text, i) <- Vector("aaa", "aab", "aac").zipWithIndex do
        val file = written(path, text)
        val _ = Files.setLastModifiedTime(path, old)
        assert(keep.digest(file) == Sha256.of(text), i)
        assert(keep.digest(file) == Sha256.of(text), i)

  test("a file that is at rest is read for its digest once", Slow):
    TempFolder.use: folder =>
      val rest = 1000L
      val keep = Keep(rest = rest)
      val file = written(folder.resolve("a"), "aaa")
      assume(FileStamp.of(folder.resolve("a"), rest = 0).nonEmpty, "needs a Unix file system")
      val stamp = FileStamp.of(folder.resolve("a"), rest = 0)
      assert(file.stamp(rest).isEmpty, "it was written just now")
      val _ = written(folder.resolve("a"), "aab")
      assert(FileStamp.of(folder.resolve("a"), rest = 0) != stamp)
      Thread.sleep(rest + 100)
      assert(file.stamp(rest).nonEmpty && keep.digest(file) == Sha256.of("aab"))

  test("what was made while its file was written is not kept"):
    TempFolder.use: folder =>
      val keep = Keep()
      val path = folder.resolve("a")
      val file = written(path, "aaa")
      val made = keep.ofFile(Words, file, ""):
        val _ = written(path, "aab")
        "of either"
      assert(made == ("of either", None))
      assert(of(keep, written(path, "aaa"), "of a") == "of a")
      assert(of(keep, written(path, "aab"), "of b") == "of b")

  test("a file that can't be read is as if nothing were kept"):
    TempFolder.use: folder =>
      val file = written(folder.resolve("a"), "aaa")
      Files.delete(folder.resolve("a"))
      assert(Keep().ofFile(Words, file, "")("made") == ("made", None))
