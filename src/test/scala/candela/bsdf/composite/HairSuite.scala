package candela.bsdf.composite

import candela.bsdf.{BsdfLaws, Directions}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.testing.Draws
import candela.textures.{ConstantFloat, ConstantRgb}

class HairSuite extends BsdfLaws:
  private val wide = HairShape(0.6f, 0.7f, 2f)
  for h <- Seq(-0.8f, 0f, 0.5f) do
    obeysLaws(
      s"brown hair at $h",
      Hair(h, 1.55f, Rgb(0.419f, 0.697f, 1.37f), wide),
      isReciprocal = false // the scales are tilted
    )
  obeysLaws(
    "fine hair",
    Hair(0.3f, 1.55f, Rgb.gray(0.1f), HairShape(0.1f, 0.15f, 2f)),
    isNarrow = true,
    isReciprocal = false
  )

  obeysLaws(
    "round hair",
    RoundHair(1.55f, Rgb(0.419f, 0.697f, 1.37f), wide),
    isReciprocal = false
  )

  test("round hair reflects at its surface as a mirror would, from outside and from within"):
    // It absorbs all that enters
    val hair = RoundHair(1.55f, Rgb.gray(1e3f), HairShape(0.05f, 0.05f, 0f))
    for degrees <- Seq(-70, -20, 0, 45, 110, 160) do
      val angle = Math.toRadians(degrees)
      val wo = Vec3(Math.sin(angle).toFloat, 0f, Math.cos(angle).toFloat)
      val mirrored = Vec3(-wo.x, 0f, wo.z)
      val wi = hair.sample(wo, 0.5f, 0.5f, 0.5f).wi
      assert((wi dot mirrored) > 0.99f, s"$degrees: $wi")

  test("highlights are on the side of the light in Mitsuba, on the other in pbrt"):
    val black = Pigment.Absorption(ConstantRgb(Rgb.gray(1e3f)))
    def reflected(offset: HairOffset, v: Float) =
      val width = ConstantFloat(0.1f)
      val material =
        HairMaterial(offset, black, ConstantFloat(1.55f), width, width, ConstantFloat(0f))
      val at = ShadingPoint()
      at.v = v
      material.bsdf(at).sample(Vec3.Z, 0.5f, 0.5f, 0.5f).wi.y
    // A curve's v falls along y: its normal faces the viewer
    assert(reflected(HairOffset.Across, 0.8f) > 0.5f)
    assert(reflected(HairOffset.Mirrored, 0.8f) < -0.5f)

  /** Light that a hair scatters to `wo` under an even sky, averaged over its width. */
  private def reflected(shape: HairShape, sigmaA: Rgb, wo: Vec3): Rgb =
    val draws = Draws(7)
    val n = 40000
    var sum = Rgb.Black
    for _ <- 0 until n do
      val hair = Hair(draws.between(-1f, 1f), 1.55f, sigmaA, shape)
      sum += hair.sample(wo, draws.unit(), draws.unit(), draws.unit()).weight
    sum * (1f / n.toFloat)

  test("hair that absorbs nothing is white under an even sky"):
    for m <- Seq(0.2f, 0.5f, 0.9f); n <- Seq(0.2f, 0.5f, 0.9f) do
      val all = reflected(HairShape(m, n, 0f), Rgb.Black, Directions.at(50, 70))
      // samples are drawn by the density itself, but for u below 1e-5 in the lobe along the hair
      assert(abs(all.g - 1f) < 1e-3f, s"$m $n: $all")

  test("each direction's scattered light, by an integral over the sphere, is the same"):
    val draws = Draws(3)
    val n = 200000
    for (m, b) <- Seq((0.4f, 0.4f), (0.8f, 0.6f)) do
      val shape = HairShape(m, b, 2f)
      val wo = Directions.at(30, 200)
      var sum = 0.0
      for _ <- 0 until n do
        val z = draws.between(-1f, 1f)
        val phi = draws.between(0f, TwoPi)
        val r = safeSqrt(1f - z * z)
        val wi = Vec3(r * cos(phi), r * sin(phi), z)
        val hair = Hair(draws.between(-1f, 1f), 1.55f, Rgb.Black, shape)
        sum += hair.f(wo, wi).g * Math.abs(z) * 4 * Math.PI
      // relative spread of the integrand below 6: three standard errors of 200,000 draws
      assert(Math.abs(sum / n - 1) < 0.04, s"$m $b: ${sum / n}")

  test("the Bessel function agrees with its power series"):
    for i <- 0 to 60 do
      val x = i * 0.25
      var term = 1.0
      var sum = 1.0
      for k <- 1 to 80 do
        term *= (x / 2) * (x / 2) / (k.toDouble * k)
        sum += term
      val found = Bessel.scaledI0(x) * Math.exp(x)
      assert(Math.abs(found / sum - 1) < 5e-7, s"I0($x)") // the fits' own accuracy is 2e-7

  test("the logistic distribution integrates to one over the circle, and is sampled so"):
    for s <- Seq(0.02f, 0.2f, 1.5f) do
      val n = 20000
      val steps = (0 until n).map(i => -Math.PI + (i + 0.5) * 2 * Math.PI / n)
      val total = steps.map(x => Logistic.density(x.toFloat, s)).sum * 2 * Math.PI / n
      // 20,000 Floats are added as Floats: roundings of 6e-8 of the sum, of either sign
      assert(Math.abs(total - 1) < 1e-4, s"$s")
      val median = Logistic.sample(0.5f, s)
      assert(abs(median) < 1e-5f)

  test("a colour's absorption gives that colour's order: darker absorbs more"):
    val dark = Pigment.ofColor(Rgb(0.1f, 0.3f, 0.9f), 0.3f)
    assert(dark.r > dark.g && dark.g > dark.b && dark.b > 0f)
    assert(Pigment.ofColor(Rgb.White, 0.3f) == Rgb.Black)
