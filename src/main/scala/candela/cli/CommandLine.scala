package candela.cli

import scopt.{DefaultOParserSetup, OEffect, OParser, OParserSetup}

import candela.base.Suggest
import candela.build.{ColorMode, LightGrouping}
import candela.build.recipe.Switches
import candela.build.sampling.PointChoice
import candela.convert.Baking
import candela.film.{Fireflies, Layer}
import candela.image.DisplayTransform
import candela.scenefile.Dialect
import candela.watch.WatchAddress

/** Parses a command line to [[Options]], or to the text to print instead. */
object CommandLine:

  /** Text to print instead of running a command. */
  final case class Answer(out: String, err: String, code: ExitCode)

  def parse(args: Seq[String]): Either[Answer, Options] =
    translated(args) match
      case Left(instead) => Left(Answer("", s"error: $instead\n", ExitCode.BadUsage))
      case Right(words, notes) => parseOurs(words).map(o => progressive(o).copy(notes = notes))

  /** Where the number of samples is not known in advance, points must not depend on it. */
  private def progressive(o: Options): Options =
    if o.film.endsEarly && o.points == PointChoice.Best && o.command == Command.Render then
      o.copy(points = PointChoice.Progressive)
    else o

  /** Translates pbrt's words for rendering; other commands have options of their own. */
  private def translated(args: Seq[String]): Either[String, (Seq[String], Vector[String])] =
    val own = Command.values.map(_.word)
    val isOther = args.headOption.exists(w => own.contains(w) && w != Command.Render.word)
    if isOther then Right((args, Vector.empty))
    else
      val isNamed = args.headOption.contains(Command.Render.word)
      PbrtOptions.translate(if isNamed then args.tail else args).map: found =>
        val words =
          if isNamed && found.command.isEmpty then Command.Render.word +: found.words
          else found.command.toSeq ++ found.words
        (words, found.notes)

  private def parseOurs(args: Seq[String]): Either[Answer, Options] =
    val (options, effects) =
      val words = FilmOptions.withValues(joined(withCommand(args)))
      OParser.runParser(OptionTable.table, words, Options(), setup)
    val out = effects.collect { case OEffect.DisplayToOut(text) => text }
    val errors = effects.collect:
      case OEffect.ReportError(text) => s"error: ${explained(text, args)}"
      case OEffect.ReportWarning(text) => s"warning: $text"
      case OEffect.DisplayToErr(text) => text
    val asked = effects.exists:
      case OEffect.Terminate(state) => state.isRight
      case _ => false
    options match
      case Some(understood) if !asked => Right(understood)
      // A request for help overrides other errors.
      case _ if asked => Left(Answer(lines(out), "", ExitCode.Done))
      case _ => Left(Answer(lines(out), lines(errors), ExitCode.BadUsage))

  private val setup: OParserSetup = new DefaultOParserSetup {}

  /** Inserts the default command, `render`, if none is named. */
  private def withCommand(args: Seq[String]): Seq[String] =
    val words = Command.values.map(_.word) ++ Seq("--help", "--version")
    if args.headOption.exists(words.contains) then args else Command.Render.word +: args

  /** Options whose value may be missing are joined with it: what follows may be a scene. */
  private def joined(args: Seq[String]): Seq[String] =
    args.foldRight(List.empty[String]):
      case ("--watch", value :: rest) if WatchAddresses.isOne(value) => s"--watch=$value" :: rest
      case ("--watch", rest) => "--watch=" :: rest
      case ("--bake", size :: rest) if size.toIntOption.nonEmpty => s"--bake=$size" :: rest
      case ("--bake", rest) => s"--bake=${Baking.DefaultSize}" :: rest
      // As Mitsuba's command line has it; scopt would split the word into short options
      case (s"-D$definition", rest) if definition.contains('=') => "--define" :: definition :: rest
      case (word, rest) => word :: rest

  private def lines(texts: List[String]): String = texts.map(_ + "\n").mkString

  /** Suggests the command's nearest option for an unknown one. */
  private def explained(error: String, args: Seq[String]): String = error match
    case s"Unknown option $option" =>
      val command = withCommand(args).head
      val known = "help" +: OptionTable.names(command)
      val name = option.dropWhile(_ == '-').takeWhile(c => c != '=' && c != ':')
      val help = Suggest.nearest(name, known).fold("")(k => s"; did you mean `--$k`?")
      s"`candela $command` has no option `$option`$help"
    case other => other

enum Command(val word: String):
  case Render extends Command("render")
  case Resume extends Command("resume")
  case Merge extends Command("merge")
  case Check extends Command("check")
  case Compare extends Command("compare")
  case Bench extends Command("bench")
  case Describe extends Command("describe")
  case Convert extends Command("convert")
  case View extends Command("view")
  case Preview extends Command("preview")
  case Image extends Command("image")
  case Average extends Command("average")
  case Info extends Command("info")

/** Part of the image to render, in fractions [0, 1] of width and height. */
final case class CropWindow(x0: Float, x1: Float, y0: Float, y1: Float)

/** A parsed command line; None if an option was not given.
  *
  * @param files scenes; for `resume` and `merge`, film files; for `compare`, the image and its
  *   reference; for `describe`, category and type
  * @param outfiles output images, instead of the file named by the scene
  * @param pixels part of the image to render, in pixels
  * @param pixel only pixel to render; with `sample`, the sample that `debug` traces instead
  * @param pixelMaterial pixel whose material is printed, instead of rendering
  * @param switches settings of the whole scene
  * @param partialImages whether to write the image of each pass
  * @param notes on words of the command line that have no effect
  * @param markdown whether `describe` prints the whole reference
  * @param pbrtOptions whether `describe` prints the options of pbrt's command lines
  * @param to target dialect of `convert`
  * @param toPly minimum number of triangles for writing a mesh as a PLY file
  * @param bake  width and height of images that replace textures, in pixels
  * @param color whether rendering is spectral
  * @param points which sample points to take
  * @param fireflies what is done about them
  * @param display how pictures show linear light
  * @param denoise whether to add a denoised image
  * @param thumbnail how to show the image in the terminal
  * @param columns pictures per row of a contact sheet
  * @param layers AOVs in addition to the scene's
  * @param film options of saved renderings
  * @param cluster options of rendering on a cluster
  * @param storeTime whether to store the render time in the image file
  * @param precisions whether AOVs are stored in 16 bits, where asked
  * @param lightGroups how to group lights for their layer
  * @param reference reference image for reports
  * @param reports report files
  * @param watch address of the live page
  * @param displayServer host and port of an image viewer
  * @param watchAfter whether the page stays when rendering has ended
  * @param bench options of `bench`
  * @param compare options of `compare`
  * @param image options of `image` and `average`
  */
final case class Options(
    command: Command = Command.Render,
    files: Vector[String] = Vector.empty,
    outfiles: Vector[String] = Vector.empty,
    threads: Option[Int] = None,
    spp: Option[Int] = None,
    seed: Int = 0,
    quick: Boolean = false,
    preview: Boolean = false,
    quiet: Boolean = false,
    verbose: Boolean = false,
    explain: Boolean = false,
    cropWindow: Option[CropWindow] = None,
    pixels: Option[PixelRange] = None,
    pixel: Option[(Int, Int)] = None,
    pixelMaterial: Option[(Int, Int)] = None,
    switches: Switches = Switches(),
    partialImages: Boolean = false,
    notes: Vector[String] = Vector.empty,
    sample: Int = 0,
    debug: Boolean = false,
    dialect: Option[Dialect] = None,
    keepGoing: Boolean = false,
    world: Int = 0,
    defines: Map[String, String] = Map.empty,
    color: ColorMode = ColorMode.Auto,
    points: PointChoice = PointChoice.Best,
    fireflies: Fireflies = Fireflies.Kept,
    layers: Vector[Layer] = Vector.empty,
    precisions: Vector[(Layer, Boolean)] = Vector.empty,
    lightGroups: Option[LightGrouping] = None,
    display: DisplayTransform = DisplayTransform.Plain,
    denoise: Boolean = false,
    thumbnail: Option[ThumbnailKind] = None,
    columns: Option[Int] = None,
    film: FilmOptions = FilmOptions(),
    cluster: ClusterOptions = ClusterOptions(),
    storeTime: Boolean = false,
    reference: Option[String] = None,
    reports: Vector[String] = Vector.empty,
    watch: Option[WatchAddress] = None,
    watchAfter: Boolean = false,
    displayServer: Option[(String, Int)] = None,
    compare: CompareOptions = CompareOptions(),
    bench: BenchOptions = BenchOptions(),
    image: ImageOptions = ImageOptions(),
    markdown: Boolean = false,
    pbrtOptions: Boolean = false,
    to: Option[Dialect] = None,
    toPly: Option[Int] = None,
    bake: Option[Int] = None
):
  /** With a parameter of a Mitsuba scene, given as NAME=VALUE. */
  def defining(text: String): Options =
    val (name, value) = text.span(_ != '=')
    copy(defines = defines.updated(name, value.drop(1)))

  /** Whether anything follows the rendering. */
  def isWatched: Boolean = watch.isDefined || displayServer.isDefined

  /** The requested number of threads, or else the number of processors. */
  def threadCount: Int = threads.getOrElse(Runtime.getRuntime.availableProcessors)
