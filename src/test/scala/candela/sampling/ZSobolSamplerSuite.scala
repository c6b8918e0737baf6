package candela.sampling

// A pixel's own samples are a net: N^(−3/2) again
class ZSobolSamplerSuite extends SamplerLaws(ZSobolSampler(_, 64, 64, _), sharper = 40):

  /** The points of a block of pixels for one pair of dimensions. */
  private def block(s: ZSobolSampler, x0: Int, y0: Int, side: Int, skip: Int): IndexedSeq[Point] =
    for
      px <- x0 until x0 + side
      py <- y0 until y0 + side
      p <- points(s, px, py, s.samplesPerPixel, skip)
    yield p

  test("the samples of each aligned block of pixels have one in every elementary interval"):
    for spp <- Seq(1, 2, 4, 8, 16); side <- Seq(1, 2, 4, 8); skip <- 0 until 3 do
      val s = ZSobolSampler(spp, 40, 24, 5)
      for (bx, by) <- Seq((0, 0), (1, 0), (2, 1)) do
        val joint = block(s, bx * side, by * side, side, skip)
        assert(ElementaryIntervals.allHoldOne(joint), s"$spp samples, side $side, skip $skip")

  test("so have those of each further set"):
    val s = ZSobolSampler(4, 40, 24, 5)
    for set <- 1 to 3 do
      val joint =
        for px <- 8 until 12; py <- 4 until 8; i <- 4 * set until 4 * set + 4 yield
          s.start(px, py, i)
          s.next2D()
          (s.x, s.y)
      assert(ElementaryIntervals.allHoldOne(joint), s"set $set")

  test("single dimensions are stratified over pixels, too"):
    for spp <- Seq(1, 2, 4, 8); side <- Seq(1, 2, 4) do
      val s = ZSobolSampler(spp, 64, 64, 5)
      val pixels = for px <- 0 until side; py <- 0 until side yield (px, py)
      val joint = pixels.flatMap((px, py) => singles(s, px, py, spp, 2))
      assert(ElementaryIntervals.eachHoldsOne(joint), s"$spp samples, side $side")

  test("counts round up to a power of two"):
    assert(Seq(1, 2, 3, 5, 16, 17).map(ZSobolSampler(_, 8, 8, 0).samplesPerPixel) ==
      Seq(1, 2, 4, 8, 16, 32))

  test("neighbours' errors cancel: blurred, they are half of OwenSobolSampler's at most"):
    def f(x: Float, y: Float) = Math.exp(x + y / 2)
    def blurredError(s: Sampler): Double =
      val exact = (Math.E - 1) * 2 * (Math.sqrt(Math.E) - 1)
      val errors = Array.tabulate(64, 64): (px, py) =>
        points(s, px, py, 4, 1).map(f).sum / 4 - exact
      // means over 4 × 4 pixels that straddle the quadrants of the curve
      val means =
        for bx <- 2 to 58 by 4; by <- 2 to 58 by 4
        yield (for dx <- 0 until 4; dy <- 0 until 4 yield errors(bx + dx)(by + dy)).sum / 16
      Math.sqrt(means.map(m => m * m).sum / means.size)
    // a factor of 2 at equal samples is what makes the scheme worth its cost
    assert(blurredError(ZSobolSampler(4, 64, 64, 1)) * 2 < blurredError(OwenSobolSampler(4, 1)))

  test("large images with many samples need more than 32 bits of curve, and still fill the square"):
    val s = ZSobolSampler(1024, 8192, 8192, 1)
    assert(ElementaryIntervals.allHoldOne(points(s, 8191, 4097, 1024, 1)))
    assert(points(s, 0, 0, 64, 0) != points(s, 4096, 4096, 64, 0))
