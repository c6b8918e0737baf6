package candela.sampling

/** A near-square grid with at least `n` cells. */
private def grid(n: Int, seed: Int): StratifiedSampler =
  val columns = Math.ceil(Math.sqrt(n)).toInt
  StratifiedSampler(columns, (n + columns - 1) / columns, jitter = true, seed)

// N⁻¹ in two dimensions: 16, and 256 samples have 4 % of noise from the 128 pixels on either side
class StratifiedSamplerSuite extends SamplerLaws(grid, sharper = 11):

  test("each cell of the grid holds one sample, in every pair and single dimension"):
    for (nx, ny) <- Seq((4, 4), (3, 5), (1, 7), (8, 2)); px <- 0 until 4; skip <- 0 until 4 do
      val s = StratifiedSampler(nx, ny, jitter = true, 2)
      val cells = points(s, px, 1, nx * ny, skip).map((x, y) => ((x * nx).toInt, (y * ny).toInt))
      assert(cells.distinct.size == nx * ny, s"$nx × $ny, pixel $px, skip $skip")
      assert(ElementaryIntervals.eachHoldsOne(singles(s, px, 1, nx * ny, skip)))

  test("without jitter samples are the centres of cells"):
    val s = StratifiedSampler(4, 2, jitter = false, 2)
    val expected = for i <- 0 until 4; j <- 0 until 2 yield ((i + 0.5f) / 4, (j + 0.5f) / 2)
    assert(points(s, 0, 0, 8, 3).toSet == expected.toSet)

  test("cells come in another order for another pixel or dimension"):
    val s = StratifiedSampler(4, 4, jitter = false, 2)
    assert(points(s, 0, 0, 16, 0) != points(s, 1, 0, 16, 0))
    assert(points(s, 0, 0, 16, 0) != points(s, 0, 0, 16, 1))

  test("samples past the last cell begin another pass with new numbers"):
    val s = StratifiedSampler(4, 4, jitter = true, 2)
    val all = points(s, 0, 0, 32, 0)
    val second = all.drop(16).map((x, y) => ((x * 4).toInt, (y * 4).toInt))
    assert(second.distinct.size == 16)
    assert(all.distinct.size == 32)

  test("a grid without cells is refused"):
    assertThrows[IllegalArgumentException](StratifiedSampler(0, 4, jitter = true, 0))
