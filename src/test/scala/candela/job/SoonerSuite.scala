package candela.job

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.build.{RenderGoal, RenderSettings}
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.render.{Cancellation, Rendering}

class SoonerSuite extends AnyFunSuite:
  private val few = RenderSettings(samples = Some(1))
  private val interior = "bench/scenes/grey-room.v4.pbrt"

  private def prepared[A](scene: String, settings: RenderSettings = few)(use: Prepared => A): A =
    val how = Preparation(settings, threads = 2)
    scala.util.Using.resource(SceneLoader.FromFile.load(scene, how))(use)

  private def tried(scene: String, seconds: Double = 1e6): Option[Sooner] =
    prepared(scene)(Sooner.trial(_, seconds, threads = 2, Cancellation()))

  /** After a rendering that took so long. */
  private def after(
      scene: String,
      seconds: Double,
      settings: RenderSettings = few,
      change: Rendering => Rendering = identity
  ): Option[Sooner] =
    prepared(scene, settings): p =>
      val rendering = change(p.render(RenderControl()).copy(seconds = seconds))
      Sooner.of(p, rendering, threads = 2, Cancellation())

  test("guided paths are sooner in an interior that is lit indirectly", Slow):
    assert(tried(interior) == Some(Sooner(guiding = true, caustics = false)))

  test("light paths are sooner for a caustic"):
    assert(tried("scenes/v4-caustics-ring.pbrt").exists(_.caustics))

  test("nothing is where what is asked for does not pay, and where nothing can be asked for"):
    assert(tried("scenes/v3-glossy.pbrt").isEmpty)
    assert(tried("scenes/v3-matte-directlighting.pbrt").isEmpty)

  test("a trial ends with its time, and then tells nothing"):
    assert(tried(interior, seconds = 0).isEmpty)

  test("only a long rendering is followed by a trial", Slow):
    assert(after(interior, 1e6).exists(_.guiding))
    assert(after(interior, Sooner.Worth - 1).isEmpty)

  test("what its user has chosen is not tried, nor what was not rendered to its end"):
    val chosen = Vector(
      few.copy(guiding = Some(GuidingMode.Off)),
      few.copy(caustics = Some(CausticsMode.Off)),
      few.copy(goal = RenderGoal(error = Some(0.5)))
    )
    for settings <- chosen do assert(after(interior, 1e6, settings).isEmpty, settings)
    assert(after(interior, 1e6, change = _.copy(samplesDone = 0)).isEmpty)
