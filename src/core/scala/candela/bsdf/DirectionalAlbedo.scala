package candela.bsdf

import candela.color.Rgb
import candela.math.Vec3

/** Estimates the hemispherical-directional reflectance of a BSDF. */
object DirectionalAlbedo:
  /** Number of samples, as in pbrt-v4. */
  val Samples = 16

  /** Mean weight of the first `samples` samples of `bsdf`; in the colours of the scene. */
  def apply(bsdf: Bsdf, wo: Vec3, samples: Int = Samples): Rgb =
    var sum = Rgb.Black
    var i = 0
    while i < samples do
      val k = 3 * i
      sum += bsdf.sample(wo, points(k), points(k + 1), points(k + 2)).weight
      i += 1
    sum * (1f / samples)

  /** Quasi-random points of the unit cube, the same for every surface, so that the albedo has no
    * noise.
    *
    * Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: multiples of
    * powers of the root of x⁴ = x + 1.
    */
  private val points: Array[Float] =
    val root = 1.2207440846057596
    Array.tabulate(3 * Samples): i =>
      val step = Math.pow(root, -(i % 3 + 1.0))
      val x = 0.5 + (i / 3 + 1) * step
      (x - Math.floor(x)).toFloat
