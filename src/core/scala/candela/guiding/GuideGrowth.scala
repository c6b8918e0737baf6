package candela.guiding

import candela.base.{FloatBuffer, IntBuffer, loop}
import scala.collection.mutable.ArrayBuffer

/** Builds the field of the next pass: regions with many events are divided where their mean is, and
  * their mixtures are fitted to what was found. Each region of the new field is fitted by itself,
  * by any thread.
  *
  * @param events of the pass
  * @param lit    part of all paths that has events
  * @param counts of each region of the old field, events that would have been recorded if all
  *               found light
  * @param costs  likewise, rays that an event brings about
  * @param cost   rays of a path
  */
private[guiding] final class GuideGrowth(
    old: GuideField,
    val events: GuideEvents,
    settings: GuideSettings,
    val lit: Double,
    counts: Array[Float],
    costs: Array[Float],
    cost: Double
):
  import GuideField.{Lobes, Sides}
  import GuideGrowth.*
  import GuideRecords.Size
  private val numbers = events.numbers
  private val axis, below = IntBuffer()
  private val split = FloatBuffer()
  private val largest = Math.max(Fewest, settings.perRegion * Math.sqrt(events.count))
  private val leaves = ArrayBuffer.empty[GuideLeaf]
  private var isGivenUp = false
  private var isRough = false
  divideAll()

  /** What the paths of the pass tell, before anything is fitted. */
  def judged(): GuideVerdict =
    leaves.foreach(_.judge())
    verdict

  /** Nothing is guided any more, so nothing need be fitted. */
  def giveUp(): Unit = isGivenUp = true

  /** The field is for few paths only, which cost less than its fits do. */
  def fitRoughly(): Unit = isRough = true

  /** Regions of the new field, which are to be fitted. */
  def regions: Int = if isGivenUp then 0 else leaves.length

  /** Fits one of them, with memory for it. */
  def grow(region: Int, fit: GuideFit): Unit = leaves(region).grow(fit)

  def newFit(): GuideFit =
    GuideFit(numbers, if isRough then GuideFit.RoughEvents else GuideFit.MaxEvents)

  /** The field, when all regions have grown. */
  def result(): GuideField =
    val centres, lobes, bsdfProbabilities, splittingFactors, measurements = FloatBuffer()
    val unit = Math.sqrt(cost / Math.max(verdict.noise, MinNoise)).toFloat
    for leaf <- leaves do
      bsdfProbabilities += leaf.bsdfProbability
      splittingFactors += (if leaf.effort > 0f then leaf.effort * unit else leaf.splittingFactor)
      measurements += leaf.measurement
      loop(3)(a => centres += leaf.centre(a))
      loop(Lobes * GuideField.Size)(i => lobes += leaf.lobes(i))
    GuideField(
      axis.drain(), split.drain(), below.drain(), bsdfProbabilities.drain(), centres.drain(),
      lobes.drain(),
      splittingFactors.drain(), measurements.drain()
    )

  /** What the paths of the pass tell of guiding, when all regions have grown. */
  def verdict: GuideVerdict =
    GuideVerdict(
      leaves.map(_.paths).sum,
      leaves.map(_.guidedNoise).sum,
      leaves.map(_.unguidedNoise).sum,
      cost
    )

  private def divideAll(): Unit =
    loop(Sides)(_ => newNode())
    val byRegion = Array.fill(old.regions)(IntBuffer())
    loop(events.count): i =>
      val event = i * Size
      val side = numbers(event + GuideRecords.Side).toInt
      byRegion(old.region(side, numbers, event)) += event
    loop(Sides)(side => copy(side, side, byRegion))

  private def newNode(): Unit =
    axis += 0
    split += 0f
    below += 0

  /** Copies the node `from` to `to`. */
  private def copy(from: Int, to: Int, of: Array[IntBuffer]): Unit =
    val next = old.below(from)
    if next < 0 then
      val region = -1 - next
      val indices = of(region).drain()
      divide(
        region,
        indices,
        to,
        found = Math.min(1f, indices.length / Math.max(1f, counts(region)))
      )
    else
      val child = newChildren(to, old.axis(from), old.split(from))
      copy(next, child, of)
      copy(next + 1, child + 1, of)

  private def newChildren(to: Int, a: Int, at: Float): Int =
    axis(to) = a
    split(to) = at
    below(to) = axis.length
    newNode()
    newNode()
    below(to)

  /** Makes a leaf or more of an old region, or part of one, with the events at `of`.
    *
    * @param found part of its events that found light
    */
  private def divide(region: Int, of: Array[Int], to: Int, found: Float): Unit =
    val (mean, variance) = spread(of)
    val a = (0 until 3).maxBy(variance(_))
    val middle = mean(a).toFloat
    val (low, high) =
      if of.length > largest then parted(of, a, middle) else (of, Array.emptyIntArray)
    if low.length > 0 && high.length > 0 then
      val child = newChildren(to, a, middle)
      divide(region, low, child, found)
      divide(region, high, child + 1, found)
    else
      below(to) = -1 - leaves.length
      val centre =
        if of.length >= Fewest then mean.map(_.toFloat)
        else old.centres.slice(3 * region, 3 * region + 3)
      leaves += GuideLeaf(old, region, numbers, of, centre, settings, lit, found, costs(region))

  /** Mean and variance of the points, by axis. */
  private def spread(of: Array[Int]): (Array[Double], Array[Double]) =
    val mean, variance = new Array[Double](3)
    loop(of.length): j =>
      val event = of(j)
      loop(3)(a => mean(a) += numbers(event + a))
    loop(3)(a => mean(a) /= Math.max(1, of.length))
    loop(of.length): j =>
      val event = of(j)
      loop(3): a =>
        val d = numbers(event + a) - mean(a)
        variance(a) += d * d
    (mean, variance)

  /** The events before the middle of the axis, and the others. */
  private def parted(of: Array[Int], a: Int, middle: Float): (Array[Int], Array[Int]) =
    var count = 0
    loop(of.length)(j => if numbers(of(j) + a) < middle then count += 1)
    val low = new Array[Int](count)
    val high = new Array[Int](of.length - count)
    count = 0
    loop(of.length): j =>
      if numbers(of(j) + a) < middle then
        low(count) = of(j)
        count += 1
      else high(j - count) = of(j)
    (low, high)

private object GuideGrowth:
  /** Events from which a mixture is fitted, at least. */
  val Fewest = 60

  /** Relative variance of a path that is taken for less. */
  private val MinNoise = 1e-6
