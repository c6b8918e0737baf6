package candela.convert

import candela.image.ImageFiles
import candela.lights.EqualAreaMap
import candela.math.Vec3
import candela.mitsuba.MitsubaScene
import candela.scenefile.Dialect

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

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

  test("a sky becomes a map, brightest around the sun, and a distant light"):
    inFolder: folder =>
      val done = converted(folder, "")
      val Vector(sky, sun) = done.scene.lights.map(_.light): @unchecked
      assert(sky.name == "infinite" && sun.name == "distant")
      assert(done.warnings.exists(_.message.contains("distant light")))
      val map = ImageFiles.read(folder.resolve(sky.param("filename").get.strings.head))
      def seen(x: Float, y: Float, z: Float): Float =
        val place = EqualAreaMap.toImage(Vec3(x, y, z).normalized)
        map((place.x * map.width).toInt, (place.y * map.height).toInt, 1)
      assert(seen(1f, 0.1f, 1f) > 2 * seen(-1f, 0f, 1f))
      assert(seen(-1f, 0f, 1f) > 0f && seen(1f, 0f, -1f) == 0f)

  test("a sky without its sun is a map alone, the sun alone a distant light"):
    inFolder: folder =>
      def names(inside: String) = converted(folder, inside).scene.lights.map(_.light.name)
      assert(names("""<float name="sun_scale" value="0"/>""") == Vector("infinite"))
      assert(names("""<float name="sky_scale" value="0"/>""") == Vector("distant"))
