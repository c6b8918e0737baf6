package candela.base

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.TempFolder

class CacheFolderSuite extends AnyFunSuite:

  test("the user's cache folder is the one that the system names"):
    def usual(variables: (String, String)*) = CacheFolder.usual(variables.toMap).map(_.toString)
    val root = Path.of("").toAbsolutePath.getRoot.resolve("x")
    val tail = Path.of("candela", "textures")
    assert(usual("XDG_CACHE_HOME" -> s"$root", "HOME" -> "/h").contains(s"${root.resolve(tail)}"))
    assert(usual("HOME" -> s"$root").contains(s"${root.resolve(".cache").resolve(tail)}"))
    assert(usual("LOCALAPPDATA" -> s"$root").contains(s"${root.resolve(tail)}"))
    assert(usual("XDG_CACHE_HOME" -> "relative").isEmpty && usual().isEmpty)

  test("a limit that has become less makes room before the next file is written"):
    TempFolder.use: folder =>
      def file(name: String) = folder.resolve(name + CacheFolder.Parts)
      val roomy = CacheFolder(folder, 1000)
      for name <- Seq("a", "b") do
        roomy.write(file(name))(_.write(ByteBuffer.allocate(100)): Unit)
      assert(Seq("a", "b").forall(n => Files.exists(file(n))))
      intercept[IOException]:
        CacheFolder(folder, 150).write(file("c")): _ =>
          assert(Seq("a", "b").count(n => Files.exists(file(n))) == 1)
          throw IOException("no space left")
      assert(!Files.exists(file("c")))

  test("a folder that is a file is told as such"):
    TempFolder.use: folder =>
      val taken = Files.writeString(folder.resolve("cache"), "x")
      def why(path: Path) =
        val cache = CacheFolder(path, 1000)
        IoReason(intercept[IOException](cache.write(path.resolve("a"))(_ => ())))
      assert(why(taken) == "there is a file of this name")
      assert(Files.readString(taken) == "x")
