package candela.stability

import candela.sampling.*
import candela.testing.Draws
import Checks.assert

/** Samplers at the ends of their counts, pixels and dimensions. */
object Sampling extends Group(
      Numbers.all.map((name, make) =>
        Case(s"$name gives numbers below 1, wherever it is asked", 2000, 10_000_000L)(count =>
          Numbers.stayBelowOne(make, count)
        )
      ) ++ Seq(
        Case("samplers spread evenly in dimensions past a thousand", 3, 100L)(Numbers.deep),
        Case("images of one pixel and of 2^31 pixels are sampled", 1, 1L)(_ => Numbers.sizes())
      )
    )

class SamplingSuite extends GroupSuite(Sampling)

private object Numbers:
  type Make = Int => Sampler
  private val Wide = 1 << 20

  val all: Seq[(String, Make)] = Seq(
    "independent" -> (n => IndependentSampler(n, 1)),
    "halton" -> (n => HaltonSampler(n, 1)),
    "sobol" -> (n => OwenSobolSampler(n, 1)),
    "zsobol" -> (n => ZSobolSampler(n, Wide, Wide, 1)),
    "stratified" -> (n => StratifiedSampler(n, 1, jitter = true, 1)),
    "stratified across" -> (n => StratifiedSampler(1, n, jitter = false, 1))
  )

  private val counts = Seq(1, 2, 3, 7, 100, 1000, 65537, 1 << 20)

  def stayBelowOne(make: Make, count: Long): Unit =
    val draws = Draws(1)
    var i = 0L
    while i < count do
      val s = make(counts((i % counts.size).toInt))
      val last = s.samplesPerPixel - 1
      val sample = if draws.coin() then last else draws.below(s.samplesPerPixel)
      val pixel = if draws.coin() then Wide - 1 else draws.below(Wide)
      s.start(pixel, draws.below(Wide), sample)
      var k = 0
      while k < 60 do
        val u = s.next1D()
        s.next2D()
        assert(
          u >= 0f && u < 1f && s.x >= 0f && s.x < 1f && s.y >= 0f && s.y < 1f,
          s"$u ${s.x} ${s.y} of sample $sample"
        ): Unit
        k += 1
      i += 1

  /** Of 1024 samples in the 10,000th dimension and after it, a sixteenth lies in each sixteenth:
    * within 4.5 deviations of independent ones, √(1024/16 · 15/16) ≈ 7.7.
    */
  def deep(count: Long): Unit =
    for (name, make) <- all do
      val s = make(1024)
      for round <- 0 until count.toInt do
        val seen = new Array[Int](16)
        for sample <- 0 until 1024 do
          s.start(3, 5, sample)
          var u = 0f
          for _ <- 0 to 2000 + round do
            s.next2D()
            u = s.next1D()
          seen((u * 16).toInt) += 1
        assert(seen.forall(n => Math.abs(n - 64) <= 35), s"$name: ${seen.mkString(" ")}"): Unit

  def sizes(): Unit =
    for (width, height) <- Seq((1, 1), (1, Int.MaxValue), (Int.MaxValue, 1), (3, 1 << 30)) do
      val s = ZSobolSampler(5, width, height, 1)
      for sample <- 0 until s.samplesPerPixel do
        s.start(width - 1, height - 1, sample)
        s.next2D()
        assert(s.x >= 0f && s.x < 1f && s.y >= 0f && s.y < 1f && s.next1D() < 1f): Unit
    // Past 2^31 samples of one pixel there is no number for them, and the request is refused
    for n <- Seq(Int.MaxValue, 1 << 30) do
      assert(scala.util.Try(StratifiedSampler(n, 4, true, 1)).isFailure)
      assert(HaltonSampler(n, 1).samplesPerPixel == n)
    val last = IndependentSampler(Int.MaxValue, 1)
    last.start(0, 0, Int.MaxValue - 1)
    assert(last.next1D() < 1f)
    for sampler <- Seq[Sampler](HaltonSampler(Int.MaxValue, 1), OwenSobolSampler(Int.MaxValue, 1))
    do
      sampler.start(Int.MaxValue, Int.MaxValue, Int.MaxValue - 1)
      for _ <- 0 until 2000 do
        val u = sampler.next1D()
        assert(u >= 0f && u < 1f): Unit
