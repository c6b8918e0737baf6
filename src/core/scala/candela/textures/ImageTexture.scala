package candela.textures

import candela.base.loop
import candela.color.{MutableRgb, Rgb}
import candela.geometry.ShadingPoint
import candela.math.*

/** Float image texture: scale·v, or 1 − scale·v (clamped to at least 0) if `invert`. */
final class FloatImageTexture(
    mapping: Mapping2D,
    lookup: FilteredLookup,
    scale: Float = 1f,
    invert: Boolean = false
) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    ImageTexture.finish(lookup.value(mapping, at), scale, invert)

  private val ofUv = mapping.ofUv

  /** Known of unfiltered images, which are not inverted. */
  override def slopes(at: ShadingPoint): Slopes | Null =
    if ofUv.isEmpty || invert then null
    else
      val imageSlopes = lookup.slopes(mapping(at))
      if imageSlopes == null then null
      else
        Slopes(
          scale * (imageSlopes.byU * ofUv(0) + imageSlopes.byV * ofUv(2)),
          scale * (imageSlopes.byU * ofUv(1) + imageSlopes.byV * ofUv(3))
        )

/** Colour image texture, with `scale` and `invert` as for [[FloatImageTexture]]. */
final class RgbImageTexture(
    mapping: Mapping2D,
    lookup: FilteredLookup,
    scale: Float = 1f,
    invert: Boolean = false
) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val color = lookup.color(mapping, at)
    if scale == 1f && !invert then color
    else color.map(v => ImageTexture.finish(v, scale, invert))

  override def maximum: Rgb = if invert then Rgb.White else lookup.maximum * scale

private object ImageTexture:
  def finish(value: Float, scale: Float, invert: Boolean): Float =
    val scaled = value * scale
    if invert then Math.max(0f, 1f - scaled) else scaled

/** Texel lookup in the unit square, filtered over the footprint of a sample with a MIP map.
  *
  * @param bottomUp whether t goes up from the image's last row, as in pbrt-v3 and v4 (and v2 for
  *                 TGA files), else down from its first (v2, EXR)
  * @param turned   whether the t derivatives point up in the image, as t does; pbrt-v4 omits to
  *                 flip them with t
  */
abstract class FilteredLookup(pyramid: MipMap, bottomUp: Boolean, turned: Boolean):
  protected final val lastLevel: Int = pyramid.size - 1
  private val down = if bottomUp && turned then -1f else 1f

  final def color(mapping: Mapping2D, at: ShadingPoint): Rgb = lookUp(mapping, at).toRgb

  /** Value of a single-channel image. */
  final def value(mapping: Mapping2D, at: ShadingPoint): Float = lookUp(mapping, at).r

  private def lookUp(mapping: Mapping2D, at: ShadingPoint): MutableRgb =
    val c = mapping(at)
    val f = mapping.footprint(at)
    val sum = at.texel
    sum.set(0f, 0f, 0f)
    addFiltered(c.s, row(c.t), f.dsdx, f.dtdx * down, f.dsdy, f.dtdy * down, sum)
    sum

  /** Derivatives by s and t of an image that has one level of detail, and a single channel. */
  def slopes(c: TexCoord): Slopes | Null = null

  /** Distance from the image's upper edge, as a fraction of its height. */
  protected final def row(t: Float): Float = if bottomUp then 1f - t else t

  /** The largest value of each channel. */
  final def maximum: Rgb =
    val image = pyramid(0)
    val reader = image.reader
    var largest = Rgb.Black
    loop(image.height): y =>
      loop(image.width): x =>
        val i = image.index(x, y)
        def channel(c: Int) = reader(i, if image.isGray then 0 else c)
        largest = largest.atLeast(Rgb(channel(0), channel(1), channel(2)))
    largest

  /** Filters around a point, over the parallelogram of the two steps (`dsdx`, `dydx`) and (`dsdy`,
    * `dydy`).
    */
  final def filtered(
      s: Float,
      y: Float,
      dsdx: Float,
      dydx: Float,
      dsdy: Float,
      dydy: Float
  ): Rgb =
    val sum = MutableRgb()
    addFiltered(s, y, dsdx, dydx, dsdy, dydy, sum)
    sum.toRgb

  /** Adds [[filtered]] to `sum`. */
  def addFiltered(
      s: Float,
      y: Float,
      dsdx: Float,
      dydx: Float,
      dsdy: Float,
      dydy: Float,
      sum: MutableRgb
  ): Unit

  protected final def addTop(sum: MutableRgb): Unit = pyramid(lastLevel).addNearest(0f, 0f, sum)

  /** MIP level whose texels match the footprint's larger extent. */
  protected final def levelOf(width: Float): Float = lastLevel + log2(Math.max(width, 1e-8f))

/** Selects one MIP level by the footprint's largest extent along either axis (pbrt-v4's "point" and
  * "bilinear").
  */
final class LevelLookup(
    pyramid: MipMap,
    interpolates: Boolean,
    bottomUp: Boolean,
    turned: Boolean
) extends FilteredLookup(pyramid, bottomUp, turned):
  override def slopes(c: TexCoord): Slopes | Null =
    if pyramid.size > 1 then null
    else if !interpolates then Slopes(0f, 0f)
    else
      val imageSlopes = pyramid(0).slopes(c.s, row(c.t))
      if bottomUp then Slopes(imageSlopes.byU, -imageSlopes.byV) else imageSlopes

  def addFiltered(
      s: Float,
      y: Float,
      dsdx: Float,
      dydx: Float,
      dsdy: Float,
      dydy: Float,
      sum: MutableRgb
  ): Unit =
    val level = levelOf(2f * Footprint.extent(dsdx, dydx, dsdy, dydy))
    if level >= lastLevel then addTop(sum)
    else
      val chosen = pyramid(if level > 0f then level.toInt else 0)
      if interpolates then chosen.addBilinear(s, y, 1f, sum) else chosen.addNearest(s, y, sum)

/** Trilinear filtering: interpolates the two MIP levels nearest to the footprint's largest extent.
  *
  * @param factor     scale of the extent: 2 in pbrt-v2 and v4, 1 in v3
  * @param fromSecond whether interpolation starts only past the second level, as in pbrt-v4
  */
final class TrilinearLookup(
    pyramid: MipMap,
    factor: Float,
    fromSecond: Boolean,
    bottomUp: Boolean,
    turned: Boolean
) extends FilteredLookup(pyramid, bottomUp, turned):
  private val blendsFrom = if fromSecond then 1f else 0f

  def addFiltered(
      s: Float,
      y: Float,
      dsdx: Float,
      dydx: Float,
      dsdy: Float,
      dydy: Float,
      sum: MutableRgb
  ): Unit =
    val level = levelOf(factor * Footprint.extent(dsdx, dydx, dsdy, dydy))
    if level >= lastLevel then addTop(sum)
    else if level < blendsFrom then pyramid(0).addBilinear(s, y, 1f, sum)
    else
      val finerLevel = level.toInt
      val fraction = level - finerLevel
      pyramid(finerLevel).addBilinear(s, y, 1f - fraction, sum)
      pyramid(finerLevel + 1).addBilinear(s, y, fraction, sum)

private object Footprint:
  def extent(dsdx: Float, dydx: Float, dsdy: Float, dydy: Float): Float =
    Math.max(Math.max(abs(dsdx), abs(dydx)), Math.max(abs(dsdy), abs(dydy)))
