package candela.cli.options

import candela.color.ColorSpace
import candela.image.{Contents, OutputFormat}
import candela.measure.PixelWindow

import java.util.Locale

import scopt.{OParser, Read}

/** How `image` changes an image.
  *
  * @param size        width and height; a missing one follows from the other
  * @param environment the wanted shape of an environment map
  */
final case class ImageOptions(
    crop: Option[PixelWindow] = None,
    size: Option[ImageSize] = None,
    channels: Option[Vector[String]] = None,
    environment: Option[MapShape] = None,
    scale: Float = 1f,
    clamp: Option[Float] = None,
    colorSpace: Option[ColorSpace] = None,
    flips: Boolean = false,
    isHalf: Boolean = false
)

/** A size in pixels; None follows from the other and the image's shape. */
final case class ImageSize(width: Option[Int], height: Option[Int]):
  def of(w: Int, h: Int): (Int, Int) =
    def side(given_ : Option[Int], other: Option[Int], n: Int, m: Int) =
      given_.orElse(other.map(o => Math.round(o.toDouble * n / m).toInt)).getOrElse(n).max(1)
    (side(width, height, w, h), side(height, width, h, w))

/** Parametrisations of the sphere by environment maps. */
enum MapShape(val word: String):
  /** Square, as in pbrt-v4. */
  case EqualArea extends MapShape("equalarea")

  /** Twice as wide as high, as in pbrt-v2, v3 and most other programs. */
  case LatLong extends MapShape("latlong")

/** Options of `image`. */
private[cli] object ImageTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.opt

  private given Read[ImageSize] = Read.reads: text =>
    def side(s: String) = s.toIntOption.filter(n => n > 0 && n <= 65536)
    text.toLowerCase(Locale.ROOT).split("x", -1) match
      case Array(w, "") if side(w).isDefined => ImageSize(side(w), None)
      case Array("", h) if side(h).isDefined => ImageSize(None, side(h))
      case Array(w, h) if side(w).isDefined && side(h).isDefined => ImageSize(side(w), side(h))
      case Array(w) if side(w).isDefined => ImageSize(side(w), None)
      case _ =>
        throw IllegalArgumentException("expected WIDTHxHEIGHT, WIDTH or xHEIGHT, e.g. 640x360")

  private given Read[MapShape] = Read.reads: word =>
    MapShape.values.find(_.word.equalsIgnoreCase(word)).getOrElse:
      throw IllegalArgumentException(s"expected ${MapShape.values.map(_.word).mkString(" or ")}")

  private given Read[ColorSpace] = Read.reads: word =>
    ColorSpace.named(word).getOrElse:
      throw IllegalArgumentException(
        s"expected one of ${ColorSpace.all.map(_.name).mkString(", ")}"
      )

  private def change(o: Options)(f: ImageOptions => ImageOptions): Options =
    o.copy(image = f(o.image))

  private val linear = OutputFormat.listed(Contents.Radiance, Contents.Channels)

  private def outfile: Row =
    opt[Seq[String]](
      'o',
      "outfile"
    )(using fileNames).required().unbounded().valueName("FILE[,FILE]")
      .text(s"image to write, ${OutputFormat.listed()}")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f))

  private def halfRow: Row =
    opt[Unit]("half")
      .text("store 16-bit floats in .exr")
      .action((_, o) => change(o)(_.copy(isHalf = true)))

  /** Options of `average`. */
  val average: Vector[Row] = Vector(outfile, halfRow)

  val options: Vector[Row] = Vector[Row](
    outfile,
    opt[Seq[String]]("channels").valueName("NAME,...")
      .text("keep only these channels")
      .validate(nonEmpty("channels"))
      .action((names, o) => change(o)(_.copy(channels = Some(names.toVector)))),
    opt[PixelWindow]("crop")(using CompareTable.window).valueName("x0,x1,y0,y1")
      .text("keep only these pixels, x1 and y1 excluded; a negative end is a size")
      .action((w, o) => change(o)(_.copy(crop = Some(w)))),
    opt[MapShape]("environment").valueName("equalarea|latlong")
      .text(OptionText(
        "turn an environment map of the other shape into this one (width by --resize)",
        "pbrt-v2, v3 and most programs have maps twice as wide as high (`latlong`), pbrt-v4 has " +
          "square ones (`equalarea`)."
      ))
      .action((s, o) => change(o)(_.copy(environment = Some(s)))),
    opt[ImageSize]("resize").valueName("WIDTHxHEIGHT")
      .text("resize; WIDTH or xHEIGHT keeps the shape")
      .action((s, o) => change(o)(_.copy(size = Some(s)))),
    opt[Double]("scale").valueName("X")
      .text(s"factor of the light, in $linear too")
      .validate(positive("scale"))
      .action((x, o) => change(o)(_.copy(scale = x.toFloat))),
    opt[Double]("clamp").valueName("X")
      .text("scale brighter pixels down so that no channel exceeds X")
      .validate(positive("clamp"))
      .action((x, o) => change(o)(_.copy(clamp = Some(x.toFloat)))),
    opt[ColorSpace]("colorspace").valueName(ColorSpace.all.map(_.name).mkString("|"))
      .text("primaries of an .exr image")
      .action((s, o) => change(o)(_.copy(colorSpace = Some(s)))),
    opt[Unit]("flip")
      .text("turn the image upside down")
      .action((_, o) => change(o)(_.copy(flips = true))),
    halfRow
  )
