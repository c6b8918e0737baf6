package candela.cli

import candela.base.{Problem, SceneError, Version}
import candela.film.{PixelBounds, SpectralBands}
import candela.image.{ImageError, ImageFiles}
import candela.render.{Cancellation, Progress, Renderer, Rendering}

import java.nio.file.Path

import scala.util.{Failure, Success, Try}

/** `candela render`: from scenes to image files. */
final class RenderCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  private val cancellation = Cancellation()
  private val threads = options.threadCount

  def run(): ExitCode =
    var code = ExitCode.Done
    var taken = Map.empty[Path, String]
    for scene <- options.files if !cancellation.isRequested do
      code = code.worseOf:
        report.guarded:
          val loaded = load(scene)
          if options.debug then PixelTrace.run(loaded.plan, options, terminal.out)
          else
            val files = outputs(loaded.plan.filename)
            val plan = loaded.plan
            if plan.layers.nonEmpty || plan.development.bands.nonEmpty then files.checkLayers()
            for path <- files.paths.map(_.toAbsolutePath.normalize) do
              taken.get(path).foreach(other => throw overwrite(path, scene, other))
              taken += path -> scene
            render(scene, loaded, files.paths)
    code

  private def load(scene: String): LoadedScene =
    // Said before the scene is read, which may take long.
    OutputFiles.asked(options.outfiles).check()
    val loaded = loader.load(scene, options)
    report.warnings(loaded.warnings, all = options.verbose)
    if options.explain || options.verbose then Explanation.print(loaded.plan, terminal.err)
    loaded

  private def outputs(filename: String): OutputFiles =
    val files =
      if options.outfiles.nonEmpty then OutputFiles.asked(options.outfiles)
      else OutputFiles.ofFilm(filename)
    report.warnings(files.warnings, all = true)
    files.check()
    files

  private def overwrite(path: Path, scene: String, other: String): SceneError =
    val message = s"the image of `$scene` would overwrite that of `$other`: $path"
    SceneError(Problem.general(message, Some("render one at a time, with --outfile")))

  private def render(scene: String, loaded: LoadedScene, paths: Vector[Path]): ExitCode =
    val reporting = Option.when(options.reports.nonEmpty)(Reporting(options, scene, loaded))
    terminal.interrupts.during(cancellation):
      val progress = ProgressLine(terminal.err, terminal.isInteractive)
      val show: Progress => Unit = if options.quiet then _ => () else progress.update
      val rendering =
        try Renderer.render(loaded.plan, threads, cancellation, show, reporting.map(_.recorder))
        finally progress.finish()
      val started = System.nanoTime
      val written = write(paths, scene, loaded, rendering)
      val writeSeconds = (System.nanoTime - started) * 1e-9
      summarise(written, loaded, rendering, writeSeconds)
      for path <- reporting.toVector.flatMap(_.write(rendering, threads, writeSeconds)) do
        if !options.quiet then terminal.out.println(s"wrote $path")
      terminal.out.flush()
      if written.size < paths.size then ExitCode.BadInput
      else if cancellation.isRequested then ExitCode.Interrupted
      else ExitCode.Done

  /** Writes every file that can be written, and returns those. */
  private def write(
      paths: Vector[Path],
      scene: String,
      loaded: LoadedScene,
      rendering: Rendering
  ): Vector[Path] =
    val development = loaded.plan.development
    val image = rendering.image(development)
    val about = metadata(scene, loaded, rendering)
    def write(path: Path) = Try(ImageFiles.write(path, image, about, development.isHalf))
    val attempts = paths.map(path => path -> write(path))
    val failures = attempts.collect:
      case (_, Failure(e: ImageError)) => Problem.general(e.getMessage)
      case (_, Failure(e)) => throw e
    if failures.nonEmpty then
      val _ = report.errors(failures)
    attempts.collect { case (path, Success(_)) => path }

  private def metadata(
      scene: String,
      loaded: LoadedScene,
      rendering: Rendering
  ): Vector[(String, String)] =
    val plan = loaded.plan
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val crop = Option.when(plan.crop != PixelBounds(0, 0, plan.width, plan.height)):
      "crop" -> s"x $x0 until $x1, y $y0 until $y1 of ${plan.width}x${plan.height}"
    Vector(
      "software" -> s"Candela ${Version.current}",
      "scene" -> scene,
      "dialect" -> loaded.description.dialect.toString.toLowerCase,
      "samplesPerPixel" -> rendering.samplesDone.toString,
      "seed" -> options.seed.toString,
      "renderSeconds" -> Figures.fixed(rendering.seconds, 2)
    ) ++ plan.features.filter(_._1 == "integrator") ++ crop ++
      plan.development.bands.fold(Vector.empty)(_ => SpectralBands.metadata)

  private def summarise(
      written: Vector[Path],
      loaded: LoadedScene,
      rendering: Rendering,
      writeSeconds: Double
  ): Unit =
    rendering.refused.foreach(r => terminal.err.println(Summary.refused(r)))
    if !options.quiet && written.nonEmpty then
      if options.verbose then
        terminal.err.println(Summary.phases(loaded, rendering, writeSeconds))
      terminal.out.println(Summary.result(written, rendering, loaded.standIns))
      terminal.out.flush()
