package candela.image

import candela.io.InputFile
import java.awt.image.BufferedImage
import java.io.ByteArrayOutputStream
import java.nio.file.{Files, Path}
import java.util.zip.{CRC32, Deflater}

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.{Draws, TempFolder}

class PngBandsSuite extends AnyFunSuite:

  private def chunk(kind: String, data: Array[Byte]): Array[Byte] =
    val body = kind.getBytes("US-ASCII") ++ data
    val sum = CRC32()
    sum.update(body)
    number(data.length) ++ body ++ number(sum.getValue.toInt)

  private def number(n: Int): Array[Byte] = Array(24, 16, 8, 0).map(s => (n >> s).toByte)

  /** Random bytes with random filters, in several IDAT chunks. */
  private def png(w: Int, h: Int, kind: Int, bits: Int, before: Array[Byte] = Array.empty) =
    val draws = Draws(w + 31 * h + kind)
    val channels = Map(0 -> 1, 2 -> 3, 4 -> 2, 6 -> 4)(kind)
    val rows = Array.fill(h):
      draws.below(5).toByte +: Array.fill(w * channels * bits / 8)(draws.below(256).toByte)
    val deflater = Deflater()
    deflater.setInput(rows.flatten)
    deflater.finish()
    val packed = new Array[Byte](2 * rows.flatten.length + 100)
    val data = packed.take(deflater.deflate(packed))
    val about = number(w) ++ number(h) ++ Array[Byte](bits.toByte, kind.toByte, 0, 0, 0)
    Array[Byte](0x89.toByte, 'P', 'N', 'G', 13, 10, 26, 10) ++ chunk("IHDR", about) ++ before ++
      chunk("tIME", new Array[Byte](7)) ++
      data.grouped(1000).flatMap(chunk("IDAT", _)) ++ chunk("IEND", Array.empty)

  private def written(folder: Path, bytes: Array[Byte]): InputFile =
    InputFile.named(Files.write(folder.resolve("a.png"), bytes))

  private def values(image: StoredImage): Vector[Float] = image match
    case bytes: ByteImage => bytes.bytes.toVector.map(_.toFloat)
    case floats: Image => floats.data.toVector

  test("bands have the pixels of the whole image, with all filters, in any number of passes"):
    TempFolder.use: folder =>
      for
        (w, h) <- Seq((1, 1), (7, 64), (40, 65), (3, 200))
        kind <- Seq(0, 2, 4, 6)
        bits <- Seq(8, 16)
      do
        val file = written(folder, png(w, h, kind, bits))
        val whole = ImageFiles.load(file)
        val bands = ImageBands.ofFile(file).getOrElse(fail("it can't be read in bands"))
        assert((bands.width, bands.height) == (w, h))
        assert(bands.channelNames == whole.channelNames && bands.encoding == whole.encoding)
        assert(bands.isBytes == (bits == 8))
        for _ <- 0 until 2 do
          var found = Vector.empty[Float]
          var next = 0
          bands.visit: (y, band) =>
            assert(y == next && y % ImageBands.Rows == 0)
            next += band.height
            found ++= values(band)
            true
          assert(next == h && found == values(whole), s"$w×$h, type $kind, $bits bits")

  test("a visit ends where it is not to be followed"):
    TempFolder.use: folder =>
      val bands = ImageBands.ofFile(written(folder, png(5, 300, 2, 8))).get
      var seen = 0
      bands.visit: (y, _) =>
        seen += 1
        y < 64
      assert(seen == 2)

  test("files with palettes, transparent colours, few bits, or interlaced are not read in bands"):
    TempFolder.use: folder =>
      val keyed = png(9, 9, 2, 8, chunk("tRNS", new Array[Byte](6)))
      val interlaced = png(9, 9, 2, 8).updated(28, 1.toByte)
      def java(kind: Int) =
        val out = ByteArrayOutputStream()
        javax.imageio.ImageIO.write(BufferedImage(9, 9, kind), "png", out): Unit
        out.toByteArray
      val palette = java(BufferedImage.TYPE_BYTE_INDEXED)
      val bits = java(BufferedImage.TYPE_BYTE_BINARY)
      for other <- Seq(keyed, interlaced, palette, bits, Array[Byte](1, 2, 3), Array.empty[Byte]) do
        assert(ImageBands.ofFile(written(folder, other)).isEmpty)

  test("a size that can't be in the file is not believed"):
    TempFolder.use: folder =>
      val large = png(9, 9, 2, 8)
      number(1 << 20).copyToArray(large, 16)
      number(1 << 20).copyToArray(large, 20)
      assert(ImageBands.ofFile(written(folder, large)).isEmpty)

  test("a file that the whole decode refuses is an ImageError at the latest when it is read"):
    TempFolder.use: folder =>
      val whole = png(30, 100, 2, 8)
      val data = whole.indexOfSlice("IDAT".getBytes("US-ASCII")) - 4
      val second = data + 1012
      val end = whole.length - 12
      def inserted(at: Int, kind: String) = whole.patch(at, chunk(kind, new Array[Byte](6)), 0)
      val begun = Seq(
        "cut in its pixels" -> whole.take(5000),
        "damaged pixels" -> whole.patch(3000, Array.fill(900)(77.toByte), 900),
        "a wrong checksum" -> whole.updated(second - 1, (whole(second - 1) ^ 1).toByte),
        "cut before its end" -> whole.take(end),
        "cut in its end" -> whole.take(end + 4),
        "an unknown chunk between pixels" -> inserted(second, "ABCD"),
        "an unknown chunk after the pixels" -> inserted(end, "ABCD"),
        "a transparent colour between pixels" -> inserted(second, "tRNS")
      )
      for (what, changed) <- begun do
        val file = written(folder, changed)
        intercept[ImageError](ImageFiles.load(file)): Unit
        val bands = ImageBands.ofFile(file).getOrElse(fail(what))
        withClue(s"$what: ")(intercept[ImageError](bands.visit((_, _) => true))): Unit
      val unknown = written(folder, inserted(data, "ABCD"))
      intercept[ImageError](ImageFiles.load(unknown)): Unit
      assert(ImageBands.ofFile(unknown).isEmpty)
