package candela.cli

import java.nio.file.{Files, Path}

import scala.util.{Failure, Success, Try}

import candela.base.{Problem, SceneError, Version}
import candela.build.RenderRegion
import candela.film.{PixelBounds, SpectralBands}
import candela.image.*
import candela.render.{Cancellation, Live, Progress, Renderer, Rendering, RenderPlan}
import candela.render.storage.FilmFile
import candela.scene.PathReport

/** `candela render`: renders scenes to image files.
  *
  * @param resumed  the saved rendering to continue, if any
  * @param register of files, shared by the renderings of a run
  */
final class RenderCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader,
    resumed: Option[FilmFile] = None,
    register: FileRegister = FileRegister()
):
  private val cancellation = Cancellation()
  private val files = RenderOutputs(options, report, register, resumed)
  private val threads = options.threadCount
  private val settings = options.settings
  private lazy val denoising =
    Option.when(settings.output.denoise)(Denoising(Oidn.load(terminal.environment), threads))

  def run(): ExitCode =
    val sequence = Sequence(options)
    val code = report.guarded:
      checkAll(sequence.frames)
      ExitCode.Done
    if code == ExitCode.Done then run(sequence) else code

  /** @throws SceneError if two scenes have one image */
  private[cli] def checkAll(frames: Vector[Frame]): Unit = files.checkAll(frames, loader)

  private def run(sequence: Sequence): ExitCode =
    for Frame(scene, outfiles) <- sequence.frames do
      // Files of v2 and v3 may have several worlds
      var world = Option(0)
      while world.nonEmpty && !cancellation.isRequested do
        val n = world.get
        world = None
        sequence.ended(scene):
          report.guarded:
            val loaded = load(scene, outfiles, n)
            if options.debug then PixelTrace.run(loaded.plan, options, terminal.out)
            else if options.pixelMaterial.isDefined then
              val (x, y) = options.pixelMaterial.get
              PixelMaterial.run(loaded.plan, x, y, terminal.out)
            else
              val isFollowed = loaded.description.isFollowed
              val names = Sequence.ofWorld(scene, outfiles, n, isFollowed)
              world = Option.when(isFollowed)(n + 1)
              render(scene, loaded, names, outputs(scene, loaded, names), sequence)
    if !options.quiet && !cancellation.isRequested then
      sequence.summary.foreach(terminal.out.println)
    terminal.out.flush()
    sequence.code

  private[cli] def load(scene: String, outfiles: Vector[String], world: Int = 0): LoadedScene =
    // Warns before parsing, which may take long.
    files.check(scene, outfiles)
    for kind <- options.thumbnail do Thumbnail.kind(kind, terminal): Unit
    denoising.foreach(identity)
    val loaded = loader.load(scene, options.copy(world = world))
    // A first look ignores most of what warnings are about.
    val isBrief = settings.preview && !options.verbose
    val told = if isBrief then loaded.warnings.filter(_.standIn.nonEmpty) else loaded.warnings
    report.warnings(told, all = options.verbose)
    if options.explain || options.verbose then Explanation.print(loaded.plan, terminal.err)
    loaded

  /** The images to write, which can be written, each by one scene. */
  private[cli] def outputs(
      scene: String,
      loaded: LoadedScene,
      outfiles: Vector[String]
  ): Vector[Path] = files.images(scene, loaded, outfiles)

  private def render(
      scene: String,
      loaded: LoadedScene,
      outfiles: Vector[String],
      paths: Vector[Path],
      sequence: Sequence
  ): ExitCode =
    val name = resumed.fold(scene)(_.header.scene)
    val keeping = FilmKeeping.of(options, report, name, loaded, outfiles, paths, resumed)
    try render(name, loaded, paths, keeping, sequence)
    finally keeping.foreach(_.close())

  private def render(
      name: String,
      loaded: LoadedScene,
      paths: Vector[Path],
      keeping: Option[FilmKeeping],
      sequence: Sequence
  ): ExitCode =
    val digest = this.digest(name, loaded, paths)
    val isDone = digest.exists(Sequence.isDone(paths, _)) ||
      (options.film.skipDone && paths.isEmpty && keeping.exists(_.isDone))
    if isDone then
      sequence.skip(name)
      ExitCode.Done
    else
      for k <- keeping; film <- k.start if !options.quiet do
        terminal.err.println(Summary.continues(film))
      val about = metadata(name, loaded, digest)
      render(name, loaded, paths, keeping, about)

  private def render(
      scene: String,
      loaded: LoadedScene,
      paths: Vector[Path],
      keeping: Option[FilmKeeping],
      about: Vector[(String, String)]
  ): ExitCode =
    val reporting = Option.when(options.reports.nonEmpty)(Reporting(options, scene, loaded))
    val goal = Option.when(settings.goal.isGiven):
      def recorder = RenderRecorder.of(loaded.plan, None)
      Goal(settings.goal, loaded.plan.samplesPerPixel, reporting.fold(recorder)(_.recorder))
    val reference = options.reference.filter(_ => settings.output.denoise)
      .map(RenderRecorder.fitting(loaded.plan, _))
    terminal.interrupts.during(cancellation):
      val progress = ProgressLine(terminal.err, terminal.isInteractive)
      val show: Progress => Unit = if options.quiet then _ => () else progress.update
      val checkpointer = keeping.map(_.checkpointer(() => goal.exists(_.isEnough)))
      val watching = Option.when(options.isWatched)(watched(scene, loaded, paths, about))
      var current = Option.empty[Live]
      def writePartly() = current.foreach: live =>
        val rendering = live.rendering
        write(paths, loaded, rendering, finished(loaded, rendering), about): Unit
      val observer = goal.orElse(reporting.map(_.recorder))
      val logged = ErrorLog.of(loaded.plan, observer).orElse(observer)
      val passObserver =
        if options.partialImages then Some(PartialImages(() => writePartly(), logged)) else logged
      try
        val rendering =
          try
            Renderer.render(
              loaded.plan,
              threads,
              cancellation,
              show,
              passObserver,
              options.film.shard,
              checkpointer,
              live =>
                current = Some(live)
                watching.foreach(_.start(live))
            )
          finally progress.finish()
        if !rendering.isComplete then terminal.interrupts.checkTime()
        watching.foreach(_.end(rendering))
        val started = System.nanoTime
        val facts = about.filter((name, _) => name != Sequence.Digest || rendering.isComplete)
        val image = finished(loaded, rendering)
        val finishedAt = System.nanoTime
        val denoised = Option.when(settings.output.denoise):
          Denoised(image, rendering.seconds, (finishedAt - started) * 1e-9)
        val wanted = writable(paths, rendering)
        val written = write(wanted, loaded, rendering, image, facts)
        val writeSeconds = (System.nanoTime - finishedAt) * 1e-9
        val films =
          keeping.map(_.path).filter(_ => paths.isEmpty && checkpointer.forall(_.failure.isEmpty))
        if wanted.size < paths.size && !options.quiet then
          terminal.err.println(Summary.kept(paths.diff(wanted), isLate))
        summarise(written ++ films, loaded, rendering, writeSeconds)
        // A preview has neither goals nor options of its own to reach them
        if !settings.preview then goal.flatMap(_.missed(rendering)).foreach(terminal.err.println)
        val pages = reporting.toVector.flatMap(_.write(rendering, threads, writeSeconds, denoised))
        for path <- pages if !options.quiet do terminal.out.println(s"wrote $path")
        terminal.out.flush()
        for r <- reference; d <- denoised if !options.quiet do
          terminal.out.println(s"relative MSE  ${d.errors(r)}")
        for kind <- options.thumbnail do
          val shown = Denoising.shown(image)
          terminal.out.control(Thumbnail.of(shown, settings.output.display, kind, terminal))
        terminal.out.flush()
        watching.foreach(_.await(written ++ films ++ pages))
        if written.size < wanted.size || checkpointer.exists(_.failure.nonEmpty) then
          ExitCode.BadInput
        else if !rendering.isComplete then ExitCode.Interrupted
        else ExitCode.Done
      finally watching.foreach(_.close())

  private def watched(
      scene: String,
      loaded: LoadedScene,
      paths: Vector[Path],
      about: Vector[(String, String)]
  ): Watching =
    val reference = options.reference.map(RenderRecorder.fitting(loaded.plan, _))
    def save(rendering: Rendering) =
      val wanted = writable(paths, rendering)
      if wanted.isEmpty then "nothing: the new image has less than 1 sample per pixel"
      else
        write(wanted, loaded, rendering, finished(loaded, rendering), about).mkString(", ")
    Watching(options, scene, loaded.plan, reference, cancellation, terminal, save)

  /** Writes the image of a rendering that was put together from film files. */
  private[cli] def finish(
      scene: String,
      loaded: LoadedScene,
      paths: Vector[Path],
      rendering: Rendering,
      digest: Option[String] = None
  ): ExitCode =
    val image = finished(loaded, rendering)
    val facts = metadata(scene, loaded, digest.filter(_ => rendering.isComplete))
    val written = write(paths, loaded, rendering, image, facts)
    summarise(written, loaded, rendering, 0)
    if written.size < paths.size then ExitCode.BadInput else ExitCode.Done

  /** The image, denoised too if asked. */
  private def finished(loaded: LoadedScene, rendering: Rendering): Image =
    val noisy = rendering.image(loaded.plan.development)
    denoising.fold(noisy)(_(noisy))

  /** An image without samples must not replace another one. */
  private def writable(paths: Vector[Path], rendering: Rendering): Vector[Path] =
    if rendering.samplesDone > 0 || rendering.isComplete then paths
    else paths.filterNot(Files.isRegularFile(_))

  /** Writes every file that can be written; returns those written. Viewers may ask for it, too. */
  private def write(
      paths: Vector[Path],
      loaded: LoadedScene,
      rendering: Rendering,
      image: Image,
      facts: Vector[(String, String)]
  ): Vector[Path] = synchronized:
    val development = loaded.plan.development
    val alpha = OutputFiles.alpha(loaded.plan, image)
    val time = Option.when(settings.output.storeTime):
      "renderSeconds" -> Figures.fixed(rendering.seconds, 2)
    // Those of earlier runs took no part of the time
    val earlier = Option.when(settings.output.storeTime && rendering.earlier > 0):
      "samplesPerPixelOfEarlierRuns" -> rendering.earlier.toString
    val samples = "samplesPerPixel" -> rendering.samplesDone.toString
    val about = facts ++ Vector(samples) ++ time ++ earlier ++
      Bias.metadata(loaded.plan, rendering, denoising)
    val how = WriteOptions(
      development.isHalf,
      precisions(loaded.plan),
      settings.output.display,
      window(loaded.plan),
      alpha
    )
    def write(path: Path) = Try:
      val (written, more) = OutputFiles.picture(path, image, alpha) match
        case Some(picture) => (picture, settings.output.display.describe(picture))
        case None => (image, loaded.plan.layers.fold(Vector.empty)(_.metadata(image)))
      ImageFiles.write(path, written, about ++ more, how)
    // Those that can't hold the digest first: what is done is told by the others
    val order = paths.sortBy(Sequence.keepsDigest)
    val attempts = order.map(path => path -> write(path)).sortBy((path, _) => paths.indexOf(path))
    val failures = attempts.collect:
      case (_, Failure(e: ImageError)) => Problem.general(e.getMessage)
      case (_, Failure(e)) => throw e
    if failures.nonEmpty then
      val _ = report.errors(failures)
    attempts.collect { case (path, Success(_)) => path }

  /** Channels whose layers have another precision than the image: whether it is half. */
  private def precisions(plan: RenderPlan): Map[String, Boolean] =
    val all =
      for
        layers <- plan.layers.toVector
        own = layers.layers.filter(_.needsFloat).map(_ -> false)
        (layer, isHalf) <- own ++ settings.output.precisions
        channel <- layers.channels(layer)
      yield channel -> isHalf
    all.toMap

  private def isCropped(plan: RenderPlan): Boolean =
    plan.crop != PixelBounds(0, 0, plan.width, plan.height)

  private def window(plan: RenderPlan): Option[ImageWindow] = Option.when(isCropped(plan)):
    ImageWindow(plan.crop.x0, plan.crop.y0, plan.width, plan.height)

  /** The digest of the rendering, if what is done is to be skipped. */
  private[cli] def digest(
      scene: String,
      loaded: LoadedScene,
      paths: Vector[Path]
  ): Option[String] =
    Option.when(options.film.skipDone):
      FilmHeaders.digest(
        FilmHeaders.of(options, scene, loaded, Path.of("film"), paths),
        settings.goal
      )

  private def metadata(
      scene: String,
      loaded: LoadedScene,
      digest: Option[String]
  ): Vector[(String, String)] =
    val plan = loaded.plan
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val crop = Option.when(isCropped(plan)):
      "crop" -> s"x $x0 to $x1, y $y0 to $y1 of ${plan.width}x${plan.height}"
    Vector(
      "software" -> s"Candela ${Version.current}",
      "scene" -> scene,
      "dialect" -> loaded.description.dialect.toString.toLowerCase,
      "seed" -> settings.seed.toString
    ) ++ plan.features.filter(_._1 == "integrator") ++ crop ++
      plan.development.bands.fold(Vector.empty)(_ => SpectralBands.metadata) ++
      digest.map(Sequence.Digest -> _)

  /** Whether a rendering without samples ended by its time, and not by its user. */
  private def isLate: Boolean = settings.goal.time.isDefined && !cancellation.isRequested

  private def summarise(
      written: Vector[Path],
      loaded: LoadedScene,
      rendering: Rendering,
      writeSeconds: Double
  ): Unit =
    for r <- rendering.refused do
      terminal.err.println(Summary.refused(r, isTraceable = !settings.preview))
    if !options.quiet && written.nonEmpty then
      if options.verbose then
        terminal.err.println(Summary.phases(loaded, rendering, writeSeconds))
        rendering.learned.foreach(o => terminal.err.println(Learning.summary(o)))
      terminal.out.println(Summary.result(written, rendering, loaded.standIns, isLate))
      terminal.out.flush()

/** Prints the features of a plan, one line each: the choices that the builder made. */
object Explanation:
  def print(plan: RenderPlan, to: Printer): Unit =
    val width = plan.features.map(_._1.length).maxOption.getOrElse(0)
    for (what, value) <- plan.features do to.println(s"  ${what.padTo(width, ' ')}  $value")

/** `candela render --pixel x,y --sample n --debug`: traces one sample and logs its path. */
private[cli] object PixelTrace:
  def run(plan: RenderPlan, options: Options, out: Printer): ExitCode =
    val (x, y) = options.settings.region match
      case RenderRegion.Pixel(x, y) => (x, y)
      case _ => (0, 0)
    val crop = plan.crop
    if x < crop.x0 || x >= crop.x1 || y < crop.y0 || y >= crop.y1 then
      val size = s"x in [${crop.x0}, ${crop.x1}), y in [${crop.y0}, ${crop.y1})"
      throw SceneError(Problem.general(s"--pixel $x,$y is outside the image: $size"))
    out.println(s"pixel ($x, $y), sample ${options.sample}")
    Renderer.trace(plan, x, y, options.sample, PathReport(out.println)) match
      case Some(light) => out.println(s"contributes $light")
      case None => out.println("discarded: NaN or infinite")
    out.flush()
    ExitCode.Done
