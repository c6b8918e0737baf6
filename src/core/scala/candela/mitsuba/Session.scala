package candela.mitsuba

import candela.diagnostics.{Allowance, Code, Problem, Refusal, SceneError, SourcePos, Suggest}
import candela.io.{InputFile, SceneFolder}
import candela.math.{Interpolation, Transform, Vec3}
import candela.scenefile.{
  AnimatedTransform, Declaration, Dialect, GraphicsState, Param, Problems, Resolution
}

import java.nio.file.Path
import java.util.regex.Matcher

import scala.collection.mutable

/** State of translating one scene: its objects by id, the folders of its files, and the problems
  * found so far.
  *
  * @param sensor which of the scene's sensors is asked for, from 0, if any is
  * @param resolution of the image, if not that of the film
  * @param observe    is told of each object that was read
  */
final class Session(
    expanded: Expanded,
    folder: SceneFolder,
    keepGoing: Boolean,
    val sensor: Option[Int] = None,
    val resolution: Option[Resolution] = None,
    observe: Properties => Unit = _ => ()
):
  private val collected = Problems()
  private val files = mutable.LinkedHashSet.empty[Path]
  private val reported = mutable.LinkedHashSet.empty[Problem]

  /** Reads values of elements. */
  val values: Values = Values(
    (name, at) => locate(name, at).map(noted),
    name => folder.suggestion(name),
    report
  )

  /** Objects of the scene, in order. */
  val objects: Vector[Property] =
    expanded.elements.flatMap: e =>
      if e.tag == "ref" then None
      else values.plugin(e).map(p => Property(e("name").getOrElse(""), Value.Nested(p), e.pos))

  /** The sensors of the scene, those in shapes last. */
  lazy val sensors: Vector[Plugin] =
    val plugins = objects.map(_.value).collect { case Value.Nested(p) => p }
    val ofShapes =
      for p <- plugins if p.kind == "shape"; q <- p.properties
      yield q.value
    plugins.filter(_.kind == "sensor") ++
      ofShapes.collect { case Value.Nested(p) if p.kind == "sensor" => p }

  /** When the sensor's shutter opens and closes. */
  lazy val shutter: (Double, Double) =
    val rendered = sensors.lift(sensor.getOrElse(0))
    def time(name: String): Double =
      rendered.flatMap(_.properties.findLast(_.name == name)).map(_.value).collect:
        case Value.Number(x) => x
      .getOrElse(0)
    (time("shutter_open"), time("shutter_close"))

  /** What a motion is while the shutter is open. */
  def motion(keys: Vector[(Double, Transform)], at: SourcePos): AnimatedTransform =
    val (open, close) = shutter
    if keys.exists((time, _) => time > open && time < close) then
      warn(
        Code.NotAnimated,
        at,
        "motion between two times within the shutter's is not supported; the path is straight"
      )
    val start = Session.interpolated(keys, open)
    if close > open then AnimatedTransform(start, Session.interpolated(keys, close))
    else GraphicsState.constant(start)

  private val byId: Map[String, Plugin] =
    val plugins = mutable.HashMap.empty[String, Plugin]
    def collect(p: Plugin): Unit =
      for id <- p.id do
        if plugins.contains(id) then
          error(
            Code.Redefined,
            p.pos,
            s"the id `$id` is repeated; the first is at ${plugins(id).pos}"
          )
        else plugins(id) = p
      p.properties.map(_.value).foreach:
        case Value.Nested(inner) => collect(inner)
        case _ => ()
    objects.map(_.value).foreach:
      case Value.Nested(p) => collect(p)
      case _ => ()
    plugins.toMap

  expanded.elements.flatMap(Attributes.ignored).foreach(report)
  for e <- expanded.elements if e.tag == "ref"; id <- e("id") do plugin(id, e.pos): Unit

  private var missingThings = 0

  /** Names of properties in the file, by position and by Mitsuba's name of today. */
  private lazy val formerNames: Map[(SourcePos, String), String] =
    def of(e: Element): Vector[((SourcePos, String), String)] =
      e.formerName.map((e.pos, e("name").mkString) -> _).toVector ++ e.children.flatMap(of)
    expanded.elements.flatMap(of).toMap

  def report(p: Problem): Unit =
    val named = p.pos.fold(p): at =>
      val message = Session.Quoted.replaceAllIn(
        p.message,
        m =>
          Matcher.quoteReplacement(formerNames.get((at, m.group(1))).fold(m.matched)(n => s"`$n`"))
      )
      p.copy(message = message)
    if reported.add(named) then collected.add(named)
  def warn(code: Code, at: SourcePos, message: String, help: => Option[String] = None): Unit =
    report(Problem.warning(code, at, message).withHelp(limitedHelp(help)))
  def error(code: Code, at: SourcePos, message: String, help: => Option[String] = None): Unit =
    report(Problem.error(code, at, message).withHelp(limitedHelp(help)))
  def missing(
      code: Code,
      at: SourcePos,
      message: String,
      standIn: String,
      help: => Option[String]
  ): Unit =
    missingThings += 1
    report(Problem.missing(code, at, message, standIn, keepGoing).withHelp(limitedHelp(help)))

  /** Not looked for in scenes where everything is missing. */
  private def limitedHelp(help: => Option[String]): Option[String] =
    if reported.size < Problems.MaxHelped then help else None

  def problems: Vector[Problem] = collected.result()

  /** How much the scene may use. */
  def allowance: Allowance = folder.allowance

  /** Files read so far, other than XML. */
  def filesRead: Vector[Path] = files.toVector

  /** The object with this id, if there is one. */
  def lookup(id: String): Option[Plugin] =
    byId.get(id).orElse(expanded.aliases.get(id).flatMap(byId.get))

  def plugin(id: String, at: SourcePos): Option[Plugin] =
    val target = lookup(id)
    if target.isEmpty then
      error(
        Code.Undefined,
        at,
        s"no object has the id `$id`",
        Suggest.help(id, byId.keySet.view ++ expanded.aliases.keySet)
      )
    target

  /** A file, in the first folder that has it. */
  private def locate(name: String, at: SourcePos): Option[InputFile] =
    folder.locate(name, Some(at), expanded.folders)

  /** The file, which becomes part of the scene. */
  private def noted(file: InputFile): InputFile =
    files += file.path
    file

  /** An existing file, which becomes part of the scene. */
  def file(name: String, at: SourcePos, standIn: String): Option[InputFile] =
    if !SceneFolder.isName(name) then
      missing(Code.NoSuchFile, at, s"`$name` is not a valid file name", standIn, None)
      None
    else
      val existing = locate(name, at).map(noted)
      if existing.isEmpty then
        val nothing = s"no such file: `$name`"
        val (message, help) = folder.absence(name, Some(at), nothing, expanded.folders)
        missing(Code.NoSuchFile, at, message, standIn, help)
      existing

  /** The name of a file for a parameter, relative to the folder of the scene. */
  def named(file: InputFile): String =
    val (from, to) = (folder.path.toAbsolutePath, file.path.toAbsolutePath)
    try from.relativize(to).toString.replace('\\', '/')
    catch case _: IllegalArgumentException => file.toString

  def declare(
      category: String,
      name: String,
      at: SourcePos,
      params: Seq[Param],
      dialect: Option[Dialect] = None
  ): Declaration = Declaration(category, name, params.toVector, at, folder, "srgb", dialect)

  /** Runs `body` on the properties of an object, then reports those that it did not query, unless
    * something was missing that it needed to go on.
    */
  def translate[A](p: Plugin)(body: Properties => A): A =
    allowance.checkTime(Some(p.pos))
    val properties = Properties(p, this)
    val earlierCount = missingThings
    val result =
      try body(properties)
      finally observe(properties)
    if missingThings == earlierCount then properties.finish()
    result

  /** As `body`, or None after reporting an error. */
  def attempt[A](body: => A): Option[A] =
    try Some(body)
    catch
      case e: SceneError =>
        e.problems.foreach(report)
        None
      case Refusal.OfFile(problem) =>
        report(problem)
        None

object Session:
  private val Quoted = "`(\\w+)`".r

  /** A motion at a time. */
  private def interpolated(keys: Vector[(Double, Transform)], time: Double): Transform =
    keys.indexWhere(_._1 > time) match
      case -1 => keys.last._2
      case 0 => keys.head._2
      case i =>
        val ((from, start), (to, end)) = (keys(i - 1), keys(i))
        Interpolation(start, end, from.toFloat, to.toFloat, shortest = true, Vec3.Zero)
          .transform(time.toFloat)

  /** References through references, at most. */
  val MaxDepth = 50
