package candela.cli

import scopt.OParser

/** The options of `bench`, one row each. */
private[cli] object BenchTable:
  private type Row = OParser[?, Options]

  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private def change(o: Options)(f: BenchOptions => BenchOptions): Options =
    o.copy(bench = f(o.bench))

  val options: Vector[Row] = Vector(
    opt[Seq[String]]("report").unbounded().valueName("FILE[,FILE]")
      .text("where to write the results: .html, .json, .csv, .svg (default: SUITE.html)")
      .action((f, o) => o.copy(reports = o.reports ++ f)),
    opt[Seq[Int]]("samples").valueName("N,...")
      .text("samples per pixel, instead of the suite's")
      .validate(n => if n.forall(_ >= 1) then success else failure("--samples: expected from 1"))
      .action((n, o) => change(o)(_.copy(samples = Some(n.toVector.distinct.sorted)))),
    opt[Int]("seeds").valueName("N")
      .text("independent images for each sample count, instead of the suite's")
      .validate: n =>
        if n >= 1 then success else failure(s"--seeds: expected a number from 1, found `$n`")
      .action((n, o) => change(o)(_.copy(seeds = Some(n)))),
    opt[Seq[String]]("programs").valueName("NAME,...")
      .text("only these of the suite")
      .action((p, o) => change(o)(_.copy(programs = p.toVector))),
    opt[Seq[String]]("scenes").valueName("NAME,...")
      .text("only these of the suite")
      .action((s, o) => change(o)(_.copy(scenes = s.toVector))),
    opt[String]("references").valueName("FOLDER")
      .text("where the references of a folder of scenes are, if not beside them")
      .action((f, o) => change(o)(_.copy(references = Some(f)))),
    opt[Unit]("no-pictures")
      .text("a page without the images: a tenth of the size")
      .action((_, o) => change(o)(_.copy(pictures = false))),
    opt[Unit]("quiet")
      .text("print nothing but errors")
      .action((_, o) => o.copy(quiet = true))
  )
