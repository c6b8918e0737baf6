package candela.integrators

import candela.base.loop
import candela.guiding.{Guide, PhotonField}
import candela.sampling.Sampler

/** How guided walks scatter, on surfaces and in media: [[Guidance]] samples the directions, and
  * says in how many branches the path leaves a vertex. Branches are followed one after the other.
  * Mutable, one per walk.
  */
private[integrators] final class GuidedScattering(
    guide: Guide,
    walk: Walk,
    photons: PhotonField | Null
):
  private val guidance = Guidance(guide, walk.vertex, photons)
  private val branches = Branches(() => walk.path.another())

  export guidance.{begin, leaveAlone, meet, pdf, roulette}

  /** The vertex has its BSDF. Photons aim at light that light paths don't find. */
  def arrive(): Unit = guidance.arrive(isAimed = photons != null && walk.path.rival == 0.0)

  /** Samples the next direction, and leaves in all branches but one, unless there is one only. */
  def scatter(sampler: Sampler): Unit =
    walk.path.scale(guidance.survival(walk.path.throughput.average, sampler))
    if guidance.branches == 1 then scatterOnce(0)
    else
      leaveInBranches()
      walk.path.absorb()

  private def scatterOnce(branch: Int): Unit =
    guidance.scatter(walk.path.throughput.average, found, branch)
    walk.path.scale(walk.vertex.bounce.weight)

  /** Light found so far, in all branches: the average of the colours. */
  private def found: Float = walk.radiance.average

  /** Leaves the vertex in all branches, which wait then. */
  private def leaveInBranches(): Unit =
    keep(branches.origin)
    loop(guidance.branches): i =>
      restore(branches.origin, Stage.Scattered)
      scatterOnce(i)
      walk.leave()
      if walk.goesOn then
        val branch = branches.push()
        keep(branch)
        guidance.keepPosition(i, branch.mark)
    walk.restore(branches.origin, Stage.Scattered)

  private def keep(branch: Branches.Branch): Unit =
    walk.keep(branch)
    guidance.keep(branch.mark)

  private def restore(branch: Branches.Branch, stage: Stage): Unit =
    walk.restore(branch, stage)
    guidance.follow(branch.mark, found)

  /** Goes on with a branch that waits; false: there is none, and all light of the path is found. */
  def followNext(sampler: Sampler): Boolean =
    val waits = !branches.isEmpty
    if waits then
      val branch = branches.pop()
      restore(branch, Stage.Departed)
      sampler.goTo(branch.mark.position)
    else guidance.finish(found)
    waits
