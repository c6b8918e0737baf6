package candela.cli.options

import candela.diagnostics.{Code, Problem, Suggest}
import candela.io.{CacheFolder, PartFiles}
import scopt.{DefaultOParserSetup, OEffect, OParser, OParserSetup}

import candela.aov.Layer
import candela.cli.terminal.{ExitCode, ProblemText, Terminal, ThumbnailKind}
import candela.convert.Baking
import candela.image.DisplayTransform
import candela.scenefile.Dialect
import candela.settings.{BuildControl, RenderRegion, RenderSettings}
import candela.watch.WatchAddress

import java.nio.file.{Files, Path}

/** Parses a command line to [[Options]], or to the text to print instead. */
object CommandLine:

  /** What to print instead of running a command: lines that were asked for, or errors. */
  final case class Answer(lines: Vector[String], problems: Vector[Problem] = Vector.empty):
    def code: ExitCode = if problems.isEmpty then ExitCode.Done else ExitCode.BadUsage
    def out: String = lines.map(_ + "\n").mkString
    def err: String = problems.map(ProblemText.format(_) + "\n").mkString

  /** @param columns width of the help, in characters */
  def parse(args: Seq[String], columns: Int = Terminal.UsualColumns): Either[Answer, Options] =
    unreadable(args).orElse(missing(args)).orElse(information(args, HelpText(columns))) match
      case Some(answer) => Left(answer)
      case None =>
        translated(args) match
          case Left(instead) =>
            Left(refusal(Vector(UsageError(Code.UnknownOption, instead)), Command.Render))
          case Right(words, notes) => parseOurs(words).map: o =>
              o.copy(notes = notes ++ IdleOptions.of(o))

  /** Of bytes that are no UTF-8, Java makes one character: two files would have one name. */
  private def unreadable(args: Seq[String]): Option[Answer] =
    for word <- args.find(_.contains('\uFFFD')) yield
      val message = s"`$word` is not UTF-8, so its file can't be told from others"
      val help = Some("rename the file, or set LC_ALL=C.UTF-8 where the locale is another")
      Answer(Vector.empty, Vector(Problem.general(Code.NoSuchFile, message, help)))

  /** The cure, if a module that is not installed has the command. */
  private def missing(args: Seq[String]): Option[Answer] =
    val word = if args.headOption.contains("help") then args.lift(1) else args.headOption
    for
      command <- word.flatMap(commandOf) if CommandService.isMissing(command)
      module <- command.module
    yield
      val message = s"`candela ${command.word}` needs the module $module"
      val cure = s"put $module.jar beside candela.jar, into the program's folder lib; releases " +
        "have it there, and `./sbt stage` makes it"
      Answer(Vector.empty, Vector(Problem.general(Code.UnknownCommand, message, Some(cure))))

  /** What needs no options: help, the version, and a word that is nearly a command. */
  private def information(args: Seq[String], help: HelpText): Option[Answer] =
    def helpAnswer(command: Option[Command]) = Answer(command.fold(help.overview)(help.of))
    val first = args.headOption.getOrElse("")
    val named = commandOf(first)
    def mistyped(word: String) =
      val commandWords = Command.values.map(_.word) ++ Vector("help", "version")
      val nearest = Synonyms.get(word).orElse(Suggest.nearest(word, commandWords))
      nearest.map(n => noCommand(s"`$word` is not a command; did you mean `$n`?"))
    if args.exists(HelpWords) then Some(helpAnswer(named))
    else if args.exists(VersionWords) || (first == "version" && args.size == 1) then
      Some(Answer(VersionText.lines()))
    else if first == "help" then
      args.lift(1) match
        case None => Some(helpAnswer(None))
        case Some(word) =>
          commandOf(word).map(c => helpAnswer(Some(c))).orElse(mistyped(word)).orElse:
            Some(noCommand(s"`$word` is not a command"))
    else if named.isEmpty && isWord(first) then mistyped(first)
    else None

  private def commandOf(word: String): Option[Command] = Command.values.find(_.word == word)

  /** Whether a word is neither an option nor a file. */
  private def isWord(word: String): Boolean =
    word.nonEmpty && word.forall(c => c >= 'a' && c <= 'z') && !Files.exists(Path.of(word))

  /** Commands by the words that other programs have for them. */
  private val Synonyms = Map(
    "diff" -> "compare",
    "difference" -> "compare",
    "validate" -> "check",
    "lint" -> "check",
    "continue" -> "resume",
    "combine" -> "merge",
    "join" -> "merge",
    "show" -> "view",
    "display" -> "view",
    "open" -> "view",
    "benchmark" -> "bench",
    "tonemap" -> "image",
    "documentation" -> "describe"
  )

  private val HelpWords = Set("--help", "-help", "-h", "-?")
  private val VersionWords = Set("--version", "-version", "-V")

  /** Errors, and where to read more. */
  private def usage(errors: Vector[UsageError], more: String): Answer =
    val problems = errors.map(e => Problem.general(e.code, e.message))
    Answer(Vector.empty, problems.init :+ problems.last.withHelp(Some(s"`$more` says more")))

  private def noCommand(message: String): Answer =
    usage(Vector(UsageError(Code.UnknownCommand, message)), "candela help")

  private def refusal(errors: Vector[UsageError], command: Command): Answer =
    usage(errors, s"candela help ${command.word}")

  /** Translates pbrt's words for rendering; other commands have options of their own. */
  private def translated(args: Seq[String]): Either[String, (Seq[String], Vector[String])] =
    val commands = Command.values.map(_.word)
    val isOther = args.headOption.exists(w => commands.contains(w) && w != Command.Render.word)
    if isOther then Right((args, Vector.empty))
    else
      val isNamed = args.headOption.contains(Command.Render.word)
      PbrtOptions.translate(if isNamed then args.tail else args).map: found =>
        val words =
          if isNamed && found.command.isEmpty then Command.Render.word +: found.words
          else found.command.toSeq ++ found.words
        (words, found.notes)

  private def parseOurs(args: Seq[String]): Either[Answer, Options] =
    val arguments = withCommand(args)
    val command = commandOf(arguments.head).getOrElse(Command.Render)
    val words = FilmOptions.withValues(joined(arguments))
    words.find(isTooLong) match
      case Some(word) =>
        val message = s"no option begins with `${word.take(MaxShownCharacters)}`"
        Left(refusal(Vector(UsageError(Code.UnknownOption, message)), command))
      case None =>
        val parser = CommandTable.parser(command)
        val (options, effects) = OParser.runParser(parser, words, Options(), setup)
        val errors = effects.collect:
          case OEffect.ReportError(text) => text
        def refused(texts: Vector[String]) =
          refusal(UsageErrors.explained(texts, command), command)
        options.toRight(refused(errors.toVector)).flatMap: read =>
          CommandTable.problem(read).orElse(CommandTable.problem(words))
            .map(text => refused(Vector(text))).toLeft(read)

  /** Whether it is a word whose parts scopt would all take for short options: their size is that of
    * the word, squared.
    */
  private def isTooLong(word: String): Boolean =
    word.length > LongestWord && word.startsWith("-") && !word.startsWith("--")

  private val LongestWord = 1000
  private val MaxShownCharacters = 20

  private val setup: OParserSetup = new DefaultOParserSetup:
    override def showUsageOnError: Option[Boolean] = Some(false)

  /** Inserts the default command, `render`, if none is named. */
  private def withCommand(args: Seq[String]): Seq[String] =
    if args.headOption.flatMap(commandOf).isDefined then args else Command.Render.word +: args

  /** Options whose value may be missing are joined with it: what follows may be a scene. */
  private def joined(args: Seq[String]): Seq[String] =
    args.foldRight(List.empty[String]):
      case ("--watch", value :: rest) if WatchAddresses.isOne(value) => s"--watch=$value" :: rest
      case ("--watch", rest) => "--watch=" :: rest
      case ("--scene-cache", value :: rest) if TextureTable.isFolder(value) =>
        s"--scene-cache=$value" :: rest
      case ("--scene-cache", rest) => "--scene-cache=" :: rest
      case ("--bake", size :: rest) if size.toIntOption.nonEmpty => s"--bake=$size" :: rest
      case ("--bake", rest) => s"--bake=${Baking.DefaultSize}" :: rest
      // As Mitsuba's command line has it; scopt would split the word into short options
      case (s"-D$definition", rest) if definition.contains('=') => "--define" :: definition :: rest
      case (word, rest) => word :: rest

/** @param module that brings the command, if it is not one of the program itself */
enum Command(val word: String, val module: Option[String] = None):
  case Render extends Command("render")
  case Resume extends Command("resume")
  case Merge extends Command("merge")
  case Check extends Command("check")
  case Compare extends Command("compare")
  case Reference extends Command("reference")
  case Bench extends Command("bench", Some("candela-bench"))
  case Robustness extends Command("robustness", Some("candela-bench"))
  case Describe extends Command("describe")
  case Convert extends Command("convert")
  case View extends Command("view")
  case Preview extends Command("preview")
  case Move extends Command("move")
  case Image extends Command("image")
  case Average extends Command("average")
  case Info extends Command("info")
  case Explain extends Command("explain")
  case Completion extends Command("completion")
  case Session extends Command("session")

/** Whole pages that `describe` prints, by the options that ask for them. */
enum Page(val option: String):
  case Reference extends Page("markdown")
  case PbrtOptions extends Page("pbrt-options")
  case Commands extends Page("commands")
  case Manual extends Page("man")
  case Problems extends Page("problems")

/** A parsed command line; None if an option was not given.
  *
  * @param files scenes; for `resume` and `merge`, film files; for `compare`, the image and its
  *   reference; for `describe`, category and type
  * @param outfiles output images, instead of the file named by the scene
  * @param settings what is rendered of the scenes
  * @param control how they are read and built
  * @param sample the sample of the pixel that `debug` traces, instead of rendering
  * @param pixelMaterial pixel whose material is printed, instead of rendering
  * @param partialImages whether to write the image of each pass
  * @param notes on words of the command line that have no effect
  * @param pages what `describe` prints instead of an entry
  * @param to target dialect of `convert`
  * @param toPly minimum number of triangles for writing a mesh as a PLY file
  * @param bake  width and height of images that replace textures, in pixels
  * @param thumbnail how to show the image in the terminal
  * @param columns pictures per row of a contact sheet
  * @param film options of saved renderings
  * @param cluster options of rendering on a cluster
  * @param reference reference image for reports
  * @param reports report files
  * @param watch address of the live page
  * @param displayServer host and port of an image viewer
  * @param watchAfter whether the page stays when rendering has ended
  * @param compare options of `compare`
  * @param image options of `image` and `average`
  * @param keepsScenes whether prepared scenes are cached
  * @param sceneFolder of these, if not that of the texture cache
  * @param module options of a command that another module brings
  */
final case class Options(
    command: Command = Command.Render,
    files: Vector[String] = Vector.empty,
    outfiles: Vector[String] = Vector.empty,
    settings: RenderSettings = RenderSettings(),
    control: BuildControl = BuildControl(threads = Runtime.getRuntime.availableProcessors),
    quiet: Boolean = false,
    verbose: Boolean = false,
    explain: Boolean = false,
    pixelMaterial: Option[(Int, Int)] = None,
    partialImages: Boolean = false,
    notes: Vector[String] = Vector.empty,
    sample: Int = 0,
    debug: Boolean = false,
    thumbnail: Option[ThumbnailKind] = None,
    columns: Option[Int] = None,
    film: FilmOptions = FilmOptions(),
    cluster: ClusterOptions = ClusterOptions(),
    reference: Option[String] = None,
    reports: Vector[String] = Vector.empty,
    watch: Option[WatchAddress] = None,
    watchAfter: Boolean = false,
    displayServer: Option[(String, Int)] = None,
    compare: CompareOptions = CompareOptions(),
    image: ImageOptions = ImageOptions(),
    pages: Vector[Page] = Vector.empty,
    to: Option[Dialect] = None,
    toPly: Option[Int] = None,
    bake: Option[Int] = None,
    keepsScenes: Boolean = false,
    sceneFolder: Option[Path] = None,
    module: Option[ModuleOptions] = None
):
  /** Where prepared scenes are kept, if they are to be. */
  def sceneCache: Option[PartFiles] = Option.when(keepsScenes):
    sceneFolder.orElse(control.textures.cache).map: folder =>
      PartFiles(CacheFolder(folder, control.textures.folderSize))
  .flatten

  def setting(change: RenderSettings => RenderSettings): Options = copy(settings = change(settings))

  def controlling(change: BuildControl => BuildControl): Options = copy(control = change(control))

  /** The same with other values of `$NAME`. */
  def defining(change: Map[String, String] => Map[String, String]): Options =
    setting(s => s.copy(reading = s.reading.copy(defines = change(s.reading.defines))))

  /** What is rendered, with what is looked at. */
  def sceneSettings: RenderSettings =
    // A traced pixel is one of the whole image
    val region = if debug then RenderRegion.Whole else settings.region
    val extraLayers = if pixelMaterial.isEmpty then Vector.empty else Layer.cryptomatte
    settings.copy(region = region, layers = (settings.layers ++ extraLayers).distinct)

  /** How the command reads and builds its scenes. */
  def building: BuildControl = control.copy(
    isRendered = command != Command.Check,
    world = Option.when(command == Command.Render)(0)
  )

  /** How pictures show linear light: those of renderings, and of images that are there. */
  def display: DisplayTransform = settings.output.display

  /** Whether anything follows the rendering. */
  def isWatched: Boolean = watch.isDefined || displayServer.isDefined
