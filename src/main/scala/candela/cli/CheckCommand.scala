package candela.cli

/** `candela check`: parses and builds scenes, says what they hold and what is wrong with them. */
final class CheckCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):

  def run(): ExitCode =
    options.files.map(scene => report.guarded(check(scene))).reduce(_ worseOf _)

  private def check(scene: String): ExitCode =
    val loaded = loader.load(scene, options)
    report.warnings(loaded.warnings, all = true)
    if !options.quiet then
      terminal.out.println(s"$scene: ${contents(loaded)}")
      if options.explain || options.verbose then Explanation.print(loaded.plan, terminal.out)
      terminal.out.flush()
    ExitCode.Done

  private def contents(loaded: LoadedScene): String =
    val d = loaded.description
    val crop = loaded.plan.crop
    val shapes = d.shapes.size + d.objects.values.map(_.size).sum
    val lights = d.lights.size + d.shapes.count(_.areaLight.nonEmpty)
    val counted = Vector(
      shapes -> "shape",
      d.instances.size -> "instance",
      lights -> "light",
      d.textures.size -> "texture",
      loaded.warnings.distinct.size -> "warning"
    ).collect { case (n, noun) if n > 0 => Figures.count(n, noun) }
    val film = s"${crop.width}x${crop.height}, ${loaded.plan.sampler.samplesPerPixel} spp"
    (Vector(d.dialect.toString.toLowerCase, film) ++ counted).mkString(", ")
