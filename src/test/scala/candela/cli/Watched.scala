package candela.cli

import candela.diagnostics.Problem
import candela.job.{Prepared, SceneLoader}
import candela.render.RenderPlan
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.Eventually.eventually

import java.util.concurrent.atomic.AtomicReference

/** A rendering of `plan` in a thread of its own, as its user starts and sees it.
  *
  * @param warnings of reading and building the scene
  */
final class Watched(plan: RenderPlan, scene: String, warnings: Vector[Problem], args: String*):
  def this(plan: RenderPlan, args: String*) = this(plan, "s.pbrt", Vector.empty, args*)

  private val captured = Captured()
  private val code = AtomicReference[Option[Int]](None)

  private object Loader extends SceneLoader:
    def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
      Prepared(SceneDescription(Dialect.V4), plan, warnings, 0.5, 0.25)

  private val thread = Thread: () =>
    code.set(Some(Main.run(scene +: args, captured.terminal, Loader)))
  thread.setDaemon(true)
  thread.start()

  def out: String = captured.out
  def err: String = captured.err

  /** The live page's address, once it is served. */
  lazy val link: String = eventually("link"):
    raw"watch at (http://\S+)\n".r.findFirstMatchIn(captured.err).map(_.group(1))

  /** The exit code, once it has ended. */
  def ended: Int =
    thread.join(120_000)
    code.get.getOrElse(throw IllegalStateException("it doesn't end"))

  def isRunning: Boolean = thread.isAlive
