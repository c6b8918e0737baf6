package candela.textures

import candela.color.MutableRgb
import candela.math.*

/** Elliptically weighted average (EWA): filters texels with a Gaussian over the footprint's
  * ellipse.
  *
  * Source: Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989, §3.5: elliptical
  * weighted average.
  *
  * @param maxAnisotropy maximum ratio of the ellipse's axes; longer ellipses are widened
  */
final class EwaLookup(
    pyramid: MipMap,
    maxAnisotropy: Float,
    bottomUp: Boolean,
    turned: Boolean
) extends FilteredLookup(pyramid, bottomUp, turned):

  def addFiltered(
      s: Float,
      y: Float,
      dsdx: Float,
      dydx: Float,
      dsdy: Float,
      dydy: Float,
      sum: MutableRgb
  ): Unit =
    val lengthX = sqrt(square(dsdx) + square(dydx))
    val lengthY = sqrt(square(dsdy) + square(dydy))
    val major = Math.max(lengthX, lengthY)
    val minor = Math.min(lengthX, lengthY)
    val widening =
      if minor > 0f && minor * maxAnisotropy < major then major / (minor * maxAnisotropy) else 1f
    if minor == 0f then pyramid(0).addBilinear(s, y, 1f, sum)
    else
      val widenX = if lengthX < lengthY then widening else 1f
      val widenY = if lengthX < lengthY then 1f else widening
      val ax = dsdx * widenX
      val ay = dydx * widenX
      val bx = dsdy * widenY
      val by = dydy * widenY
      val lod = Math.max(0f, lastLevel + log2(minor * widening))
      if lod >= lastLevel then addTop(sum)
      else
        val finerLevel = lod.toInt
        val fraction = lod - finerLevel
        EwaLookup.addAverage(pyramid(finerLevel), s, y, ax, ay, bx, by, 1f - fraction, sum)
        if fraction > 0f then
          EwaLookup.addAverage(pyramid(finerLevel + 1), s, y, ax, ay, bx, by, fraction, sum)

object EwaLookup:

  /** Table of the Gaussian exp(−2r²) − exp(−2) by squared radius, at pbrt's resolution. */
  private val Steps = 128
  private val weights = Array.tabulate(Steps): i =>
    (Math.exp(-2.0 * i / (Steps - 1)) - Math.exp(-2.0)).toFloat

  /** Adds the average over the ellipse spanned by (`ax`, `ay`) and (`bx`, `by`), times `factor`, to
    * `sum`. The ellipse is widened by one texel so that it is never empty.
    */
  private[textures] def addAverage(
      level: MipLevel,
      s: Float,
      row: Float,
      ax: Float,
      ay: Float,
      bx: Float,
      by: Float,
      factor: Float,
      sum: MutableRgb
  ): Unit =
    val w = level.width.toFloat
    val h = level.height.toFloat
    val x = MipLevel.clampCoordinate(s * w - 0.5f)
    val y = MipLevel.clampCoordinate(row * h - 0.5f)
    // The ellipse is a·dx² + b·dx·dy + c·dy² = 1 (Heckbert, p. 80)
    val a0 = square(ay * h) + square(by * h) + 1f
    val b0 = -2f * (ax * w * ay * h + bx * w * by * h)
    val c0 = square(ax * w) + square(bx * w) + 1f
    val f = 1f / (a0 * c0 - 0.25f * b0 * b0)
    val a = a0 * f
    val b = b0 * f
    val c = c0 * f
    // Half extent along each axis: square roots of the inverse matrix's diagonal
    val reachX = sqrt(c0)
    val reachY = sqrt(a0)
    val x1 = MipLevel.floor(x + reachX)
    val y1 = MipLevel.floor(y + reachY)
    // Where Floats lie farther apart than texels, at least the texel itself
    val x0 = Math.min(MipLevel.floor(x - reachX) + 1, MipLevel.floor(x))
    val texels = level.reader
    var weightSum, red, green, blue = 0f
    var iy = Math.min(MipLevel.floor(y - reachY) + 1, MipLevel.floor(y))
    while iy <= y1 do
      val dy = iy - y
      var ix = x0
      while ix <= x1 do
        val dx = ix - x
        val r2 = a * dx * dx + b * dx * dy + c * dy * dy
        if r2 < 1f then
          val weight = weights(Math.min((r2 * Steps).toInt, Steps - 1))
          val texel = level.index(ix, iy)
          weightSum += weight
          red += weight * texels(texel, 0)
          if !level.isGray then
            green += weight * texels(texel, 1)
            blue += weight * texels(texel, 2)
        ix += 1
      iy += 1
    val scale = 1f / weightSum
    val r = red * scale * factor
    if level.isGray then sum.add(r, r, r)
    else sum.add(r, green * scale * factor, blue * scale * factor)
