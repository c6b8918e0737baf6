package candela.build.media

import scala.io.{Codec, Source}

import candela.color.Rgb
import candela.scenefile.Dialect

/** Coefficients of a medium per unit of length, in linear sRGB.
  *
  * @param absorption absorption coefficient
  * @param scattering reduced scattering coefficient, for isotropic scattering
  */
final case class MediumCoefficients(absorption: Rgb, scattering: Rgb)

/** Measured media by their names in pbrt, in 1/mm.
  *
  * Sources: Jensen et al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001;
  * Narasimhan et al., "Acquiring Scattering Properties of Participating Media by Dilution",
  * SIGGRAPH 2006.
  */
private[build] object MeasuredMedia:

  def coefficients(name: String, dialect: Dialect): Option[MediumCoefficients] =
    table(dialect).get(name)

  def names(dialect: Dialect): Vector[String] = table(dialect).keys.toVector.sorted

  private def table(dialect: Dialect) = if dialect == Dialect.V2 then ofV2 else current

  private lazy val samples = read("samples")
  private lazy val current = samples ++ read("liquids")

  /** pbrt-v2 uses the measured extinction as scattering. */
  private lazy val ofV2 = samples ++ read("liquids-v2")

  /** Reads rows of a name, three numbers and three numbers; # begins a comment. */
  private def read(file: String): Map[String, MediumCoefficients] =
    val stream = getClass.getResourceAsStream(s"/candela/scattering/$file.txt")
    val source = Source.fromInputStream(stream)(using Codec.UTF8)
    try
      source
        .getLines()
        .filterNot(_.startsWith("#"))
        .map: line =>
          val Array(name, scattering, absorption) = line.split('|').map(_.trim): @unchecked
          name -> MediumCoefficients(color(absorption), color(scattering))
        .toMap
    finally source.close()

  private def color(text: String): Rgb =
    val Array(r, g, b) = text.split(' ').map(_.toFloat): @unchecked
    Rgb(r, g, b)
