package candela.guiding

import candela.base.loop
import candela.math.sqrt
import candela.sampling.SampleHash

/** Fits mixtures by expectation maximisation. Each lobe also finds the distance of its point: that
  * of some, at which its rays come closest to each other. It need not be where they hit something:
  * light through a gap meets in the gap.
  *
  * @param events their numbers, sorted ([[GuideEvents]])
  * @param most   events that one mixture is fitted to
  */
private[guiding] final class GuideFit(events: Array[Float], most: Int = GuideFit.MaxEvents):
  import GuideField.{End, Factor, Kappa, Lobes, Nearness, Size, Weight}
  import GuideFit.*

  // Events in proportion to their light: points from the centre, and directions
  private val px, py, pz, wx, wy, wz = new Array[Float](most)
  private var count = 0

  private val nears = new Array[Float](Nears)

  // Of each event and nearness, the direction from the centre
  private val directions = new Array[Float](most * Nears * 3)
  private val parts, factors = new Array[Float](Lobes)

  // Of each lobe, the distances that it tries
  private val begins, ends = new Array[Int](Lobes)

  // Of each lobe: its events, and the sums of their directions from the centre for each nearness
  private val masses = new Array[Double](Lobes)
  private val sums = new Array[Float](Lobes * Nears * 3)

  /** @param start lobes to begin with, which are overwritten; null: none */
  def apply(of: Array[Int], centre: Array[Float], start: Array[Float] | Null): Array[Float] =
    choose(of, centre)
    chooseNears()
    val lobes = if start == null then seeds() else start
    val before = Array.tabulate(Lobes)(k => lobes(k * Size + Weight))
    val rounds = if start == null then FirstRounds else Rounds
    loop(rounds): round =>
      // Distances are chosen anew in the last round, those of new lobes in each
      chooseTried(lobes, all = start == null || round == rounds - 1)
      expect(lobes)
      loop(Lobes): k =>
        maximise(lobes, k)
        lobes(k * Size + Weight) =
          (masses(k) / count).toFloat + (if start == null then Uniform else OldWeight) * before(k)
      normalise(lobes)
    finished(lobes)

  /** Takes events in proportion to their light, bright ones several times, at even steps. */
  private def choose(of: Array[Int], centre: Array[Float]): Unit =
    import GuideRecords.*
    val brightest = Brightest * meanLight(events, of)
    var all = 0.0
    loop(of.length)(j => all += Math.min(events(of(j) + Light), brightest))
    val step = all / Math.min(most, of.length)
    var sum = 0.0
    count = 0
    loop(of.length): j =>
      val at = of(j)
      sum += Math.min(events(at + Light), brightest)
      while count < most && sum > (count + 0.5) * step do
        px(count) = events(at) - centre(0)
        py(count) = events(at + 1) - centre(1)
        pz(count) = events(at + 2) - centre(2)
        wx(count) = events(at + Wi)
        wy(count) = events(at + Wi + 1)
        wz(count) = events(at + Wi + 2)
        count += 1

  /** Points may be infinitely far, and from 38 to 0.8 times as far as the region's events are from
    * its centre.
    */
  private def chooseNears(): Unit =
    var sum = 0.0
    loop(count)(j => sum += px(j) * px(j) + py(j) * py(j) + pz(j) * pz(j))
    val reach = Math.max(Math.sqrt(sum / count), 1e-12)
    loop(Nears - 1)(j => nears(j + 1) = (Math.pow(2.0, 0.75 * j - 5.25) / reach).toFloat)
    loop(count): j =>
      loop(Nears): g =>
        val x = px(j) * nears(g) + wx(j)
        val y = py(j) * nears(g) + wy(j)
        val z = pz(j) * nears(g) + wz(j)
        val s = 1f / Math.max(sqrt(x * x + y * y + z * z), 1e-12f)
        val to = (j * Nears + g) * 3
        directions(to) = x * s
        directions(to + 1) = y * s
        directions(to + 2) = z * s

  /** Which distances the lobes try: all, or the one next to their own. */
  private def chooseTried(lobes: Array[Float], all: Boolean): Unit =
    loop(Lobes): k =>
      val near = lobes(k * Size + Nearness)
      var own = 0
      loop(Nears)(g => if Math.abs(nears(g) - near) < Math.abs(nears(own) - near) then own = g)
      begins(k) = if all then 0 else own
      ends(k) = if all then Nears else own + 1

  /** Divides each event among the lobes. */
  private def expect(lobes: Array[Float]): Unit =
    loop(Lobes): k =>
      factors(k) = lobes(k * Size + Weight) * Lobe.factor(lobes(k * Size + Kappa))
    java.util.Arrays.fill(sums, 0f)
    java.util.Arrays.fill(masses, 0.0)
    loop(count): j =>
      var all = 0f
      loop(Lobes): k =>
        val at = k * Size
        val near = lobes(at + Nearness)
        val x = lobes(at) - px(j) * near
        val y = lobes(at + 1) - py(j) * near
        val z = lobes(at + 2) - pz(j) * near
        val cos = (x * wx(j) + y * wy(j) + z * wz(j)) / sqrt(x * x + y * y + z * z)
        parts(k) = factors(k) * Lobe.exp(Math.min(0f, lobes(at + Kappa) * (cos - 1f)))
        all += parts(k)
      if all > 1e-20f then
        loop(Lobes): k =>
          val part = parts(k) / all
          if part > Negligible then
            masses(k) += part
            add(j, k, part)

  /** Adds the event to the lobe. */
  private def add(j: Int, k: Int, part: Float): Unit =
    val from = (j * Nears + begins(k)) * 3
    val to = (k * Nears + begins(k)) * 3
    val end = (ends(k) - begins(k)) * 3
    var i = 0
    while i < end do
      sums(to + i) += directions(from + i) * part
      i += 1

  private def length(k: Int, g: Int): Double =
    val at = (k * Nears + g) * 3
    val x = sums(at).toDouble
    val y = sums(at + 1).toDouble
    val z = sums(at + 2).toDouble
    Math.sqrt(x * x + y * y + z * z)

  /** Sets a lobe from its events. */
  private def maximise(lobes: Array[Float], k: Int): Unit =
    if masses(k) > 1e-6 then
      var best = 0
      loop(Nears)(g => if length(k, g) > length(k, best) then best = g)
      val from = (k * Nears + best) * 3
      val at = k * Size
      // With few events, a lobe is wider than they are
      val mean = Math.min(length(k, best) / (masses(k) + Widening), 0.9999)
      loop(3)(a => lobes(at + a) = (sums(from + a) / length(k, best)).toFloat)
      lobes(at + Nearness) = nears(best)
      lobes(at + Kappa) = Math.max(0.1, mean * (3 - mean * mean) / (1 - mean * mean)).toFloat

  private def normalise(lobes: Array[Float]): Unit =
    var all = 0f
    loop(Lobes)(k => all += lobes(k * Size + Weight))
    loop(Lobes)(k => lobes(k * Size + Weight) /= all)

  /** The lobes in the order of their weights; light ones are left out of densities and samples. */
  private def finished(lobes: Array[Float]): Array[Float] =
    val order = (0 until Lobes).sortBy(k => -lobes(k * Size + Weight))
    def weight(k: Int) = lobes(k * Size + Weight)
    val kept = order.filter(k => k == order(0) || weight(k) >= Lightest)
    val all = kept.map(weight).sum
    val result = new Array[Float](lobes.length)
    var end = 0f
    for (k, i) <- order.zipWithIndex do
      val at = i * Size
      System.arraycopy(lobes, k * Size, result, at, Size)
      val part = if i < kept.length then weight(k) / all else 0f
      end += part
      result(at + Factor) = part * Lobe.factor(lobes(k * Size + Kappa))
      result(at + End) = end
    result

  /** Wide lobes around directions of events that are far from each other. */
  private def seeds(): Array[Float] =
    val lobes = new Array[Float](Lobes * Size)
    val far = Array.fill(count)(2f)
    loop(Lobes): k =>
      var all = 0.0
      loop(count)(j => all += far(j))
      val u = SampleHash.toUnit(SampleHash.mix(k + 1)) * all
      var sum = far(0).toDouble
      var j = 0
      while j < count - 1 && sum <= u do
        j += 1
        sum += far(j)
      lobes(k * Size) = wx(j)
      lobes(k * Size + 1) = wy(j)
      lobes(k * Size + 2) = wz(j)
      lobes(k * Size + Kappa) = 20f
      lobes(k * Size + Weight) = 1f / Lobes
      loop(count): i =>
        val cos = wx(i) * wx(j) + wy(i) * wy(j) + wz(i) * wz(j)
        far(i) = Math.max(0f, Math.min(far(i), 1f - cos))
    lobes

private[guiding] object GuideFit:
  import GuideField.{Lobes, Nearness, Size}

  /** A mixture is fitted to at most this many events; to fewer after few paths. */
  inline val MaxEvents = 512
  inline val RoughEvents = 256

  /** Distances that each lobe tries. */
  private inline val Nears = 7

  private inline val FirstRounds = 4
  private inline val Rounds = 3

  /** More light counts as this much, in units of the region's mean, lest single paths decide. */
  inline val Brightest = 10f

  /** Parts of events below it are left out. */
  private inline val Negligible = 0.02f

  /** Events of a prior without direction. */
  private inline val Widening = 0.2

  /** Weight of a lobe that is used. */
  private inline val Lightest = 0.025f

  /** Weights of the old mixture, and of a uniform one if there is none, beside the new one. */
  private inline val OldWeight = 0.25f
  private inline val Uniform = 0.02f

  /** Of the events at these places. */
  def meanLight(events: Array[Float], of: Array[Int]): Float =
    var sum = 0.0
    loop(of.length)(j => sum += events(of(j) + GuideRecords.Light))
    (sum / of.length).toFloat

  /** The lobes of a region as seen from another centre. */
  def moved(field: GuideField, region: Int, centre: Array[Float]): Array[Float] =
    val from = region * Lobes * Size
    val lobes = java.util.Arrays.copyOfRange(field.lobes, from, from + Lobes * Size)
    loop(Lobes): k =>
      val at = k * Size
      val near = lobes(at + Nearness)
      var square = 0.0
      loop(3): a =>
        val x = lobes(at + a) + (field.centres(3 * region + a) - centre(a)) * near
        lobes(at + a) = x
        square += x * x
      val s = (1.0 / Math.max(Math.sqrt(square), 1e-12)).toFloat
      loop(3)(a => lobes(at + a) *= s)
      lobes(at + Nearness) = near * s
    lobes
