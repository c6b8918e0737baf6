package candela.convert

import candela.diagnostics.Code
import candela.scenefile.Dialect

/** Converts some parameters of a statement.
  *
  * @param source source parameters, for the documentation
  * @param target target parameters or effect, for the documentation
  */
final class Step(val source: String, val target: String)(val run: Statement => Unit)

/** Table row: converts one kind of statement. Steps run in order; parameters that no step takes are
  * unknown in the source dialect, and dropped with a warning.
  *
  * @param to name in the target dialect; a step may override it
  * @param note difference from the source, given in a warning at each use
  * @param differs whether there is one between these two dialects
  */
final class Rule(
    val sourceNames: Seq[String],
    val to: String,
    val note: Option[String],
    val steps: Seq[Step],
    val differs: ((Dialect, Dialect)) => Boolean = _ => true
)

object Rule:
  def apply(names: (String, String))(steps: Step*): Rule =
    new Rule(names._1.split('|').toSeq, names._2, None, steps)

  /** An approximate rule; the note names the difference. */
  def approximate(names: (String, String), note: String)(steps: Step*): Rule =
    new Rule(names._1.split('|').toSeq, names._2, Some(note), steps)

/** All rules of one kind of statement.
  *
  * @param fallback replacement of statements without a rule; None: they are dropped
  */
final class Table(val category: String, val fallback: Option[String], val rules: Seq[Rule]):
  def rule(name: String): Option[Rule] = rules.find(_.sourceNames.contains(name))

object Table:
  def apply(category: String, fallback: String = "")(rules: Rule*): Table =
    new Table(category, Option.when(fallback.nonEmpty)(fallback), rules)

/** Kinds of steps. */
object Steps:

  /** Keeps name and value. */
  def retain(names: String*): Step =
    Step(names.mkString("`", "`, `", "`"), "unchanged"): s =>
      names.foreach(n => s.take(n).foreach(s.add(n, _)))

  def rename(names: (String, String)*): Step =
    Step(
      names.map(_._1).mkString("`", "`, `", "`"),
      names.map(_._2).mkString("`", "`, `", "`")
    )(s => names.foreach((from, to) => s.take(from).foreach(s.add(to, _))))

  /** Bumps, by another name. In v3, light reaches them if it is before the surface; in v4, it must
    * be before the bump, too.
    */
  def bumps(s: Statement, from: String, to: String): Unit =
    for p <- s.take(from) do
      s.add(to, p)
      val (source, target) = s.run.ends
      if source != target && s.numberOf(p).isEmpty then
        val message = "v3 lights bumps that turn away from a light, v4 does not"
        s.warn(Code.Inexpressible, p.pos, message)

  /** Where textures of v3 and v4 lie: each mapping has its own numbers. */
  val mapping: Step =
    Step("`mapping`, `uscale`, `vscale`, `udelta`, `vdelta`, `v1`, `v2`", "those of the mapping"):
      s =>
        val kind = s.takeString("mapping", "uv")
        if kind != "uv" then s.addString("mapping", kind)
        for name <- Placement; p <- s.take(name) if Placements.getOrElse(kind, Set.empty)(name) do
          s.add(name, p)
        if kind == "cylindrical" then
          val message = "\"cylindrical\" maps heights in v4, and directions from the centre in v3"
          s.warn(Code.Inexpressible, s.declaration.pos, message)

  /** The numbers of mappings. */
  val Placement: Vector[String] = Vector("uscale", "vscale", "udelta", "vdelta", "v1", "v2")

  private val Placements =
    Map("uv" -> Placement.take(4).toSet, "planar" -> Placement.drop(2).toSet)

  /** Drops parameters that don't affect the image. */
  def drop(names: String*): Step =
    Step(names.mkString("`", "`, `", "`"), "ignored: does not affect the image"): s =>
      names.foreach(s.take)

  /** Drops a parameter that the target dialect lacks; warns unless its value is neutral. */
  def unsupported(name: String, instead: String)(isNeutral: (Param, Statement) => Boolean): Step =
    Step(s"`$name`", s"dropped: $instead"): s =>
      for p <- s.take(name) if !isNeutral(p, s) do
        s.warn(
          Code.Inexpressible,
          p.pos,
          s"`$name` of \"${s.name}\" is not supported in ${s.target}; $instead"
        )

  def unsupported(name: String, instead: String): Step = unsupported(name, instead)((_, _) => false)

  /** Writes a default explicitly where the target dialect's differs. */
  def otherwise(name: String, text: String)(write: Statement => Unit): Step =
    Step(s"no `$name`", text)(s => if !s.contains(name) then write(s))

  private type Param = candela.scenefile.Param

  def isColor(value: Float)(p: Param, s: Statement): Boolean =
    s.colorOf(p).exists(c => c.r == value && c.g == value && c.b == value)

  def isNumber(value: Float)(p: Param, s: Statement): Boolean = s.numberOf(p).contains(value)

/** Noise textures, equal in all dialects except for marble. */
private[convert] object Noise:
  val octaves: Step = Steps.retain("octaves", "roughness")

  val rules: Seq[Rule] = Seq(
    Rule("fbm" -> "fbm")(octaves),
    Rule("wrinkled" -> "wrinkled")(octaves),
    Rule("windy" -> "windy")()
  )

  /** pbrt-v3 extrapolates the first segment of the colour spline; v2 and v4 use all six colours. */
  val marble: Rule = new Rule(
    Seq("marble"),
    "marble",
    Some("pbrt-v3's marble extrapolates the colours of v2's and v4's"),
    Seq(Steps.retain("octaves", "roughness", "scale", "variation")),
    differs = _ != (Dialect.V2, Dialect.V4)
  )
