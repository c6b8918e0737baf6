package candela.job

import candela.base.{JavaHeap, SceneError}
import candela.build.{BuildControl, OutputSettings, RenderGoal, SceneBuilder}
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.render.{Cancellation, Renderer, Rendering, RenderListener, RenderMethod, RenderPlan}

/** What would have reached the error of a long rendering sooner.
  *
  * With a number of samples paths neither learn nor look for caustics, as in pbrt. Whether that
  * would have paid is found out by a small image of the same scene, by the rules of `auto`: guiding
  * compares both variances after a few passes, and the pilots of caustics decide before.
  *
  * @param guiding  would guided paths pay?
  * @param caustics would light paths, or paths guided by photons?
  */
final case class Sooner(guiding: Boolean, caustics: Boolean)

object Sooner:
  /** Shorter renderings, in seconds, are not worth a trial: it takes seconds to compile. */
  val Worth = 60.0

  /** What the trial may take of the rendering's time. */
  private val Part = 0.03

  /** Pixels and samples of the trial: as many passes as guiding needs to decide. */
  private val Pixels = 20000
  private val Samples = 16

  /** After a rendering; none if nothing is known to be sooner, or the time is not enough to tell.
    */
  def of(
      prepared: Prepared,
      rendering: Rendering,
      threads: Int,
      cancellation: Cancellation
  ): Option[Sooner] =
    if isAskable(prepared, rendering) then trial(prepared, rendering.seconds, threads, cancellation)
    else None

  private def isAskable(prepared: Prepared, rendering: Rendering): Boolean =
    val settings = prepared.settings
    val asksNothing = settings.guiding.isEmpty && settings.caustics.isEmpty &&
      !settings.goal.isGiven && !settings.preview
    val isPlain = prepared.plan.method match
      case RenderMethod.Tiles(_) => true
      case _ => false
    // What a stranger's scene may use is counted for one rendering
    val isOwn = prepared.how.limits.all.isEmpty && !prepared.how.limits.sandbox
    asksNothing && isPlain && isOwn && rendering.isComplete && rendering.seconds >= Worth &&
    prepared.buildSeconds < Part / 2 * rendering.seconds

  /** @param seconds of the rendering */
  private[job] def trial(
      prepared: Prepared,
      seconds: Double,
      threads: Int,
      cancellation: Cancellation
  ): Option[Sooner] =
    val began = System.nanoTime
    def isLate = (System.nanoTime - began) * 1e-9 > Part * seconds
    try
      val plan = small(prepared)
      val caustics = plan.method match
        case RenderMethod.SplattedTiles(_, beside, _, _) => beside
        case _ => false
      val deadline = new RenderListener:
        override def isOver(seconds: Double, still: Double): Boolean = isLate
      val isLearning = plan.method.learns && !isLate
      val learned = Option.when(isLearning):
        Renderer.render(plan, threads, cancellation, deadline).learned
      val guiding = learned.flatten.exists(o => o.pays && !o.gaveUp)
      Option.when(guiding || caustics)(Sooner(guiding, caustics))
    // Not even a small second image of it fits into the memory
    catch case _: SceneError | _: OutOfMemoryError => None

  private def small(prepared: Prepared): RenderPlan =
    val how = prepared.how
    val settings = prepared.settings.copy(
      samples = Some(Samples),
      goal = RenderGoal(),
      layers = Vector.empty,
      lightGroups = None,
      guiding = Some(GuidingMode.Progressive),
      caustics = Some(CausticsMode.Auto),
      output = OutputSettings()
    )
    val runtime = Runtime.getRuntime
    val control = BuildControl(
      prepared.pool,
      textures = how.textures,
      keep = how.keep,
      heap = JavaHeap.limit - (runtime.totalMemory - runtime.freeMemory),
      pixels = Some(Pixels)
    )
    SceneBuilder.build(prepared.description, settings, control)._1
