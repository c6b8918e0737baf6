package candela.textures

import candela.base.{Keep, Parallel}

/** The levels of a MIP map, made when one of them is first looked up: pyramids take more time and
  * memory than their images, and many textures of a scene are never seen. Safe for threads.
  *
  * @param size   number of levels
  * @param whenSeen makes them
  */
final class MipMap private (val size: Int, whenSeen: () => Array[MipLevel]):
  // null once the levels are there: it holds the image
  private var make: (() => Array[MipLevel]) | Null = whenSeen
  @volatile private var levels: Array[MipLevel] | Null = null

  /** The level `i`, the largest first. */
  def apply(i: Int): MipLevel =
    val known = levels
    if known != null then known(i) else made()(i)

  private def made(): Array[MipLevel] = synchronized:
    if levels == null then
      levels = make.nn()
      make = null
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
      most: Float,
      parallel: Parallel,
      keep: Keep = Keep.Nothing,
      key: Option[String] = None
  )(texels: () => Texels): MipMap =
    def made() = Pyramid.of(texels(), wrap, most, parallel)
    MipMap(
      Pyramid.size(width, height),
      () => key.fold(made())(k => keep(Levels, s"$k $most")(made()))
    )

  /** The smallest level of [[ofImage]], the mean of the image. */
  def ofMean(all: MipMap): MipMap = MipMap(1, () => Array(all(all.size - 1)))

  /** An image as it is. */
  def plain(wrap: Wrap)(texels: () => Texels): MipMap =
    MipMap(1, () => Array(MipLevel(texels(), wrap)))

  private val Levels = Keep.Shelf[Array[MipLevel]]()
