package candela.cli.options

import candela.diagnostics.Code
import candela.guiding.GuidingMode
import candela.settings.{RenderRegion, RenderSettings, SettingsTable}

import scopt.{OParser, OptionDef}

/** What a command is for, and its arguments.
  *
  * @param arguments what follows its name, except options
  * @param takes     what the arguments are, for shells
  * @param table     its options
  * @param more      what pages add to the meaning, in Markdown whose links start at `docs`
  */
private[candela] final case class CommandRow(
    command: Command,
    meaning: String,
    arguments: Vector[OParser[?, Options]],
    takes: Words,
    table: Vector[OParser[?, Options]],
    more: String = ""
):
  /** As in `candela view [options] image...`. */
  def usage: String =
    val suffix = if table.isEmpty then "" else " [options]"
    (s"candela ${command.word}$suffix" +: files).mkString(" ")

  /** Names of the arguments. */
  def files: Vector[String] = arguments.flatMap(_.toList).map(_.name)

  /** The meaning for pages, in Markdown. */
  def page: String =
    val module =
      command.module.map(name => s"\nit belongs to the module [`$name`](INSTALL.md#benchmarks)")
    OptionText.sentences(OptionText(meaning, more) + module.getOrElse(""))

  def options: Vector[OptionDef[?, Options]] = table.flatMap(_.toList)

  /** Long option names, without dashes. */
  def names: Vector[String] = options.map(_.name)

  /** The option of this name. */
  def option(name: String): Option[OptionDef[?, Options]] =
    options.find(_.name == name)

/** All commands: those of the program, and those of modules that are installed. */
private[cli] object CommandTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{cmd, programName}

  private def files(name: String, text: String): Row = file(name, text).unbounded()

  private def scenes: Row =
    files("scene.pbrt...", "scene files; each is rendered or checked by itself")

  private val ofProgram: Vector[CommandRow] = Vector(
    CommandRow(
      Command.Render,
      "render scenes (the default command)",
      Vector(scenes),
      Words.scenes,
      OptionTable.render,
      "It writes one image per scene, or as many as `--frames` asks for: see [output " +
        "files](#output-files)."
    ),
    CommandRow(
      Command.Preview,
      "show scenes within seconds: small, shaded by a headlight",
      Vector(files("scene.pbrt...", "scene files")),
      Words.scenes,
      OptionTable.preview,
      "For a first look: it shows any scene within about two seconds of reading it, with few " +
        "pixels and headlight shading, which has no noise. Missing files become placeholders. " +
        "For a draft with the scene's own light use `render --quick`, or few samples with " +
        "`--denoise`."
    ),
    CommandRow(
      Command.Move,
      "move the camera of a scene on a page in the browser",
      Vector(file("scene.pbrt", "the scene")),
      Words.scenes,
      OptionTable.move,
      "The page shows each view at once, and the camera as text; it writes a file for " +
        "`--camera`: [moving the camera](WATCHING.md#moving-the-camera)."
    ),
    CommandRow(
      Command.Check,
      "parse and build scenes, and report errors",
      Vector(scenes),
      Words.scenes,
      OptionTable.check,
      "It lists unsupported features without rendering. With several scenes the last line has " +
        "the number of accepted ones."
    ),
    CommandRow(
      Command.Convert,
      "convert a scene to another dialect",
      Vector(file("scene.pbrt", "the scene to convert")),
      Words.scenes,
      OptionTable.convert,
      "[Converting scenes](CONVERTING.md) has the mapping of every type and " + "parameter."
    ),
    CommandRow(
      Command.Describe,
      "print the scene reference: types, parameters, defaults",
      Vector(file("[category] [type]", "what to describe").optional().unbounded()),
      Words.Categories,
      OptionTable.describe,
      "[The reference](REFERENCE.md) has all entries on one page."
    ),
    CommandRow(
      Command.Resume,
      "continue a saved rendering, or add samples",
      Vector(file("film.film", "the film file, as --checkpoint or --outfile FILE.film wrote it")),
      Words.films,
      OptionTable.resume,
      "[Film files](FILMS.md)."
    ),
    CommandRow(
      Command.Merge,
      "make an image of shards, or of a saved rendering",
      Vector(files("film.film...", "film files of all shards of a rendering")),
      Words.films,
      OptionTable.merge,
      "[Several machines](FILMS.md#several-machines)."
    ),
    CommandRow(
      Command.View,
      "show images, or write them as a picture; several: a contact sheet",
      Vector(files("image...", "images in any readable format")),
      Words.images,
      OptionTable.view,
      "[Pictures](PICTURES.md)."
    ),
    CommandRow(
      Command.Info,
      "print size, channels, metadata and statistics of images",
      Vector(files("image...", "images in any readable format; film files, too")),
      Words.images,
      Vector.empty
    ),
    CommandRow(
      Command.Compare,
      "measure the error of an image against a reference",
      Vector(
        file("image", "an image, or a folder of images"),
        file(
          "reference",
          "its reference, or a folder of references by the same names; with " +
            "--bias, another program's images of the scene"
        )
      ),
      Words.images,
      CompareTable.options,
      "[Definitions of the metrics](METRICS.md)."
    ),
    CommandRow(
      Command.Reference,
      "render a reference, with its own error, by independent runs",
      Vector(file("scene.pbrt", "the scene")),
      Words.scenes,
      OptionTable.reference,
      "[References](NOISE.md#references)."
    ),
    CommandRow(
      Command.Image,
      "convert an image: format, size, range, primaries, environment map",
      Vector(file("image", "an image in any readable format")),
      Words.images,
      OptionTable.image
    ),
    CommandRow(
      Command.Average,
      "average images of one size, such as renderings with several seeds",
      Vector(files("image...", "images with the same channels")),
      Words.images,
      OptionTable.average
    ),
    CommandRow(
      Command.Explain,
      "explain a problem: what it means, an example, the cure",
      Vector(file("[E0123]...", "numbers of problems, which end messages (default: all)")
        .optional().unbounded()),
      Words.Of(Code.values.toVector.map(_.word)),
      Vector.empty,
      "[All problems](PROBLEMS.md)."
    ),
    CommandRow(
      Command.Completion,
      "print the completion of command lines for a shell",
      Vector(file(Words.shells.mkString("|"), "the shell")),
      Words.Of(Words.shells),
      Vector.empty,
      Completion.Install
    ),
    CommandRow(
      Command.Session,
      "run the command lines that a program sends, in a process that stays",
      Vector.empty,
      Words.Anything,
      Vector.empty,
      "[Other programs](PYTHON.md#other-programs) describes requests and answers."
    )
  )

  lazy val rows: Vector[CommandRow] = ofProgram ++ CommandService.installed.map(_.row)

  def of(command: Command): CommandRow =
    ofProgram.find(_.command == command).getOrElse(CommandService.of(command).row)

  /** For scopt: a command line of this command. */
  def parser(command: Command): Row =
    val row = of(command)
    OParser.sequence(
      programName("candela"),
      cmd(command.word)
        .action((_, o) => o.copy(command = command))
        .children((row.arguments ++ row.table)*)
    )

  /** What is wrong with options that belong together, if anything. It holds for options that could
    * all be read: one that could not would seem to be missing.
    */
  def problem(o: Options): Option[String] =
    val isRender = o.command == Command.Render
    val isSeveral = o.files.size > 1
    def needsSingle(option: String, isGiven: Boolean) =
      Option.when(isGiven && isSeveral)(s"--$option needs a single scene, found several")
    def needed(text: String, isMissing: Boolean) = Option.when(isMissing)(text)
    val rendered = Set(Command.Render, Command.Preview)(o.command)
    needsSingle("outfile", rendered && o.outfiles.nonEmpty)
      .orElse(rendering(o))
      .orElse(needsSingle("report", isRender && o.reports.nonEmpty))
      .orElse(needed("--columns needs several images", o.columns.isDefined && !isSeveral))
      .orElse(if isRender then FilmTable.problem(o).orElse(ClusterTable.problem(o)) else None)
      .orElse(needed(
        "--reference needs --report FILE, --watch or --denoise",
        isRender && o.reference.nonEmpty && o.reports.isEmpty && o.watch.isEmpty &&
          !o.settings.output.denoise
      ))
      .orElse(needsSingle(if o.watch.isDefined then "watch" else "display-server", o.isWatched))
      .orElse(needed("--watch-after needs --watch", o.watchAfter && o.watch.isEmpty))
      .orElse(CompareTable.problem(o))
      .orElse(ReferenceTable.problem(o))

  /** Was it asked for? A goal that chooses it can't be divided itself, and is refused as such. */
  private def guides(s: RenderSettings): Boolean = s.guiding.exists(_ != GuidingMode.Off)

  private def rendering(o: Options): Option[String] =
    val s = o.settings
    val isPixel = s.region match
      case RenderRegion.Pixel(_, _) => true
      case _ => false
    if s.output.reference.isDefined != s.output.errors.isDefined then
      Some("--mse-reference-image and --mse-reference-out must be given together")
    else if s.output.errors.isDefined && o.files.size > 1 then
      Some("--mse-reference-out needs a single scene, found several")
    else if guides(s) && !o.film.shard.isWhole then
      Some("--guiding can't be divided by --shard: paths learn from those of all samples")
    else if guides(s) && o.cluster.master.isDefined then
      Some("--guiding can't be divided by --spark: paths learn from those of all samples")
    else if o.debug && !isPixel then Some("--debug needs --pixel x,y")
    else None

  /** What is wrong with the words of a command line, of which one may name a part of the image. */
  def problem(words: Seq[String]): Option[String] =
    val regions = words.map(_.takeWhile(c => c != '=' && c != ':')).filter(Regions)
    val assigned = words.find(word => word.contains('=') && Flags(word.takeWhile(_ != '=')))
    Option.when(regions.size > 1):
      "only one of --cropwindow, --pixelbounds and --pixel can be given"
    .orElse(assigned.map: word =>
      val (flag, value) = word.splitAt(word.indexOf('='))
      s"$flag takes no value, found `${value.drop(1)}`")

  private val Flags = SettingsTable.all.filterNot(_.takesValue).map("--" + _.name).toSet
  private val Regions = Set("--cropwindow", "--pixelbounds", "--pixel")
