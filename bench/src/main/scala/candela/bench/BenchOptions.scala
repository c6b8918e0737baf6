package candela.bench

import candela.bench.suite.Work
import candela.cli.options.{
  Command, CommandRow, ModuleOptions, OptionRows, OptionTable, Options, Words
}

import scopt.OParser

/** Options of `bench`; empty or None keeps the suite's setting.
  *
  * @param work sample counts or time budgets
  * @param references folder of the references of a folder of scenes, if not that folder
  * @param pictures whether the page contains all images
  * @param denoise whether Candela also renders with --denoise
  * @param peers whether the programs are those of this machine, instead of the suite's
  */
final case class BenchOptions(
    work: Option[Work] = None,
    seeds: Option[Int] = None,
    programs: Vector[String] = Vector.empty,
    scenes: Vector[String] = Vector.empty,
    references: Option[String] = None,
    pictures: Boolean = true,
    denoise: Boolean = false,
    peers: Boolean = false
) extends ModuleOptions

object BenchOptions:
  def of(o: Options): BenchOptions =
    o.module.collect { case options: BenchOptions => options }.getOrElse(BenchOptions())

/** Option table of `bench`, one row each. */
private[bench] object BenchTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private def change(o: Options)(f: BenchOptions => BenchOptions): Options =
    o.copy(module = Some(f(BenchOptions.of(o))))

  private def unique(option: String)(all: Seq[?]): Either[String, Unit] =
    Work.repeated(all).fold(success)(n => failure(s"--$option has `$n` twice"))

  private val options: Vector[Row] = Vector(
    opt[Seq[String]]("report").unbounded().valueName("FILE[,FILE]")
      .text("output files: .html, .json, .csv, .svg (default: SUITE.html)")
      .action((f, o) => o.copy(reports = o.reports ++ f)),
    opt[Seq[Int]]("samples").valueName("N,...")
      .text("samples per pixel; overrides the suite")
      .validate(n => if n.forall(_ >= 1) then success else failure("--samples must be at least 1"))
      .validate(unique("samples"))
      .action((n, o) => change(o)(_.copy(work = Some(Work.Samples(n.toVector.sorted))))),
    opt[Seq[Double]]("seconds").valueName("N,...")
      .text("time per image, instead of samples; overrides the suite")
      .validate(n => if n.forall(_ > 0) then success else failure("--seconds must be above 0"))
      .validate(unique("seconds"))
      .action((n, o) => change(o)(_.copy(work = Some(Work.Seconds(n.toVector.sorted))))),
    opt[Int]("seeds").valueName("N")
      .text("independent images per sample count; overrides the suite")
      .validate(atLeast("seeds", 1))
      .action((n, o) => change(o)(_.copy(seeds = Some(n)))),
    opt[Seq[String]]("programs").valueName("NAME,...")
      .text("restrict the suite to these programs")
      .action((p, o) => change(o)(_.copy(programs = p.toVector))),
    opt[Seq[String]]("scenes").valueName("NAME,...")
      .text("restrict the suite to these scenes")
      .action((s, o) => change(o)(_.copy(scenes = s.toVector))),
    opt[String]("references").valueName("FOLDER")
      .text("references for a folder of scenes (default: that folder)")
      .action((f, o) => change(o)(_.copy(references = Some(f)))),
    opt[Unit]("denoise")
      .text("measure Candela with and without denoising")
      .action((_, o) => change(o)(_.copy(denoise = true))),
    opt[Unit]("peers")
      .text("compare the renderers of this machine on the suite's scenes, converted for each")
      .action((_, o) => change(o)(_.copy(peers = true))),
    opt[Unit]("no-pictures")
      .text("omit images from the page: a tenth of the size")
      .action((_, o) => change(o)(_.copy(pictures = false))),
    OptionTable.quiet
  )

  val row: CommandRow = CommandRow(
    Command.Bench,
    "measure error against time, for several renderers",
    Vector(file(
      "[suite.conf]",
      "the suite, or a folder of scenes with references; with --peers, " +
        "a scene, or nothing: a suite of some minutes"
    ).optional()),
    Words.Files(Vector("conf")),
    options,
    "[Error against time](BENCH.md)."
  )
