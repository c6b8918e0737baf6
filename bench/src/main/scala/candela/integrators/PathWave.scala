package candela.integrators

import candela.accel.tracing.RayStreams
import candela.color.MutableRgb
import candela.geometry.{Ray, RayDifferential}
import candela.sampling.{SampleHash, Sampler}
import candela.scene.Scene

/** Many paths at once: all rays of the wave are traced, then each path is followed at what its ray
  * has met. What a path carries waits in arrays; the steps have one [[WaveWalk]] for all.
  *
  * @param most   paths at a time
  * @param ray    of the camera
  * @param clock  nanoseconds of the thread's processor time
  */
private[candela] final class PathWave(
    scene: Scene,
    limits: PathLimits,
    sampler: Sampler,
    ray: Ray,
    most: Int,
    clock: () => Long
):
  private val current = SurfacePath()
  private val walk = WaveWalk(scene, limits, current)
  private val closest = RayStreams.of(scene.accelerator, most, anyHit = false).get
  private val shadows = RayStreams.of(scene.accelerator, most, anyHit = true).get

  private val diffuse: DiffuseStage | Null =
    if java.lang.Boolean.getBoolean("candela.lanes.raysOnly") then null
    else DiffuseStage.of(scene, limits, most).orNull
  private val shadow = Ray()
  private val brings = MutableRgb()

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
  var closestNanos, shadowNanos, vertexNanos, diffuseNanos: Long = 0L

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

  /** Vertices in lanes, and those of the walk, which include ends of paths. */
  var inLanes, others: Long = 0L

  /** What a path has found. */
  def red(number: Int): Float = found(3 * number)
  def green(number: Int): Float = found(3 * number + 1)
  def blue(number: Int): Float = found(3 * number + 2)

  /** Follows all paths to their ends. */
  def follow(): Unit =
    while count > 0 do
      val t0 = clock()
      closest.trace()
      val t1 = clock()
      shadows.trace()
      val t2 = clock()
      closest.clear()
      shadows.clear()
      var left = 0
      var i = 0
      val stage = diffuse
      if stage != null then stage.clear()
      while i < count do
        val number = active(i)
        addLight(number)
        if stage != null && isDiffuse(stage, number) then stage.add(number, closest)
        else if lives(number) && advance(number) then
          active(left) = number
          left += 1
        i += 1
      val t3 = clock()
      if stage != null then
        inLanes += stage.size
        left = advance(stage, left)
      count = left
      closestNanos += t1 - t0
      shadowNanos += t2 - t1
      vertexNanos += t3 - t2
      diffuseNanos += clock() - t3

  /** Adds the last light sample, if it is visible. */
  private def addLight(number: Int): Unit =
    if waits(number) && !shadows.isHit(number) then
      val at = 3 * number
      found(at) += pending(at)
      found(at + 1) += pending(at + 1)
      found(at + 2) += pending(at + 2)
    waits(number) = false

  private def isDiffuse(stage: DiffuseStage, number: Int): Boolean =
    lives(number) && closest.isHit(number) && stage.takes(closest.primitiveOf(number)) &&
      paths(number).depth + paths(number).passed != limits.maxDepth

  /** Follows the paths at diffuse vertices.
    *
    * @param from place of the first that goes on, in `active`
    */
  private def advance(stage: DiffuseStage, from: Int): Int =
    var left = from
    val n = stage.size
    var i = 0
    while i < n do
      select(stage.at.who(i))
      stage.draw(i, sampler)
      i += 1
    stage.compute()
    i = 0
    while i < n do
      val number = stage.at.who(i)
      val goesOn = if stage.isSound(i) then leave(stage, i, number) else advance(number)
      if goesOn then
        active(left) = number
        left += 1
      i += 1
    left

  private def select(number: Int): Unit =
    sampler.start(xs(number), ys(number), samples(number))
    sampler.goTo(positions(number))

  private def leave(stage: DiffuseStage, i: Int, number: Int): Boolean =
    val path = paths(number)
    if stage.aim(i, path, shadow, brings) then
      pending(3 * number) = brings.r
      pending(3 * number + 1) = brings.g
      pending(3 * number + 2) = brings.b
      waits(number) = true
      shadows.add(number, shadow)
      rays += 1
    select(number)
    sampler.goTo(sampler.position + 4 * SampleHash.Step)
    lives(number) = stage.leave(i, path, ray, sampler)
    if lives(number) then
      positions(number) = sampler.position
      differentials(number).isKnown = false
      closest.add(number, ray)
      rays += 1
    lives(number) || waits(number)

  /** Follows a path at what its ray has met; false: it has ended. */
  private def advance(number: Int): Boolean =
    val at = 3 * number
    if !lives(number) then false
    else
      others += 1
      current.set(paths(number))
      walk.setFound(found(at), found(at + 1), found(at + 2))
      select(number)
      val isHit = closest.isHit(number)
      closest.restore(number, ray)
      ray.differential.copyKnown(differentials(number))
      if isHit then closest.read(number, walk.met)
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
