package candela.integrators

import candela.base.Assertions

/** How far the path of a [[Walk]] has come at its current vertex. */
private[candela] enum Stage:
  /** It is on its way along its ray. */
  case Departed

  /** The ray was traced, and has met a surface, or leaves the scene. */
  case Hit, Escaped

  /** The geometry of the vertex is known. What is found here comes by the last vertex: throughput
    * and densities are still those of the direction that was taken there.
    */
  case Arrived

  /** The vertex has its BSDF: light may be sampled. */
  case Evaluated

  /** A point on a light was sampled, and may be connected to the vertex. */
  case Sampled

  /** The next direction was sampled, and throughput includes it: no light may be added here any
    * more.
    */
  case Scattered

  case Ended

/** Checks that the steps of a path come in an order in which its estimate is unbiased, where
  * [[candela.base.Assertions]] are on.
  */
private[candela] final class StepOrder:
  private var stage = Stage.Ended

  /** A step leads to a stage, and may only follow another. */
  def step(to: Stage, after: Stage): Unit = step(to, after, after)

  /** A step that may follow either. */
  def step(to: Stage, after: Stage, or: Stage): Unit =
    if Assertions.areOn then check(to, after, or)

  /** A step that may come at any stage. */
  def set(to: Stage): Unit = if Assertions.areOn then stage = to

  private def check(to: Stage, after: Stage, or: Stage): Unit =
    if stage != after && stage != or then
      val expected = if after == or then s"$after" else s"$after or $or"
      throw AssertionError(s"$to follows $expected, not $stage")
    stage = to
