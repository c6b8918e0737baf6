package candela.bidirectional

import candela.film.Fireflies
import candela.guiding.GuidingMode
import candela.image.Image
import candela.integrators.CausticsMode
import candela.render.{Renderer, RenderPlan}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{BlockMeans, SceneTexts}

import org.scalatest.funsuite.AnyFunSuite

/** Light paths from emitters, which bring what fog scatters close to these. Bidirectional path
  * tracing finds it with little noise, too, by weights of its own.
  */
@org.scalatest.tags.Slow
final class EmitterPathsSuite extends AnyFunSuite:
  import CausticTracerSuite.{GlassBall, inFog, emitter, scene}

  private def plan(
      text: String,
      mode: CausticsMode,
      seed: Int = 0,
      color: ColorMode = ColorMode.Rgb,
      guiding: GuidingMode = GuidingMode.Off
  ): RenderPlan =
    val settings = RenderSettings(
      Some(96),
      seed,
      color = color,
      caustics = Some(mode),
      guiding = Some(guiding)
    )
    SceneTexts.plan(text, Dialect.V4, settings)

  private def image(plan: RenderPlan, threads: Int = 2): Image =
    Renderer.render(plan, threads).image(plan.development)

  private def told(plan: RenderPlan): String = plan.features.toMap.apply("caustics")

  private val thick = "[.9 .6 .3]"
  private val rough = GlassBall.replace("dielectric\"", "dielectric\" \"float roughness\" .05")

  /** A ball of fog, and no other. */
  private def inBall(text: String): String = text
    .replace(
      "WorldBegin",
      s"""WorldBegin
         MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" $thick
         "rgb sigma_a" [.02 .02 .02] "float g" .4
         AttributeBegin
         MediumInterface "fog" ""
         Material "interface" Translate 0 .5 0 Shape "sphere" "float radius" 1.8
         AttributeEnd
         """
    )
    .replace("Translate 0 .7 0", "Translate 0 .7 0 MediumInterface \"\" \"fog\"")
    .replace("\"path\"", "\"volpath\"")

  private val point = """LightSource "point" "rgb I" [3 3 3] "point3 from" [.5 1.6 -.4]"""
  private val spot = """LightSource "spot" "rgb I" [9 9 9] "point3 from" [1 1.6 -.4]
    "point3 to" [0 .6 0] "float coneangle" 40 "float conedeltaangle" 20"""
  private val within = s"""AttributeBegin MediumInterface "" "fog"
    Translate -.2 -1.2 -.6 ${emitter(0.03f)} AttributeEnd"""
  private val sun =
    """LightSource "distant" "rgb L" [2 2 2] "point3 from" [.3 1 -.5] "point3 to" [0 0 0]"""
  private val sky = """LightSource "infinite" "rgb L" [.5 .6 .8]"""

  private val scenes = Vector(
    "an emitter in fog" -> inFog(scene(GlassBall, emitter(0.03f)), thick),
    "an emitter in a ball of fog" -> inBall(scene(GlassBall, within)),
    "a point and a spot beside rough glass" -> inFog(scene(rough, s"$point\n$spot"), thick),
    "sun and sky beside rough glass" -> inBall(scene(rough, s"$within\n$sun\n$sky"))
  )

  for (what, text) <- scenes do
    test(s"with light paths from emitters the mean of each block stays: $what"):
      val made = plan(text, CausticsMode.On)
      assert(told(made).contains("from emitters"))
      BlockMeans.assertEqual(image(made), image(both(text)))

  /** Bidirectional path tracing of the scene. */
  private def both(text: String): RenderPlan =
    plan(text.replace("\"volpath\"", "\"bdpt\""), CausticsMode.Off, seed = 1)

  test("beside guided paths, too"):
    val text = scenes.head._2
    val made = plan(text, CausticsMode.On, guiding = GuidingMode.On)
    assert(told(made).contains("from emitters"))
    BlockMeans.assertEqual(image(made), image(both(text)))

  test("and in colours that glass disperses"):
    val glass = GlassBall.replace("dielectric\"", "dielectric\" \"spectrum eta\" \"glass-F11\"")
    val text = inFog(scene(glass, emitter(0.03f)), thick)
    val made = plan(text, CausticsMode.On, color = ColorMode.Spectral)
    assert(told(made).contains("from emitters"))
    val off = plan(text, CausticsMode.Off, seed = 1, color = ColorMode.Spectral)
    BlockMeans.assertEqual(image(made), image(off))

  test("they reduce the noise of fog around a small emitter, for any number of threads the same"):
    val near = s"AttributeBegin Translate -.1 -1.2 -.5 ${emitter(0.004f)} AttributeEnd"
    val text = inFog(scene(GlassBall, near), "[1.5 1 .6]")
    def noise(mode: CausticsMode): Double =
      val Vector(a, b) =
        // Reflections of the emitter are those of paths alone
        Vector(0, 1).map: seed =>
          image(plan(text, mode, seed)).data.map(x => Math.min(x.toDouble, 2.0)): @unchecked
      a.indices.map(i => (a(i) - b(i)) * (a(i) - b(i))).sum
    assert(told(plan(text, CausticsMode.On)).contains("from emitters"))
    val ratio = noise(CausticsMode.On) / noise(CausticsMode.Off)
    assert(ratio < 0.6, ratio)
    val one = image(plan(text, CausticsMode.On), threads = 1)
    assert(image(plan(text, CausticsMode.On), threads = 3).data.sameElements(one.data))

  test("none begin where light from infinity passes fog without end"):
    assert(!told(plan(inFog(scene(GlassBall, s"${emitter(0.03f)}\n$sun"), thick), CausticsMode.On))
      .contains("from emitters"))

  test("none begin where light is limited that was scattered more than once"):
    val text = scenes.head._2
    def limited(limit: Option[Float]) =
      val settings = RenderSettings(
        Some(16),
        color = ColorMode.Rgb,
        caustics = Some(CausticsMode.On),
        fireflies = limit.fold(Fireflies.Kept)(Fireflies.Clamped(_))
      )
      told(SceneTexts.plan(text, Dialect.V4, settings))
    assert(limited(None).contains("from emitters") && !limited(Some(5f)).contains("from emitters"))
