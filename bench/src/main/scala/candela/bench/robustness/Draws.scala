package candela.bench.robustness

import java.util.SplittableRandom

import candela.math.*

/** Random numbers, vectors and transforms: the same sequence in every run. */
final class Draws(seed: Long):
  private val random = SplittableRandom(seed)

  def below(n: Int): Int = random.nextInt(n)
  def coin(): Boolean = random.nextBoolean()

  /** In [0, 1), a multiple of 2⁻²⁴. */
  def unit(): Float = random.nextInt(1 << 24) * 5.9604645e-8f
  def between(low: Float, high: Float): Float = low + (high - low) * unit()

  /** Uniform in the logarithm: all orders of magnitude alike. */
  def magnitude(low: Double, high: Double): Float =
    Math.exp(random.nextDouble(Math.log(low), Math.log(high))).toFloat

  def vec(low: Float, high: Float): Vec3 =
    Vec3(between(low, high), between(low, high), between(low, high))

  /** Uniform on the unit sphere; Doubles inside. */
  def direction(): Vec3 =
    val z = 2 * random.nextDouble() - 1
    val phi = 2 * Math.PI * random.nextDouble()
    val r = Math.sqrt(1 - z * z)
    Vec3((r * Math.cos(phi)).toFloat, (r * Math.sin(phi)).toFloat, z.toFloat)

  /** A unit vector in the hemisphere of `n`. */
  def above(n: Vec3): Vec3 = direction().facing(n)

  def rotation(): Transform =
    val a = direction()
    Transform.rotate(random.nextDouble(360), a.x, a.y, a.z).get

  def translation(size: Float): Transform =
    val v = vec(-size, size)
    Transform.translate(v.x, v.y, v.z)

  /** Stretches by 1/4 to 4 along each axis; half of them mirror. */
  def stretch(): Transform =
    def factor() = magnitude(0.25, 4).toDouble
    Transform.scale(if coin() then -factor() else factor(), factor(), factor()).get
