package candela.io

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.TempFolder

class PartFilesSuite extends AnyFunSuite:

  private class Form(name: String) extends PartForm[Array[Int]](name):
    def size(thing: Array[Int]): Long = 4L * thing.length
    def write(thing: Array[Int], out: CheckedOutput): Unit = out.ints(thing)
    def read(in: CheckedInput): Array[Int] = in.ints()

  private object Numbers extends Form("numbers 1")
  private object Longer extends Form("numbers 1"):
    override def read(in: CheckedInput): Array[Int] =
      val all = super.read(in)
      val _ = in.int()
      all
  private object Shorter extends Form("numbers 1"):
    override def read(in: CheckedInput): Array[Int] = Array(in.int())

  private def files(folder: Path, most: Long = Long.MaxValue) = PartFiles(CacheFolder(folder, most))
  private def found(folder: Path, form: Form = Numbers, key: String = "a") =
    files(folder).read(form, key).map(_.toVector)

  private val large = Array.tabulate(50_001)(i => i * i)
  private val Whole = Some(large.toVector)

  private def only(folder: Path): Path = folder.resolve(TempFolder.names(folder).head)

  test("a part is read as it was written, by its key and its form only"):
    TempFolder.use: folder =>
      assert(found(folder).isEmpty)
      files(folder).write(Numbers, "a", large)
      assert(found(folder) == Whole)
      assert(found(folder, key = "b").isEmpty)
      assert(found(folder, form = Form("numbers 2")).isEmpty)
      assert(found(folder, form = Longer).isEmpty && found(folder, form = Shorter).isEmpty)

  test("a file that is damaged anywhere is as none, and is written again"):
    TempFolder.use: folder =>
      files(folder).write(Numbers, "a", large)
      val file = only(folder)
      val whole = Files.readAllBytes(file)
      val places = Seq(0, 3, 5, 40, 90, whole.length / 2, whole.length - 20, whole.length - 1)
      val changed = places.map(i => whole.updated(i, (whole(i) ^ 1).toByte)) ++
        Seq(0, 1, 4, 15, 60, 100, whole.length / 2, whole.length - 1).map(whole.take) ++
        Seq(whole ++ whole, whole :+ 0.toByte)
      for (bytes, i) <- changed.zipWithIndex do
        val _ = Files.write(file, bytes)
        assert(found(folder).isEmpty, i)
        files(folder).write(Numbers, "a", large)
        assert(Files.readAllBytes(file).sameElements(whole), i)
        assert(found(folder) == Whole, i)

  test("a file of another key in its place is as none"):
    TempFolder.use: folder =>
      files(folder).write(Numbers, "a", large)
      val place = only(folder)
      TempFolder.use: other =>
        files(other).write(Numbers, "b", large)
        val _ = Files.copy(only(other), place, java.nio.file.StandardCopyOption.REPLACE_EXISTING)
      assert(found(folder).isEmpty)

  test("small things are not written"):
    TempFolder.use: folder =>
      files(folder).write(Numbers, "a", new Array[Int](100))
      assert(TempFolder.names(folder).isEmpty)

  test("where files can't be written, that is told once"):
    TempFolder.use: folder =>
      val file = Files.write(folder.resolve("file"), Array.emptyByteArray)
      val there = files(file)
      assert(there.trouble().isEmpty)
      there.write(Numbers, "a", large)
      assert(there.trouble().exists(_.contains(s"$file")))
      there.write(Numbers, "a", large)
      assert(there.trouble().isEmpty && there.read(Numbers, "a").isEmpty)

  test("the files that were used least recently go when the folder is full, those of tiles, too"):
    TempFolder.use: folder =>
      def age(file: Path, seconds: Long) =
        val time = java.nio.file.attribute.FileTime.fromMillis(1000 * seconds)
        Files.setLastModifiedTime(file, time): Unit
      files(folder).write(Numbers, "a", large)
      val part = only(folder)
      val name = CacheFolder(folder, 1).file("x", CacheFolder.Tiles)
      val tiles = Files.write(name, s"CTL3${CacheFolder.Mark}".getBytes.padTo(300_000, 0.toByte))
      val strange = Files.write(folder.resolve("note.txt"), new Array[Byte](300_000))
      for (file, i) <- Vector(strange, tiles, part).zipWithIndex do age(file, 1000L + i)
      files(folder, most = 500_000).write(Numbers, "b", large)
      assert(!Files.exists(tiles) && Files.exists(strange))
      assert(found(folder) == Whole && found(folder, key = "b") == Whole)
      for name <- TempFolder.names(folder) do age(folder.resolve(name), 2000)
      assert(found(folder) == Whole, "which is a use")
      files(folder, most = 500_000).write(Numbers, "c", large)
      assert(found(folder) == Whole && found(folder, key = "b").isEmpty)

  test("what is kept in files is there for another process, and is read once"):
    TempFolder.use: folder =>
      val shelf = Keep.Shelf(Some(Numbers))
      assert(Keep(Some(files(folder)))(shelf, "a")(large).toVector == large.toVector)
      val second = Keep(Some(files(folder)))
      val read = second(shelf, "a")(fail("it is made again"))
      assert(read.toVector == large.toVector && (second(shelf, "a")(fail("again")) eq read))
      Files.delete(only(folder))
      assert(second.lookup(shelf, "a").exists(_ eq read))
      assert(Keep(Some(files(folder))).lookup(shelf, "a").isEmpty)
