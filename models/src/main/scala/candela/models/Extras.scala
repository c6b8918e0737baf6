package candela.models

import candela.color.Rgb
import candela.diagnostics.{Code, Suggest}

/** The members of `extras.candela`: what models may say beyond glTF. Those that are unknown, and
  * numbers out of range, are warnings.
  *
  * @param known names that it may have
  */
private[models] final class Extras private (
    val entry: Json,
    known: Vector[String],
    session: Session
):
  for name <- entry.names if !known.contains(name) do
    val help = Suggest.nearest(name, known) match
      case Some(near) => s"did you mean `$near`?"
      case None => known.mkString("known: ", ", ", "")
    val at = session.at(Json.memberPointer(entry.pointer, name))
    session.warn(at, s"unknown member `$name`; $help", Code.UnknownParameter)

  def apply(name: String): Option[Json] = entry(name)

  /** A number within limits; beyond, the nearer one of these. */
  def number(name: String, default: Double, min: Double, max: Double): Double =
    entry.number(name, default, Limits(min, max))

  /** A length, or another number that is not negative. */
  def size(name: String, default: Double): Double =
    entry.number(name, default, Limits.NonNegative)

  /** Two lengths. */
  def sizes(name: String): Vector[Double] =
    val member = entry.required(name)
    val lengths = member.numbers(2)
    if lengths.exists(_ <= 0) then
      member.fail(s"expected lengths above 0, found ${Limits.text(lengths)}")
    lengths

  /** A colour, or a coefficient of each. */
  def color(name: String, default: Rgb): Rgb =
    Materials.rgb(entry, name, default, Limits.NonNegative)

  /** True unless it says otherwise. */
  def isInView: Boolean = entry("inView").forall(_.flag)

private[models] object Extras:
  private val Places = Map(
    "scenes" -> Vector("environment"),
    "nodes" -> Vector("camera", "light", "medium"),
    "materials" -> Vector("medium")
  )

  /** A member of `extras.candela` of a scene, node or material, whose members have these names. */
  def of(owner: Json, list: String, member: String, session: Session)(
      known: String*
  ): Option[Extras] =
    for
      all <- owner("extras")
      if all.isObject
      own <- all("candela")
      entry <- Extras(own, Places(list), session)(member)
    yield Extras(entry, known.toVector, session)
