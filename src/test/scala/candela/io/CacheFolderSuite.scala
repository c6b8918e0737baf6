package candela.io

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.TempFolder

class CacheFolderSuite extends AnyFunSuite:

  test("the user's cache folder is the one that the system names"):
    def usual(variables: (String, String)*) =
      CacheFolder.userFolder(variables.toMap).map(_.toString)
    val root = Path.of("").toAbsolutePath.getRoot.resolve("x")
    val tail = Path.of("candela", "textures")
    assert(usual("XDG_CACHE_HOME" -> s"$root", "HOME" -> "/h").contains(s"${root.resolve(tail)}"))
    assert(usual("HOME" -> s"$root").contains(s"${root.resolve(".cache").resolve(tail)}"))
    assert(usual("LOCALAPPDATA" -> s"$root").contains(s"${root.resolve(tail)}"))
    assert(usual("XDG_CACHE_HOME" -> "relative").isEmpty && usual().isEmpty)

  test("a limit that has become less makes room before the next file is written"):
    TempFolder.use: folder =>
      val roomy = CacheFolder(folder, 1000)
      def file(name: String) = roomy.file(name, CacheFolder.Parts)
      for name <- Seq("a", "b") do roomy.write(file(name))(_.write(content(100)): Unit)
      assert(Seq("a", "b").forall(n => Files.exists(file(n))))
      intercept[IOException]:
        CacheFolder(folder, 150).write(file("c")): _ =>
          assert(Seq("a", "b").count(n => Files.exists(file(n))) == 1)
          throw IOException("no space left")
      assert(!Files.exists(file("c")))

  /** As files of a cache begin. */
  private def content(size: Int): ByteBuffer =
    ByteBuffer.allocate(size).position(4).put(CacheFolder.Mark.getBytes).rewind()

  test("files that the cache has not written stay, whatever they are called"):
    TempFolder.use: folder =>
      val cache = CacheFolder(folder, 150)
      val first = cache.file("a", CacheFolder.Parts)
      cache.write(first)(_.write(content(100)): Unit)
      assert(cache.remark.isEmpty)
      val film = Files.write(folder.resolve("holiday-film.mkv.part"), content(900).array)
      val named = Files.write(cache.file("x", CacheFolder.Tiles), new Array[Byte](900))
      val target = Files.write(folder.resolve("target"), content(900).array)
      val link = Files.createSymbolicLink(cache.file("y", CacheFolder.Digests), target)
      val next = CacheFolder(folder, 150)
      next.write(cache.file("b", CacheFolder.Parts))(_.write(content(100)): Unit)
      assert(next.remark.exists(_.contains("has 2 files that are not Candela's")))
      assert(!Files.exists(first) && Seq(film, named, target, link).forall(Files.exists(_)))

  test("a planted link is not followed, neither to read nor to write"):
    TempFolder.use: folder =>
      val cache = CacheFolder(folder.resolve("cache"), 1000)
      val file = cache.file("a", CacheFolder.Parts)
      val target = Files.write(folder.resolve("target"), content(50).array)
      for isDangling <- Seq(false, true) do
        if isDangling then Files.delete(target)
        Files.createDirectories(file.getParent)
        Files.deleteIfExists(file): Unit
        Files.createSymbolicLink(file, target): Unit
        intercept[IOException](cache.open(file))
        cache.write(file)(_.write(content(100)): Unit)
        assert(!Files.isSymbolicLink(file) && Files.size(file) == 100)
        assert(if isDangling then !Files.exists(target) else Files.size(target) == 50): Unit

  test("a folder that all users can write in is no cache, and the message says the cure"):
    TempFolder.use: folder =>
      val cache = CacheFolder(folder, 1000)
      val file = cache.file("a", CacheFolder.Parts)
      cache.write(file)(_.write(content(100)): Unit)
      val permissions = Files.getPosixFilePermissions(folder)
      permissions.add(java.nio.file.attribute.PosixFilePermission.OTHERS_WRITE): Unit
      Files.setPosixFilePermissions(folder, permissions): Unit
      for act <- Seq(() => cache.open(file).close(), () => cache.write(file)(_ => ())) do
        assert(intercept[IOException](act()).getMessage.contains(s"chmod o-w $folder")): Unit

  test("many files stay within the limit, and nearly fill it"):
    TempFolder.use: folder =>
      val cache = CacheFolder(folder, 32_000)
      for i <- 0 until 1000 do
        cache.write(cache.file(s"$i", CacheFolder.Parts))(_.write(content(100)): Unit)
        val sizes = TempFolder.names(folder).toVector.map(n => Files.size(folder.resolve(n))).sum
        assert(sizes <= 32_000 && sizes >= Math.min(100 * (i + 1), 28_000)): Unit

  test("a folder that is a file is told as such"):
    TempFolder.use: folder =>
      val taken = Files.writeString(folder.resolve("cache"), "x")
      def why(path: Path) =
        val cache = CacheFolder(path, 1000)
        IoReason(intercept[IOException](cache.write(path.resolve("a"))(_ => ())))
      assert(why(taken) == "there is a file of this name")
      assert(Files.readString(taken) == "x")
