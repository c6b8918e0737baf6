package candela.guiding

import candela.base.{FloatBuffer, IntBuffer, loop}

/** Builds the field of the next pass: regions with many events are divided where their mean is, and
  * their mixtures are fitted to what was found.
  *
  * @param events sorted ([[GuideRecords]])
  */
private[guiding] final class GuideGrowth(
    old: GuideField,
    events: Array[Float],
    settings: GuideSettings
):
  import GuideField.{Lobes, Sides}
  import GuideGrowth.*
  import GuideRecords.Size
  private val axis, below = IntBuffer()
  private val split, shares, centres, lobes = FloatBuffer()
  private val fit = GuideFit(events)

  private var compared, remaining = 0.0

  def result(): GuideField =
    loop(Sides)(_ => newNode())
    val of = Array.fill(old.regions)(IntBuffer())
    loop(events.length / Size): i =>
      val at = i * Size
      val side = events(at + GuideRecords.Side).toInt
      of(old.region(side, events(at), events(at + 1), events(at + 2))) += at
    loop(Sides)(side => copy(side, side, of))
    GuideField(axis.take(), split.take(), below.take(), shares.take(), centres.take(), lobes.take())

  /** What is left of the second moment where the best way of sampling is chosen for each region:
    * the mean, by events that found light. Regions differ in brightness, events in the eye don't.
    */
  def left: Double = if compared > 0.0 then remaining / compared else 1.0

  private def newNode(): Unit =
    axis += 0
    split += 0f
    below += 0

  /** Copies the node `from` to `to`. */
  private def copy(from: Int, to: Int, of: Array[IntBuffer]): Unit =
    val next = old.below(from)
    if next < 0 then grow(-1 - next, of(-1 - next).take(), to)
    else
      val child = divide(to, old.axis(from), old.split(from))
      copy(next, child, of)
      copy(next + 1, child + 1, of)

  private def divide(to: Int, a: Int, at: Float): Int =
    axis(to) = a
    split(to) = at
    below(to) = axis.length
    newNode()
    newNode()
    below(to)

  /** Makes a leaf or more of an old region, or part of one, with the events at `of`. */
  private def grow(region: Int, of: Array[Int], to: Int): Unit =
    val (mean, variance) = spread(of)
    val a = (0 until 3).maxBy(variance(_))
    val middle = mean(a).toFloat
    val (low, high) =
      if of.length > settings.perRegion then of.partition(i => events(i + a) < middle)
      else (of, Array.emptyIntArray)
    if low.length > 0 && high.length > 0 then
      val child = divide(to, a, middle)
      grow(region, low, child)
      grow(region, high, child + 1)
    else
      below(to) = -1 - shares.length
      leaf(region, of, mean.map(_.toFloat))

  private def leaf(region: Int, of: Array[Int], centre: Array[Float]): Unit =
    if of.length < Fewest then
      shares += old.shares(region)
      loop(3)(a => centres += old.centres(3 * region + a))
      val base = region * Lobes * GuideField.Size
      loop(Lobes * GuideField.Size)(i => lobes += old.lobes(base + i))
    else
      shares += share(region, of)
      val start = if old.isFitted(region) then GuideFit.moved(old, region, centre) else null
      loop(3)(a => centres += centre(a))
      val fitted = fit(of, centre, start)
      loop(fitted.length)(i => lobes += fitted(i))

  /** Mean and variance of the points, by axis. */
  private def spread(of: Array[Int]): (Array[Double], Array[Double]) =
    val mean, variance = new Array[Double](3)
    for a <- 0 until 3 do
      loop(of.length)(j => mean(a) += events(of(j) + a))
      mean(a) /= Math.max(1, of.length)
      loop(of.length): j =>
        val d = events(of(j) + a) - mean(a)
        variance(a) += d * d
    (mean, variance)

  /** The probability of BSDF sampling: that which would have had the least second moment, by what
    * the old field had learnt.
    */
  private def share(region: Int, of: Array[Int]): Float =
    val moments = Shares.map(moment(of, _))
    val best = Shares.indices.minBy(moments(_))
    compared += of.length
    remaining += of.length * Math.min(1.0, moments(best) / moments(0))
    if !settings.adapts then if best == 0 then Half else Shares(best)
    else if moments(best) < Pays * moments(0) then Shares(best)
    else if old.shares(region) < 1f && moments(best) < moments(0) then old.shares(region)
    else 1f

  private def moment(of: Array[Int], share: Float): Double =
    import GuideRecords.*
    val most = Brightest * fit.meanLight(of)
    var sum = 0.0
    loop(of.length): j =>
      val at = of(j)
      val light = Math.min(events(at + Light), most)
      val pdf = share * events(at + BsdfPdf) + (1f - share) * events(at + GuidePdf)
      sum += light * light * events(at + Pdf) / pdf
    sum

private object GuideGrowth:
  /** Events from which a mixture is fitted, at least. */
  val Fewest = 60

  /** Probabilities of BSDF sampling that are compared; the first is the unguided one. */
  val Shares: Array[Float] = Array(1f, 0.5f, 0.25f)

  /** More light counts as this much, in units of the region's mean. */
  val Brightest = 100f

  /** A region is guided if that leaves less than this part of the second moment. */
  val Pays = 0.85

  /** Probability of BSDF sampling that is not learnt. */
  val Half = 0.5f
