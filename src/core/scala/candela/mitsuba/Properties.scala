package candela.mitsuba

import candela.diagnostics.{Code, SourcePos, Suggest}
import candela.math.Transform
import candela.scenefile.{AnimatedTransform, GraphicsState}

import scala.collection.mutable

/** The properties of an object, and which of them have been queried. */
final class Properties(val plugin: Plugin, val session: Session):
  private val entries = mutable.LinkedHashMap.empty[String, Query]
  private val queried = mutable.HashSet.empty[Property]

  def pos: SourcePos = plugin.pos

  /** What was asked of the object. */
  def queries: Vector[Query] = entries.values.toVector

  /** Notes that it may contain something: what is said first of kind and default counts. */
  def note(name: String, kind: => String, default: => String = ""): Unit =
    val entry = entries.getOrElse(name, Query(name, "", ""))
    if entry.kind.isEmpty || entry.default.isEmpty then
      entries(name) = Query(
        name,
        if entry.kind.isEmpty then kind else entry.kind,
        if entry.default.isEmpty then default else entry.default
      )

  private def names = entries.keySet.filter(!_.startsWith("<"))

  def property(name: String): Option[Property] =
    note(name, "")
    val matches = plugin.properties.filter(_.name == name)
    matches.foreach(queried.add)
    if matches.size > 1 then
      session.warn(
        Code.IdleParameter,
        matches.head.pos,
        s"`$name` is repeated at ${matches.last.pos}; this value is ignored"
      )
    matches.lastOption

  def contains(name: String): Boolean = property(name).isDefined
  def posOf(name: String): SourcePos = property(name).fold(pos)(_.pos)

  private def value[A](name: String, kind: String, expected: String)(
      read: PartialFunction[Value, A]
  ): Option[A] =
    note(name, kind)
    property(name).flatMap: p =>
      val converted = read.lift(p.value)
      if converted.isEmpty then
        session.error(
          Code.ParameterValue,
          p.pos,
          s"`$name` of ${plugin.description} must be $expected, found ${p.value.description}"
        )
      converted

  def number(name: String): Option[Double] =
    value(name, "float", "a number"):
      case Value.Number(x) => x
      case Value.Flat(x) => x
  def number(name: String, default: Double): Double =
    note(name, "float", Properties.text(default))
    number(name).getOrElse(default)

  def integer(name: String, default: Int): Int =
    note(name, "integer", default.toString)
    number(name).fold(default): x =>
      if x != Math.rint(x) || Math.abs(x) > Int.MaxValue then
        session.error(Code.ParameterType, posOf(name), s"`$name` must be a whole number")
      x.toInt

  def flag(name: String, default: Boolean): Boolean =
    note(name, "boolean", default.toString)
    value(name, "boolean", "a boolean") { case Value.Flag(b) => b }.getOrElse(default)
  def text(name: String): Option[String] =
    value(name, "string", "a string") { case Value.Text(t) => t }
  def text(name: String, default: String): String =
    note(name, "string", default)
    text(name).getOrElse(default)
  def triple(name: String): Option[(Double, Double, Double)] =
    value(name, "vector", "a vector") { case Value.Triple(x, y, z) => (x, y, z) }

  def triple(name: String, default: (Double, Double, Double)): (Double, Double, Double) =
    note(name, "vector", default.toList.map(Properties.text).mkString(", "))
    triple(name).getOrElse(default)

  /** A transform that may move. */
  def motion(name: String): Option[AnimatedTransform] =
    value(name, "transform", "a transform"):
      case Value.Placed(t) => GraphicsState.constant(t)
      case Value.Moving(keys) => session.motion(keys, posOf(name))

  /** A transform where nothing can move. */
  def transform(name: String): Transform =
    motion(name).fold(Transform.Identity): t =>
      if t.isAnimated then
        session.warn(
          Code.NotAnimated,
          posOf(name),
          s"${plugin.description} can't move; using its place as the shutter opens"
        )
      t.start

  /** One of the words. */
  def word(name: String, default: String, choices: String*): String =
    note(name, choices.mkString("|"), default)
    val choice = text(name, default)
    if choices.contains(choice) then choice
    else
      session.error(
        Code.UnknownType,
        posOf(name),
        s"unknown `$name` `$choice`",
        Suggest.help(choice, choices)
      )
      default

  /** Nested and referenced objects of a kind; all of them if no name is given. */
  def nested(kind: String, name: String = ""): Vector[Plugin] =
    if name.nonEmpty then note(name, kind) else note(s"<$kind>", kind)
    named(kind).collect { case (of, child) if name.isEmpty || of == name => child }

  /** The nested or referenced object of a kind; others are ignored, with a warning each. */
  def single(kind: String): Option[Plugin] =
    val all = nested(kind)
    Properties.warnOfSurplus(all, kind, plugin.description, session)
    all.headOption

  /** The same of any name, with their names. */
  def named(kind: String): Vector[(String, Plugin)] =
    for
      p <- plugin.properties
      child <- objectOf(p) if child.kind == kind
    yield
      queried += p
      (p.name, child)

  private def objectOf(p: Property): Option[Plugin] = p.value match
    case Value.Nested(plugin) => Some(plugin)
    case Value.Reference(id) =>
      val referenced = session.plugin(id, p.pos)
      if referenced.isEmpty then queried += p
      referenced
    case _ => None

  /** A named object, if it is one. */
  def objectNamed(name: String): Option[Plugin] = property(name).flatMap(objectOf)

  /** Properties that do not affect the image. */
  def ignore(ignored: String*): Unit =
    for name <- ignored do
      note(name, "")
      plugin.properties.filter(_.name == name).foreach(queried.add)

  /** Properties without effect here: each use is a warning. */
  def warnUnsupported(consequence: String, unsupported: String*): Unit =
    for name <- unsupported; p <- property(name) do
      session.warn(
        Code.Unsupported,
        p.pos,
        s"`$name` of ${plugin.description} is not supported; $consequence"
      )

  /** A name as files of this version spell it. */
  private def inFile(name: String): String = if plugin.isOld then OldNames.camel(name) else name

  def finish(): Unit =
    for p <- plugin.properties if !queried(p) do
      p.value match
        case Value.Nested(inner) =>
          session.warn(
            Code.UnknownParameter,
            p.pos,
            s"${plugin.description} takes no ${inner.description} here; it is ignored"
          )
        case Value.Reference(id) =>
          session.warn(
            Code.UnknownParameter,
            p.pos,
            s"${plugin.description} takes no `$id` here; it is ignored"
          )
        case _ =>
          session.warn(
            Code.IdleParameter,
            p.pos,
            s"`${p.name}` is not a parameter of ${plugin.description}; it is ignored",
            Suggest.help(inFile(p.name), names.map(inFile))
          )

private[mitsuba] object Properties:
  def warnOfSurplus(all: Vector[Plugin], kind: String, owner: String, session: Session): Unit =
    for surplus <- all.drop(1) do
      session.warn(Code.Nesting, surplus.pos, s"$owner has one $kind; this one is ignored")

  /** A number without needless digits. */
  def text(x: Double): String = x.toFloat.toString.stripSuffix(".0")
