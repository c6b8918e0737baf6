package candela.mitsuba

import candela.diagnostics.{SceneError, SourcePos}
import candela.io.InputFile
import candela.color.Rgb
import candela.math.{Transform, Vec3}

import java.nio.file.Files
import java.nio.{ByteBuffer, ByteOrder}

import org.scalatest.funsuite.AnyFunSuite

class VolumesSuite extends AnyFunSuite:

  private def read(size: Seq[Int], channels: Int, values: Float*): VolumeFile =
    val bytes = ByteBuffer.allocate(48 + 4 * values.length).order(ByteOrder.LITTLE_ENDIAN)
    bytes.put("VOL".getBytes("US-ASCII")).put(3.toByte).putInt(1)
    (size :+ channels).foreach(bytes.putInt)
    Seq(0f, 0f, 0f, 2f, 1f, 1f).foreach(bytes.putFloat)
    values.foreach(bytes.putFloat)
    val file = Files.createTempFile("candela", ".vol")
    try
      VolumeFile.read(InputFile.named(Files.write(file, bytes.array)), SourcePos("scene.xml", 1, 1))
    finally Files.delete(file)

  test("a volume may be of bytes, of which 255 is 1"):
    val bytes = ByteBuffer.allocate(51).order(ByteOrder.LITTLE_ENDIAN)
    bytes.put("VOL".getBytes("US-ASCII")).put(3.toByte).putInt(3)
    Seq(3, 1, 1, 1).foreach(bytes.putInt)
    Seq(0f, 0f, 0f, 2f, 1f, 1f).foreach(bytes.putFloat)
    bytes.put(Array(0, 51, -1).map(_.toByte))
    val file = Files.createTempFile("candela", ".vol")
    try
      val read =
        VolumeFile.read(
          InputFile.named(Files.write(file, bytes.array)),
          SourcePos("scene.xml", 1, 1)
        )
      assert(read.values.toVector == Vector(0f, 0.2f, 1f))
    finally Files.delete(file)

  test("a volume whose values are no densities is refused"):
    for value <- Seq(1e30f, Float.NaN, Float.PositiveInfinity) do
      val problem = intercept[SceneError](read(Seq(1, 1, 1), 1, value)).problems.head
      assert(problem.message.endsWith(s"its value $value is damaged"))

  private val unit = Array(0f, 0f, 0f, 1f, 1f, 1f)

  test("a volume has one or three channels"):
    val three = read(Seq(2, 1, 1), 3, 1f, 2f, 3f, 4f, 5f, -6f)
    assert(three.channels == 3 && three.values.toVector == Vector(1f, 2f, 3f, 4f, 5f, 0f))
    assert(three.bounds.toVector == Vector(0f, 0f, 0f, 2f, 1f, 1f))
    def why(body: => Any) = intercept[SceneError](body).problems.head.message
    assert(why(read(Seq(1, 1, 1), 2, 1f, 2f)).contains("it has 2 channels"))
    assert(why(read(Seq(2, 1, 1), 3, 1f, 2f, 3f)).contains("too short"))

  test("extinction is parted into absorption and scattering, cell by cell"):
    val coloured =
      PlacedGrid(read(Seq(2, 1, 1), 3, 1f, 2f, 4f, 8f, 0f, 2f), Transform.Identity, unit)
    val (absorbed, scattered) = coloured.parted(Right(Rgb(0.5f, 0.25f, 1f)))
    assert(scattered.toVector == Vector(0.5f, 0.5f, 4f, 4f, 0f, 2f))
    assert(absorbed.toVector == Vector(0.5f, 1.5f, 0f, 4f, 0f, 0f))

  test("a grid of albedos parts one extinction"):
    val shares =
      PlacedGrid(read(Seq(2, 1, 1), 3, 0.5f, 0.25f, 1f, 1f, 0f, 0.5f), Transform.Identity, unit)
    val (absorbed, scattered) = shares.sharing(Rgb(2f, 4f, 8f))
    assert(scattered.toVector == Vector(1f, 1f, 8f, 2f, 0f, 4f))
    assert(absorbed.toVector == Vector(1f, 3f, 0f, 0f, 4f, 4f))

  test("a grid of albedos is interpolated at the centres of the cells, wherever it lies"):
    val grey = PlacedGrid(read(Seq(4, 1, 1), 1, 1f, 1f, 1f, 1f), Transform.Identity, unit)
    val shares = read(Seq(2, 1, 1), 1, 0f, 1f)
    val same = grey.parted(Left(PlacedGrid(shares, Transform.Identity, unit)))._2
    // Centres at 1/8, 3/8 … between those of the albedos, at 1/4 and 3/4
    assert(same.grouped(3).map(_.head).toVector == Vector(0f, 0.25f, 0.75f, 1f))
    val wide = PlacedGrid(shares, Transform.translate(-0.5f, 0, 0), Array(0f, 0f, 0f, 2f, 1f, 1f))
    assert(wide.toWorld.point(Vec3.Zero).x == -0.5f)
    val spread = grey.parted(Left(wide))._2.grouped(3).map(_.head).toVector
    assert(spread == Vector(0.125f, 0.375f, 0.625f, 0.875f))
