package candela.aov

import candela.color.{ColorSpace, Matrix3}

/** Channels of an image besides its colours: a [[Layer]], which command lines name, or one that a
  * scene names itself.
  */
trait ImageLayer:
  /** What it is called where layers are listed. */
  def word: String

  /** Channels in an image whose lights have these groups. */
  def channelsOf(groups: Vector[String]): Vector[String]

  private[aov] def statisticOf(groups: Vector[String]): Statistic

  /** Whether the scene must track ray differentials for it. */
  def needsFootprints: Boolean = false

  /** Whether its values need 32 bits even if the image has 16. */
  def needsFloat: Boolean = false

  /** Whether the integrator must divide its light ([[LightParts]]). */
  def dividesLight: Boolean = false

  /** Whether it is made of the parts of the light, where the integrator has them. */
  def isLight: Boolean = dividesLight

  /** Matrix from linear sRGB to the colour space of the image, for layers of colours. */
  private[aov] def to(@annotation.unused space: ColorSpace): Option[Matrix3] = None

/** A property of the first surface, under a name that the scene gives: averaged over all samples,
  * in world space, as by Mitsuba's integrator "aov".
  *
  * @param inColors whether its channels are named as colours, as by 0.6's integrator "field"
  */
final case class NamedLayer(name: String, value: HitValue, inColors: Boolean = false)
    extends ImageLayer:
  def word: String = s"$name:${value.word}"
  def channelsOf(groups: Vector[String]): Vector[String] =
    val letters = if inColors then value.components.map(NamedLayer.InColors) else value.components
    letters.map(c => s"$name.$c").toVector
  private[aov] def statisticOf(groups: Vector[String]): Statistic = value.statistic
  override def needsFootprints: Boolean = value.needsPartials

object NamedLayer:
  private val InColors: Char => Char = "XYZUVT".zip("RGBRGY").toMap.withDefault(identity)
