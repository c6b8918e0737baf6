package candela.io

import org.scalatest.funsuite.AnyFunSuite

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.file.StandardOpenOption.WRITE
import java.nio.file.{Files, Path}

import scala.util.Using

import candela.testing.{Pipes, TempFolder}

class WholeFileSuite extends AnyFunSuite:

  private def bytes(path: Path) = Files.readAllBytes(path).toVector

  test("what is written takes the place of what was there"):
    TempFolder.use: folder =>
      val path = folder.resolve("a")
      WholeFile.write(path, Array[Byte](1, 2))
      WholeFile.write(path, Array[Byte](3))
      assert(bytes(path) == Vector(3))
      assert(TempFolder.names(folder) == Set("a"))

  test("parts of any size are written in order, as much as remains of each"):
    TempFolder.use: folder =>
      val file = folder.resolve("parts.bin")
      val long = Array.tabulate((1 << 21) + 3)(i => (i * 31 >> 3).toByte)
      val few = ByteBuffer.wrap(Array[Byte](1, 2, 3, 4)).position(1).limit(3)
      WholeFile.write(file, Vector(few, ByteBuffer.allocate(0), ByteBuffer.wrap(long)))
      assert(Files.readAllBytes(file).sameElements(Array[Byte](2, 3) ++ long))

  test("a write that fails leaves what was there, and nothing else, and names the file"):
    TempFolder.use: folder =>
      val path = folder.resolve("a")
      WholeFile.write(path, Array[Byte](1, 2))
      val error = intercept[IOException]:
        WholeFile.write(path): channel =>
          val _ = channel.write(ByteBuffer.wrap(Array[Byte](3)))
          throw IOException("No space left on device")
      assert(error.getMessage == s"can't write `$path`: No space left on device")
      assert(bytes(path) == Vector(1, 2))
      intercept[WriteError](WholeFile.write(folder, Array[Byte](1)))
      assert(TempFolder.names(folder) == Set("a"))

  test("the target of a link is replaced, and the link stays: of a chain, relative or dangling"):
    TempFolder.use: folder =>
      val file = Files.createDirectory(folder.resolve("far")).resolve("a")
      val link = Files.createSymbolicLink(folder.resolve("link"), Path.of("far", "a"))
      val second = Files.createSymbolicLink(folder.resolve("second"), link)
      for (path, i) <- Vector(link, second, file, second).zipWithIndex do
        WholeFile.write(path, Array[Byte](i.toByte))
        assert(bytes(file) == Vector(i))
      assert(Files.isSymbolicLink(link) && Files.isSymbolicLink(second))
      assert(TempFolder.names(folder.resolve("far")) == Set("a"))

  test("links in a circle are refused"):
    TempFolder.use: folder =>
      val one = folder.resolve("one")
      val _ = Files.createSymbolicLink(folder.resolve("two"), one)
      val _ = Files.createSymbolicLink(one, folder.resolve("two"))
      val error = intercept[WriteError](WholeFile.write(one, Array[Byte](1)))
      assert(error.getMessage == s"can't write `$one`: too many levels of symbolic links")

  test("a device is written to, and stays one"):
    val device = Path.of("/dev/null")
    assume(Files.exists(device), "needs /dev/null")
    WholeFile.write(device, Array[Byte](1))
    assert(!Files.isRegularFile(device))
    val full = Path.of("/dev/full")
    assume(Files.exists(full), "needs /dev/full")
    val error = intercept[WriteError](WholeFile.write(full, Array[Byte](1)))
    assert(error.getMessage == "can't write `/dev/full`: No space left on device")

  test("what a killed run has left of the file is removed; what others are writing is not"):
    TempFolder.use: folder =>
      val path = folder.resolve("a")
      def left(of: Path, owner: Long) =
        val beginning = f".candela-${of.getFileName.toString.hashCode}%08x-"
        Files.write(folder.resolve(s"$beginning$owner-1.tmp"), Array[Byte](1)).getFileName.toString
      val dead = left(path, Int.MaxValue.toLong)
      val ofAnother = left(folder.resolve("b"), Int.MaxValue.toLong)
      val ours = left(path, ProcessHandle.current.pid)
      val locked = left(path, Int.MaxValue.toLong - 1)
      Using.resource(FileChannel.open(folder.resolve(locked), WRITE)): channel =>
        val _ = channel.lock()
        WholeFile.write(path, Array[Byte](1))
      assert(TempFolder.names(folder) == Set("a", ofAnother, ours, locked))
      assert(!Files.exists(folder.resolve(dead)))

  test("a pipe or a link with the name of what a killed run leaves is left alone"):
    TempFolder.use: folder =>
      val path = folder.resolve("a")
      val beginning = f".candela-${"a".hashCode}%08x-${Int.MaxValue}-"
      val pipe = folder.resolve(s"${beginning}1.tmp")
      assume(Pipes.make(pipe), "needs mkfifo")
      val link = Files.createSymbolicLink(folder.resolve(s"${beginning}2.tmp"), pipe)
      Pipes.unblocked(WholeFile.write(path, Array[Byte](1)))
      assert(bytes(path) == Vector(1) && Files.exists(pipe) && Files.isSymbolicLink(link))

  test("a name as long as the file system allows can be written, a longer one is an obstacle"):
    TempFolder.use: folder =>
      val longest = folder.resolve("x" * 255)
      assert(WholeFile.obstacle(longest).isEmpty)
      WholeFile.write(longest, Array[Byte](1))
      assert(Files.exists(longest))
      assert(WholeFile.obstacle(folder.resolve("x" * 256)).contains("File name too long"))

  test("a folder, and a folder that is not there, are obstacles"):
    TempFolder.use: folder =>
      assert(WholeFile.obstacle(folder).contains("it is a folder"))
      val nowhere = folder.resolve("no")
      assert(WholeFile.obstacle(nowhere.resolve("a")).contains(s"no such folder: `$nowhere`"))
      assert(TempFolder.names(folder).isEmpty)

  test("a file that is replaced keeps its permissions"):
    TempFolder.use: folder =>
      import java.nio.file.attribute.PosixFilePermissions.{fromString, toString as shown}
      val path = Files.write(folder.resolve("a"), Array[Byte](1))
      val isPosix = Files.getFileStore(folder).supportsFileAttributeView("posix")
      assume(isPosix, "needs POSIX permissions")
      val _ = Files.setPosixFilePermissions(path, fromString("rw-r-----"))
      WholeFile.write(path, Array[Byte](2))
      assert(shown(Files.getPosixFilePermissions(path)) == "rw-r-----")
