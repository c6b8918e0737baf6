package candela.color

import candela.base.loop

/** Spectral response of a light detector.
  *
  * @param nm      wavelengths at which the light's spectrum is evaluated
  * @param weights responses at these wavelengths; for light with the spectrum of D65, scaled to
  *   luminance 1 and attenuated as requested, their sum is the total response
  */
final class Detector(val nm: Array[Float], val weights: Array[Float])

/** Response of several detectors to light of known colour, assumed to have the spectrum that
  * pbrt-v4 assigns to it: D65, filtered by a smooth reflectance (see [[Upsampling]]).
  *
  * The response is proportional to the light: a table stores it for colours with a largest
  * component of 1, and interpolates linearly.
  */
final class ColorResponse(detectors: Vector[Detector]):
  import ColorResponse.*
  private val count = detectors.size

  // Indexed by the largest component, then by the next and the previous component
  private val table = new Array[Float](3 * Nodes * Nodes * count)
  for largest <- 0 until 3 do fill(largest)

  /** Traverses the table back and forth, since the fit proceeds from one colour to a nearby one.
    */
  private def fill(largest: Int): Unit =
    val walk = Upsampling.Walk()
    for i <- Nodes - 1 to 0 by -1 do
      for k <- 0 until Nodes do
        val j = if (Nodes - 1 - i) % 2 == 0 then Nodes - 1 - k else k
        // Half the maximum reflectance, as in pbrt-v4
        val reflectance = Array(0.5, 0.5, 0.5)
        reflectance((largest + 1) % 3) *= i.toDouble / (Nodes - 1)
        reflectance((largest + 2) % 3) *= j.toDouble / (Nodes - 1)
        walk.moveTo(reflectance.map(Math.max(_, Darkest)))
        for (detector, d) <- detectors.zipWithIndex do
          val products = detector.nm.indices.map(w => detector.weights(w) * walk(detector.nm(w)))
          table(index(largest, i, j) + d) = 2 * products.sum

  private def index(largest: Int, i: Int, j: Int): Int = ((largest * Nodes + i) * Nodes + j) * count

  /** Writes the response to linear sRGB to `out` from `at` on. Light with negative components is
    * the difference of two non-negative lights.
    */
  def apply(r: Float, g: Float, b: Float, out: Array[Float], at: Int): Unit =
    loop(count)(d => out(at + d) = 0f)
    add(Math.max(r, 0f), Math.max(g, 0f), Math.max(b, 0f), 1f, out, at)
    if r < 0f || g < 0f || b < 0f then
      add(Math.max(-r, 0f), Math.max(-g, 0f), Math.max(-b, 0f), -1f, out, at)

  private def add(r: Float, g: Float, b: Float, sign: Float, out: Array[Float], at: Int): Unit =
    val maximum = Math.max(r, Math.max(g, b))
    if maximum > 0f then
      if r == maximum then add(0, maximum, g, b, sign, out, at)
      else if g == maximum then add(1, maximum, b, r, sign, out, at)
      else add(2, maximum, r, g, sign, out, at)

  private def add(
      largest: Int,
      maximum: Float,
      after: Float,
      before: Float,
      sign: Float,
      out: Array[Float],
      at: Int
  ): Unit =
    val x = after / maximum * (Nodes - 1)
    val y = before / maximum * (Nodes - 1)
    val i = Math.min(x.toInt, Nodes - 2)
    val j = Math.min(y.toInt, Nodes - 2)
    val (right, up) = (x - i, y - j)
    val low = index(largest, i, j)
    val high = index(largest, i + 1, j)
    val scale = sign * maximum
    loop(count): d =>
      val atLow = table(low + d) * (1f - up) + table(low + count + d) * up
      val atHigh = table(high + d) * (1f - up) + table(high + count + d) * up
      out(at + d) += scale * (atLow * (1f - right) + atHigh * right)

object ColorResponse:
  private inline val Nodes = 25

  /** Darkest value for which the fit is smooth. */
  private inline val Darkest = 1e-3
