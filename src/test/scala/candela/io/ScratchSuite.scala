package candela.io

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.attribute.FileTime
import java.nio.file.{Files, Path}

class ScratchSuite extends AnyFunSuite:
  private val temporary = Path.of(sys.props("java.io.tmpdir"))

  private def left(name: String, hasLock: Boolean): Path =
    val folder = Files.createTempDirectory(name)
    val _ = Files.writeString(folder.resolve("copy.exr"), "half")
    if hasLock then
      val _ = Files.createFile(folder.resolve("lock"))
    folder

  test("a scratch folder is gone when it is closed, with all that is in it"):
    val scratch = Scratch.create()
    assert(scratch.folder.getParent == temporary)
    val _ = Files.createDirectories(scratch.folder.resolve("a/b"))
    val _ = Files.writeString(scratch.folder.resolve("a/b/c"), "x")
    scratch.close()
    assert(!Files.exists(scratch.folder))

  test("a folder keeps its lock when the same process makes another one"):
    val locks = Path.of("/proc/locks")
    assume(Files.isReadable(locks), "the system lists no locks")
    val mine = Scratch.create()
    try
      Scratch.create().close()
      val number = Files.getAttribute(mine.folder.resolve("lock"), "unix:ino")
      val own = s" ${ProcessHandle.current.pid} "
      val held = Files.readString(locks).linesIterator.filter(_.contains(own))
      assert(held.exists(_.contains(s":$number ")))
    finally mine.close()

  test("what killed processes have left is removed, and nothing else"):
    val killed = left("candela-scratch-", hasLock = true)
    val young = left("candela-scratch-", hasLock = false)
    val old = left("candela-scratch-", hasLock = false)
    val _ = Files.setLastModifiedTime(old, FileTime.fromMillis(0))
    val foreign = left("other-scratch-", hasLock = true)
    val target = left("linked-", hasLock = true)
    val linked = temporary.resolve(s"candela-scratch-${System.nanoTime}")
    val link = Files.createSymbolicLink(linked, target)
    val mine = Scratch.create()
    val second = Scratch.create()
    try
      for gone <- Vector(killed, old) do assert(!Files.exists(gone), gone)
      for kept <- Vector(young, foreign, target, link, mine.folder) do
        assert(Files.exists(kept), kept)
      assert(Files.exists(target.resolve("copy.exr")))
    finally
      mine.close()
      second.close()
      val _ = Files.delete(link)
      for folder <- Vector(young, foreign, target) do
        for name <- Vector("copy.exr", "lock") do Files.deleteIfExists(folder.resolve(name)): Unit
        Files.delete(folder)
