package candela.mitsuba

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.render.Renderer
import candela.scenefile.SceneDescription
import candela.settings.RenderSettings

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** Small scenes of Mitsuba 0.6. */
abstract class OldScenes extends AnyFunSuite:

  protected def using[A](body: String, version: String, files: (String, Array[Byte])*)(
      use: SceneDescription => A
  ): A =
    val folder = Files.createTempDirectory("candela-old")
    val scene =
      Files.writeString(folder.resolve("s.xml"), s"<scene version=\"$version\">$body</scene>")
    val others = files.map((name, bytes) => Files.write(folder.resolve(name), bytes))
    try use(MitsubaScene.readable(scene, Map.empty, keepGoing = false))
    finally
      (scene +: others).foreach(Files.delete)
      Files.delete(folder)

  protected def sensor(kind: String = "perspective", more: String = "", film: String = "") =
    s"""<sensor type="$kind"><transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0"
      up="0,1,0"/></transform>$more<sampler type="independent">
      <integer name="sampleCount" value="64"/></sampler><film type="hdrfilm">$film
      <integer name="width" value="8"/><integer name="height" value="8"/><rfilter type="box"/>
      </film></sensor>"""

  protected val fov = "<float name=\"fov\" value=\"40\"/>"

  /** Without errors. */
  protected def warnings(body: String, version: String = "0.6.0"): Vector[String] =
    using(body, version): scene =>
      assert(scene.errors.isEmpty, scene.errors)
      scene.warnings.map(_.message)

  /** RGB of each pixel. */
  protected def pixels(
      body: String,
      version: String,
      files: (String, Array[Byte])*
  ): Vector[Rgb] =
    using(body, version, files*): scene =>
      assert(scene.errors.isEmpty, scene.errors)
      val plan = SceneBuilder.build(scene, RenderSettings())._1
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      val n = image.channels
      Vector.tabulate(image.data.length / n): i =>
        Rgb(image.data(n * i), image.data(n * i + 1), image.data(n * i + 2))

  protected def mean(body: String, version: String = "0.6.0", files: (String, Array[Byte])*): Rgb =
    val all = pixels(body, version, files*)
    all.reduce(_ + _) * (1f / all.size)

  protected def isNear(found: Rgb, right: Rgb, relative: Float): Unit =
    for (a, b) <- Seq(found.r -> right.r, found.g -> right.g, found.b -> right.b) do
      assert(Math.abs(a - b) <= relative * b, s"$found, not $right")

  protected val box = "<shape type=\"cube\"/><emitter type=\"constant\"/>"
