package candela.stability

import candela.color.Rgb
import candela.image.Image
import candela.lights.*
import candela.math.*
import candela.shapes.*
import candela.testing.{Draws, Soups}
import Checks.assert

/** Lights of any size and distance, at points beside, on and inside them. */
object Lighting extends Group(
      Seq(
        Case("a sphere lights as its solid angle says, from any distance", 3000, 10_000_000L)(
          Lit.bySphere
        ),
        Case("a small triangle lights as its solid angle says", 3000, 10_000_000L)(Lit.byTriangle),
        Case("points on and inside lights get numbers", 3000, 10_000_000L)(Lit.inside),
        Case(
          "100,000 lights of twelve orders of power are chosen as often as they say",
          50,
          10_000L
        )(
          Many.check
        ),
        Case("a sky with one bright pixel brings all of its light", 20000, 10_000_000L)(
          Sky.onePixel
        ),
        Case("skies without light, and at their poles, bring numbers", 5000, 10_000_000L)(Sky.poles)
      )
    )

class LightingSuite extends GroupSuite(Lighting)

private object Lit:
  private val emitted = Rgb.White

  private def light(shape: Shape): AreaLight =
    val (axis, spread) = shape.normals
    AreaLight(shape, emitted, false, shape.bounds, axis, spread)

  /** A sphere whose cone is sampled uniformly: the density is 1 over its solid angle, 2π (1 − cos),
    * here with sin² = (r/d)² in 60 digits.
    */
  def bySphere(count: Long): Unit =
    import Exact.*
    val draws = Draws(1)
    val out = LightSample()
    var i = 0L
    while i < count do
      val r = draws.magnitude(1e-6, 1e6)
      val shape = Soups.sphere(Transform.Identity, r)
      val from = draws.direction() * (r * draws.magnitude(1.001, 1e6))
      light(shape).sample(from, draws.unit(), draws.unit(), out)
      val d2 = of(from) dot of(from)
      val sin2 = (of(r) *~ of(r)) /~ d2
      val angle = 2 * Math.PI * (of(1f) -~ (of(1f) -~ sin2).root).doubleValue
      assert(Math.abs(out.pdf * angle - 1) < 1e-5, s"${out.pdf}, not ${1 / angle}: $r $from")
      val off = Math.abs((out.target.p.length - r) / r)
      assert(off < 1e-6f && out.radiance.toRgb == emitted, s"${out.target.p} $r $from"): Unit
      i += 1

  /** A triangle seen under so small an angle that it is its area over the square of the distance,
    * times the cosine, to the square of that angle.
    */
  def byTriangle(count: Long): Unit =
    val draws = Draws(2)
    val out = LightSample()
    var i = 0L
    while i < count do
      val size = draws.magnitude(1e-6, 1e6)
      val soup = Soups.of(Soups.randomTriangles(draws, 1, size)(Vec3.Zero))
      val t = TriangleSampler(soup, 0)
      val from = draws.direction() * (size * draws.magnitude(1e4, 1e6))
      val emitter = AreaLight(t, emitted, true, t.bounds, t.normal, 1f)
      emitter.sample(from, draws.unit(), draws.unit(), out)
      val cosine = Math.abs(from.normalized dot t.normal)
      if cosine > 0.01f && t.area > 1e-3f * size * size then
        val expected = from.length.toDouble * from.length / (t.area * cosine)
        assert(Math.abs(out.pdf / expected - 1) < 0.03, s"${out.pdf} not $expected"): Unit
      i += 1

  def inside(count: Long): Unit =
    val draws = Draws(3)
    val out = LightSample()
    var i = 0L
    while i < count do
      val size = draws.magnitude(1e-4, 1e4)
      val toWorld = draws.translation(size) * draws.rotation()
      val shape = i % 4 match
        case 0 => Soups.sphere(toWorld, size)
        case 1 => Disk(toWorld, 0f, size, 0f, TwoPi, false)
        case 2 => Quadrics.cylinder(size, -size, size, TwoPi).placed(toWorld)
        case _ =>
          BilinearPatches.of(BilinearPatches.corners(draws).map(p => toWorld.point(p * size)))
      val sample = SurfaceSample()
      shape.sample(Vec3(9f * size, 8f * size, 7f * size), draws.unit(), draws.unit(), sample)
      // On it, by a last digit beside it, or anywhere inside
      val from = draws.below(3) match
        case 0 => sample.p
        case 1 => sample.p + draws.direction() * (size * draws.magnitude(1e-9, 1e-3))
        case _ => toWorld.point(draws.vec(-0.5f, 0.5f) * size)
      val emitter = light(shape)
      emitter.sample(from, draws.unit(), draws.unit(), out)
      val isSane = out.pdf >= 0f && !out.pdf.isNaN &&
        (out.pdf == 0f || (out.wi.isFinite && Math.abs(out.wi.length - 1f) < 1e-4f))
      assert(isSane, s"${out.pdf} ${out.wi} from $from")
      val back = shape.pdf(from, sample.p, sample.n)
      assert(back >= 0f && !back.isNaN, s"$back from $from to ${sample.p}"): Unit
      i += 1

private object Many:
  def check(count: Long): Unit =
    val draws = Draws(4)
    val lights = Array.fill[Light](100000):
      PointLight(draws.vec(-100, 100), Rgb.gray(draws.magnitude(1e-6, 1e6)))
    val selection = LightTree(lights)
    val choice = LightChoice()
    var i = 0L
    while i < count do
      val p = draws.vec(-120, 120)
      // Points that face all around get some light from each
      var sum = 0.0
      if i < 1 then
        for k <- lights.indices do sum += selection.probability(p, Vec3.Zero, k)
        assert(Math.abs(sum - 1) < 1e-3, s"$sum at $p"): Unit
      selection.choose(p, Vec3.Zero, draws.unit(), choice)
      val chance = selection.probability(p, Vec3.Zero, choice.light)
      assert(
        choice.light >= 0 && chance > 0f && chance <= 1f,
        s"${choice.light} $chance at $p"
      ): Unit
      i += 1

private object Sky:
  private val frame = LightFrame(Transform.Identity)

  private def sky(layout: SphereMap, smooth: Boolean)(pixel: (Int, Int) => Float) =
    val side = 64
    val data = Array.tabulate(3 * side * side)(i => pixel(i / 3 % side, i / 3 / side))
    val image = SphereImage(Image(side, side, Image.RgbNames, data), layout, Rgb.White, smooth)
    ImageEnvironment(frame, image, complete = true)

  private val layouts = Seq((LatLongMap, true), (EqualAreaMap, false))

  /** ∫ of the radiance: the pixel's value times its solid angle; bilinear lookups spread it over
    * its neighbours, whose solid angles are the same to a thousandth here.
    */
  def onePixel(count: Long): Unit =
    for (layout, smooth) <- layouts do
      val bright = 1e9f
      val light = sky(layout, smooth)((x, y) => if x == 20 && y == 30 then bright else 0f)
      val draws = Draws(5)
      val out = LightSample()
      var sum = 0.0
      var i = 0L
      while i < count do
        light.sample(Vec3.Zero, draws.unit(), draws.unit(), out)
        if out.pdf > 0f then sum += out.radiance.g.toDouble / out.pdf
        i += 1
      val expected = bright * layout.stretch(30.5f / 64).toDouble / (64 * 64)
      // Bilinear lookups vary by as much as they are: 4.5 standard errors
      val allowed = if smooth then 4.5 / Math.sqrt(count.toDouble) + 2e-3 else 1e-4
      assert(Math.abs(sum / count / expected - 1) < allowed, s"${sum / count}, not $expected"): Unit

  def poles(count: Long): Unit =
    for (layout, smooth) <- layouts; value <- Seq(0f, 1f, 1e-38f, 1e30f) do
      val light = sky(layout, smooth)((_, y) => if y == 0 || y == 63 then value else 0f)
      assert(light.isSampled == (value > 0f), s"$value"): Unit
      val draws = Draws(6)
      val out = LightSample()
      var i = 0L
      while i < count do
        light.sample(Vec3.Zero, draws.unit(), draws.unit(), out)
        val d =
          if i % 2 == 0 then Vec3(0f, -0f, if draws.coin() then 1f else -1f)
          else draws.direction()
        val numbers = Seq(out.pdf, light.pdf(Vec3.Zero, d), light.radiance(Vec3.Zero, d).g)
        assert(numbers.forall(x => x >= 0f && java.lang.Float.isFinite(x)), s"$numbers for $d")
        if out.pdf > 0f then assert(Math.abs(out.wi.length - 1f) < 1e-5f, s"${out.wi}"): Unit
        i += 1
