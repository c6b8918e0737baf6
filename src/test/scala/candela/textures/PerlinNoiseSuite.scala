package candela.textures

import candela.math.*
import candela.testing.Draws
import org.scalatest.funsuite.AnyFunSuite

class PerlinNoiseSuite extends AnyFunSuite:

  test("noise is 0 at lattice points, near and far"):
    val draws = Draws(1)
    for _ <- 0 until 1000 do
      val p = Vec3(draws.below(2000) - 1000f, draws.below(2000) - 1000f, draws.below(600) - 300f)
      assert(PerlinNoise(p) == 0f, s"$p")

  test("noise is continuous, with a continuous slope, across lattice planes"):
    val draws = Draws(2)
    val h = 1e-3f
    for _ <- 0 until 1000 do
      val p = Vec3(draws.below(9) - 4f, draws.between(-4, 4), draws.between(-4, 4))
      def at(dx: Float) = PerlinNoise(p + Vec3(dx, 0, 0))
      // The slope is at most about 4, its change over h at most about 40 h
      assert(abs(at(h) - at(-h)) < 8 * h)
      assert(abs((at(h) - at(0)) - (at(0) - at(-h))) < 60 * h * h + 1e-6f)

  test("noise repeats after 256 and stays within its range, on both sides of zero"):
    val draws = Draws(3)
    val values = Vector.fill(20000):
      val p = draws.vec(-8, 8)
      // 256 added takes 5 bits from the fraction: 8 + 8 + 4 of 24 are left
      assert(abs(PerlinNoise(p + Vec3(256, 0, 0)) - PerlinNoise(p)) < 2e-4f)
      PerlinNoise(p)
    assert(values.forall(v => abs(v) <= 1.05f) && values.min < -0.7f && values.max > 0.7f)
    assert(abs(values.sum / values.size) < 0.01f)

  test("the slope at a lattice point is one of the cube's twelve edge directions"):
    val h = 1e-2f
    for x <- 0 until 6; y <- 0 until 6; z <- 0 until 6 do
      val p = Vec3(x.toFloat, y.toFloat, z.toFloat)
      def slope(d: Vec3) = (PerlinNoise(p + d * h) - PerlinNoise(p - d * h)) / (2 * h)
      val gradient = Seq(Vec3.X, Vec3.Y, Vec3.Z).map(slope)
      // The neighbours' weights begin with h³
      val sizes = gradient.map(g => abs(g)).sorted
      assert(sizes.zip(Seq(0f, 1f, 1f)).forall((a, b) => abs(a - b) < 0.01f), s"$gradient at $p")

  test("values are those of Perlin's algorithm, worked out by hand"):
    // At the cell's middle all weights are 1/2: the mean of the eight corners' slopes
    val gradients = Vector(
      (1, 1, 0),
      (-1, 1, 0),
      (1, -1, 0),
      (-1, -1, 0),
      (1, 0, 1),
      (-1, 0, 1),
      (1, 0, -1),
      (-1, 0, -1),
      (0, 1, 1),
      (0, -1, 1),
      (0, 1, -1),
      (0, -1, -1),
      (1, 1, 0),
      (-1, 1, 0),
      (0, 1, -1),
      (0, -1, -1)
    )
    // The few entries of Perlin's published permutation that the cell at the origin needs
    val p = Map(
      0 -> 151,
      1 -> 160,
      17 -> 36,
      18 -> 103,
      119 -> 86,
      120 -> 164,
      151 -> 17,
      152 -> 182,
      160 -> 119,
      161 -> 248,
      182 -> 108,
      183 -> 110,
      248 -> 128,
      249 -> 195
    )
    val slopes =
      for x <- 0 to 1; y <- 0 to 1; z <- 0 to 1 yield
        val (gx, gy, gz) = gradients(p(p(p(x) + y) + z) & 15)
        gx * (0.5f - x) + gy * (0.5f - y) + gz * (0.5f - z)
    assert(abs(PerlinNoise(0.5f, 0.5f, 0.5f) - slopes.sum / 8) < 1e-6f)
