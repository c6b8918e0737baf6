package candela.cli

import candela.base.Version
import candela.film.Layer
import candela.image.{Contents, OutputFormat}
import candela.scenefile.Dialect

import scopt.{OParser, Read}

/** All commands and their options, one row each: parsing, checking and help. */
private[cli] object OptionTable:
  private type Row = OParser[?, Options]

  private val b = OParser.builder[Options]
  import b.{arg, checkConfig, cmd, failure, head, help, note, opt, programName, success, version}

  private given Read[Dialect] = Read.reads: text =>
    Dialect.values
      .find(_.toString.equalsIgnoreCase(text))
      .getOrElse(throw IllegalArgumentException("expected v2, v3 or v4"))

  private given Read[(Int, Int)] = Read.reads: text =>
    text.split(",", -1).map(_.trim.toIntOption) match
      case Array(Some(x), Some(y)) if x >= 0 && y >= 0 => (x, y)
      case _ => throw IllegalArgumentException("expected x,y in pixels, e.g. 12,40")

  private given Read[CropWindow] = Read.reads: text =>
    text.split(",", -1).map(_.trim.toFloatOption) match
      case Array(Some(x0), Some(x1), Some(y0), Some(y1))
          if 0 <= x0 && x0 < x1 && x1 <= 1 && 0 <= y0 && y0 < y1 && y1 <= 1 =>
        CropWindow(x0, x1, y0, y1)
      case _ =>
        throw IllegalArgumentException(
          "expected x0,x1,y0,y1 with 0 <= x0 < x1 <= 1, and y likewise, e.g. 0.25,0.75,0,0.5"
        )

  private given Read[Layer] = Read.reads: text =>
    Layer.values
      .find(_.word.equalsIgnoreCase(text.trim))
      .getOrElse(throw IllegalArgumentException(s"expected some of $layers"))

  private def atLeast[N](name: String, least: Int)(n: N)(using number: Numeric[N]) =
    if number.gteq(n, number.fromInt(least)) then success
    else failure(s"--$name: expected a number from $least, found `$n`")

  private def file(name: String, text: String): OParser[String, Options] =
    arg[String](name).text(text).action((f, o) => o.copy(files = o.files :+ f))

  private def scenes: Row = file("scene.pbrt...", "scene files, each for itself").unbounded()

  // What several commands have is made anew for each: scopt gives a row one parent.
  private def shared: Vector[Row] = Vector(
    opt[Dialect]("dialect").valueName("v2|v3|v4")
      .text("read the scene as this version of pbrt does, instead of recognising it")
      .action((d, o) => o.copy(dialect = Some(d))),
    opt[Unit]("keep-going")
      .text("use stand-ins for what is missing: magenta for pictures and materials")
      .action((_, o) => o.copy(keepGoing = true)),
    opt[Unit]("explain")
      .text("say what the scene is built of, and what was left out")
      .action((_, o) => o.copy(explain = true)),
    opt[Unit]("quiet")
      .text("print nothing but errors")
      .action((_, o) => o.copy(quiet = true)),
    opt[Unit]("verbose")
      .text("print every warning, the times of all phases, and what --explain says")
      .action((_, o) => o.copy(verbose = true))
  )

  private def layers: String = Layer.values.map(_.word).mkString(", ")

  private val renderOptions: Vector[Row] = Vector(
    opt[Seq[String]]("outfile").unbounded().valueName("FILE[,FILE]")
      .text(s"output image, ${OutputFormat.listed()}; several: the same image in each format")
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
    opt[(Int, Int)]("pixel").valueName("x,y")
      .text("with --debug: which pixel, from 0,0 at the top left")
      .action((p, o) => o.copy(pixel = Some(p))),
    opt[Int]("sample").valueName("N")
      .text("with --debug: which of its samples, from 0 (default 0)")
      .validate(atLeast("sample", 0))
      .action((n, o) => o.copy(sample = n)),
    opt[Unit]("debug")
      .text("write no image, but say what happens along the path of one sample")
      .action((_, o) => o.copy(debug = true)),
    opt[Seq[Layer]]("aov").unbounded().valueName("LAYER[,LAYER]")
      .text(s"add layers to the ${OutputFormat.listed(Contents.Channels)} image: $layers")
      .action((l, o) => o.copy(layers = o.layers ++ l)),
    opt[String]("film").valueName("gbuffer")
      .text("write all layers that pbrt-v4's film of this name has")
      .validate(f => if f == "gbuffer" then success else failure(s"--film: only gbuffer, not `$f`"))
      .action((_, o) => o.copy(layers = o.layers ++ Layer.gbuffer)),
    opt[Seq[String]]("report").unbounded().valueName("FILE[,FILE]")
      .text("write the error over time, .html, .json or .csv; the image stays the same")
      .action((f, o) => o.copy(reports = o.reports ++ f)),
    opt[String]("reference").valueName("FILE")
      .text("the image that --report compares with, instead of estimating errors from the noise")
      .action((f, o) => o.copy(reference = Some(f)))
  ) ++ shared

  private val checkOptions: Vector[Row] = shared

  private val describeOptions: Vector[Row] = Vector(
    opt[Dialect]("dialect").valueName("v2|v3|v4")
      .text("only what this version of pbrt knows")
      .action((d, o) => o.copy(dialect = Some(d))),
    opt[Unit]("markdown")
      .text("the whole reference, as a page of documentation")
      .action((_, o) => o.copy(markdown = true)),
    opt[String]("outfile").valueName("FILE")
      .text("where to write that, instead of here")
      .action((f, o) => o.copy(outfiles = Vector(f)))
  )

  private val convertOptions: Vector[Row] = Vector(
    opt[Dialect]("to").required().valueName("v4|v3")
      .text("the dialect to write; the scene's own formats it (v2 only from v2)")
      .action((d, o) => o.copy(to = Some(d))),
    opt[String]("outfile").valueName("FILE")
      .text("the scene to write, instead of printing it; its images and meshes go beside it")
      .action((f, o) => o.copy(outfiles = Vector(f))),
    opt[Int]("to-ply").valueName("N")
      .text("write meshes of N triangles or more as binary PLY files")
      .validate(atLeast("to-ply", 1))
      .action((n, o) => o.copy(toPly = Some(n)))
  ) ++ shared.filterNot(_.toList.exists(_.name == "explain"))

  /** The long options of a command, without dashes. */
  def names(command: String): Vector[String] =
    val rows = Command.values.find(_.word == command) match
      case Some(Command.Render) => renderOptions
      case Some(Command.Check) => checkOptions
      case Some(Command.Compare) => CompareTable.options
      case Some(Command.Bench) => BenchTable.options
      case Some(Command.Describe) => describeOptions
      case Some(Command.Convert) => convertOptions
      case None => Vector.empty
    rows.flatMap(_.toList).map(_.name)

  private def command(c: Command, text: String)(rows: Vector[Row]): Row =
    cmd(c.word).text(text).action((_, o) => o.copy(command = c)).children(rows*)

  val table: Row = OParser.sequence(
    programName("candela"),
    head("candela", Version.current),
    help("help").text("print this"),
    version("version").text("print the version"),
    note(""),
    command(Command.Render, "render scenes; the word itself may be left out")(
      scenes +: renderOptions
    ),
    note(""),
    command(Command.Check, "parse and build scenes, without rendering")(scenes +: checkOptions),
    note(""),
    command(Command.Compare, "print how an image differs from its reference")(
      Vector(
        file("image", "what to judge; or a folder of images"),
        file("reference", "what to judge it by; or a folder of references, by the same names")
      ) ++ CompareTable.options
    ),
    note(""),
    command(Command.Bench, "measure how fast programs come to which error")(
      file("suite.conf", "the suite; or a folder of scenes with references") +: BenchTable.options
    ),
    note(""),
    command(Command.Describe, "say what scene files can say: all categories, types, parameters")(
      arg[String]("[category] [type]").optional().unbounded().text("what to describe")
        .action((f, o) => o.copy(files = o.files :+ f)) +: describeOptions
    ),
    note(""),
    command(Command.Convert, "write a scene in another dialect")(
      file("scene.pbrt", "the scene to convert") +: convertOptions
    ),
    note("""
      |Without --outfile the image goes where the scene's Film says; an .exr also as a .png.
      |Ctrl-C writes the image as far as it is; a second one quits at once.
      |Exit codes: 0 done, 1 bad input, 2 bad usage, 3 a bug in Candela, 130 Ctrl-C.
      |""".stripMargin.stripTrailing),
    checkConfig: o =>
      if o.command == Command.Render && o.outfiles.nonEmpty && o.files.size > 1 then
        failure("--outfile names one image, but there are several scenes")
      else if o.debug != o.pixel.isDefined then
        failure("--debug and --pixel x,y go together")
      else if o.command == Command.Render && o.reports.nonEmpty && o.files.size > 1 then
        failure("--report is about one scene, but there are several")
      else if o.command == Command.Render && o.reference.nonEmpty && o.reports.isEmpty then
        failure("--reference is what --report compares with: say where to write the report")
      else success
  )
