package candela.convert

import candela.color.Rgb
import candela.image.{Image, ImageFiles}
import candela.lights.{EqualAreaMap, SkyModel, SunAndSky}
import candela.math.Vec3
import candela.mitsuba.MitsubaScene
import candela.scenefile.Dialect

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class SunskyLightsSuite extends AnyFunSuite:

  private def inFolder[A](use: Path => A): A =
    val folder = Files.createTempDirectory("candela-sky")
    try use(folder)
    finally
      folder.toFile.listFiles.foreach(_.delete())
      Files.delete(folder)

  private def converted(folder: Path, inside: String): Converted =
    val file = folder.resolve("sky.xml")
    Files.writeString(
      file,
      s"""<scene version="3.0.0"><sensor type="perspective"/><emitter type="sunsky">
        <vector name="sun_direction" x="1" y="0" z="1"/>$inside</emitter></scene>"""
    )
    val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
    Converter.convert(scene, Dialect.V4, folder)

  test("a sky becomes a map, brightest around the sun, and the sun another", Slow):
    inFolder: folder =>
      val done = converted(folder, "")
      val Vector(sky, sun) = done.scene.lights.map(_.light): @unchecked
      assert(sky.name == "infinite" && sun.name == "infinite")
      assert(done.warnings.exists(_.message.contains("blur its edge")))
      val map = ImageFiles.read(folder.resolve(sky.param("filename").get.strings.head))
      def seen(x: Float, y: Float, z: Float): Float =
        val place = EqualAreaMap.toImage(Vec3(x, y, z).normalized)
        map((place.x * map.width).toInt, (place.y * map.height).toInt, 1)
      assert(seen(1f, 0.1f, 1f) > 2 * seen(-1f, 0f, 1f))
      assert(seen(-1f, 0f, 1f) > 0f && seen(1f, 0f, -1f) == 0f)

  test("the sky or the sun alone is one map", Slow):
    inFolder: folder =>
      def files(inside: String) =
        converted(folder, inside).scene.lights.map(_.light.param("filename").get.strings.head)
      val Vector(sky) = files("""<float name="sun_scale" value="0"/>"""): @unchecked
      val Vector(sun) = files("""<float name="sky_scale" value="0"/>"""): @unchecked
      assert(sky.startsWith("sky-") && sun.startsWith("sun-"))

  private val toSun = Vec3(0.48f, -0.6f, 0.64f)

  private def irradiance(image: Image, scale: Float): Rgb =
    val pixel = 4 * Math.PI / (image.width.toDouble * image.height)
    val sums = (0 to 2).map(c => image.data.indices.by(3).map(i => image.data(i + c).toDouble).sum)
    Rgb(sums(0).toFloat, sums(1).toFloat, sums(2).toFloat) * (scale * pixel).toFloat

  test("the sun's map has the sun's irradiance, at its place", Slow):
    val expected = Rgb(1.5f, 1f, 0.5f)
    val (image, scale) = SunImage(toSun, 0.5358f, expected)
    assert((irradiance(image, scale) - expected).map(Math.abs(_)).max < 1e-5f)
    assert(image.data.max <= 1f)
    val lit = image.data.indices.by(3).filter(i => image.data(i) > 0f).map(_ / 3)
    val side = image.width
    assert(lit.nonEmpty && lit.forall: i =>
      val d = EqualAreaMap.toDirection((i % side + 0.5f) / side, (i / side + 0.5f) / side)
      (d - toSun).length < 0.0047f + SunImage.PixelAngle)

  test("half of a sun at the horizon is dark"):
    val (image, scale) = SunImage(Vec3.Y, 2f, Rgb.White)
    // The horizon crosses 160 of the disk's 20,000 directions, half of which are 0.4 %
    assert(Math.abs(irradiance(image, scale).r - 0.5f) < 0.005f)

  test("half of a pixel of the sky at the horizon is dark"):
    val model = SkyModel(3f, Rgb.gray(0.3f), 0.6f)
    def mean(parts: Int) =
      val sky = SunAndSky.picture(model, toSun, 32, 32, EqualAreaMap, parts)
      sky.data.foldLeft(0.0)(_ + _)
    // Four directions a pixel for its mean; whole pixels at the horizon would add 6 %
    assert(Math.abs(mean(2) / mean(16) - 1) < 0.02)
