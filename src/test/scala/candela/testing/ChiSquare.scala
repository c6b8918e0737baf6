package candela.testing

import java.util.SplittableRandom

import org.apache.commons.numbers.gamma.RegularizedGamma

import candela.math.*

/** Pearson's χ² test that samples are spread as their density says.
  *
  * The domain is cut into bins. A bin's expected count is the number of draws times the integral of
  * the density over it; draws that return nothing are a bin of their own, which expects what the
  * density lacks to 1. Bins that expect fewer than five draws are pooled, because χ² needs about
  * that many. The p-value is the probability that a correct sampler strays at least as far from the
  * expectation.
  *
  * Use, for a suite that makes 12 such tests in all:
  * {{{
  * val result = ChiSquare.directions(seed = 1)(
  *   draw = u => Some(Warp.cosineHemisphere(u(), u())),
  *   pdf = w => Warp.cosineHemispherePdf(w.z)
  * )
  * assert(result.accepted(tests = 12), result)
  * }}}
  * The random numbers are a fixed sequence, so a result never changes from run to run. A draw may
  * use any number of them; it must use nothing else that is random.
  *
  * Source: Pharr, Jakob, Humphreys do the same in PBRT's and Jakob in Mitsuba's tests ("testing
  * BSDFs with χ²"); Pearson 1900.
  */
object ChiSquare:

  /** @param pooled how many bins were thrown together for expecting too little */
  final case class Result(statistic: Double, degreesOfFreedom: Int, pooled: Int, pValue: Double):

    /** Not refuted. That any of `tests` correct samplers is refused has probability `significance`.
      *
      * Source: Šidák, "Rectangular confidence regions for the means of multivariate normal
      * distributions", JASA 62, 1967.
      */
    def accepted(tests: Int, significance: Double = 0.01): Boolean =
      pValue >= 1 - Math.pow(1 - significance, 1.0 / tests)

  /** Tests a sampler of unit directions against its density in sr⁻¹. Bins are equal in cos θ (about
    * +z) and φ, so all have the same solid angle.
    *
    * @param draw makes one direction from uniform numbers in [0, 1); None: no sample
    * @param pdf  must integrate to the share of draws that return a direction
    */
  def directions(seed: Long, draws: Int = 200000, cosBins: Int = 20, phiBins: Int = 20)(
      draw: (() => Float) => Option[Vec3],
      pdf: Vec3 => Float
  ): Result =
    def direction(s: Double, t: Double): Vec3 =
      val z = 2 * s - 1
      val r = Math.sqrt(Math.max(0.0, 1 - z * z))
      val phi = 2 * Math.PI * t
      Vec3((r * Math.cos(phi)).toFloat, (r * Math.sin(phi)).toFloat, z.toFloat)
    square(seed, draws, cosBins, phiBins)(
      u =>
        draw(u).map: w =>
          val turns = Math.atan2(w.y, w.x) / (2 * Math.PI)
          Vec3((w.z + 1) / 2, (if turns < 0 then turns + 1 else turns).toFloat, 0f)
      ,
      (s, t) => pdf(direction(s, t)) * 4 * Math.PI
    )

  /** Tests a sampler of points (x, y) of the unit square (z is ignored) against its density. */
  def square(seed: Long, draws: Int = 200000, columns: Int = 20, rows: Int = 20)(
      draw: (() => Float) => Option[Vec3],
      pdf: (Double, Double) => Double
  ): Result =
    val random = SplittableRandom(seed)
    val uniform = () => random.nextInt(1 << 24) * 5.9604645e-8f // a multiple of 2⁻²⁴
    val observed = new Array[Long](columns * rows + 1)
    for _ <- 0 until draws do
      val bin = draw(uniform) match
        case Some(p) =>
          require(p.x >= 0f && p.x <= 1f && p.y >= 0f && p.y <= 1f, s"$p is outside")
          val column = clamp((p.x * columns).toInt, 0, columns - 1)
          column * rows + clamp((p.y * rows).toInt, 0, rows - 1)
        case None => columns * rows
      observed(bin) += 1
    val expected = new Array[Double](columns * rows + 1)
    for column <- 0 until columns; row <- 0 until rows do
      val integral = BinIntegral(pdf)(
        column.toDouble / columns,
        row.toDouble / rows,
        1.0 / columns,
        1.0 / rows
      )
      expected(column * rows + row) = draws * integral
    expected(columns * rows) = Math.max(0.0, draws - expected.sum)
    counts(observed, expected)

  /** Tests any counts against what is expected; both include all draws. */
  def counts(observed: Array[Long], expected: Array[Double]): Result =
    require(observed.length == expected.length)
    var statistic = 0.0
    var bins = 0
    def add(o: Double, e: Double): Unit =
      statistic += (o - e) * (o - e) / e
      bins += 1
    val (large, small) = expected.indices.partition(i => expected(i) >= 5)
    large.foreach(i => add(observed(i).toDouble, expected(i)))
    val (pooledO, pooledE) = (small.map(observed(_)).sum.toDouble, small.map(expected(_)).sum)
    // With less than half a draw expected, three are a miracle: no χ² is needed to refuse them.
    val impossible = pooledE < 0.5 && pooledO >= 3 + pooledE
    if pooledE >= 0.5 then add(pooledO, pooledE)
    val freedom = bins - 1
    val p =
      if impossible then 0.0
      else if freedom < 1 then 1.0
      else RegularizedGamma.Q.value(freedom / 2.0, statistic / 2)
    Result(statistic, freedom, small.size, p)
