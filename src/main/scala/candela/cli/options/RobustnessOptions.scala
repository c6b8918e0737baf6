package candela.cli.options

import candela.base.Suggest
import candela.robustness.RobustnessRun

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
)

object RobustnessOptions:
  /** Enough to see what is wrong in one of 10,000 trials. */
  final val UsualRays = 200_000L

  /** A day or more. */
  final val MostRays = 1_000_000_000_000L

/** Option table of `robustness`, one row each. */
private[cli] object RobustnessTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private def change(o: Options)(f: RobustnessOptions => RobustnessOptions): Options =
    o.copy(robustness = f(o.robustness))

  val kinds: Vector[String] = RobustnessRun.all.map(_.key)

  val options: Vector[Row] = Vector(
    opt[Long]("rays").valueName("N")
      .text(s"rays, inputs or pixels of each row (default ${RobustnessOptions.UsualRays})")
      .validate(atLeast("rays", 1))
      .validate: n =>
        if n <= RobustnessOptions.MostRays then success
        else failure(s"--rays must be at most ${RobustnessOptions.MostRays}, found `$n`")
      .action((n, o) => change(o)(_.copy(rays = n))),
    opt[Seq[String]]("only").valueName("KIND,...")
      .text(s"only these kinds of faults: ${kinds.mkString(", ")}")
      .validate(some("only"))
      .validate: all =>
        all.find(!kinds.contains(_)).fold(success): word =>
          val near = Suggest.nearest(word, kinds)
          val meant = near.fold(kinds.mkString(", "))(n => s"did you mean `$n`?")
          failure(s"--only has no kind `$word`: $meant")
      .action((k, o) => change(o)(r => r.copy(only = r.only ++ k))),
    opt[Seq[String]]("report").unbounded().valueName("FILE[,FILE]")
      .text("also write the table as .html (with pictures where programs differ), .json or .md")
      .action((f, o) => o.copy(reports = o.reports ++ f)),
    opt[String]("python").valueName("PYTHON")
      .text("a Python with the module embreex, to measure Embree (default: that of " +
        "CANDELA_PYTHON, else python3)")
      .action((p, o) => change(o)(_.copy(python = Some(p))))
  )
