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
    entry(name).fold(default): member =>
      val x = member.number
      val limited = Math.max(min, Math.min(max, x))
      if limited != x then
        def text(x: Double) = Json.numberText(x)
        val range =
          if max == Double.PositiveInfinity then s"at least ${text(min)}"
          else s"from ${text(min)} to ${text(max)}"
        val message = s"`$name` must be $range, found ${text(x)}; using ${text(limited)}"
        session.warn(member.at, message, Code.CorrectedValue)
      limited

  /** A length, or another number that is not negative. */
  def size(name: String, default: Double): Double =
    number(name, default, 0, Double.PositiveInfinity)

  /** Two lengths. */
  def sizes(name: String): Vector[Double] =
    val member = entry.required(name)
    val lengths = member.numbers(2)
    if lengths.exists(_ <= 0) then
      member.fail(s"expected lengths above 0, found ${all(lengths)}")
    lengths

  /** A colour, or a coefficient of each. */
  def color(name: String, default: Rgb): Rgb = entry(name).fold(default): member =>
    val c = member.numbers(3)
    if c.exists(_ < 0) then
      val message =
        s"`$name` must be at least 0, found ${all(c)}; using ${all(c.map(Math.max(0, _)))}"
      session.warn(member.at, message, Code.CorrectedValue)
    val Vector(r, g, b) = c.map(x => Math.max(0, x).toFloat): @unchecked
    Rgb(r, g, b)

  private def all(numbers: Vector[Double]): String = numbers.map(Json.numberText).mkString(" ")

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
