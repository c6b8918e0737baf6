package candela.build

import candela.job.{CameraFile, Render}
import candela.render.{Renderer, RenderPlan}
import candela.scenefile.{Resolution, SceneDescription}
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Path

/** A scene that was built for one camera is rendered for another as if it were built for that. */
class BuiltSceneSuite extends AnyFunSuite:

  /** Textures over footprints, media, volumes, light paths, AOVs, wavelengths, motion. */
  private val scenes = Vector(
    "v2-textures", "v2-volumes", "v3-filtered-floor", "v3-fog", "v3-bdpt-caustic", "v3-motion",
    "v4-dispersion", "v4-bdpt-media", "v4-gbuffer", "v4-mlt", "showcase"
  )

  private def pixels(plan: RenderPlan): Seq[Float] =
    Renderer.render(plan, 1).image(plan.development).data.toSeq

  for name <- scenes do
    test(s"$name looks the same from elsewhere, whether it was built for that or not"):
      val reading = ReadSettings(resolution = Some(Resolution.Size(20, 12)))
      val settings = RenderSettings(samples = Some(2), reading = reading)
      val scene = Render.read(Path.of(s"scenes/$name.pbrt"), reading, BuildControl())
      // Shapes that move do so while the shutter of the camera is open
      val camera = if name == "v3-motion" then "" else "Camera \"perspective\" \"float fov\" 40"
      val view = s"LookAt 1 -7 4  0 0 .6  0 0 1\n$camera"
      val elsewhere = CameraFile.ofText(scene, "camera", view)
      def built(description: SceneDescription) =
        Render.build(description, settings, BuildControl())
      val (first, second) = (built(scene), built(elsewhere))
      try
        val seen = first.built.get.seenAs(elsewhere, settings).get
        assert(pixels(seen) == pixels(second.built.get.plan))
        assert(pixels(seen) != pixels(first.built.get.plan))
        val small = settings.copy(reading =
          reading.copy(resolution = Some(Resolution.Size(5, 3)))
        )
        val plan = first.built.get.seenAs(elsewhere, small).get
        assert((plan.width, plan.height) == (5, 3) && pixels(plan).nonEmpty)
      finally
        first.close()
        second.close()

  test("a scene around whose camera the world is built is built again for a distant one"):
    val text = "LookAt 5e6 5e6 9  5e6 5e6 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n" +
      "LightSource \"infinite\"\nTranslate 5e6 5e6 0\nShape \"sphere\"\n"
    val settings = RenderSettings(samples = Some(1))
    val scene = Render.readText(Path.of("a.pbrt"), text, settings.reading, BuildControl())
    val prepared = Render.build(scene, settings, BuildControl())
    try
      def seen(view: String) =
        prepared.built.get.seenAs(CameraFile.ofText(scene, "camera", view), settings)
      assert(!prepared.built.get.origin.isOrigin)
      assert(seen("LookAt 5e6 5e6 8  5e6 5e6 0  0 1 0").isDefined)
      assert(seen("LookAt 0 0 9  0 0 0  0 1 0").isEmpty)
    finally prepared.close()
