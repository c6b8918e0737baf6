package candela.bsdf

import candela.color.Rgb
import candela.math.*
import candela.testing.{ChiSquare, RandomLaws, TrialPlan}
import java.util.SplittableRandom

/** What every [[Bsdf]] must obey; a suite calls `obeysLaws` for some parameters of its own.
  *
  * Chance is allowed for at 4.5 standard errors (1 in 150,000): of a thousand checks, none fails
  * for a right BSDF.
  */
abstract class BsdfLaws extends RandomLaws:

  /** @param isNarrow   too narrow lobes for integration on a grid: those laws are left to wider
    *                   ones
    * @param isLossless all power is scattered
    * @param compresses refraction scales radiance by the square of the index
    * @param isReciprocal false where the model itself isn't
    * @param isPassive  false where the model itself scatters more power than arrives
    * @param isWalked   values are random numbers with the right mean, and the pdf is but a guide
    */
  protected def obeysLaws(
      name: String,
      bsdf: Bsdf,
      isNarrow: Boolean = false,
      isLossless: Boolean = false,
      compresses: Boolean = true,
      isReciprocal: Boolean = true,
      isPassive: Boolean = true,
      isWalked: Boolean = false
  ): Unit =
    law(s"$name: is finite and not negative for all directions, however awkward"):
      staysFinite(bsdf, if isWalked then 10000 else 100000, _)
    if isWalked then obeysOnAverage(name, bsdf)
    else
      law(s"$name: a sample's weight is f·cos/pdf, its pdf that of its direction"):
        samplesConsistently(bsdf, isNarrow, _)
    if isPassive then
      law(s"$name: scatters ${if isLossless then "all the" else "no more"} power than arrives"):
        conserves(bsdf, isLossless, compresses, _)
    if !bsdf.isSpecular && isReciprocal && !isWalked then
      law(s"$name: is reciprocal, but for the square of the index in refraction"):
        reciprocates(bsdf, _)
    if !isReciprocal then
      test(s"$name: tells that it is not reciprocal"):
        assert(!bsdf.isReciprocal)
    if !bsdf.isSpecular && !isNarrow && !isWalked then
      law(s"$name: sampled directions are spread like the pdf"):
        spreadsLikePdf(bsdf, _)

  private def obeysOnAverage(name: String, bsdf: Bsdf): Unit =
    law(s"$name: a sample's pdf is that of its direction, and all of them are at most 1"):
      guides(bsdf, _)
    law(s"$name: is reciprocal on average"):
      reciprocatesOnAverage(bsdf, _)
    law(s"$name: samples send as much everywhere as f·cos says"):
      sendsLikeValues(bsdf, _)

  private def isSane(c: Rgb): Boolean = c.isFinite && c.r >= 0 && c.g >= 0 && c.b >= 0
  private def isSane(x: Float): Boolean = java.lang.Float.isFinite(x) && x >= 0

  private def draw(bsdf: Bsdf, wo: Vec3, random: SplittableRandom): BsdfSample =
    def unit() = Math.min(random.nextDouble().toFloat, OneMinusEpsilon)
    bsdf.sample(wo, unit(), unit(), unit())

  private def staysFinite(bsdf: Bsdf, count: Int, plan: TrialPlan): Unit =
    val random = SplittableRandom(plan.seed(1))
    val corners = Array(0f, 0.25f, 0.5f, 0.75f, OneMinusEpsilon)
    def corner() = corners(random.nextInt(corners.length))
    for i <- 0 until plan.count(count) do
      val (wo, wi) = (Directions.awkward(random), Directions.awkward(random))
      val (f, pdf) = (bsdf.f(wo, wi), bsdf.pdf(wo, wi))
      assert(isSane(f) && isSane(pdf), s"f=$f pdf=$pdf at wo=$wo wi=$wi")
      val s =
        if i % 4 == 0 then bsdf.sample(wo, corner(), corner(), corner())
        else draw(bsdf, wo, random)
      assert(isSane(s.weight) && isSane(s.pdf), s"weight=${s.weight} pdf=${s.pdf} at wo=$wo")
      // Unit length, to the rounding of a few Float operations.
      assert(Math.abs(s.wi.length - 1f) < 1e-5f, s"wi=${s.wi} at wo=$wo")
      assert(bsdf.isTransmissive || s.pdf == 0f || s.wi.z * wo.z >= 0f, s"wi=${s.wi} at wo=$wo")
      assert(s.isSpecular || !bsdf.isSpecular || s.pdf == 0f)

  private def samplesConsistently(bsdf: Bsdf, isNarrow: Boolean, plan: TrialPlan): Unit =
    val random = SplittableRandom(plan.seed(2))
    // The facet, found again from two directions, is off by 1e-7: little against the width of a
    // wide lobe, and 1e-4 of the least width (1e-3), which the tails of the lobe multiply.
    val tolerance = if isNarrow then 2e-2f else 2e-3f
    for wo <- Directions.few; _ <- 0 until plan.count(2000) do
      val s = draw(bsdf, wo, random)
      if s.pdf > 0f && !s.isSpecular && Math.abs(s.wi.z) > 1e-3f then
        val pdf = bsdf.pdf(wo, s.wi)
        assert(Math.abs(pdf - s.pdf) <= tolerance * s.pdf, s"pdf $pdf, not ${s.pdf}; $wo ${s.wi}")
        val expected = bsdf.f(wo, s.wi) * (Math.abs(s.wi.z) / pdf)
        val off = (s.weight - expected).map(c => Math.abs(c)).max
        val message = s"weight ${s.weight}, not $expected; $wo ${s.wi}"
        assert(off <= tolerance * expected.max, message): Unit

  private def conserves(
      bsdf: Bsdf,
      isLossless: Boolean,
      compresses: Boolean,
      plan: TrialPlan
  ): Unit =
    val random = SplittableRandom(plan.seed(3))
    for wo <- Directions.few do
      val power = Statistics()
      for _ <- 0 until plan.count(20000) do
        val s = draw(bsdf, wo, random)
        power.add(s.weight.max * (if compresses then s.eta * s.eta else 1f))
      assert(power.mean <= 1 + 4.5 * power.error + 1e-5, s"$power at wo=$wo") // 1e-5: rounding
      assert(!isLossless || power.mean >= 1 - 4.5 * power.error - 1e-5, s"$power at wo=$wo")

  private def reciprocates(bsdf: Bsdf, plan: TrialPlan): Unit =
    val random = SplittableRandom(plan.seed(4))
    for _ <- 0 until plan.count(20000) do
      val wo = Directions.uniform(random)
      val s = draw(bsdf, wo, random)
      if s.pdf > 0f && !s.isSpecular && Math.abs(s.wi.z) > 1e-3f && Math.abs(wo.z) > 1e-3f then
        val there = bsdf.f(wo, s.wi) * (s.eta * s.eta)
        val back = bsdf.f(s.wi, wo)
        // Within the rounding of the narrowest lobe, as above.
        val off = (there - back).map(c => Math.abs(c)).max
        assert(off <= 2e-2f * back.max, s"$there, not $back; $wo ${s.wi}"): Unit

  private def spreadsLikePdf(bsdf: Bsdf, plan: TrialPlan): Unit =
    val (rows, columns) = if plan.isFull then (16, 32) else (8, 16)
    val samples = plan.count(40000)
    val random = SplittableRandom(plan.seed(5))
    for wo <- Directions.few do
      val density = Directions.integrals(rows, columns, fine = 24)(wi => bsdf.pdf(wo, wi))
      // The grid is good to a thousandth; that is less than chance shows in any cell.
      assert(density.sum < 1.002, s"at wo=$wo")
      val seen = new Array[Long](rows * columns + 1)
      for _ <- 0 until samples do
        val s = draw(bsdf, wo, random)
        val nowhere = s.isSpecular || s.pdf == 0f
        seen(if nowhere then rows * columns else Directions.cell(rows, columns)(s.wi)) += 1
      val expected = (density :+ Math.max(0.0, 1 - density.sum)).map(_ * samples)
      val result = ChiSquare.counts(seen, expected)
      val nowhere = s"nowhere: ${seen.last}, expected ${expected.last}"
      assert(result.accepted(tests = 200), s"$result at wo=$wo; $nowhere")

  private def guides(bsdf: Bsdf, plan: TrialPlan): Unit =
    val random = SplittableRandom(plan.seed(2))
    for wo <- Directions.few do
      for _ <- 0 until plan.count(2000) do
        val s = draw(bsdf, wo, random)
        assert(s.weight.isBlack || s.pdf > 0f)
        if s.pdf > 0f && !s.isSpecular then assert(bsdf.pdf(wo, s.wi) == s.pdf): Unit
      val total = Directions.integrals(1, 1, fine = 100)(wi => bsdf.pdf(wo, wi)).sum
      assert(total < 1.005, s"$total at wo=$wo")

  /** For thirds of both cosines. */
  private def reciprocatesOnAverage(bsdf: Bsdf, plan: TrialPlan): Unit =
    val random = SplittableRandom(plan.seed(4))
    val apart = Array.fill(9)(Statistics())
    def third(w: Vec3) = Math.min((Math.abs(w.z) * 3).toInt, 2)
    for _ <- 0 until plan.count(20000) do
      val (wo, wi) = (Directions.uniform(random), Directions.uniform(random))
      apart(3 * third(wo) + third(wi)).add(bsdf.f(wo, wi).g - bsdf.f(wi, wo).g)
    for part <- apart do assert(Math.abs(part.mean) <= 4.5 * part.error + 1e-6, part)

  private def sendsLikeValues(bsdf: Bsdf, plan: TrialPlan): Unit =
    val (rows, columns, n) = (4, 4, plan.count(8000))
    val random = SplittableRandom(plan.seed(6))
    for wo <- Directions.few do
      def parts() = Array.fill(rows * columns)(Statistics())
      val (sent, said) = (parts(), parts())
      def add(parts: Array[Statistics], wi: Vec3, power: Double): Unit =
        val cell = Directions.cell(rows, columns)(wi)
        for i <- parts.indices do parts(i).add(if i == cell then power else 0.0)
      for _ <- 0 until n do
        val s = draw(bsdf, wo, random)
        add(sent, s.wi, if s.isSpecular then 0.0 else s.weight.g)
        val wi = Directions.uniform(random)
        add(said, wi, 4 * Math.PI * bsdf.f(wo, wi).g * Math.abs(wi.z))
      for (a, b) <- sent.zip(said) do
        val allowed = 4.5 * Math.hypot(a.error, b.error) + 1e-6
        assert(Math.abs(a.mean - b.mean) <= allowed, s"samples $a, values $b, at wo=$wo")

/** Mean and standard error of a stream of numbers. */
final class Statistics:
  private var n = 0L
  private var sum, sum2 = 0.0

  def add(x: Double): Unit =
    n += 1
    sum += x
    sum2 += x * x

  def mean: Double = sum / n
  def error: Double = Math.sqrt(Math.max(0.0, sum2 / n - mean * mean) / n)
  override def toString: String = s"$mean ± $error"
