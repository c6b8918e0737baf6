package candela.mitsuba

import candela.base.Decimal
import candela.diagnostics.{Code, Problem, Refusal, SceneError, SourcePos, Suggest}
import candela.io.{InputFile, IoReason, SceneFolder}
import candela.color.{Rgb, Spectrum}
import candela.math.Transform

import java.util.Locale
import scala.util.Try

/** Turns elements into objects and values.
  *
  * @param find    the file of a name
  * @param suggest a name like that of a missing file
  * @param report  receives errors; the property or object is then left out
  */
final class Values(
    find: (String, SourcePos) => Option[InputFile],
    suggest: String => Option[String],
    report: Problem => Unit
):
  import Values.*

  /** The object of an element; children with errors are left out. */
  def plugin(e: Element): Option[Plugin] = attempt:
    if !Kinds.contains(e.tag) then
      fail(
        Code.UnknownElement,
        e.pos,
        s"unknown element <${e.tag}>",
        Suggest.help(e.tag, Kinds ++ Tags)
      )
    val name = e("type").getOrElse(fail(
      Code.UnknownElement,
      e.pos,
      s"<${e.tag}> must have the attribute `type`"
    ))
    Plugin(e.tag, name, e("id"), e.pos, e.children.flatMap(property), e.isOld)

  private def attempt[A](body: => A): Option[A] =
    try Some(body)
    catch
      case e: SceneError =>
        e.problems.foreach(report)
        None
      case Refusal.OfFile(problem) =>
        report(problem)
        None

  private def property(e: Element): Option[Property] =
    val isObject = Kinds.contains(e.tag) && (e.tag != "spectrum" || e("type").nonEmpty)
    if isObject then
      plugin(e).map(p => Property(e("name").getOrElse(""), Value.Nested(p), e.pos))
    else
      attempt(value(e)).map: v =>
        Property(e("name").getOrElse(""), v, e.pos)

  private def value(e: Element): Value =
    def text = e("value").getOrElse(fail(
      Code.UnknownElement,
      e.pos,
      s"<${e.tag}> must have the attribute `value`"
    ))
    if e.tag != "ref" && e("name").isEmpty then
      if !Tags.contains(e.tag) then
        fail(
          Code.UnknownElement,
          e.pos,
          s"unknown element <${e.tag}>",
          Suggest.help(e.tag, Kinds ++ Tags)
        )
      else fail(Code.UnknownElement, e.pos, s"<${e.tag}> must have the attribute `name`")
    e.tag match
      case "float" => Value.Number(number(text, e.pos))
      case "integer" => Value.Number(integer(text, e.pos))
      case "boolean" =>
        text.trim.toLowerCase(Locale.ROOT) match
          case "true" => Value.Flag(true)
          case "false" => Value.Flag(false)
          case other => fail(Code.ParameterValue, e.pos, s"expected true or false, found `$other`")
      case "string" => Value.Text(text)
      case "vector" | "point" =>
        e("value") match
          case Some(t) => triple(numbers(t, e.pos), e.pos)
          case None =>
            def c(name: String) = e(name).fold(0.0)(number(_, e.pos))
            Value.Triple(c("x"), c("y"), c("z"))
      case "rgb" | "srgb" =>
        if e.tag == "rgb" && !e.isOld && text.trim.startsWith("#") then
          report(Problem.warning(
            Code.UnlikePbrt,
            e.pos,
            s"Mitsuba 3 takes no `${text.trim}`; reading the values divided by 255",
            Some("write three numbers")
          ))
        Value.Color(color(text, e.pos))
      case "spectrum" => spectrum(e)
      case "blackbody" =>
        val kelvin = number(e("temperature").getOrElse(text).stripSuffix("K"), e.pos)
        val position = e.pos
        Value.Nested(
          Plugin(
            "spectrum",
            "blackbody",
            None,
            position,
            Vector(Property("temperature", Value.Number(kelvin), position)) ++
              e("scale").map(s => Property("scale", Value.Number(number(s, e.pos)), position))
          )
        )
      case "transform" => Value.Placed(Transforms.of(e))
      case "animation" =>
        val keys = e.children.filter(_.tag == "transform").map: key =>
          number(key("time").getOrElse("0"), key.pos) -> Transforms.of(key)
        if keys.isEmpty then fail(Code.UnknownElement, e.pos, "<animation> must have a <transform>")
        Value.Moving(keys.sortBy(_._1))
      case "ref" =>
        Value.Reference(e("id").getOrElse(fail(
          Code.UnknownElement,
          e.pos,
          "<ref> must have the attribute `id`"
        )))
      case other => fail(
          Code.UnknownElement,
          e.pos,
          s"unknown element <$other>",
          Suggest.help(other, Kinds ++ Tags)
        )

  private def triple(xs: Vector[Double], at: SourcePos): Value = xs match
    case Vector(x) => Value.Triple(x, x, x)
    case Vector(x, y, z) => Value.Triple(x, y, z)
    case _ => fail(Code.ParameterCount, at, s"expected three numbers, found ${xs.size}")

  /** Three numbers, one for all, or `#rrggbb`. */
  private def color(text: String, at: SourcePos): Rgb =
    if text.trim.startsWith("#") then
      val code = Try(Integer.parseInt(text.trim.drop(1), 16)).toOption
      val c = code.filter(_ => text.trim.length == 7)
        .getOrElse(fail(
          Code.ParameterValue,
          at,
          s"expected a colour such as #ff8000, found `$text`"
        ))
      Rgb((c >> 16 & 255) / 255f, (c >> 8 & 255) / 255f, (c & 255) / 255f)
    else
      numbers(text, at).map(_.toFloat) match
        case Vector(v) => Rgb.gray(v)
        case Vector(r, g, b) => Rgb(r, g, b)
        case components =>
          fail(Code.ParameterCount, at, s"expected three numbers, found ${components.size}")

  /** One number, or pairs `wavelength:value`, or those of a file. */
  private def spectrum(e: Element): Value =
    (e("value"), e("filename")) match
      case (Some(text), _) if text.contains(':') =>
        Value.Wavelengths(pairs(words(text).flatMap(_.split(':')), e.pos))
      case (Some(text), _) => Value.Flat(number(text, e.pos))
      case (None, Some(name)) => Value.Wavelengths(file(name, e.pos))
      case _ =>
        fail(Code.SpectrumFile, e.pos, "<spectrum> must have the attribute `value` or `filename`")

  def file(name: String, at: SourcePos): Spectrum =
    def fails(reason: String) =
      fail(Code.SpectrumFile, at, s"can't read the spectrum `$name`: $reason", suggest(name))
    if !SceneFolder.isName(name) then
      fail(Code.SpectrumFile, at, s"can't read the spectrum `$name`")
    val file = find(name, at).getOrElse(fails("no such file"))
    val lines =
      try file.lines()
      catch case e: java.io.IOException => fails(IoReason(e))
    val texts = lines.filterNot(_.trim.startsWith("#")).flatMap(words)
    for odd <- texts.find(Decimal.double(_).isEmpty) do
      fail(
        Code.SpectrumFile,
        at,
        s"spectrum `$name`: expected a number, found ${file.quoted(odd.take(20))}"
      )
    try pairs(texts, at)
    catch
      case e: SceneError => throw SceneError(e.problems.map: p =>
          p.copy(message = s"spectrum `$name`: ${p.message}"))

  private def pairs(texts: Iterable[String], at: SourcePos): Spectrum =
    Values.spectrum(texts.map(number(_, at)).toVector, at)

object Values:
  /** Elements that are objects. */
  val Kinds: Set[String] =
    Set("bsdf", "emitter", "film", "integrator", "medium", "phase", "rfilter", "sampler", "sensor",
      "shape", "spectrum", "subsurface", "texture", "volume")

  /** Elements that are values. */
  private val Tags =
    Set("animation", "boolean", "float", "integer", "point", "ref", "rgb", "string", "transform",
      "vector")

  def fail(code: Code, at: SourcePos, message: String, help: Option[String] = None): Nothing =
    throw SceneError(Problem.error(code, at, message, help))

  def words(text: String): Vector[String] =
    text.split("[\\s,]+").toVector.filter(_.nonEmpty)

  def numbers(text: String, at: SourcePos): Vector[Double] = words(text).map(number(_, at))

  def number(text: String, at: SourcePos): Double =
    Decimal.double(text.trim).filter(java.lang.Double.isFinite(_))
      .getOrElse(fail(Code.ParameterValue, at, s"expected a number, found `${text.trim}`"))

  /** Mitsuba takes neither `1.0` nor `+1`. */
  private def integer(text: String, at: SourcePos): Double =
    text.trim.toLongOption.filterNot(_ => text.trim.startsWith("+")).map(_.toDouble)
      .getOrElse(fail(Code.ParameterValue, at, s"expected an integer, found `${text.trim}`"))

  /** Of wavelengths and values in turn. */
  def spectrum(xs: Vector[Double], at: SourcePos): Spectrum =
    if xs.size % 2 != 0 then fail(Code.SpectrumFile, at, "a wavelength has no value")
    val (lambda, values) = xs.grouped(2).map(p => (p(0).toFloat, p(1).toFloat)).toVector.unzip
    if lambda.isEmpty || lambda.zip(lambda.drop(1)).exists((a, b) => a >= b) then
      fail(Code.SpectrumFile, at, "expected ascending wavelengths, each with a value")
    Spectrum(lambda.toArray, values.toArray, Spectrum.Outside.Zero)

/** Transforms, as elements. */
private[mitsuba] object Transforms:
  import Values.{fail, number, numbers}

  /** Steps apply in order. */
  def of(e: Element): Transform = e.children.foldLeft(Transform.Identity)((t, s) => step(s) * t)

  /** By Rodrigues' formula with the axis as it is: Mitsuba does not normalise it. */
  private def rotation(degrees: Double, axis: Vector[Double]): Option[Transform] =
    val Vector(x, y, z) = axis: @unchecked
    val isUnit = Math.abs(x * x + y * y + z * z - 1) < 1e-6
    if isUnit then Transform.rotate(degrees, x, y, z)
    else
      val (s, c) = (Math.sin(Math.toRadians(degrees)), Math.cos(Math.toRadians(degrees)))
      val k = 1 - c
      Transform.fromRows(
        Vector(x * x * k + c, x * y * k - z * s, x * z * k + y * s, 0) ++
          Vector(x * y * k + z * s, y * y * k + c, y * z * k - x * s, 0) ++
          Vector(x * z * k - y * s, y * z * k + x * s, z * z * k + c, 0) ++ Vector(0, 0, 0, 1)
      )

  /** What Mitsuba takes for up where a `lookat` has none: the first vector of the frame about the
    * direction.
    */
  private def across(origin: Vector[Double], target: Vector[Double]): Vector[Double] =
    val direction = target.lazyZip(origin).map(_ - _)
    val length = Math.sqrt(direction.map(x => x * x).sum)
    if length == 0.0 then direction
    else
      val Vector(x, y, z) = direction.map(_ / length): @unchecked
      val m = Shapes.frame(x, y, z).m
      Vector(m(0), m(4), m(8))

  private def step(e: Element): Transform =
    def component(name: String, default: Double) = e(name).fold(default)(number(_, e.pos))
    def list(name: String) =
      e(name).map(numbers(_, e.pos)).filter(_.size == 3)
        .getOrElse(fail(
          Code.ParameterCount,
          e.pos,
          s"<${e.tag}> must have the attribute `$name`, of three numbers"
        ))
    def regular(t: Option[Transform], reason: String) =
      t.getOrElse(fail(Code.Transform, e.pos, s"transform can't be inverted: $reason"))
    def axes(default: Double) =
      e("value").map(numbers(_, e.pos)) match
        case Some(Vector(s)) => Vector(s, s, s)
        case Some(v) if v.size == 3 => v
        case Some(v) => fail(Code.ParameterCount, e.pos, s"expected three numbers, found ${v.size}")
        case None =>
          Vector(component("x", default), component("y", default), component("z", default))
    e.tag match
      case "translate" =>
        val v = axes(0)
        Transform.translate(v(0), v(1), v(2))
      case "scale" =>
        val v = axes(1)
        regular(Transform.scale(v(0), v(1), v(2)), "zero scale")
      case "rotate" =>
        val v = axes(0)
        if v.forall(_ == 0) then fail(Code.Transform, e.pos, "a rotation needs an axis")
        val degrees = e("angle").fold(fail(
          Code.UnknownElement,
          e.pos,
          "<rotate> must have the attribute `angle`"
        )):
          number(_, e.pos)
        regular(rotation(degrees, v), "axis of length 0, or far from 1")
      case "lookat" =>
        val reason = "origin equals target, or up is zero or parallel to the view direction"
        val (origin, target) = (list("origin"), list("target"))
        val stated = if e("up").isDefined then list("up") else Vector(0.0, 0.0, 0.0)
        val up = if stated.forall(_ == 0.0) then across(origin, target) else stated
        regular(Transform.lookAt(origin, target, up), reason).inverse
      case "matrix" =>
        val m = numbers(e("value").getOrElse(""), e.pos)
        val rows = m.size match
          case 16 => m
          case 9 => Vector(m.take(3) :+ 0.0, m.slice(3, 6) :+ 0.0, m.drop(6) :+ 0.0).flatten ++
              Vector(0.0, 0.0, 0.0, 1.0)
          case n => fail(Code.ParameterCount, e.pos, s"expected 16 numbers, found $n")
        regular(Transform.fromRows(rows), "matrix of determinant 0")
      case other =>
        val steps = List("lookat", "matrix", "rotate", "scale", "translate")
        fail(
          Code.UnknownElement,
          e.pos,
          s"unknown element <$other>",
          candela.diagnostics.Suggest.help(other, steps)
        )
