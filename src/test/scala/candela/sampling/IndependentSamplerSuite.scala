package candela.sampling

import candela.math.*
import candela.testing.ChiSquare

// the error falls by 4 ± 12 % (128 pixels on either side): 3 is three deviations below
class IndependentSamplerSuite extends SamplerLaws(IndependentSampler(_, _), sharper = 2.8):

  test("pairs are uniform in the square, for a fixed pixel and for a fixed sample"):
    val s = IndependentSampler(1 << 20, 1)
    var i = 0
    val alongSamples = ChiSquare.square(1)(
      _ =>
        s.start(3, 4, i)
        s.next2D()
        i += 1
        Some(Vec3(s.x, s.y, 0f))
      ,
      (_, _) => 1.0
    )
    assert(alongSamples.accepted(tests = 2), alongSamples)
    val alongPixels = ChiSquare.square(1)(
      _ =>
        s.start(i % 640, i / 640, 0)
        s.next2D()
        i += 1
        Some(Vec3(s.x, s.y, 0f))
      ,
      (_, _) => 1.0
    )
    assert(alongPixels.accepted(tests = 2), alongPixels)

  test("the largest bits make the largest Float below 1"):
    assert(SampleHash.toUnit(-1) == OneMinusEpsilon)
    assert(SampleHash.toUnit(0) == 0f)
