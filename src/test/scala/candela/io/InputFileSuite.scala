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
      val text = Using.resource(InputFile.asked(pipe).stream())(_.readNBytes(1 << 10))
      assert(String(text) == "Shape \"disk\"")
