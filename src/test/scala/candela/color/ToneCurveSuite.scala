package candela.color

import org.scalatest.funsuite.AnyFunSuite

class ToneCurveSuite extends AnyFunSuite:

  // From the published formulas, in double precision.
  private val known = Vector(
    (ToneCurve.Linear, Rgb(2f, 0.5f, 0.1f), Rgb(2f, 0.5f, 0.1f)),
    (ToneCurve.Filmic, Rgb.gray(0.18f), Rgb.gray(0.128338f)),
    (ToneCurve.Filmic, Rgb(2f, 0.5f, 0.1f), Rgb(0.713238f, 0.304301f, 0.0742147f)),
    (ToneCurve.Aces, Rgb.gray(0.18f), Rgb.gray(0.105591f)),
    (ToneCurve.Aces, Rgb(2f, 0.5f, 0.1f), Rgb(0.901499f, 0.418689f, 0.105001f)),
    (ToneCurve.Agx, Rgb.gray(0.18f), Rgb(0.214467f, 0.214533f, 0.214537f)),
    (ToneCurve.Agx, Rgb(2f, 0.5f, 0.1f), Rgb(0.807289f, 0.449624f, 0.210690f))
  )

  test("the curves have the values of their sources"):
    for (curve, light, shown) <- known do
      val found = curve(light)
      // Float matrices of numbers up to 1.6.
      assert((found - shown).largest < 2e-5f, s"$curve of $light: $found")

  test("brighter grey is never darker, from black to white"):
    for curve <- ToneCurve.values.filter(_ != ToneCurve.Linear) do
      val grays = (0 to 400).map(i => curve(Rgb.gray(Math.pow(2, i / 20.0 - 12).toFloat)))
      assert(grays.sliding(2).forall(p => p(1).luminance >= p(0).luminance - 1e-6f), curve)
      assert(curve(Rgb.Black).largest < 1e-6f, curve)
      // AgX's polynomial ends at 0.9986, which its exponent of 2.2 makes 0.997
      assert((curve(Rgb.gray(1e30f)) - Rgb.White).largest < 5e-3f, curve)

  test("values stay in [0, 1], whatever the light"):
    val light = Vector(-5f, 0f, 0.3f, 7f, Float.MaxValue, Float.PositiveInfinity)
    for curve <- ToneCurve.values.filter(_ != ToneCurve.Linear); r <- light; g <- light; b <- light
    do
      val c = curve(Rgb(r, g, b))
      for v <- Vector(c.r, c.g, c.b) do assert(v >= 0f && v <= 1f, s"$curve of $r $g $b")
