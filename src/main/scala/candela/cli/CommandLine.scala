package candela.cli

import candela.base.Suggest

import scopt.{DefaultOParserSetup, OEffect, OParser, OParserSetup}

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
