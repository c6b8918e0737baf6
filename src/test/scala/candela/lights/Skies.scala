package candela.lights

import candela.math.*

/** Integrals over directions by brute force: the middles of 512 × 512 cells of equal solid
  * angle.
  */
object Skies:
  private val Side = 512

  /** ∫ f over the sphere. */
  def sphere(f: Vec3 => Double): Double = integral(-1, f)

  /** ∫ f · cos over the hemisphere of +z. */
  def irradiance(f: Vec3 => Double): Double = integral(0, d => f(d) * d.z)

  private def integral(bottom: Double, f: Vec3 => Double): Double =
    var sum = 0.0
    for i <- 0 until Side; j <- 0 until Side do
      val z = bottom + (1 - bottom) * (i + 0.5) / Side
      val phi = 2 * Math.PI * (j + 0.5) / Side
      val r = Math.sqrt(1 - z * z)
      sum += f(Vec3((r * Math.cos(phi)).toFloat, (r * Math.sin(phi)).toFloat, z.toFloat))
    sum * 2 * Math.PI * (1 - bottom) / (Side.toDouble * Side)

  /** Irradiance at `from` on the plane z = const, from above, by `count` samples of the light. */
  def sampled(light: Light, from: Vec3, count: Int): Double =
    val draws = candela.testing.Draws(11)
    val out = LightSample()
    var sum = 0.0
    for _ <- 1 to count do
      light.sample(from, draws.unit(), draws.unit(), out)
      if out.pdf > 0f && out.wi.z > 0f then
        sum += out.radiance.g.toDouble * out.wi.z / out.pdf
    sum / count
