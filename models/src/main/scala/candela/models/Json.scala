package candela.models

import candela.diagnostics.{Code, SourcePos}

import scala.util.control.NonFatal

/** A value of a JSON file, with its place. Whatever has another type than expected is an error that
  * names the place.
  *
  * @param pointer as RFC 6901 has it
  */
private[models] final class Json(val value: ujson.Value, val pointer: String, session: Session):
  def at: SourcePos = session.at(pointer)

  def fail(message: String): Nothing = Session.fail(at, message)

  private def wrong(expected: String): Nothing =
    val kind = value match
      case _: ujson.Obj => "an object"
      case _: ujson.Arr => "an array"
      case _: ujson.Str => "a string"
      case _: ujson.Num => "the number " + Json.numberText(value.num)
      case ujson.Null => "null"
      case _ => "a bool"
    fail(s"expected $expected, found $kind")

  private def fields = value match
    case o: ujson.Obj => o.value
    case _ => wrong("an object")

  def isObject: Boolean = value.isInstanceOf[ujson.Obj]

  /** Names of an object's members. */
  def names: Vector[String] = fields.keysIterator.toVector

  def apply(name: String): Option[Json] =
    session.members.query(name, fields.keysIterator, pointer)
    fields.get(name).map(Json(_, Json.memberPointer(pointer, name), session))

  def required(name: String): Json = apply(name).getOrElse(fail(s"`$name` is missing"))

  def items: Vector[Json] = value match
    case a: ujson.Arr =>
      a.value.iterator.zipWithIndex.map((v, i) => Json(v, s"$pointer/$i", session)).toVector
    case _ => wrong("an array")

  /** The items of an array that may be missing. */
  def list(name: String): Vector[Json] = apply(name).fold(Vector.empty)(_.items)

  def number: Double = value match
    case n: ujson.Num if java.lang.Double.isFinite(n.value) => n.value
    case _ => wrong("a finite number")

  def int: Int =
    val x = number
    if x == x.toInt then x.toInt else wrong("an integer")

  /** A count or a size. */
  def size: Int =
    val n = int
    if n < 0 then fail(s"expected at least 0, found $n") else n

  def text: String = value match
    case s: ujson.Str => s.value
    case _ => wrong("a string")

  def flag: Boolean = value match
    case b: ujson.Bool => b.value
    case _ => wrong("a bool")

  def numbers(count: Int): Vector[Double] =
    val all = items
    if all.size != count then fail(s"expected $count numbers, found ${all.size}")
    all.map(_.number)

  def number(name: String, default: Double): Double = apply(name).fold(default)(_.number)

  def number(name: String, default: Double, limits: Limits): Double =
    apply(name).fold(default)(m => limits(name, Vector(m.number), m.at, session).head)

  def factor(name: String, default: Double): Double = number(name, default, Limits.Unit)

  /** The numbers of a member, if it is there. */
  def numbers(name: String, count: Int, limits: Limits): Option[Vector[Double]] =
    apply(name).map(m => limits(name, m.numbers(count), m.at, session))

  def size(name: String, default: Int): Int = apply(name).fold(default)(_.size)
  def flag(name: String): Boolean = apply(name).exists(_.flag)
  def text(name: String): Option[String] = apply(name).map(_.text)

  def extension(name: String): Option[Json] = apply("extensions").flatMap(_(name))

  /** The element of a list whose index this is. */
  def element(of: Vector[Json], what: String): Json =
    of.lift(size).getOrElse:
      val validIndices = if of.isEmpty then "there are none" else s"they are 0 to ${of.size - 1}"
      fail(s"there are no $what with the index $size; $validIndices")

  /** That of a member, if there is one. */
  def element(name: String, of: Vector[Json], what: String): Option[Json] =
    apply(name).map(_.element(of, what))

private[models] object Json:
  def parse(bytes: Array[Byte], session: Session): Json =
    val value =
      try ujson.read(bytes)
      catch
        case e: ujson.ParseException =>
          Session.fail(session.at(""), s"not valid JSON: ${e.clue}, at byte ${e.index}")
        case _: ujson.IncompleteParseException =>
          Session.fail(session.at(""), "not valid JSON: it ends early")
        case _: StackOverflowError =>
          Session.fail(session.at(""), "the JSON is nested too deeply", Code.TooDeep)
        case NonFatal(e) => Session.fail(session.at(""), s"not valid JSON: ${e.getMessage}")
    Json(value, "", session)

  /** The pointer to a member of the object at another one. */
  def memberPointer(pointer: String, name: String): String =
    s"$pointer/${name.replace("~", "~0").replace("/", "~1")}"

  def numberText(x: Double): String =
    if x == x.toLong then x.toLong.toString else x.toString
