package candela.shapes

import org.scalatest.Assertion
import org.scalatest.Assertions.assert

import candela.geometry.{Frame, Hit, Ray}
import candela.math.*
import candela.testing.{ChiSquare, Draws}

/** Checks that hold for any surface on which points are sampled. */
object SampledShapes:
  /** What a ray from `from` in direction `w` meets first: its point and normal. */
  type Visible = (Vec3, Vec3) => Option[(Vec3, Vec3)]

  def visible(shape: Shape): Visible =
    // Its own, as suites run beside each other
    val (ray, hit, at) = (Ray(), Hit(), candela.geometry.ShadingPoint())
    (from, w) =>
      ray.set(from, w, Float.PositiveInfinity)
      Option.when(shape.intersect(ray, hit)):
        shape.surface(ray, hit, at)
        (at.p, at.geometricNormal)

  /** Is the sample what `from` sees in its direction, or does the surface hide it? */
  private def isSeen(from: Vec3, p: Vec3, see: Visible): Boolean =
    // Points of the far side are far from those of the near side but at the very silhouette
    see(from, (p - from).normalized).exists((q, _) => (q - p).length <= 1e-3f * (p - from).length)

  /** The density of the directions to visible samples is `pdf`; it integrates to their share. */
  def chiSquare(seed: Long, surface: SurfaceSampler, see: Visible, from: Vec3): ChiSquare.Result =
    val out = SurfaceSample()
    // Bins so small that what their integrals miss at the surface's edge is below their noise
    ChiSquare.directions(seed, draws = 100000, cosBins = 40, phiBins = 40)(
      u =>
        surface.sample(from, u(), u(), out)
        Option.when(out.pdf > 0 && isSeen(from, out.p, see))((out.p - from).normalized)
      ,
      w => see(from, w).map((p, n) => surface.pdf(from, p, n)).getOrElse(0f)
    )

  /** The same for a small cone of directions around `axis`, which is cut into bins instead of the
    * sphere; the density must be uniform in it.
    */
  def coneChiSquare(
      seed: Long,
      surface: SurfaceSampler,
      from: Vec3,
      axis: Vec3,
      oneMinusCos: Double
  ): ChiSquare.Result =
    val out = SurfaceSample()
    val frame = Frame.fromZ(axis)
    ChiSquare.square(seed)(
      u =>
        surface.sample(from, u(), u(), out)
        val d = Array(
          out.p.x.toDouble - from.x,
          out.p.y.toDouble - from.y,
          out.p.z.toDouble - from.z
        )
        def along(v: Vec3) = d(0) * v.x + d(1) * v.y + d(2) * v.z
        val (x, y, z) = (along(frame.s), along(frame.t), along(frame.n))
        val sin2 = (x * x + y * y) / (x * x + y * y + z * z)
        val height = sin2 / (1 + Math.sqrt(1 - sin2)) / oneMinusCos
        val turns = Math.atan2(y, x) / (2 * Math.PI)
        Some(Vec3(Math.min(1.0, height).toFloat, (turns - Math.floor(turns)).toFloat, 0f))
      ,
      (_, _) => 2 * Math.PI * oneMinusCos * surface.pdf(from, out.p, out.n)
    )

  /** `sample` returns the density that `pdf` gives for its point. */
  def pdfAgrees(
      surface: SurfaceSampler,
      from: Vec3,
      draws: Draws,
      relative: Float = 1e-5f
  ): Assertion =
    val out = SurfaceSample()
    for _ <- 0 until 2000 do
      surface.sample(from, draws.unit(), draws.unit(), out)
      val again = surface.pdf(from, out.p, out.n)
      // Rounding p moves its normal and its distance by 1e-7 or so; edge-on the cosine magnifies it
      val d = (out.p - from).normalized
      val slack = relative / Math.max(1e-4f, out.n absDot d)
      assert(abs(out.pdf - again) <= slack * again, s"${out.p} ${out.pdf} $again")
    assert(out.pdf > 0f)

  /** The mean of f/pdf over visible samples is ∫ f over the directions that meet the surface, found
    * by sampling the sphere: within 4.5 standard errors of each other (once in 1e5).
    */
  def integrates(surface: SurfaceSampler, see: Visible, from: Vec3, draws: Draws)(
      f: Vec3 => Double
  ): Assertion =
    val out = SurfaceSample()
    def mean(count: Int)(value: => Double): (Double, Double) =
      var (sum, sum2) = (0.0, 0.0)
      for _ <- 0 until count do
        val x = value
        sum += x
        sum2 += x * x
      (sum / count, (sum2 / count - sum / count * sum / count) / count)
    val (sampled, variance) = mean(100000):
      surface.sample(from, draws.unit(), draws.unit(), out)
      val w = (out.p - from).normalized
      if out.pdf > 0f && isSeen(from, out.p, see) then f(w) / out.pdf else 0.0
    val (expected, variance2) = mean(200000):
      val w = draws.direction()
      if see(from, w).isDefined then f(w) * 4 * Math.PI else 0.0
    assert(
      Math.abs(sampled - expected) <= 4.5 * Math.sqrt(variance + variance2),
      s"$sampled instead of $expected"
    )
