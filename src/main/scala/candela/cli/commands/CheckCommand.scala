package candela.cli.commands

import candela.base.Figures
import candela.diagnostics.{SceneError, Severity}
import candela.cli.files.FilmName
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.job.{Prepared, SceneFormat, SceneLoader}

import java.nio.file.Path
import java.util.Locale

import scala.util.Using

/** `candela check`: parses and builds scenes, prints their contents, and reports problems. */
final class CheckCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):

  private var warned = 0

  def run(): ExitCode =
    val codes = options.files.map: scene =>
      val previousErrors = report.errors
      val code = report.guarded(check(scene))
      val errors = report.errors - previousErrors
      if code != ExitCode.Done && options.files.size > 1 && !options.quiet then
        terminal.out.println(s"$scene: rejected, ${Figures.count(errors, "error")}")
        terminal.out.flush()
      code
    if options.files.size > 1 && !options.quiet then summarise(codes)
    codes.reduce(_ worseOf _)

  private def summarise(codes: Vector[ExitCode]): Unit =
    val accepted = codes.count(_ == ExitCode.Done)
    val counts = Vector(
      accepted -> "accepted",
      warned -> "of them with warnings",
      (codes.size - accepted) -> "rejected"
    ).collect { case (n, what) if n > 0 => s"$n $what" }
    terminal.out.println(s"${codes.size} scenes: ${counts.mkString(", ")}")

  private def check(scene: String): ExitCode =
    Using.resource(loader.load(scene, options.sceneSettings, options.building))(check(scene, _))

  private def check(scene: String, read: Prepared): ExitCode =
    val film = FilmName.problem(read.description)
    for p <- film if p.severity == Severity.Error do throw SceneError(read.warnings :+ p)
    val loaded = read.copy(warnings = read.warnings ++ film)
    report.warnings(loaded.warnings, all = options.verbose)
    if loaded.warnings.nonEmpty then warned += 1
    if !options.quiet then
      terminal.out.println(s"$scene: ${contents(scene, loaded)}")
      for added <- read.description.additions do terminal.out.println(s"$scene: $added")
    if options.explain || (options.verbose && !options.quiet) then
      Explanation.print(loaded.plan, terminal.out)
    terminal.out.flush()
    ExitCode.Done

  private def contents(scene: String, loaded: Prepared): String =
    val d = loaded.description
    val crop = loaded.plan.crop
    val shapes = d.shapes.size + d.objects.values.map(_.size).sum
    // Each triangle of a shape that emits light may be one
    val statements = d.lights.size + d.shapes.count(_.areaLight.nonEmpty)
    val lights = loaded.plan.lights
    val suffix =
      if statements > 0 && lights > statements then s" (of $statements in the file)" else ""
    val counted = Vector(
      shapes -> "shape",
      d.instances.size -> "instance",
      lights -> "light",
      d.textures.size -> "texture",
      loaded.warnings.distinct.size -> "warning",
      loaded.standIns -> "placeholder"
    ).collect:
      case (n, noun) if n > 0 => Figures.count(n, noun) + (if noun == "light" then suffix else "")
    val film = s"${crop.width}x${crop.height}, ${loaded.plan.sampler.samplesPerPixel} spp"
    // All models have the dialect of glTF's materials
    val kind = SceneFormat.named(Path.of(scene)).filter(_.isModel).fold(s"${d.dialect}")(_.name)
    (Vector(kind.toLowerCase(Locale.ROOT), film) ++ counted).mkString(", ")
