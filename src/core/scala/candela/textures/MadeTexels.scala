package candela.textures

import candela.concurrency.Parallel
import candela.color.{Encoding, Rgb}

/** How some texels are chosen that stand for all.
  *
  * @param step   one of so many, in row order, is looked at
  * @param maxColors so many are chosen
  * @param choose them
  */
final case class ColorChoice(step: Int, maxColors: Int, choose: Vector[Rgb] => Vector[Rgb]):

  /** Those of texels in memory. */
  def select(texels: Texels): Vector[Rgb] = choose(candidates(texels, 0))

  /** Those that are looked at, of a band whose first texel is the `first` of the image. */
  private[textures] def candidates(band: Texels, first: Long): Vector[Rgb] =
    val start = Math.floorMod(-first, step.toLong).toInt
    start.until(band.width * band.height, step)
      .map(i => Rgb(band(i, 0), band(i, 1), band(i, 2)))
      .toVector

/** The texels of an image file, as they are to be made.
  *
  * @param maxValue upper limit of the texels of enlarged images; None: neither enlarged nor reduced
  * @param encoding of the file
  * @param colors   which stand for all of them, if they are colours
  * @param confirm  throws an [[candela.image.ImageError]] if the file has changed since its key was
  *   made: what is made of it then has another
  */
final case class MadeTexels(
    bands: TexelBands,
    maxValue: Option[Float],
    encoding: Encoding,
    colors: Option[ColorChoice],
    confirm: () => Unit = () => ()
):
  /** Width and height of each level, the largest first, and whether it has bytes. */
  def sizes: Vector[(Int, Int, Boolean)] =
    if maxValue.isEmpty then Vector((bands.width, bands.height, bands.isBytes))
    else
      Pyramid.sizes(bands.width, bands.height).map: (w, h) =>
        (w, h, bands.isBytes && w == bands.width && h == bands.height)

  /** All levels in memory, and what is said of them. */
  def inMemory(wrap: Wrap, parallel: Parallel): (Array[Texels], TexelFacts) =
    val texels = bands.inMemory
    confirm()
    val levels = maxValue.fold(Array(texels))(Pyramid.levels(texels, wrap, _, parallel))
    (levels, TexelFacts(colors.fold(Vector.empty)(_.select(texels)), texels.odd))

/** What is known of the texels of an image file once all are seen.
  *
  * @param colors some that stand for all
  * @param odd    the first that is no number
  */
final case class TexelFacts(colors: Vector[Rgb], odd: Option[OddTexel])
