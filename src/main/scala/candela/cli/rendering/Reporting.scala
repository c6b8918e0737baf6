package candela.cli.rendering

import candela.base.{Figures, Version}
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{FileName, WholeFile}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path

import candela.cli.files.{Denoised, FileRegister, OutputFiles}
import candela.cli.options.Options
import candela.job.{Denoising, ImageFile, Prepared}
import candela.render.Rendering
import candela.report.{Machine, Picture, RenderData, RenderPage, RenderReport, Span}
import candela.settings.{RenderRegion, TextForm}

/** Report about one rendering: checked before rendering starts, written when it ends. */
final class Reporting(options: Options, scene: String, loaded: Prepared):
  private val paths: Vector[Path] = ReportFiles.checked(options.reports)
  private val machine = Machine.current()

  val recorder: RenderRecorder = RenderRecorder.of(loaded.plan, options.reference)

  /** Writes the reports that can be written, none if no pass completed.
    *
    * @return those written, and what is wrong with the others
    */
  def write(
      rendering: Rendering,
      threads: Int,
      developSeconds: Double,
      writeSeconds: Double,
      denoised: Option[Denoised] = None
  ): (Vector[Path], Vector[Problem]) =
    if recorder.pictures.forall(_.isReference) then (Vector.empty, Vector.empty)
    else
      ReportFiles.write(paths, report(rendering, threads, developSeconds, writeSeconds, denoised))

  private def report(
      rendering: Rendering,
      threads: Int,
      developSeconds: Double,
      writeSeconds: Double,
      denoised: Option[Denoised]
  ): RenderReport =
    val (last, others) = recorder.pictures.splitAt(1)
    val errors =
      for d <- denoised; r <- recorder.reference yield "error" -> d.errors(r)
    val clean = denoised.map: d =>
      Picture(s"${last.map(_.name).mkString}, denoised", Denoising.displayed(d.image))
    RenderReport(
      scene,
      Version.current,
      machine,
      rows(rendering, threads) ++ errors,
      loaded.plan.features,
      options.reference,
      recorder.points,
      phases(rendering, developSeconds, writeSeconds, denoised),
      recorder.passes,
      last ++ clean ++ others,
      rendering.rays,
      rendering.learned.fold(Vector.empty)(Learning.figures),
      CostRows.figures(loaded.plan.costs, rendering, developSeconds + writeSeconds)
    )

  private def phases(
      rendering: Rendering,
      developSeconds: Double,
      writeSeconds: Double,
      denoised: Option[Denoised]
  ): Vector[Span] =
    val phases = Vector(
      "parse" -> loaded.readSeconds,
      "build" -> loaded.buildSeconds,
      "render" -> rendering.seconds,
      "measure errors" -> recorder.seconds
    ) :+ denoised.fold("develop" -> developSeconds)(
      "denoise" -> _.seconds
    ) :+ ("write" -> writeSeconds)
    val begins = phases.map(_._2).scanLeft(0.0)(_ + _)
    phases.zip(begins).map:
      case ((name, seconds), begin) => Span(name, begin, begin + seconds)

  private def window: Option[String] = options.settings.region match
    case window: RenderRegion.Window => Some(TextForm.window.format(window))
    case _ => None

  private def quick: Option[String] =
    val settings = options.settings
    val parts = Vector(
      "a quarter of the width and height" -> settings.reading.resolution.isEmpty,
      "1 spp" -> settings.samples.isEmpty
    ).collect { case (part, true) => part }
    Option.when(settings.quick && parts.nonEmpty)(parts.mkString(", "))

  private def rows(rendering: Rendering, threads: Int): Vector[(String, String)] =
    Vector(
      "samples per pixel" -> Reporting.samples(rendering),
      "threads" -> threads.toString,
      "seed" -> options.settings.seed.toString,
      "image" -> s"${rendering.film.width}×${rendering.film.height}",
      "rays" -> Figures.metric(rendering.rays.toDouble)
    ) ++
      ImageFile.fireflies(loaded.plan, rendering).map("fireflies" -> _) ++
      rendering.film.levels.map: l =>
        "memory of brightness levels" -> s"${Figures.metric(l.memory.toDouble)}B"
      ++
      options.reference.map("reference" -> _) ++
      quick.map("quick" -> _) ++
      window.map("crop window" -> _) ++
      Option.when(options.settings.reading.keepGoing)("placeholders" -> loaded.standIns.toString)

private object Reporting:
  private def samples(r: Rendering): String =
    val planned = if r.isOpenEnded then "" else s" of ${r.samplesPerPixel}"
    val runNote =
      if r.earlier == 0 then "" else s", ${r.samplesDone - r.earlier} of them in this run"
    s"${r.samplesDone}$planned$runNote"

/** Report files: `.html` for readers, `.json` and `.csv` for programs. */
object ReportFiles:
  private val Suffixes = Vector("html", "json", "csv")

  /** Verifies before rendering that the files can be written.
    *
    * @throws SceneError if one can't
    */
  def checked(names: Vector[String]): Vector[Path] =
    val paths = names.map(OutputFiles.path).distinct
    val problems = paths.flatMap: path =>
      if !Suffixes.contains(FileName.suffix(path)) then
        val help = Some("reports are written as .html, .json or .csv")
        Some(Problem.general(Code.UnknownFormat, s"can't write the report `$path`", help))
      else FileRegister.obstacle(path)
    if problems.nonEmpty then throw SceneError(problems)
    paths

  /** Writes every file that can be written.
    *
    * @return those written, and what is wrong with the others
    */
  def write(paths: Vector[Path], report: RenderReport): (Vector[Path], Vector[Problem]) =
    val failures = OutputFiles.failures(paths): path =>
      val text = FileName.suffix(path) match
        case "html" => RenderPage.html(report)
        case "json" => RenderData.json(report)
        case _ => RenderData.csv(report)
      WholeFile.write(path, text.getBytes(UTF_8))
    (paths.diff(failures.map(_._1)), failures.map(_._2))
