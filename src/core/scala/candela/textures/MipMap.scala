package candela.textures

import candela.concurrency.Parallel
import candela.io.Keep

/** The levels of a MIP map, made when one of them is first looked up: pyramids take more time and
  * memory than their images, and many textures of a scene are never seen. Safe for threads.
  *
  * @param size   number of levels
  * @param whenSeen makes them
  */
final class MipMap private (val size: Int, whenSeen: () => Array[MipLevel]):
  // null once the levels are there: it holds the image
  private var builder: (() => Array[MipLevel]) | Null = whenSeen
  @volatile private var levels: Array[MipLevel] | Null = null

  /** The level `i`, the largest first. */
  def apply(i: Int): MipLevel =
    val built = levels
    if built != null then built(i) else build()(i)

  private def build(): Array[MipLevel] = synchronized:
    if levels == null then
      levels = builder.nn()
      builder = null
    levels.nn

object MipMap:

  /** Levels that are there. */
  def of(levels: Array[MipLevel]): MipMap = MipMap(levels.length, () => levels)

  /** [[Pyramid.of]] an image of this size.
    *
    * @param keep has the levels of other scenes
    * @param key  tells the texels; None: not to be kept
    */
  def ofImage(
      width: Int,
      height: Int,
      wrap: Wrap,
      maxValue: Float,
      parallel: Parallel,
      keep: Keep = Keep.Nothing,
      key: Option[String] = None
  )(texels: () => Texels): MipMap =
    def pyramid() = Pyramid.of(texels(), wrap, maxValue, parallel)
    MipMap(
      Pyramid.size(width, height),
      () => key.fold(pyramid())(k => keep(Levels, s"$k $maxValue")(pyramid()))
    )

  /** The smallest level of [[ofImage]], the mean of the image. */
  def ofMean(pyramid: MipMap): MipMap = MipMap(1, () => Array(pyramid(pyramid.size - 1)))

  /** An image as it is. */
  def plain(wrap: Wrap)(texels: () => Texels): MipMap =
    MipMap(1, () => Array(MipLevel(texels(), wrap)))

  private val Levels = Keep.Shelf[Array[MipLevel]]()
