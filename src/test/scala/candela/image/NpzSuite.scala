package candela.image

import org.scalatest.funsuite.AnyFunSuite

import java.io.ByteArrayInputStream
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_8}
import java.nio.{ByteBuffer, ByteOrder}
import java.util.zip.ZipInputStream

class NpzSuite extends AnyFunSuite:

  private def entries(file: Array[Byte]): Map[String, Array[Byte]] =
    val zip = ZipInputStream(ByteArrayInputStream(file))
    Iterator.continually(zip.getNextEntry).takeWhile(_ != null)
      .map(e => e.getName -> zip.readAllBytes()).toMap

  /** The header of an array, and its values. */
  private def array(bytes: Array[Byte]): (String, Vector[Float]) =
    assert(String(bytes, 1, 5, ISO_8859_1) == "NUMPY" && (bytes(0) & 0xff) == 0x93)
    val all = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
    val end = 10 + all.getShort(8)
    assert(end % 64 == 0 && bytes(end - 1) == '\n')
    val values = all.position(end).slice.order(ByteOrder.LITTLE_ENDIAN).asFloatBuffer
    (String(bytes, 10, end - 10, ISO_8859_1).trim, Vector.fill(values.remaining)(values.get))

  private def written(image: Image, texts: Vector[(String, String)] = Vector.empty) =
    Npz.write(image, texts, WriteOptions())

  test("each group of channels is an array of floats, rows from the top"):
    val image = Samples.random(3, 2, Vector("R", "G", "B", "A", "N.X", "N.Y", "N.Z", "Z"), 1)
    val found = entries(written(image))
    assert(found.keySet ==
      Set("rgb.npy", "alpha.npy", "N.npy", "Z.npy", "metadata.json"))
    val (header, values) = array(found("N.npy"))
    assert(header == "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 3), }")
    assert(values == Vector.tabulate(18)(i => image(i / 3 % 3, i / 9, 4 + i % 3)))
    assert(array(found("alpha.npy"))(0).contains("'shape': (2, 3), "))

  test("metadata are JSON, with the names of the channels and every text as it is"):
    val text = "a \"b\" \\ c\nd é"
    val found = entries(written(Samples.random(1, 1, Image.RgbNames, 1), Vector("scene" -> text)))
    val json = ujson.read(String(found("metadata.json"), UTF_8))
    assert(json("texts")("scene").str == text)
    assert(json("channels")("rgb").arr.map(_.str).toVector == Image.RgbNames)

  test("equal images are equal files, and a file cut short has no end"):
    val image = Samples.random(9, 7, Image.RgbNames, 2)
    val file = written(image)
    assert(file.sameElements(written(image)))
    assert(Npz.hasEnd(file) && !Npz.hasEnd(file.dropRight(1)))

  test("display values are decoded: arrays are linear light"):
    val bytes = ByteImage(1, 1, Image.RgbNames, Array(0, -1, -1), candela.color.Encoding.Srgb)
    val (_, values) = array(entries(written(bytes.toImage))("rgb.npy"))
    assert(values == Vector(0f, 1f, 1f))
