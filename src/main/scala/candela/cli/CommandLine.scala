package candela.cli

import scopt.{DefaultOParserSetup, OEffect, OParser, OParserSetup}

import candela.base.Suggest
import candela.film.Layer
import candela.scenefile.Dialect

/** From the words of a command line to [[Options]], or to what to print instead. */
object CommandLine:

  /** What to print instead of running a command. */
  final case class Answer(out: String, err: String, code: ExitCode)

  def parse(args: Seq[String]): Either[Answer, Options] =
    val (options, effects) =
      OParser.runParser(OptionTable.table, withCommand(args), Options(), setup)
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
      // Who asks for help need not have everything else right.
      case _ if asked => Left(Answer(lines(out), "", ExitCode.Done))
      case _ => Left(Answer(lines(out), lines(errors), ExitCode.BadUsage))

  private val setup: OParserSetup = new DefaultOParserSetup {}

  /** `render` is what is meant if no command is named. */
  private def withCommand(args: Seq[String]): Seq[String] =
    val words = Command.values.map(_.word) ++ Seq("--help", "--version")
    if args.headOption.exists(words.contains) then args else Command.Render.word +: args

  private def lines(texts: List[String]): String = texts.map(_ + "\n").mkString

  /** Unknown options offer the nearest one that the command has. */
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
  case Check extends Command("check")
  case Compare extends Command("compare")
  case Bench extends Command("bench")
  case Describe extends Command("describe")
  case Convert extends Command("convert")

/** The part of the image to render: fractions of its width and height, 0 to 1. */
final case class CropWindow(x0: Float, x1: Float, y0: Float, y1: Float)

/** A command line, understood; what is None was not said.
  *
  * @param files     the scenes; for `compare`, the image and its reference; for `describe`, what to
  *                  describe
  * @param outfiles  where to write the image, instead of the scene's file name
  * @param pixel     with `sample`, what `debug` looks at instead of rendering an image
  * @param markdown  whether `describe` writes the whole reference
  * @param to        the dialect that `convert` writes
  * @param out       where it writes the scene
  * @param toPly     meshes of at least as many triangles go into PLY files
  * @param layers    what images hold beside colours and what the scene asks for
  * @param reference what reports judge the image by
  * @param reports   where to write them
  * @param bench     what `bench` is asked for
  * @param compare   what `compare` is asked for
  */
final case class Options(
    command: Command = Command.Render,
    files: Vector[String] = Vector.empty,
    outfiles: Vector[String] = Vector.empty,
    threads: Option[Int] = None,
    spp: Option[Int] = None,
    seed: Int = 0,
    quick: Boolean = false,
    quiet: Boolean = false,
    verbose: Boolean = false,
    explain: Boolean = false,
    cropWindow: Option[CropWindow] = None,
    pixel: Option[(Int, Int)] = None,
    sample: Int = 0,
    debug: Boolean = false,
    dialect: Option[Dialect] = None,
    keepGoing: Boolean = false,
    layers: Vector[Layer] = Vector.empty,
    reference: Option[String] = None,
    reports: Vector[String] = Vector.empty,
    compare: CompareOptions = CompareOptions(),
    bench: BenchOptions = BenchOptions(),
    markdown: Boolean = false,
    to: Option[Dialect] = None,
    toPly: Option[Int] = None
):
  /** As many threads as were asked for, or else as there are processors. */
  def threadCount: Int = threads.getOrElse(Runtime.getRuntime.availableProcessors)
