package candela.integrators

import candela.base.loop
import candela.guiding.Guide
import candela.sampling.Sampler

/** How guided paths scatter, on surfaces and in media: [[Guidance]] samples the directions, and
  * says in how many branches the path leaves a vertex. Branches are followed one after the other.
  * Mutable, one per path tracer.
  */
private final class GuidedScattering(guide: Guide, tracer: CameraPath, history: PathHistory):
  private val guidance = Guidance(guide, tracer.vertex)
  private val branches = Branches(() => tracer.path.another())

  export guidance.{arrive, startPath, skipVertex, pdf, rouletteThroughput}

  /** Samples the next direction, and leaves in all branches but one, unless there is one only. */
  def scatter(sampler: Sampler): Unit =
    tracer.path.scale(guidance.rouletteOrSplit(tracer.path.throughput.average, sampler))
    if guidance.branches == 1 then scatterOnce(0)
    else
      leaveInBranches()
      tracer.path.absorb()

  private def scatterOnce(branch: Int): Unit =
    guidance.scatter(tracer.path.throughput.average, radiance, branch)
    tracer.path.scale(tracer.vertex.bounce.weight)

  /** Radiance so far, in all branches: the average of the colours. */
  private def radiance: Float = tracer.radianceSoFar.average

  /** Leaves the vertex in all branches, which wait then. */
  private def leaveInBranches(): Unit =
    save(branches.origin)
    loop(guidance.branches): i =>
      restore(branches.origin)
      scatterOnce(i)
      tracer.leaveVertex()
      if tracer.goesOn then
        val branch = branches.push()
        save(branch)
        guidance.keepPosition(i, branch.state)
    restorePath(branches.origin)

  private def save(branch: Branches.Branch): Unit =
    branch.path.set(tracer.path)
    branch.history.set(history)
    branch.departure.set(tracer.ray)
    guidance.store(branch.state)

  /** Goes on with the path as it was; its radiance so far stays. */
  private def restore(branch: Branches.Branch): Unit =
    restorePath(branch)
    guidance.follow(branch.state, radiance)

  private def restorePath(branch: Branches.Branch): Unit =
    tracer.path.set(branch.path)
    history.set(branch.history)
    branch.departure.restore(tracer.ray)
    tracer.goesOn = true

  /** Goes on with a branch that waits; false: there is none, and the path is complete. */
  def followNext(sampler: Sampler): Boolean =
    val waits = !branches.isEmpty
    if waits then
      val branch = branches.pop()
      restore(branch)
      sampler.goTo(branch.state.position)
    else guidance.finish(radiance)
    waits
