package candela.render

import candela.build.SceneBuilder
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.measure.{BiasTest, Renderings, TileSums}
import candela.scenefile.Parser
import candela.settings.{PointChoice, RenderSettings}

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

/** Integrators, sample points and options that change the noise of an image leave its expectation,
  * by [[BiasTest]], without a reference. The seeds are fixed: an unchanged renderer always gets the
  * same answer.
  */
class UnbiasedOptionsSuite extends AnyFunSuite:
  import UnbiasedOptionsSuite.*

  private lazy val usual = renderings("path", RenderSettings(), firstSeed = 1)

  private val options = Vector(
    "volpath" -> RenderSettings(),
    "bdpt" -> RenderSettings(),
    "path" -> RenderSettings(guiding = Some(GuidingMode.On)),
    "path" -> RenderSettings(caustics = Some(CausticsMode.On))
  ) ++ PointChoice.all.filter(_ != PointChoice.Best).map: points =>
    "path" -> RenderSettings(points = Some(points))

  for ((integrator, settings), i) <- options.zipWithIndex do
    val what = s"$integrator, points ${settings.points.fold("as usual")(_.word)}, " +
      s"guiding ${settings.guiding.nonEmpty}, caustics ${settings.caustics.nonEmpty}"
    test(s"the image is the same: $what"):
      val test = BiasTest.of(renderings(integrator, settings, 100 * (i + 1)), usual)
      assert(test.p >= Significance, test.worst.headOption)

  test("an albedo 10 % too high is seen"):
    def brighter(scene: String) = scene.replace(".5 .4 .3", ".55 .44 .33")
    val wrong = renderings("path", RenderSettings(), 5000, brighter)
    assert(BiasTest.of(wrong, usual).p < Significance)

  test("light of the last bounces that is left out is seen"):
    def shorter(scene: String) = scene.replace("maxdepth\" 4", "maxdepth\" 1")
    val short = renderings("path", RenderSettings(), 6000, shorter)
    assert(BiasTest.of(short, usual).p < Significance)

private object UnbiasedOptionsSuite:
  /** Chance that an option that is right is accused after a change of random numbers. */
  val Significance = 1e-3

  private val Seeds = 12
  private val SamplesPerPixel = 4

  private def scene(integrator: String) =
    s"""Film "rgb" "integer xresolution" 40 "integer yresolution" 32
       |LookAt 0 1 -5  0 0.6 0  0 1 0
       |Camera "perspective" "float fov" 45
       |Sampler "independent" "integer pixelsamples" $SamplesPerPixel
       |Integrator "$integrator" "integer maxdepth" 4
       |WorldBegin
       |AttributeBegin
       |  AreaLightSource "diffuse" "rgb L" [ 6 6 5 ]
       |  Translate 0 4 -1
       |  Shape "sphere" "float radius" 0.8
       |AttributeEnd
       |LightSource "infinite" "rgb L" [ .2 .2 .3 ]
       |Material "diffuse" "rgb reflectance" [ .5 .4 .3 ]
       |Shape "bilinearmesh" "point3 P" [ -9 -1 -9  9 -1 -9  -9 -1 9  9 -1 9 ]
       |Material "diffuse" "rgb reflectance" [ .3 .5 .6 ]
       |Shape "bilinearmesh" "point3 P" [ -9 -1 2  9 -1 2  -9 9 2  9 9 2 ]
       |Material "conductor" "float roughness" .3
       |Shape "sphere"
       |""".stripMargin

  /** @param change of the scene's text */
  private def renderings(
      integrator: String,
      settings: RenderSettings,
      firstSeed: Int,
      change: String => String = identity
  ): Renderings =
    val text = change(scene(integrator))
    val description = Parser.parseText("ball.pbrt", text, Path.of("."))
    Renderings.seeds(Vector.tabulate(Seeds): i =>
      val plan = SceneBuilder.build(description, settings.copy(seed = firstSeed + i))._1.piloted
      TileSums.of(Renderer.render(plan, 2).image(plan.development)))
