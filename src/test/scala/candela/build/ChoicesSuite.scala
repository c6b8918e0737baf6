package candela.build

import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.sampling.PointSet
import candela.scenefile.Dialect
import candela.settings.{Choices, PointChoice, RenderGoal, RenderSettings}
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class ChoicesSuite extends AnyFunSuite:
  private val timed = RenderSettings(goal = RenderGoal(time = Some(10)))
  private val exact = RenderSettings(goal = RenderGoal(error = Some(0.01)))
  private val asked = RenderSettings(
    points = Some(PointChoice.Best),
    guiding = Some(GuidingMode.Off),
    caustics = Some(CausticsMode.Auto)
  )

  private def plan(settings: RenderSettings, integrator: String = "path") =
    SceneTexts.plan(
      s"""Integrator "$integrator" Sampler "zsobol" "integer pixelsamples" 4
         |Camera "perspective" WorldBegin
         |LightSource "infinite" Shape "sphere"""".stripMargin,
      Dialect.V4,
      settings
    )

  /** Whether it is guided, and learns until it brings no more. */
  private def learnsOn(settings: RenderSettings) =
    plan(settings).method.guide.exists(_.learnsOn)

  test("a goal guides paths and takes points of any number; a number of samples does neither"):
    for settings <- Vector(timed, exact, timed.copy(samples = Some(64))) do
      assert(learnsOn(settings) && plan(settings).sampler.isProgressive)
    val samples = RenderSettings(samples = Some(64))
    assert(!learnsOn(samples) && !plan(samples).sampler.isProgressive)
    assert(samples.choices == Choices.OfScene)

  test("a goal looks for caustics, and the methods don't depend on how much time there is"):
    for time <- Vector(0.5, 19.0, 20.0, 3600.0) do
      assert(RenderSettings(goal = RenderGoal(time = Some(time))).choices == timed.choices)
    assert(timed.choices == exact.choices)
    assert(timed.choices.caustics == CausticsMode.Auto)

  test("what is asked for is done, whatever ends the rendering"):
    for goal <- Vector(RenderGoal(), timed.goal) do
      assert(asked.copy(goal = goal).choices == Choices(
        PointChoice.Best,
        GuidingMode.Off,
        CausticsMode.Auto
      ))
    val on = timed.copy(guiding = Some(GuidingMode.On))
    assert(on.choices.guiding == GuidingMode.On && !learnsOn(on))

  test("paths guided where it pays learn until it brings no more if samples can be added"):
    val counted = RenderSettings(samples = Some(64), guiding = Some(GuidingMode.Auto))
    assert(!learnsOn(counted))
    assert(learnsOn(counted.copy(points = Some(PointChoice.Progressive))))
    // A goal adds samples, whatever the points
    val halton = Some(PointChoice.Named(PointSet.Halton))
    assert(learnsOn(timed.copy(points = halton)))
    assert(!learnsOn(timed.copy(points = halton, samples = Some(64))))

  test("what a goal chose is told with its reason, and what was asked for without"):
    def told(s: RenderSettings, what: String, integrator: String = "path") =
      plan(s, integrator).features.toMap.get(what)
    assert(told(timed, "guiding").get ==
      "where it pays, learnt until it brings no more; ends sooner if it does not; " +
      "chosen as a time or an error ends the rendering (--guiding off takes none)")
    assert(told(timed, "sampler").get.contains("any number of which are evenly spread"))
    for goal <- Vector(timed, exact) do assert(told(goal, "caustics").get.startsWith("none: "))
    val auto = timed.copy(guiding = Some(GuidingMode.Auto))
    assert(told(auto, "guiding").get.endsWith("ends sooner if it does not"))
    assert(told(RenderSettings(), "guiding").isEmpty && told(RenderSettings(), "caustics").isEmpty)
    // Nobody asked for it, so that it is not possible is no matter of warnings
    val (other, warnings) = SceneBuilder.build(
      SceneTexts.parse("Integrator \"bdpt\"\nWorldBegin\nLightSource \"infinite\"\n", Dialect.V4),
      timed
    )
    assert(warnings.isEmpty && other.method.takesCameraSamples)
