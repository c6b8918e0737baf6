package candela.cli.options

import candela.job.ReferenceFile

import scopt.OParser

/** Rows of the option table that `reference` has alone. Each call makes new rows: scopt gives a row
  * one parent.
  */
private[cli] object ReferenceTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.opt

  def options: Vector[Row] = Vector(
    opt[String]('o', "outfile").valueName("FILE.exr")
      .text("the reference (default: the scene's name with -reference.exr, in this folder)")
      .action((f, o) => o.copy(outfiles = Vector(f))),
    setting(
      "error",
      OptionText(
        "end when the reference's own relative error is below X, e.g. 0.002 or 0.2%",
        s"The error is estimated from the differences between runs, at least " +
          s"${ReferenceFile.MinRuns}: [references](NOISE.md#references)."
      )
    ),
    setting("time", "end with the run that ends nearest to this time of rendering, e.g. 2h"),
    opt[Int]("spp").valueName("N")
      .text(s"samples per pixel of each run (default ${ReferenceFile.UsualSamples})")
      .validate(atLeast("spp", 1))
      .action((n, o) => o.controlling(_.copy(samples = Some(n)))),
    setting("seed", "random seed: references of different seeds are independent (default 0)")
  )

  /** What is wrong with the options of `reference`, if anything. */
  def problem(o: Options): Option[String] =
    Option.when(o.command == Command.Reference && !o.settings.goal.isGiven):
      "reference needs --error X or --time TIME, which end it"
