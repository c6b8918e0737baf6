package candela.integrators

import candela.accel.tracing.RayStreams
import candela.geometry.{Ray, RayDifferential}
import candela.sampling.Sampler
import candela.scene.Scene

/** Many paths at once: all rays of the wave are traced, then each path is followed at what its ray
  * has met. What a path carries waits in arrays; the steps have one [[WaveWalk]] for all.
  *
  * @param most   paths at a time
  * @param ray    of the camera
  */
private[candela] final class PathWave(
    scene: Scene,
    limits: PathLimits,
    sampler: Sampler,
    ray: Ray,
    most: Int
):
  private val current = SurfacePath()
  private val walk = WaveWalk(scene, limits, current)
  private val closest = RayStreams.of(scene.accelerator, most, anyHit = false).get
  private val shadows = RayStreams.of(scene.accelerator, most, anyHit = true).get

  private val paths = Array.fill(most)(SurfacePath())
  private val differentials = Array.fill(most)(RayDifferential())
  private val xs, ys, samples = new Array[Int](most)
  private val positions = new Array[Long](most)
  private val found, pending = new Array[Float](3 * most)
  private val waits, lives = new Array[Boolean](most)
  private val active = new Array[Int](most)
  private var count = 0
  private var rays = 0L

  /** Rays traced so far, and how often one went on alone. */
  def raysTraced: Long = rays
  def singles: Long = closest.singles + shadows.singles

  /** Nanoseconds in streams of rays, and at vertices. */
  var closestNanos, shadowNanos, vertexNanos: Long = 0L

  /** Begins a path, along the camera's ray, of this sample, whose number no other has. */
  def begin(number: Int, x: Int, y: Int, sample: Int): Unit =
    xs(number) = x
    ys(number) = y
    samples(number) = sample
    waits(number) = false
    walk.begin(ray, sampler)
    active(count) = number
    count += 1
    leave(number)

  /** What a path has found. */
  def red(number: Int): Float = found(3 * number)
  def green(number: Int): Float = found(3 * number + 1)
  def blue(number: Int): Float = found(3 * number + 2)

  /** Follows all paths to their ends. */
  def follow(): Unit =
    while count > 0 do
      val t0 = System.nanoTime
      closest.trace()
      val t1 = System.nanoTime
      shadows.trace()
      val t2 = System.nanoTime
      closest.clear()
      shadows.clear()
      var left = 0
      var i = 0
      while i < count do
        val number = active(i)
        if advance(number) then
          active(left) = number
          left += 1
        i += 1
      count = left
      closestNanos += t1 - t0
      shadowNanos += t2 - t1
      vertexNanos += System.nanoTime - t2

  /** Follows a path at what its ray has met; false: it has ended. */
  private def advance(number: Int): Boolean =
    val at = 3 * number
    if waits(number) && !shadows.isHit(number) then
      found(at) += pending(at)
      found(at + 1) += pending(at + 1)
      found(at + 2) += pending(at + 2)
    if !lives(number) then false
    else
      current.set(paths(number))
      walk.setFound(found(at), found(at + 1), found(at + 2))
      sampler.start(xs(number), ys(number), samples(number))
      sampler.goTo(positions(number))
      val isHit = closest.isHit(number)
      closest.restore(number, ray)
      ray.differential.copyKnown(differentials(number))
      if isHit then closest.read(number, ray, walk.met)
      walk.follow(isHit, sampler)
      waits(number) = walk.waits
      if walk.waits then
        pending(at) = walk.pendingR
        pending(at + 1) = walk.pendingG
        pending(at + 2) = walk.pendingB
        shadows.add(number, walk.shadow)
        rays += 1
      leave(number)
      lives(number) || waits(number)

  /** Keeps the path, whose ray waits to be traced. */
  private def leave(number: Int): Unit =
    val at = 3 * number
    found(at) = walk.foundR
    found(at + 1) = walk.foundG
    found(at + 2) = walk.foundB
    lives(number) = walk.isAlive
    if walk.isAlive then
      paths(number).set(current)
      positions(number) = sampler.position
      differentials(number).copyKnown(ray.differential)
      closest.add(number, ray)
      rays += 1

extension (to: RayDifferential)
  /** A copy; unknown ones have nothing to copy. */
  private def copyKnown(from: RayDifferential): Unit =
    if from.isKnown then to.copy(from) else to.isKnown = false
