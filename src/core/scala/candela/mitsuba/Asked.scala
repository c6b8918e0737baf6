package candela.mitsuba

import candela.base.{Code, SourcePos, Suggest}
import candela.math.Transform

import scala.collection.mutable

/** The properties of an object, and which of them were asked for. */
final class Asked(val plugin: Plugin, val session: Session):
  private val names = mutable.LinkedHashSet.empty[String]
  private val taken = mutable.HashSet.empty[Property]

  def at: SourcePos = plugin.at

  def property(name: String): Option[Property] =
    names += name
    val found = plugin.properties.filter(_.name == name)
    found.foreach(taken.add)
    if found.size > 1 then
      session.warn(
        Code.IdleParameter,
        found.head.at,
        s"`$name` is repeated at ${found.last.at}; this value is ignored"
      )
    found.lastOption

  def has(name: String): Boolean = property(name).isDefined
  def atOf(name: String): SourcePos = property(name).fold(at)(_.at)

  private def value[A](name: String, expected: String)(read: PartialFunction[Value, A]): Option[A] =
    property(name).flatMap: p =>
      val found = read.lift(p.value)
      if found.isEmpty then
        session.error(
          Code.ParameterValue,
          p.at,
          s"`$name` of ${plugin.shown} must be $expected, found ${p.value.shown}"
        )
      found

  def number(name: String): Option[Double] =
    value(name, "a number"):
      case Value.Number(x) => x
      case Value.Flat(x) => x
  def number(name: String, default: Double): Double = number(name).getOrElse(default)

  def integer(name: String, default: Int): Int =
    number(name).fold(default): x =>
      if x != Math.rint(x) || Math.abs(x) > Int.MaxValue then
        session.error(Code.ParameterType, atOf(name), s"`$name` must be a whole number")
      x.toInt

  def flag(name: String, default: Boolean): Boolean =
    value(name, "a boolean") { case Value.Flag(b) => b }.getOrElse(default)
  def text(name: String): Option[String] =
    value(name, "a string") { case Value.Text(t) => t }
  def text(name: String, default: String): String = text(name).getOrElse(default)
  def triple(name: String): Option[(Double, Double, Double)] =
    value(name, "a vector") { case Value.Triple(x, y, z) => (x, y, z) }
  def transform(name: String): Transform =
    value(name, "a transform") { case Value.Placed(t) => t }.getOrElse(Transform.Identity)

  /** One of the words. */
  def word(name: String, default: String, known: String*): String =
    val found = text(name, default)
    if known.contains(found) then found
    else
      session.error(
        Code.UnknownType,
        atOf(name),
        s"unknown $name `$found`",
        Suggest.help(found, known)
      )
      default

  /** Nested and referenced objects of a kind; all of them if no name is given. */
  def nested(kind: String, name: String = ""): Vector[Plugin] =
    if name.nonEmpty then names += name
    for
      p <- plugin.properties
      if name.isEmpty || p.name == name
      found <- objectOf(p) if found.kind == kind
    yield
      taken += p
      found

  private def objectOf(p: Property): Option[Plugin] = p.value match
    case Value.Nested(plugin) => Some(plugin)
    case Value.Reference(id) =>
      val found = session.plugin(id, p.at)
      if found.isEmpty then taken += p
      found
    case _ => None

  /** A named object, if it is one. */
  def objectNamed(name: String): Option[Plugin] = property(name).flatMap(objectOf)

  /** Properties that do not affect the image. */
  def ignore(others: String*): Unit =
    for name <- others do
      names += name
      plugin.properties.filter(_.name == name).foreach(taken.add)

  /** Properties without effect here: each use is a warning. */
  def lose(consequence: String, others: String*): Unit =
    for name <- others; p <- property(name) do
      session.warn(
        Code.Unsupported,
        p.at,
        s"`$name` of ${plugin.shown} is not supported; $consequence"
      )

  def finish(): Unit =
    for p <- plugin.properties if !taken(p) do
      p.value match
        case Value.Nested(inner) =>
          session.warn(
            Code.UnknownParameter,
            p.at,
            s"${plugin.shown} takes no ${inner.shown} here; it is ignored"
          )
        case Value.Reference(id) =>
          session.warn(
            Code.UnknownParameter,
            p.at,
            s"${plugin.shown} takes no `$id` here; it is ignored"
          )
        case _ =>
          session.warn(
            Code.IdleParameter,
            p.at,
            s"`${p.name}` is not a parameter of ${plugin.shown}; it is ignored",
            Suggest.help(p.name, names)
          )
