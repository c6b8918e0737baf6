package candela.sampling

// N^(−3/2) for smooth integrands: 64; 128 pixels on either side leave 12 % of noise
class OwenSobolSamplerSuite extends SamplerLaws(OwenSobolSampler(_, _), sharper = 40):

  test("each power-of-two prefix of a pair has one sample in every elementary interval"):
    val s = OwenSobolSampler(256, 1)
    for px <- 0 until 8; skip <- 0 until 4 do
      val all = points(s, px, 3, 256, skip)
      for log <- 0 to 8 do
        assert(ElementaryIntervals.allHoldOne(all.take(1 << log)), s"pixel $px skip $skip, 2^$log")

  test("each power-of-two prefix of a single dimension has one sample in every interval"):
    val s = OwenSobolSampler(256, 1)
    for px <- 0 until 8; skip <- 0 until 4; log <- 0 to 8 do
      assert(ElementaryIntervals.eachHoldsOne(singles(s, px, 3, 1 << log, skip)))

  test("so has each aligned power-of-two block"):
    val all = points(OwenSobolSampler(256, 1), 2, 3, 256, 1)
    for log <- 0 to 6; block <- 0 until (256 >> log) do
      assert(ElementaryIntervals.allHoldOne(all.slice(block << log, (block + 1) << log)))

  test("a count that is no power of two has a smaller error than independent samples"):
    def f(x: Double, y: Double) = x * x * y
    val independent = Math.sqrt((1.0 / 15 - 1.0 / 36) / 48)
    assert(error(48, 0)(f, 1.0 / 6) < independent / 4)

  test("different requests pair up independently: no order is shared"):
    val s = OwenSobolSampler(16, 1)
    val joint = (0 until 64).flatMap: px =>
      singles(s, px, 0, 16, 0).zip(singles(s, px, 0, 16, 1)).map: (u, v) =>
        ((u * 16).toInt, (v * 16).toInt)
    // 1024 random throws into 256 cells leave 256 · e⁻⁴ = 4.7 empty; a shared order leaves 240
    assert(joint.distinct.size > 235)
