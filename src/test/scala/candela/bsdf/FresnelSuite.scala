package candela.bsdf

import candela.color.Rgb
import org.scalatest.funsuite.AnyFunSuite

class FresnelSuite extends AnyFunSuite:

  /** By the sine and tangent form of the equations: independent of the form in use. */
  private def bySines(thetaI: Double, eta: Double): Double =
    val thetaT = Math.asin(Math.sin(thetaI) / eta)
    val s = Math.sin(thetaI - thetaT) / Math.sin(thetaI + thetaT)
    val p = Math.tan(thetaI - thetaT) / Math.tan(thetaI + thetaT)
    (s * s + p * p) / 2

  /** By complex arithmetic, straight from the definition. */
  private def byComplex(cosI: Double, n: Double, k: Double): Double =
    final case class C(re: Double, im: Double):
      def +(o: C) = C(re + o.re, im + o.im)
      def -(o: C) = C(re - o.re, im - o.im)
      def *(o: C) = C(re * o.re - im * o.im, re * o.im + im * o.re)
      def norm: Double = re * re + im * im
      def root: C =
        val (r, angle) = (Math.sqrt(Math.hypot(re, im)), Math.atan2(im, re) / 2)
        C(r * Math.cos(angle), r * Math.sin(angle))
    val eta = C(n, k)
    val cosine = C(cosI, 0)
    // eta · cos θt
    val t = (eta * eta - C(1 - cosI * cosI, 0)).root
    val s = (cosine - t).norm / (cosine + t).norm
    val p = (eta * eta * cosine - t).norm / (eta * eta * cosine + t).norm
    (s + p) / 2

  test("at normal incidence ((n − 1)/(n + 1))² is reflected, from either side"):
    for n <- Seq(1.1, 1.33, 1.5, 2.4) do
      val expected = Math.pow((n - 1) / (n + 1), 2)
      // One rounding of the index, one of the result.
      assert(Math.abs(Fresnel.dielectric(1f, n.toFloat) - expected) < 1e-6 * expected)
      assert(Math.abs(Fresnel.dielectric(-1f, n.toFloat) - expected) < 1e-6 * expected)

  test("between the normal and grazing it is off by at most 1e-6 from the form with sines"):
    for n <- Seq(0.6f, 0.9f, 1.2f, 1.5f, 2.4f); degrees <- 1 to 89 do
      val theta = Math.toRadians(degrees)
      val expected = if Math.sin(theta) >= n then 1.0 else bySines(theta, n)
      // At the critical angle the rounding of the cosine alone (6e-8) shows as its square root.
      val allowed = if Math.abs(Math.sin(theta) - n) < 1e-3 then 1e-3 else 1e-6
      val actual = Fresnel.dielectric(Math.cos(theta).toFloat, n)
      assert(Math.abs(actual - expected) < allowed, s"n=$n at $degrees°")

  test("at Brewster's angle only one polarisation is reflected"):
    for n <- Seq(1.33, 1.5, 2.0) do
      val expected = Math.pow((n * n - 1) / (n * n + 1), 2) / 2
      val actual = Fresnel.dielectric(Math.cos(Math.atan(n)).toFloat, n.toFloat)
      // The rounding of angle and index.
      assert(Math.abs(actual - expected) < 1e-6)

  test("all is reflected at grazing angles and past the critical one, nothing by an index of 1"):
    assert(Fresnel.dielectric(0f, 1.5f) == 1f)
    val critical = Math.asin(1 / 1.5)
    assert(Fresnel.dielectric(-Math.cos(critical + 1e-3).toFloat, 1.5f) == 1f)
    assert(Fresnel.dielectric(-Math.cos(critical - 1e-3).toFloat, 1.5f) < 1f)
    assert(Fresnel.dielectric(0.3f, 1f) == 0f)

  test("what enters at an angle leaves at the angle it entered with"):
    for degrees <- 0 to 89 do
      val cosI = Math.cos(Math.toRadians(degrees)).toFloat
      val cosT = Fresnel.cosRefracted(cosI, 1.5f)
      // Rounding: 1e-7 in cosT is magnified by cosT/cosI on the way back.
      assert(Math.abs(Fresnel.cosRefracted(cosT, 1 / 1.5f) - cosI) < 1e-6f / Math.max(cosI, 0.01f))
      val there = Fresnel.dielectric(cosI, 1.5f)
      val back = Fresnel.dielectric(-cosT, 1.5f)
      assert(Math.abs(there - back) < 1e-5f / Math.max(cosI, 0.01f), s"at $degrees°")

  test("refraction obeys Snell's law and stays in the plane of incidence"):
    val m = Directions.at(25, 70)
    for eta <- Seq(0.7f, 1.5f); w <- Directions.few if (w dot m) > 0.1f do
      val cosI = w dot m
      val cosT = Fresnel.cosRefracted(cosI, eta)
      if cosT >= 0f then
        val t = Fresnel.refracted(w, m, cosI, cosT, eta)
        // A few roundings of numbers near 1.
        assert(Math.abs(t.length - 1f) < 1e-6f)
        assert(((t * eta + w) cross m).length < 1e-6f)
        assert((t dot m) < 0f)
      else assert(Math.sqrt(1 - cosI * cosI) >= eta - 1e-6)

  test("a metal that does not absorb is a dielectric"):
    for n <- Seq(0.5f, 1.2f, 1.5f, 3f); degrees <- 0 to 90 by 3 do
      val c = Math.cos(Math.toRadians(degrees)).toFloat
      // The last digit; near the critical angle as above.
      val allowed = if Math.abs(Math.sqrt(1 - c * c) - n) < 1e-3 then 1e-3f else 1e-6f
      val metal = Fresnel.conductor(c, n, 0f)
      assert(Math.abs(metal - Fresnel.dielectric(c, n)) < allowed, s"n=$n at $degrees°")

  test("metals agree with complex arithmetic to 1e-6, also those with a small index"):
    for (n, k) <- Seq((0.2f, 3.9f), (1.1f, 2.6f), (0.01f, 5f), (2.9f, 3f), (0.05f, 0.4f)) do
      for degrees <- 0 to 90 by 2 do
        val c = Math.cos(Math.toRadians(degrees)).toFloat
        val actual = Fresnel.conductor(c, n, k)
        assert(Math.abs(actual - byComplex(c, n, k)) < 1e-6, s"n=$n k=$k at $degrees°")

  test("the approximation for strong absorbers is within 0.02 of the truth for copper"):
    for (n, k) <- Seq((0.2f, 3.9f), (1.04f, 2.58f), (1.2f, 2.3f)); degrees <- 0 to 90 by 5 do
      val c = Math.cos(Math.toRadians(degrees)).toFloat
      // At the normal there is no sine to drop.
      val allowed = if degrees == 0 then 1e-6 else 0.02
      assert(Math.abs(Fresnel.strongConductor(c, n, k) - byComplex(c, n, k)) < allowed)

  test("the channels of a metal don't mix"):
    val (eta, k) = (Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.6f, 2.4f))
    val c = Fresnel.conductor(0.7f, eta, k)
    assert(c == Rgb(
      Fresnel.conductor(0.7f, 0.2f, 3.9f),
      Fresnel.conductor(0.7f, 0.9f, 2.6f),
      Fresnel.conductor(0.7f, 1.1f, 2.4f)
    ))
