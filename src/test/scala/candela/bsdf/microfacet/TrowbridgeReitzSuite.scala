package candela.bsdf.microfacet

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Directions

class TrowbridgeReitzSuite extends AnyFunSuite:
  private val shapes = Seq(TrowbridgeReitz(0.3f, 0.3f), TrowbridgeReitz(0.2f, 0.6f))

  test("the projected area of all facets is that of the surface"):
    for shape <- shapes do
      // The grid's error.
      assert(Math.abs(Directions.overHemisphere(m => shape.d(m) * m.z.toDouble) - 1) < 1e-3)

  test("visible facets cover what is seen: the pdf of normals integrates to 1"):
    for shape <- shapes; wo <- Directions.few if wo.z > 0f do
      assert(
        Math.abs(Directions.overHemisphere(m => shape.pdf(wo, m)) - 1) < 1e-3,
        s"at $wo"
      ) // the grid's error

  test("the density is that of the textbook, with tangents and cosines"):
    val (ax, ay) = (0.2, 0.6)
    for (theta, phi) <- Seq((5.0, 0.0), (30.0, 50.0), (70.0, 120.0)) do
      val (t, p) = (Math.toRadians(theta), Math.toRadians(phi))
      val tilt = Math.pow(Math.cos(p) / ax, 2) + Math.pow(Math.sin(p) / ay, 2)
      val e = Math.pow(Math.tan(t), 2) * tilt
      val expected = 1 / (Math.PI * ax * ay * Math.pow(Math.cos(t), 4) * Math.pow(1 + e, 2))
      val actual = TrowbridgeReitz(0.2f, 0.6f).d(Directions.at(theta, phi))
      assert(Math.abs(actual - expected) < 1e-5 * expected) // rounding of the direction

  test("visibility is Smith's G, correlated in height, over four cosines"):
    val (ax, ay) = (0.2, 0.6)
    def lambda(theta: Double, phi: Double): Double =
      val (t, p) = (Math.toRadians(theta), Math.toRadians(phi))
      val alpha2 = Math.pow(Math.cos(p) * ax, 2) + Math.pow(Math.sin(p) * ay, 2)
      (Math.sqrt(1 + alpha2 * Math.pow(Math.tan(t), 2)) - 1) / 2
    val g = 1 / (1 + lambda(50, 20) + lambda(75, 140))
    val cosines = Math.cos(Math.toRadians(50)) * Math.cos(Math.toRadians(75))
    val (wo, wi) = (Directions.at(50, 20), Directions.at(75, 140))
    val actual = TrowbridgeReitz(0.2f, 0.6f).visibility(wo, wi, (wo + wi).normalized)
    assert(Math.abs(actual - g / (4 * cosines)) < 1e-6 * actual * 10) // ten roundings

  test("sampled normals face the viewer"):
    for shape <- shapes :+ TrowbridgeReitz(0.001f, 0.001f); wo <- Directions.few if wo.z > 0f do
      for i <- 0 until 32; j <- 0 until 32 do
        val m = shape.sample(wo, i / 32f, j / 32f)
        assert(m.z > 0f && (m dot wo) > -1e-6f, s"$m for $wo") // rounding

  test("roughness below a thousandth counts as none only if it is so in both directions"):
    assert(TrowbridgeReitz(0.0009f, 0f).isSmooth)
    assert(!TrowbridgeReitz(0f, 0.1f).isSmooth && !TrowbridgeReitz(0.001f, 0.001f).isSmooth)
    val m = TrowbridgeReitz(0f, 0.1f).sample(Directions.at(30, 30), 0.3f, 0.6f)
    assert(m.isFinite && java.lang.Float.isFinite(TrowbridgeReitz(0f, 0.1f).d(m)))

  test("regularized it is twice as rough, but from 0.1 to 0.3, and what is rougher stays"):
    for
      (alpha, expected) <- Seq(
        (0f, 0.1f),
        (0.04f, 0.1f),
        (0.1f, 0.2f),
        (0.2f, 0.3f),
        (0.3f, 0.3f),
        (0.5f, 0.5f)
      )
    do
      val wide = TrowbridgeReitz(alpha, 0.7f).regularized
      assert(wide.alphaX == expected && wide.alphaY == 0.7f)
