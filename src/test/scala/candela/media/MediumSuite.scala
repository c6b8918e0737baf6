package candela.media

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.color.Rgb
import candela.math.*
import candela.sampling.HenyeyGreenstein

/** Estimates against integrals that are known. */
final class MediumSuite extends AnyFunSuite:
  private val isotropic = HenyeyGreenstein(0f)
  private val grey = (Rgb.gray(0.3f), Rgb.gray(0.9f))
  private val colored = (Rgb(0.05f, 0.6f, 1.5f), Rgb(1.2f, 0.4f, 0f))

  /** Single estimates are at most a few times as large as their means: four deviations of the mean
    * of 300,000 of them are below 0.01.
    */
  private val Tries = 300000
  private val Tolerance = 0.01f

  private def near(got: Rgb, expected: Rgb, what: String): Assertion =
    assert(Tracking.isNear(got, expected, Tolerance), s"$what: $got, expected $expected")

  /** The unit cube, moved to [−1, 1]³. */
  private val toUnit = (Transform.scale(0.5, 0.5, 0.5).get * Transform.translate(1, 1, 1))

  /** Radiance and transmittance of density `d` over t in [0, 1], of a way of this length. */
  private def check(medium: Medium, expectedFrom: (Vec3, Vec3), colors: (Rgb, Rgb), le: Rgb)(
      d: Double => Double
  ): Unit =
    val (from, to) = expectedFrom
    val length = (to - from).length
    val (a, s) = colors
    def parts(a: Float, s: Float, le: Float): (Double, Double, Double) =
      var depth, scattered, glow = 0.0
      val n = 20000
      for i <- 0 until n do
        val here = d((i + 0.5) / n) * length / n
        val left = Math.exp(-(depth + 0.5 * (a + s) * here))
        scattered += left * s * here
        glow += left * a * le * here
        depth += (a + s) * here
      (Math.exp(-depth), scattered, glow)
    val all = Seq((a.r, s.r, le.r), (a.g, s.g, le.g), (a.b, s.b, le.b)).map(parts)
    def color(f: ((Double, Double, Double)) => Double) =
      Rgb(f(all(0)).toFloat, f(all(1)).toFloat, f(all(2)).toFloat)
    // A direction that is no unit vector: parameters are not lengths
    val means = Tracking.means(medium, from, (to - from) * 0.5f, 2f, Tries)
    near(means.passed, color(_._1), "passed")
    near(means.dimmed, color(_._1), "dimmed")
    near(means.scattered, color(_._2), "scattered")
    near(means.glow, color(_._3), "glow"): Unit

  for (name, colors) <- Seq("grey" -> grey, "coloured" -> colored) do
    test(s"a homogeneous medium, $name: Beer's law"):
      val le = Rgb(1f, 0.5f, 2f)
      val medium = HomogeneousMedium(colors._1, colors._2, le, isotropic)
      check(medium, (Vec3(0f, 1f, 2f), Vec3(1f, 1f, 1f)), colors, le)(_ => 1)

    test(s"a grid that is the same all over but at its sides, $name"):
      val density = SampledGrid(3, 3, 3, Array.fill(27)(0.8f))
      val le = Rgb(1f, 0.5f, 2f)
      // Constant within the centres of the outermost cells, so the glow's factor, too
      val glow = ColoredGlow(le, SampledGrid(3, 3, 3, Array.fill(27)(1f)))
      val medium = GridMedium(toUnit, density, colors._1, colors._2, Some(glow), isotropic)
      check(medium, (Vec3(-0.6f, -0.5f, 0f), Vec3(0.6f, 0.4f, 0.3f)), colors, le)(_ => 0.8)

    test(s"densities of a grid are linear between its centres, and 0 is around it, $name"):
      val values = Array(0.2f, 1f, 2f, 0f, 1.5f)
      val density = SampledGrid(1, 1, 5, values)
      val medium = GridMedium(toUnit, density, colors._1, colors._2, None, isotropic)
      // In the middle of x and y, where a single cell has its whole value; from far out
      def linear(z: Double): Double =
        val s = (z + 1) / 2 * 5 - 0.5
        val i = Math.floor(s).toInt
        def v(k: Int) = if k < 0 || k > 4 then 0.0 else values(k).toDouble
        if Math.abs(z) > 1 then 0 else v(i) + (s - i) * (v(i + 1) - v(i))
      check(medium, (Vec3(0f, 0f, -3f), Vec3(0f, 0f, 2f)), colors, Rgb.Black): t =>
        linear(-3 + 5 * t)

  test("media of one kind are counted in the summary, of many kinds the first are named"):
    assert(Medium.summary(Seq("cloud")) == "1 (cloud)")
    assert(Medium.summary(Seq("fog", "cloud", "fog")) == "3 (2 fog; cloud)")
    val kinds = Vector.tabulate(10)(i => s"grid $i")
    assert(Medium.summary(kinds) == kinds.take(8).mkString("10 (", "; ", "; 2 more kinds)"))

  test("a grid of colours lets through what its coefficients say"):
    val size = 2
    def channel(v: Float) = SampledGrid(size, size, size, Array.fill(8)(v))
    val absorption = ColorGrid(channel(0.2f), channel(0.5f), channel(1f))
    val scattering = ColorGrid(channel(0.7f), channel(0.5f), channel(0.1f))
    val medium = ColorGridMedium(
      toUnit,
      absorption.r,
      Some(absorption),
      Some(scattering),
      1f,
      factor = 2f,
      Some(ColorGrid(channel(1f), channel(2f), channel(0.5f))),
      isotropic
    )
    val colors = (Rgb(0.4f, 1f, 2f), Rgb(1.4f, 1f, 0.2f))
    check(medium, (Vec3(-0.5f, 0f, 0f), Vec3(0.5f, 0f, 0f)), colors, Rgb(1f, 2f, 0.5f))(_ => 1)

  test("a grid of albedos parts the extinction, not its product at the cells"):
    def step(low: Float, high: Float) =
      val channel = SampledGrid(2, 1, 1, Array(low, high), GridEdge.Clamped)
      ColorGrid(channel, channel, channel)
    def medium(place: Transform) = ColorGridMedium(
      toUnit,
      step(0f, 1f).r,
      Some(step(0f, 1f)),
      Some(step(0f, 3f)),
      1f,
      factor = 2f,
      None,
      isotropic,
      Some(AlbedoGrid(step(1f, 0.5f), place))
    )
    def parts(place: Transform, x: Float) =
      val out = MediumPoint()
      medium(place).coefficients(x, 0.5f, 0.5f, out)
      (out.absorbG, out.scatterG)
    // Extinctions of 0 and 8, albedos of 1 and 0.5 at 1/4 and 3/4
    assert(parts(Transform.Identity, 0.5f) == (1f, 3f))
    assert(parts(Transform.Identity, 0.625f) == (2.25f, 3.75f))
    assert(parts(Transform.translate(-0.5, 0, 0), 0.75f) == (0f, 8f))

  test("a cloud lets through what its density says", Slow):
    val (low, size) = (Vec3(-0.5f, 0f, -0.5f), Vec3(1f, 1f, 1f))
    val map = Transform.translate(0.5, 0, 0.5)
    val (a, s) = (Rgb.gray(0.5f), Rgb.gray(4f))
    val cloud = CloudMedium(map, low, size, a, s, 3f, 1f, 5f, isotropic)
    check(cloud, (Vec3(-1f, 0.4f, 0f), Vec3(1f, 0.9f, 0.1f)), (a, s), Rgb.Black): t =>
      val x = -1 + 2 * t
      if Math.abs(x) > 0.5 then 0
      else cloud.densityAt(x.toFloat, (0.4 + 0.5 * t).toFloat, (0.1 * t).toFloat).toDouble

  test("nothing passes an endless medium, nor does it stop what meets no density"):
    val endless = HomogeneousMedium(grey._1, grey._2, Rgb.Black, isotropic)
    val far = Tracking.means(endless, Vec3.Zero, Vec3.X, Float.PositiveInfinity, 1000)
    assert(far.passed.isBlack && far.dimmed.isBlack)
    // All three colours scatter the same 3 of 4 parts
    near(far.scattered, Rgb.gray(0.75f), "scattered")
    val empty = GridMedium(
      toUnit,
      SampledGrid(1, 1, 1, Array(0f)),
      grey._1,
      grey._2,
      None,
      isotropic
    )
    val clear = Tracking.means(empty, Vec3(-2f, 0f, 0f), Vec3.X, 9f, 1000)
    assert(clear.passed == Rgb.White && clear.dimmed == Rgb.White && clear.scattered.isBlack)

  test("densities of any size leave finite numbers"):
    for factor <- Seq(1e-30f, 1e6f, 1e20f, 1e38f) do
      val colors = (colored._1 * factor, colored._2 * factor)
      val media = Seq(
        HomogeneousMedium(colors._1, colors._2, Rgb.White, isotropic),
        GridMedium(
          toUnit,
          SampledGrid(2, 2, 2, Array.fill(8)(1f)),
          colors._1,
          colors._2,
          Some(ColoredGlow(Rgb.White, SampledGrid.One)),
          isotropic
        )
      )
      for medium <- media do
        val m = Tracking.means(medium, Vec3(-2f, 0.1f, 0f), Vec3.X, 4f, 300)
        for c <- Seq(m.passed, m.scattered, m.glow, m.dimmed) do assert(c.isFinite, (factor, m))

  test("a ray along a face of the box, and one that starts on it, come to an end"):
    val medium = GridMedium(
      toUnit,
      SampledGrid(4, 4, 4, Array.fill(64)(1f)),
      grey._1,
      grey._2,
      None,
      isotropic
    )
    for
      (from, direction) <- Seq(
        (Vec3(-2f, 1f, 0f), Vec3.X),
        (Vec3(-1f, -1f, -1f), Vec3(1f, 1f, 1f)),
        (Vec3(1f, 0f, 0f), Vec3.X),
        (Vec3(0.5f, 0.5f, -3f), Vec3(0f, -0f, 1f)),
        (Vec3(1e6f, 2e5f, 1f), Vec3(-1f, -0.2f, 0f))
      )
    do
      val m = Tracking.means(medium, from, direction, Float.PositiveInfinity, 200)
      assert(m.passed.isFinite && m.passed.max <= 1f + 1e-5f, (from, m))

  /** A medium that scatters nowhere, with a majorant. */
  private def empty(majorant: Float): VaryingMedium =
    new VaryingMedium(toUnit, MajorantGrid.constant(1f), Rgb.gray(majorant)):
      val phase = isotropic
      def isEmissive: Boolean = false
      def isChromatic: Boolean = false
      def describe: String = "empty"
      protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
        out.setDensity(0f, Rgb.Black, Rgb.Black)

  test("tracking without progress is given up, and its sample is not a number", Slow):
    def lost(majorant: Float) =
      val (work, ray) = (MediumWork(), candela.geometry.Ray())
      work.random.seed(0.25f, 0.5f)
      work.start(0)
      ray.set(Vec3(0f, 0f, -2f), Vec3(0f, 0f, 1f), 10f)
      val _ = empty(majorant).follow(ray, 0.5f, emits = false, work)
      work.shadow.start(0, 1f)
      empty(majorant).attenuate(ray, work)
      (work.weights.isLost, work.shadow.isLost)
    // A hundred thousand steps are those of very dense clouds
    assert(lost(1e5f) == (false, false))
    assert(lost(1e12f) == (true, true))
    assert(lost(Float.MaxValue) == (true, true))
