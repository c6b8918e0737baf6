package candela.cli

import candela.base.{Suggest, Version}
import candela.scenefile.Dialect

import scopt.{DefaultOParserSetup, OEffect, OParser, OParserSetup, Read}

/** The one table of commands and options: parsing, checking and help. */
object CommandLine:

  /** What to print instead of running a command. */
  final case class Answer(out: String, err: String, code: ExitCode)

  def parse(args: Seq[String]): Either[Answer, Options] =
    val (options, effects) = OParser.runParser(table, withCommand(args), Options(), setup)
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
      case _ =>
        val code = if asked then ExitCode.Done else ExitCode.BadUsage
        Left(Answer(lines(out), lines(errors), code))

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
      val commands = table.toList.filter(_.name == command).map(_.id)
      val known = table.toList
        .filter(o => o.isOptLike && o.getParentId.forall(commands.contains))
        .map(_.name)
      val name = option.dropWhile(_ == '-').takeWhile(c => c != '=' && c != ':')
      val help = Suggest.nearest(name, known).fold("")(k => s"; did you mean `--$k`?")
      s"`candela $command` has no option `$option`$help"
    case other => other

  private given Read[Dialect] = Read.reads: text =>
    Dialect.values
      .find(_.toString.equalsIgnoreCase(text))
      .getOrElse(throw IllegalArgumentException("expected v2, v3 or v4"))

  private given Read[CropWindow] = Read.reads: text =>
    text.split(",", -1).map(_.trim.toFloatOption) match
      case Array(Some(x0), Some(x1), Some(y0), Some(y1))
          if 0 <= x0 && x0 < x1 && x1 <= 1 && 0 <= y0 && y0 < y1 && y1 <= 1 =>
        CropWindow(x0, x1, y0, y1)
      case _ =>
        throw IllegalArgumentException(
          "expected x0,x1,y0,y1 with 0 <= x0 < x1 <= 1, and y likewise, e.g. 0.25,0.75,0,0.5"
        )

  private lazy val table: OParser[?, Options] =
    val b = OParser.builder[Options]
    import b.*

    def atLeast[N](name: String, least: Int)(n: N)(using number: Numeric[N]) =
      if number.gteq(n, number.fromInt(least)) then success
      else failure(s"--$name: expected a number from $least, found `$n`")

    def scenes = arg[String]("scene.pbrt...").unbounded()
      .text("scene files, each rendered or checked by itself")
      .action((f, o) => o.copy(files = o.files :+ f))

    def dialect = opt[Dialect]("dialect").valueName("v2|v3|v4")
      .text("read the scene as pbrt of this version does, instead of recognising it")
      .action((d, o) => o.copy(dialect = Some(d)))

    def explain = opt[Unit]("explain")
      .text("say what the scene is built of, and what was left out")
      .action((_, o) => o.copy(explain = true))

    def quiet = opt[Unit]("quiet")
      .text("print nothing but errors")
      .action((_, o) => o.copy(quiet = true))

    def verbose = opt[Unit]("verbose")
      .text("print every warning, the times of all phases, and what --explain says")
      .action((_, o) => o.copy(verbose = true))

    val render = cmd(Command.Render.word).text("render scenes; the word itself may be left out")
      .action((_, o) => o.copy(command = Command.Render))
      .children(
        scenes,
        opt[Seq[String]]("outfile").unbounded().valueName("FILE[,FILE]")
          .text("the image to write, .exr or .png; several: the same image in each format")
          .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
        opt[Int]('j', "nthreads").valueName("N")
          .text("threads to render with (default: one for each processor)")
          .validate(atLeast("nthreads", 1))
          .action((n, o) => o.copy(threads = Some(n))),
        opt[Int]("spp").valueName("N")
          .text("samples per pixel, instead of the scene's")
          .validate(atLeast("spp", 1))
          .action((n, o) => o.copy(spp = Some(n))),
        opt[Int]("seed").valueName("N")
          .text("of the random numbers (default 0): other noise, same expected image")
          .action((n, o) => o.copy(seed = n)),
        opt[Unit]("quick")
          .text("a quarter of the width and height, one sample per pixel: a first look")
          .action((_, o) => o.copy(quick = true)),
        opt[CropWindow]("cropwindow").valueName("x0,x1,y0,y1")
          .text("render only this part of the image, in fractions of its size")
          .action((w, o) => o.copy(cropWindow = Some(w))),
        dialect,
        explain,
        quiet,
        verbose
      )

    val check = cmd(Command.Check.word).text("parse and build scenes, without rendering")
      .action((_, o) => o.copy(command = Command.Check))
      .children(scenes, dialect, explain, quiet, verbose)

    val compare = cmd(Command.Compare.word).text("print how an image differs from its reference")
      .action((_, o) => o.copy(command = Command.Compare))
      .children(
        arg[String]("image").text("what to judge").action((f, o) => o.copy(files = o.files :+ f)),
        arg[String]("reference").text("what to judge it by")
          .action((f, o) => o.copy(files = o.files :+ f)),
        opt[Double]("max-relmse").valueName("X")
          .text("exit with 1 if the relative mean squared error is above")
          .validate(atLeast("max-relmse", 0))
          .action((x, o) => o.copy(maxRelMse = Some(x))),
        verbose
      )

    OParser.sequence(
      programName("candela"),
      head("candela", Version.current),
      help("help").text("print this"),
      version("version").text("print the version"),
      note(""),
      render,
      note(""),
      check,
      note(""),
      compare,
      note("""
        |Without --outfile the image goes where the scene's Film says; an .exr also as a .png.
        |Ctrl-C writes the image as far as it is; a second one quits at once.
        |Exit codes: 0 done, 1 bad input, 2 bad usage, 3 a bug in Candela, 130 Ctrl-C.""".stripMargin),
      checkConfig: o =>
        if o.outfiles.nonEmpty && o.files.size > 1 then
          failure("--outfile names one image, but there are several scenes")
        else success
    )
