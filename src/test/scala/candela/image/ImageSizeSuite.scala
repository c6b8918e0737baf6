package candela.image

import candela.io.InputFile
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.{TempFolder, TiledExr}

class ImageSizeSuite extends AnyFunSuite:

  private def guess(file: Path): ImageSize = ImageSize.guess(InputFile.named(file)).get

  test("files of most formats tell their size, however well they are packed"):
    TempFolder.use: folder =>
      // Even: a file of a few bytes
      val image = Image.rgb(300, 200)
      for (suffix, isBytes) <- Seq("png" -> true, "jpg" -> true, "exr" -> false) do
        val file = folder.resolve(s"a.$suffix")
        ImageFiles.write(file, image)
        assert(guess(file) == ImageSize(300, 200, 3, isBytes), suffix)

  test("Radiance files say which way their rows run"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.hdr")
      for (size, width, height) <- Seq(("-Y 200 +X 300", 300, 200), ("+X 200 -Y 300", 200, 300)) do
        Files.writeString(file, s"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n$size\n"): Unit
        assert(guess(file) == ImageSize(width, height, 3, isBytes = false))

  test("EXR files with tiles and levels, and of one channel, count what textures take of them"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      TiledExr(512, 256, 64, 64)((_, _, _, _) => 0.5f).write(file): Unit
      assert(guess(file) == ImageSize(512, 256, 3, isBytes = false))
      val grey = folder.resolve("b.exr")
      ImageFiles.write(grey, Image(100, 50, Vector("Y"), new Array[Float](5000)))
      assert(guess(grey) == ImageSize(100, 50, 1, isBytes = false))

  test("a header that is damaged is counted by the length of the file"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      ImageFiles.write(file, Image.rgb(30, 20))
      val bytes = Files.readAllBytes(file).take(100)
      assert(guess(Files.write(file, bytes)) == ImageSize(8, 1, 3, isBytes = false))
