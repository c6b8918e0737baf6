package candela.convert

import java.io.Writer

import candela.math.Transform
import candela.scenefile.{AnimatedTransform, Declaration, Dialect, Param, ParamType}

/** Writes single statements: indentation, quotes, and a dialect's spelling of types and values. */
final class Statements(out: Writer, dialect: Dialect):
  private var indent = 0
  private var colorSpace = "srgb"

  def line(text: String): Unit =
    out.write("  " * indent)
    out.write(text)
    out.write('\n')

  def blank(): Unit = out.write('\n')

  /** A block, which restores the state at its end. */
  def block(begin: String, end: String)(body: => Unit): Unit =
    val outside = colorSpace
    line(begin)
    indent += 1
    body
    indent -= 1
    line(end)
    colorSpace = outside

  /** `Attribute` statements: parameters that may apply to none of their targets. */
  def defaults(target: String, d: Declaration): Unit =
    val params = d.params.filter(_.isDefault)
    for space <- params.map(d.colorSpaceOf).distinct do
      switchColorSpace(space)
      statement("Attribute", Vector(target), params.filter(d.colorSpaceOf(_) == space))

  def declaration(directive: String, d: Declaration): Unit =
    declaration(directive, Vector(d.name), d)

  /** @param names quoted names after the directive */
  def declaration(directive: String, names: Vector[String], d: Declaration): Unit =
    switchColorSpace(d.colorSpace)
    statement(directive, names, d.params.filterNot(_.isDefault))

  private def switchColorSpace(space: String): Unit =
    if space != colorSpace then
      colorSpace = space
      line(s"ColorSpace ${Statements.quoted(space)}")

  /** Writes a short statement on one line, a longer one with a line per parameter. */
  def statement(directive: String, names: Vector[String], params: Vector[Param]): Unit =
    val head = (directive +: names.map(Statements.quoted)).mkString(" ")
    val entries = params.map(p => (heading(p), values(p)))
    val length = 2 * indent + head.length +
      entries.map((heading, v) =>
        heading.length + v.take(Statements.Width).map(_.length + 1).sum
      ).sum
    if length <= Statements.Width then
      line(head + entries.map((heading, v) => s" $heading ${listed(v)}").mkString)
    else
      line(head)
      indent += 2
      for (heading, v) <- entries do wrapped(heading, v)
      indent -= 2

  private def listed(values: Seq[String]): String =
    if values.size == 1 then values.head else values.mkString("[ ", " ", " ]")

  private def wrapped(heading: String, values: Seq[String]): Unit =
    val total = values.iterator.take(Statements.Width).map(_.length + 1).sum
    if heading.length + total + 2 * indent < Statements.Width then
      line(s"$heading ${listed(values)}")
    else
      line(s"$heading [")
      indent += 1
      val row = StringBuilder()
      for v <- values do
        if row.nonEmpty && row.length + v.length + 1 + 2 * indent > Statements.Width then
          line(row.result())
          row.clear()
        if row.nonEmpty then row += ' '
        row ++= v
      line(row.result())
      indent -= 1
      line("]")

  /** The parameter's type and name, quoted. */
  private def heading(p: Param): String =
    Statements.quoted(s"${Statements.spelling(p.paramType, dialect)} ${p.name}")

  /** Lazy, because lists may be very long. */
  private def values(p: Param): Seq[String] = p.paramType match
    case ParamType.Integer => p.ints.view.map(_.toString).toSeq
    case ParamType.Bool =>
      // v2 and v3 scenes conventionally quote booleans; v4 rejects quotes.
      p.bools.map(b => if dialect == Dialect.V4 then b.toString else s"\"$b\"")
    case _ if p.strings.nonEmpty => p.strings.map(Statements.quoted)
    case _ if p.paramType == ParamType.Point3 || p.rests.length > 0 =>
      p.floats.indices.view.map(NumberText.of(p, _)).toSeq
    case _ => p.floats.view.map(NumberText.of).toSeq

  def transform(t: AnimatedTransform): Unit =
    if t.isAnimated then
      line("ActiveTransform StartTime")
      transform(t.start)
      line("ActiveTransform EndTime")
      transform(t.end)
      line("ActiveTransform All")
    else transform(t.start)

  /** Of an instance whose transform has the rounding errors of
    * [[candela.math.MotionRows.transform]].
    */
  def placement(t: Transform): Unit = transform(t, Statements.rounded(t))

  private def transform(t: Transform): Unit = transform(t, t.m.toVector)

  /** Matrices in scene files are in column order. */
  private def transform(t: Transform, rows: Vector[Double]): Unit =
    if t.isIdentity then line("Identity")
    else
      val columns = Vector.tabulate(16)(i => NumberText.of(rows(i % 4 * 4 + i / 4)))
      val singleLine = columns.mkString("Transform [ ", " ", " ]")
      if singleLine.length + 2 * indent <= Statements.Width then line(singleLine)
      else
        line("Transform [")
        indent += 1
        for column <- columns.grouped(4) do line(column.mkString(" "))
        indent -= 1
        line("]")

object Statements:
  private val Width = 100

  /** Digits of the largest number in a row that rounding errors leave alone. */
  private val Digits = 14

  /** The numbers of an affine transform without the digits that rounding may change: what is
    * written and read is written as the same again.
    */
  private[convert] def rounded(t: Transform): Vector[Double] =
    def round(x: Double, largest: Double) =
      val decimals = Digits - Math.ceil(Math.log10(largest)).toInt
      java.math.BigDecimal(x).setScale(decimals, java.math.RoundingMode.HALF_EVEN).doubleValue
    Vector.tabulate(16): i =>
      val row = i & ~3
      val linear = (row until row + 3).map(k => Math.abs(t.m(k))).max
      if i >= 12 then t.m(i)
      else round(t.m(i), if i == row + 3 then Math.max(linear, Math.abs(t.m(i))) else linear)

  def quoted(text: String): String =
    val escaped = text.flatMap:
      case '"' => "\\\""
      case '\\' => "\\\\"
      case '\n' => "\\n"
      case '\r' => "\\r"
      case '\t' => "\\t"
      case other => other.toString
    s"\"$escaped\""

  private def spelling(t: ParamType, dialect: Dialect): String =
    (t, dialect) match
      case (ParamType.Rgb, Dialect.V2) => "color"
      case (ParamType.Point3, Dialect.V2) => "point"
      case (ParamType.Vector3, Dialect.V2) => "vector"
      case _ => t.spelling
