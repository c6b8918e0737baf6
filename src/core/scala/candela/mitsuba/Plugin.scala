package candela.mitsuba

import candela.diagnostics.SourcePos
import candela.color.{Rgb, Spectrum}
import candela.math.Transform

/** A value of a property. */
enum Value(val description: String):
  case Number(x: Double) extends Value("a number")
  case Flag(isSet: Boolean) extends Value("a boolean")
  case Text(text: String) extends Value("a string")
  case Triple(x: Double, y: Double, z: Double) extends Value("a vector")
  case Color(c: Rgb) extends Value("a colour")
  case Wavelengths(s: Spectrum) extends Value("a spectrum")

  /** A spectrum of equal values, whose light is not white. */
  case Flat(x: Double) extends Value("a spectrum")
  case Placed(t: Transform) extends Value("a transform")

  /** @param keys transforms by their times, in order */
  case Moving(keys: Vector[(Double, Transform)]) extends Value("a motion")
  case Nested(plugin: Plugin) extends Value("an object")
  case Reference(id: String) extends Value("a reference")

/** A named value; nested objects often have no name. */
final class Property(val name: String, val value: Value, val pos: SourcePos)

/** An object of a scene.
  *
  * @param kind element: `shape`, `bsdf`, `emitter`, …
  * @param name its type: `sphere`, `diffuse`, `area`, …
  * @param isOld whether its file is one of Mitsuba 0.6, whose defaults may differ
  */
final class Plugin(
    val kind: String,
    val name: String,
    val id: Option[String],
    val pos: SourcePos,
    val properties: Vector[Property],
    val isOld: Boolean = false
):
  def description: String = s"$kind \"$name\""
