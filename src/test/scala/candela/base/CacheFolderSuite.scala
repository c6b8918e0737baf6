package candela.base

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class CacheFolderSuite extends AnyFunSuite:

  test("the user's cache folder is the one that the system names"):
    def usual(variables: (String, String)*) = CacheFolder.usual(variables.toMap).map(_.toString)
    val root = Path.of("").toAbsolutePath.getRoot.resolve("x")
    val tail = Path.of("candela", "textures")
    assert(usual("XDG_CACHE_HOME" -> s"$root", "HOME" -> "/h").contains(s"${root.resolve(tail)}"))
    assert(usual("HOME" -> s"$root").contains(s"${root.resolve(".cache").resolve(tail)}"))
    assert(usual("LOCALAPPDATA" -> s"$root").contains(s"${root.resolve(tail)}"))
    assert(usual("XDG_CACHE_HOME" -> "relative").isEmpty && usual().isEmpty)
