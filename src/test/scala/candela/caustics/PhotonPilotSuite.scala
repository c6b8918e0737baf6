package candela.caustics

import candela.aov.Layer
import candela.film.Fireflies
import candela.image.Image
import candela.integrators.CausticsMode
import candela.render.{Renderer, RenderPlan, ThreadPool}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

/** Which scenes take caustics from photons. */
final class PhotonPilotSuite extends AnyFunSuite:
  import CausticTracerSuite.{GlassBall, Small, emitter, scene}

  private def settings(mode: CausticsMode, spp: Int = 1, seed: Int = 0) =
    RenderSettings(Some(spp), seed, color = ColorMode.Rgb, caustics = Some(mode))

  private def plan(text: String, settings: RenderSettings, threads: Int = 2): RenderPlan =
    SceneTexts.plan(text, Dialect.V4, settings, ThreadPool(threads))

  private def plan(text: String, mode: CausticsMode): RenderPlan = plan(text, settings(mode))

  private def told(plan: RenderPlan): String = plan.features.toMap.apply("caustics")

  private def takesPhotons(plan: RenderPlan): Boolean = plan.method.blurs

  private def image(plan: RenderPlan, threads: Int = 2): Image =
    Renderer.render(plan, threads).image(plan.development)

  /** A pool with a wavy surface, under an emitter: paths meet it by chance alone. */
  private val water =
    """LookAt 0 3 -6  0 .2 0  0 1 0
       Camera "perspective" "float fov" 30
       Film "rgb" "integer xresolution" 32 "integer yresolution" 32
       PixelFilter "box" "float xradius" .5 "float yradius" .5
       Sampler "independent"
       Integrator "path" "integer maxdepth" 6
       WorldBegin
       AttributeBegin
       Translate 1 4 .5
       Rotate 90 1 0 0
       AreaLightSource "diffuse" "rgb L" [588 490 392]
       Shape "disk" "float radius" .1
       AttributeEnd
       Material "diffuse" "rgb reflectance" [.5 .5 .6]
       Shape "trianglemesh" "point3 P" [-5 0 -5  5 0 -5  5 0 5  -5 0 5]
         "integer indices" [0 1 2 0 2 3]
       Material "dielectric" "float eta" 1.33
       Shape "trianglemesh" "point3 P" [-5 .8 -5  5 .8 -5  5 .8 5  -5 .8 5]
         "normal N" [-.1 1 0  .2 1 0  0 1 .2  -.1 1 .1] "integer indices" [0 2 1 0 3 2]
    """

  test("photons are taken where they pay"):
    val made = plan(water, CausticsMode.Auto)
    assert(takesPhotons(made), told(made))
    assert(told(made).contains("the pilot expects"))

  test("photons reduce the noise of a caustic under water"):
    def noise(mode: CausticsMode): Double =
      val Vector(a, b) = Vector(0, 1).map: seed =>
        image(plan(water, settings(mode, 16, seed))).data.map(_.toDouble): @unchecked
      a.indices.map(i => (a(i) - b(i)) * (a(i) - b(i))).sum
    val ratio = noise(CausticsMode.Auto) / noise(CausticsMode.Off)
    assert(ratio < 0.2, ratio)

  test("the choice and the image are the same for any number of threads"):
    def made(threads: Int) = plan(water, settings(CausticsMode.Auto, 4), threads)
    assert(told(made(1)) == told(made(3)))
    assert(image(made(3), threads = 3).data.sameElements(image(made(1), threads = 1).data))

  test("where paths find a large emitter well, there are no photons"):
    val text = scene(GlassBall, emitter(1.2f))
    val made = plan(text, CausticsMode.Auto)
    assert(told(made).startsWith("none: the pilot expects"), told(made))
    assert(image(made).data.sameElements(image(plan(text, CausticsMode.Off)).data))
    assert(takesPhotons(plan(text, CausticsMode.Photons)))

  test("where the camera sees no caustic, there are no photons"):
    // The ball is behind the camera, and its light falls there
    val text = scene("""Translate 0 0 -30 Material "dielectric" Shape "sphere" "float radius" .5""")
    val made = plan(text, CausticsMode.Auto)
    assert(told(made).startsWith("none: "))
    assert(image(made).data.sameElements(image(plan(text, CausticsMode.Off)).data))

  test("where photons can't be used, auto takes light paths"):
    val divided = settings(CausticsMode.Auto).copy(layers = Vector(Layer.Indirect))
    val limited = settings(CausticsMode.Auto).copy(fireflies = Fireflies.Clamped(2f))
    val reweighted = settings(CausticsMode.Auto).copy(fireflies = Fireflies.Reweighted)
    for s <- Seq(divided, limited, reweighted) do
      assert(told(plan(Small, s)).contains("light paths per camera sample"))

  test("the better is taken, light paths if photons are little better"):
    def of(work: Double, pays: Boolean) = PilotResult(None, work, pays, s"$work")
    val (good, fair, poor) = (of(0.1, true), of(0.15, true), of(1.0, false))
    for (mine, other, better) <- Seq(
        (good, fair, good),
        (fair, good, fair),
        (of(0.3, true), good, good),
        (poor, fair, fair),
        (fair, poor, fair)
      )
    do assert(mine.better(other, margin = 2.0) == better)
    assert(poor.better(of(2.0, false), margin = 2.0).result == (None, "none: 1.0; 2.0"))
