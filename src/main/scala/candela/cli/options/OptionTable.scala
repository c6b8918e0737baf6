package candela.cli.options

import candela.convert.Baking
import candela.image.{Contents, OutputFormat}
import candela.scenefile.Dialect
import candela.settings.{RenderRegion, SettingsTable, TextForm}
import candela.watch.{TevDisplay, WatchAddress}

import scopt.{OParser, Read}

/** The options of all commands, one row each, for parsing, validation and help. */
private[candela] object OptionTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private given Read[(String, Int)] = Read.reads: text =>
    WatchAddresses.display(text)
      .getOrElse(throw IllegalArgumentException("expected HOST:PORT, e.g. localhost:14158"))

  private given Read[WatchAddress] = Read.reads: text =>
    WatchAddresses.parse(text)
      .getOrElse(throw IllegalArgumentException("expected PORT or ADDRESS:PORT, e.g. 0.0.0.0:8642"))

  // Rows of several commands are methods: scopt gives a row one parent.
  private def explain: Row = opt[Unit]("explain")
    .text("print what the scene is built from and what was ignored")
    .action((_, o) => o.copy(explain = true))

  def quiet: Row =
    opt[Unit]("quiet").text("print errors only").action((_, o) => o.copy(quiet = true))

  private def verbose(text: String): Row =
    opt[Unit]("verbose").text(s"print every warning$text")
      .action((_, o) => o.copy(verbose = true))

  /** More than any machine's processors; each thread takes memory, and a slot of the system. */
  private val MaxThreads = 4096

  private def threads: Row = opt[Int]('j', "nthreads").valueName("N")
    .text("number of render threads (default: one per processor)")
    .validate(atLeast("nthreads", 1))
    .validate: n =>
      if n <= MaxThreads then success
      else failure(s"--nthreads must be at most $MaxThreads, found `$n`")
    .action((n, o) => o.controlling(_.copy(threads = n)))

  private def watch(meaning: String): Row =
    opt[Option[WatchAddress]]("watch").valueName("[PORT]")
      .text(OptionText(
        s"$meaning, on this machine only; with ADDRESS:PORT, to anyone who has the link",
        "[The live page](WATCHING.md)."
      ))
      .action((a, o) => o.copy(watch = Some(a.getOrElse(WatchAddress(None, None)))))

  private def parsing: Vector[Row] =
    settings("dialect", "define", "sensor", "camera", "light", "background") ++
      settings("at", "animation", "variant", "up")

  /** The command `preview` sets that of its name. */
  private def allSettings: Vector[Row] =
    SettingsTable.all.filter(_.name != Command.Preview.word).map(row(_))

  val render: Vector[Row] = Vector(
    opt[Seq[String]]('o', "outfile")(using fileNames).unbounded().valueName("FILE[,FILE]")
      .text(OptionText(
        s"output image, ${OutputFormat.listed()}; several: the same image in each format",
        "The suffix selects the format; `x.exr,x.png` are image and preview. A name that ends " +
          "with `.film` is a [film file](FILMS.md). Without it the scene names the image: see " +
          "[output files](#output-files)."
      ))
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
    threads
  ) ++ allSettings ++ Vector[Row](
    opt[Int]("sample").valueName("N")
      .text("the sample of --debug, from 0 (default 0)")
      .validate(atLeast("sample", 0))
      .action((n, o) => o.copy(sample = n)),
    opt[Unit]("debug")
      .text("trace one sample and print the events along its path; writes no image")
      .action((_, o) => o.copy(debug = true)),
    opt[RenderRegion.Pixel]("pixelmaterial").valueName("x,y")
      .text("print what the centre of the pixel shows; writes no image")
      .action((p, o) => o.copy(pixelMaterial = Some((p.x, p.y)))),
    opt[Unit]("write-partial-images")
      .text("write the image at 1, 2, 4, 8, ... samples per pixel, too")
      .action((_, o) => o.copy(partialImages = true)),
    opt[Seq[String]]("report")(using fileNames).unbounded().valueName("FILE[,FILE]")
      .text(OptionText(
        "write error over time as .html, .json or .csv; the image is unaffected",
        "[What a report shows](BENCH.md#a-single-rendering)."
      ))
      .action((f, o) => o.copy(reports = o.reports ++ f)),
    opt[String]("reference").valueName("FILE")
      .text(
        "reference for --report, --watch (default: the error is estimated from the noise) and " +
          "--denoise"
      )
      .action((f, o) => o.copy(reference = Some(f))),
    watch("serve a live page of the image"),
    opt[Unit]("watch-after")
      .text("keep the live page after rendering, until Ctrl-C or its button `end`")
      .action((_, o) => o.copy(watchAfter = true)),
    opt[(String, Int)]("display-server").valueName("HOST[:PORT]")
      .text(OptionText(
        s"show the image in the viewer tev (default port: ${TevDisplay.DefaultPort})",
        "[tev](https://github.com/Tom94/tev) must be running; pbrt-v4 has the same option."
      ))
      .action((a, o) => o.copy(displayServer = Some(a))),
    explain,
    quiet,
    verbose(", the time of each phase, and what --explain prints")
  ) ++ FilmTable.render ++ ClusterTable.options ++ DisplayTable.thumbnails ++
    TextureTable.options ++ TextureTable.scenes ++ LimitTable.options

  val resume: Vector[Row] = Vector(
    threads,
    setting("spp", "samples per pixel; more than planned adds samples"),
    FilmTable.every
  ) ++ settings("time", "error") ++ LimitTable.options ++ TextureTable.options ++
    TextureTable.scenes ++ Vector(quiet, verbose(", and the time of each phase"))

  val merge: Vector[Row] = Vector(
    opt[Seq[String]](
      'o',
      "outfile"
    )(using fileNames).required().unbounded().valueName("FILE[,FILE]")
      .text(s"output image, ${OutputFormat.listed()}; or .film: the merged film")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f))
  ) ++ FilmTable.merge ++ Vector(quiet, verbose(""))

  val check: Vector[Row] =
    parsing ++ settings("keep-going", "color") ++
      Vector(explain, quiet, verbose(", and what --explain prints")) ++ LimitTable.options

  private val describable: TextForm[Dialect] =
    val all = Dialect.ofPbrt :+ Dialect.Mitsuba
    TextForm("v2, v3, v4 or mitsuba", t => all.find(_.toString.equalsIgnoreCase(t)), _.toString)

  val describe: Vector[Row] = Vector(
    opt[Unit]("pbrt-options")
      .text("print pbrt's options and their equivalents as a Markdown page")
      .action((_, o) => o.copy(pages = o.pages :+ Page.PbrtOptions)),
    opt[Unit]("commands")
      .text("print all commands and options as a Markdown page")
      .action((_, o) => o.copy(pages = o.pages :+ Page.Commands)),
    opt[Unit]("man")
      .text("print the manual page candela(1), for man")
      .action((_, o) => o.copy(pages = o.pages :+ Page.Manual)),
    opt[Unit]("problems")
      .text("print all problems that `explain` explains, as a Markdown page")
      .action((_, o) => o.copy(pages = o.pages :+ Page.Problems)),
    opt[Dialect]("dialect")(using reading(describable)).valueName("v2|v3|v4|mitsuba")
      .text("only types and parameters of this pbrt version, or of Mitsuba")
      .action((d, o) => o.setting(s => s.copy(reading = s.reading.copy(dialect = Some(d))))),
    opt[Unit]("markdown")
      .text("print the whole reference as a Markdown page, docs/REFERENCE.md")
      .action((_, o) => o.copy(pages = o.pages :+ Page.Reference)),
    opt[String]('o', "outfile").valueName("FILE")
      .text("where to write the page (default: standard output)")
      .action((f, o) => o.copy(outfiles = Vector(f)))
  )

  private val target: TextForm[Dialect] =
    TextForm("v4 or v3", t => Dialect.ofPbrt.find(_.toString.equalsIgnoreCase(t)), _.toString)

  val convert: Vector[Row] = Vector(
    opt[Dialect]("to")(using reading(target)).valueName("v4|v3")
      .text("target dialect (default: the scene's own, which reformats it)")
      .action((d, o) => o.copy(to = Some(d))),
    opt[String]('o', "outfile").valueName("FILE")
      .text("output scene (default: standard output); its images and meshes go beside it")
      .action((f, o) => o.copy(outfiles = Vector(f))),
    opt[Int]("to-ply").valueName("N")
      .text("write meshes of at least N triangles as binary PLY files")
      .validate(atLeast("to-ply", 1))
      .action((n, o) => o.copy(toPly = Some(n))),
    opt[Int]("bake").valueName("[N]")
      .text(OptionText(
        s"paint textures that the dialect lacks as images of N × N pixels " +
          s"(default ${Baking.DefaultSize})",
        "[What is painted](CONVERTING.md)."
      ))
      .validate(atLeast("bake", 1))
      .validate: n =>
        if n <= 8192 then success else failure(s"--bake must be at most 8192, found `$n`")
      .action((n, o) => o.copy(bake = Some(n)))
  ) ++ parsing ++ Vector(quiet, verbose("")) ++ LimitTable.options

  val view: Vector[Row] = Vector[Row](
    opt[Seq[String]]('o', "outfile")(using fileNames).unbounded().valueName("FILE[,FILE]")
      .text(s"picture to write, ${OutputFormat.listed(Contents.Display)} (default: the terminal)")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
    opt[Int]("columns").valueName("N")
      .text("pictures per row of a contact sheet (default: about as many as rows)")
      .validate(atLeast("columns", 1))
      .action((n, o) => o.copy(columns = Some(n))),
    quiet
  ) ++ DisplayTable.options

  val preview: Vector[Row] = Vector[Row](
    opt[Seq[String]]('o', "outfile")(using fileNames).unbounded().valueName("FILE[,FILE]")
      .text("picture to write (default: the scene's name with -preview.png, in this folder)")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
    threads
  ) ++ settings("resolution", "cropwindow") ++ parsing ++ Vector(
    explain,
    quiet,
    verbose("")
  ) ++ DisplayTable.options ++
    LimitTable.options

  val move: Vector[Row] = Vector[Row](
    opt[String]('o', "outfile").valueName("FILE")
      .text("file for the camera (default: the scene's name with -camera.pbrt, in this folder)")
      .action((f, o) => o.copy(outfiles = Vector(f))),
    threads,
    watch("where to serve the page")
  ) ++ settings("spp", "seed", "resolution", "cropwindow", "aov") ++ parsing ++
    settings("keep-going", "color", "sampler", "guiding", "caustics", "sky") ++
    Vector(explain, quiet, verbose(", and what --explain prints")) ++ TextureTable.options ++
    LimitTable.options

  val image: Vector[Row] = (ImageTable.options :+ quiet) ++ DisplayTable.imageRows

  val average: Vector[Row] = (ImageTable.average :+ quiet) ++ DisplayTable.imageRows

  val reference: Vector[Row] =
    ReferenceTable.options ++ TextureTable.options ++ Vector(threads) ++
      settings(
        "resolution",
        "cropwindow"
      ) ++ parsing ++ settings("keep-going", "color", "sampler") ++
      Vector(FilmTable.every, quiet, verbose(", and what --explain prints")) ++ LimitTable.options
