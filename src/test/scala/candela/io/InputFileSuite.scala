package candela.io

import candela.testing.{Pipes, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

import scala.util.Using

class InputFileSuite extends AnyFunSuite:

  test("a pipe is read to its end, in whatever pieces its text comes"):
    TempFolder.use: folder =>
      val pipe = folder.resolve("pipe")
      assume(Pipes.make(pipe), "needs mkfifo")
      val writer = Thread: () =>
        Using.resource(Files.newOutputStream(pipe)): out =>
          for piece <- Vector("Shape", " \"disk", "\"") do
            out.write(piece.getBytes)
            out.flush()
            Thread.sleep(20)
      writer.setDaemon(true)
      writer.start()
      val text = Using.resource(InputFile.named(pipe).stream())(_.readNBytes(1 << 10))
      assert(String(text) == "Shape \"disk\"")

  private val pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:7\nsize 190001066\n"

  test("a pointer of Git LFS is named as one, however it is read"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("mesh.ply"), pointer)
      val reads = Vector[InputFile => Any](
        _.bytes(), _.text(), _.stream(), _.channel(), _.map(), _.beginning(4), _.again()
      )
      for (read, i) <- reads.zipWithIndex do
        val e = intercept[java.io.IOException](read(InputFile.named(file)))
        assert(e.getMessage.contains("git lfs pull"), s"read $i")
      assert(!InputFile.named(file).isPipe)
      val (message, _) = SceneFolder(folder).absence("mesh.ply", None, "no such file")
      assert(SceneFolder(folder).locate("mesh.ply", None).isEmpty && message.contains("Git LFS"))

  test("a larger file that begins like a pointer of Git LFS is read"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a"), pointer + " " * 1024)
      assert(InputFile.named(file).bytes().length > 1024)
