package candela.color

import org.scalatest.funsuite.AnyFunSuite

final class NamedSpectraSuite extends AnyFunSuite:

  test("all 88 names of pbrt-v4 are known"):
    assert(NamedSpectra.names.distinct.size == 88)
    val some = Seq("metal-CuZn-k", "glass-LASF9", "stdillum-A", "stdillum-F12", "illum-acesD60",
      "canon_eos_100d_r", "sony_ilce_9_b")
    for name <- some do assert(NamedSpectra.names.contains(name))

  for name <- NamedSpectra.names do
    test(s"the spectrum $name covers the visible range, without negative values"):
      val s = NamedSpectra(name).get
      assert(s.lambda.length >= 2)
      assert(s.lambda.zip(s.lambda.tail).forall(_ < _))
      assert(s.lambda.head <= 400f && s.lambda.last >= 700f)
      assert(s.values.forall(_ >= 0f))

  test("unknown names have no spectrum"):
    assert(NamedSpectra("metal-Xx-eta").isEmpty)

  // CIE 15:2004, tables T.3 and 11.1; ACES: SMPTE ST 2065-1
  private val chromaticities = Seq(
    ("stdillum-A", 0.4476, 0.4074),
    ("stdillum-D50", 0.3457, 0.3585),
    ("stdillum-D65", 0.3127, 0.3290),
    ("illum-acesD60", 0.3217, 0.3377),
    ("stdillum-F1", 0.3131, 0.3371),
    ("stdillum-F2", 0.3721, 0.3751),
    ("stdillum-F3", 0.4091, 0.3941),
    ("stdillum-F4", 0.4402, 0.4031),
    ("stdillum-F5", 0.3138, 0.3452),
    ("stdillum-F6", 0.3779, 0.3882),
    ("stdillum-F7", 0.3129, 0.3292),
    ("stdillum-F8", 0.3458, 0.3586),
    ("stdillum-F9", 0.3741, 0.3727),
    ("stdillum-F10", 0.3458, 0.3588),
    ("stdillum-F11", 0.3805, 0.3769),
    ("stdillum-F12", 0.4370, 0.4042)
  )

  for (name, x, y) <- chromaticities do
    test(s"the illuminant $name has its published chromaticity"):
      val s = NamedSpectra(name).get
      val xyz = Colorimetry.observers.map: o =>
        (360 to 830 by 5).map(nm => (o(nm.toFloat) * s(nm.toFloat)).toDouble).sum
      // Published to four digits
      assert(Math.abs(xyz(0) / xyz.sum - x) < 6e-5)
      assert(Math.abs(xyz(1) / xyz.sum - y) < 6e-5)

  test("a sensor's curves are those of the film's sensor, by channel"):
    val Seq(r, g, b) = Seq("r", "g", "b").map(c => NamedSpectra(s"nikon_d810_$c").get)
    assert(r(600f) > g(600f) && g(530f) > r(530f) && b(450f) > g(450f))
