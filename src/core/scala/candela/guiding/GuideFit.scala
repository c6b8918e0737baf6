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
  private val densities, factors = new Array[Float](Lobes)

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
    val oldWeights = Array.tabulate(Lobes)(k => lobes(k * Size + Weight))
    val rounds = if start == null then FirstRounds else Rounds
    loop(rounds): round =>
      // Distances are chosen anew in the last round, those of new lobes in each
      chooseTried(lobes, all = start == null || round == rounds - 1)
      expect(lobes)
      loop(Lobes): k =>
        maximise(lobes, k)
        lobes(k * Size + Weight) =
          (masses(k) / count).toFloat + (if start == null then Uniform else OldWeight) * oldWeights(
            k
          )
      normalise(lobes)
    finished(lobes)

  /** Takes events in proportion to their light, bright ones several times, at even steps. */
  private def choose(of: Array[Int], centre: Array[Float]): Unit =
    import GuideRecords.*
    val brightest = Brightest * meanLight(events, of)
    var total = 0.0
    loop(of.length)(j => total += Math.min(events(of(j) + Light), brightest))
    val step = total / Math.min(most, of.length)
    var sum = 0.0
    count = 0
    loop(of.length): j =>
      val event = of(j)
      sum += Math.min(events(event + Light), brightest)
      while count < most && sum > (count + 0.5) * step do
        px(count) = events(event) - centre(0)
        py(count) = events(event + 1) - centre(1)
        pz(count) = events(event + 2) - centre(2)
        wx(count) = events(event + Wi)
        wy(count) = events(event + Wi + 1)
        wz(count) = events(event + Wi + 2)
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
      val nearness = lobes(k * Size + Nearness)
      var nearest = 0
      loop(Nears)(g =>
        if Math.abs(nears(g) - nearness) < Math.abs(nears(nearest) - nearness) then nearest = g
      )
      begins(k) = if all then 0 else nearest
      ends(k) = if all then Nears else nearest + 1

  /** Divides each event among the lobes. */
  private def expect(lobes: Array[Float]): Unit =
    loop(Lobes): k =>
      factors(k) = lobes(k * Size + Weight) * Lobe.factor(lobes(k * Size + Kappa))
    java.util.Arrays.fill(sums, 0f)
    java.util.Arrays.fill(masses, 0.0)
    loop(count): j =>
      var total = 0f
      loop(Lobes): k =>
        val lobe = k * Size
        val nearness = lobes(lobe + Nearness)
        val x = lobes(lobe) - px(j) * nearness
        val y = lobes(lobe + 1) - py(j) * nearness
        val z = lobes(lobe + 2) - pz(j) * nearness
        val cos = (x * wx(j) + y * wy(j) + z * wz(j)) / sqrt(x * x + y * y + z * z)
        densities(k) = factors(k) * Lobe.exp(Math.min(0f, lobes(lobe + Kappa) * (cos - 1f)))
        total += densities(k)
      if total > 1e-20f then
        loop(Lobes): k =>
          val responsibility = densities(k) / total
          if responsibility > Negligible then
            masses(k) += responsibility
            add(j, k, responsibility)

  /** Adds the event to the lobe. */
  private def add(j: Int, k: Int, responsibility: Float): Unit =
    val from = (j * Nears + begins(k)) * 3
    val to = (k * Nears + begins(k)) * 3
    val end = (ends(k) - begins(k)) * 3
    var i = 0
    while i < end do
      sums(to + i) += directions(from + i) * responsibility
      i += 1

  private def length(k: Int, g: Int): Double =
    val offset = (k * Nears + g) * 3
    val x = sums(offset).toDouble
    val y = sums(offset + 1).toDouble
    val z = sums(offset + 2).toDouble
    Math.sqrt(x * x + y * y + z * z)

  /** Sets a lobe from its events. */
  private def maximise(lobes: Array[Float], k: Int): Unit =
    if masses(k) > 1e-6 then
      var longest = 0
      loop(Nears)(g => if length(k, g) > length(k, longest) then longest = g)
      val offset = (k * Nears + longest) * 3
      val lobe = k * Size
      // With few events, a lobe is wider than they are
      val mean = Math.min(length(k, longest) / (masses(k) + Widening), 0.9999)
      loop(3)(a => lobes(lobe + a) = (sums(offset + a) / length(k, longest)).toFloat)
      lobes(lobe + Nearness) = nears(longest)
      lobes(lobe + Kappa) = Math.max(0.1, mean * (3 - mean * mean) / (1 - mean * mean)).toFloat

  private def normalise(lobes: Array[Float]): Unit =
    var total = 0f
    loop(Lobes)(k => total += lobes(k * Size + Weight))
    loop(Lobes)(k => lobes(k * Size + Weight) /= total)

  /** The lobes in the order of their weights; light ones are left out of densities and samples. */
  private def finished(lobes: Array[Float]): Array[Float] =
    val order = (0 until Lobes).sortBy(k => -lobes(k * Size + Weight))
    def weight(k: Int) = lobes(k * Size + Weight)
    val retained = order.filter(k => k == order(0) || weight(k) >= Lightest)
    val total = retained.map(weight).sum
    val result = new Array[Float](lobes.length)
    var end = 0f
    for (k, i) <- order.zipWithIndex do
      val target = i * Size
      System.arraycopy(lobes, k * Size, result, target, Size)
      val fraction = if i < retained.length then weight(k) / total else 0f
      end += fraction
      result(target + Factor) = fraction * Lobe.factor(lobes(k * Size + Kappa))
      result(target + End) = end
    result

  /** Wide lobes around directions of events that are far from each other. */
  private def seeds(): Array[Float] =
    val lobes = new Array[Float](Lobes * Size)
    val far = Array.fill(count)(2f)
    loop(Lobes): k =>
      var total = 0.0
      loop(count)(j => total += far(j))
      val u = SampleHash.toUnit(SampleHash.mix(k + 1)) * total
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
    val offset = region * Lobes * Size
    val lobes = java.util.Arrays.copyOfRange(field.lobes, offset, offset + Lobes * Size)
    loop(Lobes): k =>
      val lobe = k * Size
      val nearness = lobes(lobe + Nearness)
      var square = 0.0
      loop(3): a =>
        val x = lobes(lobe + a) + (field.centres(3 * region + a) - centre(a)) * nearness
        lobes(lobe + a) = x
        square += x * x
      val s = (1.0 / Math.max(Math.sqrt(square), 1e-12)).toFloat
      loop(3)(a => lobes(lobe + a) *= s)
      lobes(lobe + Nearness) = nearness * s
    lobes
