package candela.bench

import candela.diagnostics.Suggest
import candela.bench.robustness.RobustnessRun
import candela.cli.options.{
  Command, CommandRow, ModuleOptions, OptionRows, OptionTable, Options, Words
}

import scopt.OParser

/** Options of `robustness`.
  *
  * @param rays   trials of each row
  * @param only   kinds of faults, or empty for all
  * @param python a Python that has embreex, if not `python3`
  */
final case class RobustnessOptions(
    rays: Long = RobustnessOptions.UsualRays,
    only: Vector[String] = Vector.empty,
    python: Option[String] = None
) extends ModuleOptions

object RobustnessOptions:
  /** Enough to see what is wrong in one of 10,000 trials. */
  final val UsualRays = 200_000L

  /** A day or more. */
  final val MaxRays = 1_000_000_000_000L

  def of(o: Options): RobustnessOptions =
    o.module.collect { case options: RobustnessOptions => options }.getOrElse(RobustnessOptions())

/** Option table of `robustness`, one row each. */
private[bench] object RobustnessTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private def change(o: Options)(f: RobustnessOptions => RobustnessOptions): Options =
    o.copy(module = Some(f(RobustnessOptions.of(o))))

  val kinds: Vector[String] = RobustnessRun.all.map(_.key)

  private val options: Vector[Row] = Vector(
    opt[Long]("rays").valueName("N")
      .text(s"rays, inputs or pixels of each row (default ${RobustnessOptions.UsualRays})")
      .validate(atLeast("rays", 1))
      .validate: n =>
        if n <= RobustnessOptions.MaxRays then success
        else failure(s"--rays must be at most ${RobustnessOptions.MaxRays}, found `$n`")
      .action((n, o) => change(o)(_.copy(rays = n))),
    opt[Seq[String]]("only").valueName("KIND,...")
      .text(s"only these kinds of faults: ${kinds.mkString(", ")}")
      .validate(nonEmpty("only"))
      .validate: all =>
        all.find(!kinds.contains(_)).fold(success): word =>
          val nearest = Suggest.nearest(word, kinds)
          val hint = nearest.fold(kinds.mkString(", "))(n => s"did you mean `$n`?")
          failure(s"--only has no kind `$word`: $hint")
      .action((k, o) => change(o)(r => r.copy(only = r.only ++ k))),
    opt[Seq[String]]("report").unbounded().valueName("FILE[,FILE]")
      .text("also write the table as .html (with pictures where programs differ), .json or .md")
      .action((f, o) => o.copy(reports = o.reports ++ f)),
    opt[String]("python").valueName("PYTHON")
      .text("a Python with the module embreex, to measure Embree (default: that of " +
        "CANDELA_PYTHON, else python3)")
      .action((p, o) => change(o)(_.copy(python = Some(p)))),
    OptionTable.quiet
  )

  val row: CommandRow = CommandRow(
    Command.Robustness,
    "count numerical faults, of Candela and of other renderers",
    Vector.empty,
    Words.Anything,
    options,
    "It exits with 1 if Candela has a fault that the table does not explain. [What is counted, " +
      "and the results](STABILITY.md#measure-it-yourself)."
  )
