package candela.bidirectional

import candela.guiding.GuidingMode
import candela.image.Image
import candela.integrators.CausticsMode
import candela.render.{Renderer, RenderPlan, ThreadPool}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{BlockMeans, SceneTexts}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** Light that only specular surfaces show to the camera. The emitter is wide, so that paths find it
  * without photons, too.
  */
@org.scalatest.tags.Slow
final class AimPilotSuite extends AnyFunSuite:
  import AimPilotSuite.*

  private def plan(
      mode: CausticsMode,
      text: String,
      seed: Int,
      guiding: GuidingMode,
      threads: Int = 1
  ): RenderPlan =
    val settings = RenderSettings(
      Some(64),
      seed,
      color = ColorMode.Rgb,
      caustics = Some(mode),
      guiding = Some(guiding)
    )
    val pool = ThreadPool(threads)
    SceneTexts.plan(text, Dialect.V4, settings, pool)

  private def image(
      mode: CausticsMode,
      text: String = Water,
      seed: Int = 0,
      guiding: GuidingMode = GuidingMode.Off,
      threads: Int = 2
  ): Image =
    val made = plan(mode, text, seed, guiding, threads)
    Renderer.render(made, threads).image(made.development)

  private def told(text: String): String =
    plan(CausticsMode.Auto, text, 0, GuidingMode.Off).features.toMap.apply("caustics")

  private lazy val glass = Files.readString(Path.of("scenes/v4-caustics-glass.pbrt"))
  private lazy val unguided = image(CausticsMode.Off, seed = 1)

  test("photons guide paths under water, and the mean of each block stays"):
    assert(told(Water).contains("photons guide paths"))
    BlockMeans.assertEqual(image(CausticsMode.Auto), unguided)

  test("paths that learn are guided by photons, too"):
    BlockMeans.assertEqual(image(CausticsMode.Auto, guiding = GuidingMode.On), unguided)

  test("photons reduce the noise of what is seen through water"):
    def noise(mode: CausticsMode): Double =
      val Vector(a, b) =
        Vector(2, 3).map(seed => image(mode, seed = seed).data.map(_.toDouble)): @unchecked
      a.indices.map(i => (a(i) - b(i)) * (a(i) - b(i))).sum
    val ratio = noise(CausticsMode.Auto) / noise(CausticsMode.Off)
    // 0.05 when this was written
    assert(ratio < 0.2, ratio)

  test("guided by photons, an image has the same bits for any number of threads"):
    for text <- Seq(Water, glass) do
      val one = image(CausticsMode.Auto, text, threads = 1)
      assert(image(CausticsMode.Auto, text, threads = 3).data.sameElements(one.data))

  test("beside paths that photons guide, there are as many light paths as suit these"):
    val counts = raw"([\d.]+) light paths per camera sample".r
    val all = counts.findAllMatchIn(told(glass)).map(_.group(1).toDouble).toVector
    // Unguided paths leave more noise than light paths can take away; guided ones do not
    val Vector(beforePhotons, withPhotons) = all: @unchecked
    assert(withPhotons > beforePhotons, all)

  test("where no specular surface shows a caustic, there are no photons"):
    val above = Water.replace("LookAt 0 3 -6  0 .2 0", "LookAt 0 3 -6  0 6 9")
    assert(told(above).startsWith("none") && !told(above).contains("guide"))

private object AimPilotSuite:
  /** A pool with a wavy surface, under an emitter. */
  val Water: String = """
      LookAt 0 3 -6  0 .2 0  0 1 0
      Camera "perspective" "float fov" 30
      Film "rgb" "integer xresolution" 32 "integer yresolution" 32
      PixelFilter "box" "float xradius" .5 "float yradius" .5
      Sampler "independent"
      Integrator "path" "integer maxdepth" 6
      WorldBegin
      AttributeBegin
      Translate 1 4 .5
      Rotate 90 1 0 0
      AreaLightSource "diffuse" "rgb L" [12 10 8]
      Shape "disk" "float radius" .7
      AttributeEnd
      Material "diffuse" "rgb reflectance" [.5 .5 .6]
      Shape "trianglemesh" "point3 P" [-5 0 -5  5 0 -5  5 0 5  -5 0 5]
        "integer indices" [0 1 2 0 2 3]
      Material "dielectric" "float eta" 1.33
      Shape "trianglemesh" "point3 P" [-5 .8 -5  5 .8 -5  5 .8 5  -5 .8 5]
        "normal N" [-.1 1 0  .2 1 0  0 1 .2  -.1 1 .1] "integer indices" [0 2 1 0 3 2]
    """
