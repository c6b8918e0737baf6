package candela.convert

/** What a row of a table does with some parameters.
  *
  * @param source what they are called in the dialect that is read, for the documentation
  * @param target what becomes of them, in words or as a name
  */
final class Step(val source: String, val target: String)(val run: Statement => Unit)

/** One row of a table: what becomes of a kind of statement. Steps run in their order; parameters
  * that none of them takes don't exist in this dialect, and are left out with a warning.
  *
  * @param to   the name in the other dialect; a step may choose another one
  * @param note in what way the result is not the same, named in a warning wherever it is used
  */
final class Rule(
    val from: Seq[String],
    val to: String,
    val note: Option[String],
    val steps: Seq[Step]
)

object Rule:
  def apply(names: (String, String))(steps: Step*): Rule =
    new Rule(names._1.split('|').toSeq, names._2, None, steps)

  /** With a note, because the two are not the same. */
  def near(names: (String, String), note: String)(steps: Step*): Rule =
    new Rule(names._1.split('|').toSeq, names._2, Some(note), steps)

/** All rules for one kind of statement.
  *
  * @param fallback what stands in for a statement that has no rule; None: it is left out
  */
final class Table(val category: String, val fallback: Option[String], val rules: Seq[Rule]):
  def rule(name: String): Option[Rule] = rules.find(_.from.contains(name))

object Table:
  def apply(category: String, fallback: String = "")(rules: Rule*): Table =
    new Table(category, Option.when(fallback.nonEmpty)(fallback), rules)

/** The kinds of steps. */
object Steps:

  /** The same name and meaning. */
  def keep(names: String*): Step =
    Step(names.mkString("`", "`, `", "`"), "the same"): s =>
      names.foreach(n => s.take(n).foreach(s.add(n, _)))

  def rename(names: (String, String)*): Step =
    Step(
      names.map(_._1).mkString("`", "`, `", "`"),
      names.map(_._2).mkString("`", "`, `", "`")
    )(s => names.foreach((from, to) => s.take(from).foreach(s.add(to, _))))

  /** No meaning for the picture. */
  def drop(names: String*): Step =
    Step(names.mkString("`", "`, `", "`"), "left out: no part of the picture"): s =>
      names.foreach(s.take)

  /** What the other dialect can't say: a warning, unless the value has no effect anyway. */
  def lose(name: String, instead: String)(isNeutral: (Param, Statement) => Boolean): Step =
    Step(s"`$name`", s"lost: $instead"): s =>
      for p <- s.take(name) if !isNeutral(p, s) do
        s.warn(p.at, s"`$name` of \"${s.name}\" can't be said in ${s.target}: $instead")

  def lose(name: String, instead: String): Step = lose(name, instead)((_, _) => false)

  /** Writes what the other dialect has another default for. */
  def otherwise(name: String, text: String)(write: Statement => Unit): Step =
    Step(s"no `$name`", text)(s => if !s.has(name) then write(s))

  private type Param = candela.scenefile.Param

  def isColor(value: Float)(p: Param, s: Statement): Boolean =
    s.colorOf(p).exists(c => c.r == value && c.g == value && c.b == value)

  def isNumber(value: Float)(p: Param, s: Statement): Boolean = s.numberOf(p).contains(value)

/** Textures of noise, which are the same in all dialects but for one. */
private[convert] object Noise:
  val octaves: Step = Steps.keep("octaves", "roughness")

  val rules: Seq[Rule] = Seq(
    Rule("fbm" -> "fbm")(octaves),
    Rule("wrinkled" -> "wrinkled")(octaves),
    Rule("windy" -> "windy")()
  )

  /** pbrt-v3 goes on along the first curves between the colours; v2 and v4 have all six. */
  val marble: Rule = Rule.near(
    "marble" -> "marble",
    "pbrt-v3's marble runs beyond the colours of v2's and v4's"
  )(Steps.keep("octaves", "roughness", "scale", "variation"))
