package candela.cli.options

import candela.aov.Layer
import candela.convert.Baking
import candela.film.Fireflies
import candela.image.{Contents, OutputFormat}
import candela.job.TextForm
import candela.scenefile.Dialect
import candela.settings.{ColorMode, LightGrouping, PointChoice, RenderRegion, RenderSettings}
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

  // Options of several commands are methods: scopt gives a row one parent.
  private def dialect(text: String): Row =
    opt[Dialect]("dialect").valueName("v2|v3|v4").text(text)
      .action(setReading((d, r) => r.copy(dialect = Some(d))))

  private def parsedAs: Row =
    dialect("parse the scene as this pbrt version (default: auto-detected)")

  private def keepGoing: Row = opt[Unit]("keep-going")
    .text(OptionText(
      "replace missing files and types with placeholders, with a warning each",
      "Missing or unreadable images, textures and materials become magenta (float textures 1), " +
        "meshes and objects are dropped, includes are skipped; the last line counts these " +
        "placeholders."
    ))
    .action(setReading((_, r) => r.copy(keepGoing = true)))

  private def defines: Row =
    opt[(String, String)]('D', "define")(using reading(TextForm.definition))
      .unbounded().valueName("NAME=VALUE")
      .text(OptionText(
        "set $NAME of a Mitsuba scene; also -DNAME=VALUE",
        "[Mitsuba scenes](MITSUBA.md)."
      ))
      .action(setReading((d, r) => r.copy(defines = r.defines + d)))

  private def color: Row = opt[ColorMode]("color").valueName("auto|rgb|spectral")
    .text(OptionText(
      "render RGB or sampled wavelengths (default auto: RGB where it is accurate)",
      "`auto` uses RGB where its error is below half a percent."
    ))
    .action(set((mode, s) => s.copy(color = mode)))

  private def explain: Row = opt[Unit]("explain")
    .text("print what the scene is built from and what was ignored")
    .action((_, o) => o.copy(explain = true))

  def quiet: Row =
    opt[Unit]("quiet").text("print errors only").action((_, o) => o.copy(quiet = true))

  private def verbose(text: String): Row =
    opt[Unit]("verbose").text(s"print every warning$text")
      .action((_, o) => o.copy(verbose = true))

  /** More than any machine's processors; each thread takes memory, and a slot of the system. */
  private val MostThreads = 4096

  private def threads: Row = opt[Int]('j', "nthreads").valueName("N")
    .text("number of render threads (default: one per processor)")
    .validate(atLeast("nthreads", 1))
    .validate: n =>
      if n <= MostThreads then success
      else failure(s"--nthreads must be at most $MostThreads, found `$n`")
    .action((n, o) => o.controlling(_.copy(threads = n)))

  private def samples(text: String): Row = opt[Int]("spp").valueName("N")
    .text(text)
    .validate(atLeast("spp", 1))
    .action(set((n, s) => s.copy(samples = Some(n))))

  private def crop: Row = opt[RenderRegion.Window]("cropwindow").valueName("x0,x1,y0,y1")
    .text("render only this window, in fractions of width and height")
    .action(setRegion)

  private def layers: String = Layer.values.map(_.word).mkString(", ")

  private def grouped(groups: LightGrouping, s: RenderSettings): RenderSettings =
    s.copy(lightGroups = Some(groups), layers = (s.layers :+ Layer.Lights).distinct)

  private def sampler: Row =
    val words = PointChoice.all.map(_.word).mkString("|")
    opt[PointChoice]("sampler").valueName(words)
      .text(OptionText(
        "sample points: those with the least noise (best, the default), the scene's own, or these",
        "`progressive` is the default with `--time` and `--error`; " +
          "[measurements](SAMPLERS.md)."
      ))
      .action(set((p, s) => s.copy(points = Some(p))))

  private def fireflies: Row =
    opt[Fireflies]("fireflies").valueName("keep|reweight|clamp:X")
      .text(OptionText(
        "trade noise for bias: omit light that few samples have found, or limit each sample's " +
          "indirect light to X (default: keep)",
        "[Fireflies](NOISE.md#fireflies)."
      ))
      .action(set((f, s) => s.copy(fireflies = f)))

  val render: Vector[Row] = Vector(
    opt[Seq[String]]('o', "outfile").unbounded().valueName("FILE[,FILE]")
      .text(OptionText(
        s"output image, ${OutputFormat.listed()}; several: the same image in each format",
        "The suffix selects the format; `x.exr,x.png` are image and preview. A name that ends " +
          "with `.film` is a [film file](FILMS.md). Without it the scene names the image: see " +
          "[output files](#output-files)."
      ))
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
    threads,
    samples("samples per pixel; overrides the scene"),
    opt[Int]("seed").valueName("N")
      .text("random seed (default 0)")
      .action(set((n, s) => s.copy(seed = n))),
    opt[Unit]("quick")
      .text("draft: a quarter of the width and height, one sample per pixel")
      .action(set((_, s) => s.copy(quick = true))),
    crop,
    opt[RenderRegion.Pixel]("pixel").valueName("x,y")
      .text("render only this pixel, from 0,0 at the top left; with --debug, trace it")
      .action(setRegion),
    opt[Int]("sample").valueName("N")
      .text("the sample of --debug, from 0 (default 0)")
      .validate(atLeast("sample", 0))
      .action((n, o) => o.copy(sample = n)),
    opt[Unit]("debug")
      .text("trace one sample and print the events along its path; writes no image")
      .action((_, o) => o.copy(debug = true)),
    opt[Seq[(Layer, Option[Boolean])]]("aov").unbounded().valueName("LAYER[,LAYER]")
      .text(OptionText(
        s"add AOVs to the ${OutputFormat.listed(Contents.Channels)} image: $layers; " +
          "LAYER:half and LAYER:float select its precision",
        "[All layers](LAYERS.md)."
      ))
      .action(set((all, s) => s.adding(all))),
    opt[LightGrouping]("light-groups").valueName("statement|type|NAME=LIGHT[+LIGHT],…")
      .text(OptionText(
        "groups of the layer lights, which is added: each light statement (default), each type, " +
          "or named groups of statements (point_12: type and line) and types",
        "For example `key=point_12+spot_14,sky=infinite`."
      ))
      .action(set(grouped)),
    opt[Unit]("denoise")
      .text(OptionText(
        "add the image denoised by Open Image Denoise; .png and .jpg show it " +
          s"(layers ${Layer.denoising.map(_.word).mkString(" and ")} are added, too)",
        "[How to install Open Image Denoise](DENOISING.md)."
      ))
      .action(set((_, s) => s.denoised)),
    opt[String]("film").valueName("gbuffer|rgba")
      .text(OptionText(
        "add all AOVs of pbrt-v4's gbuffer film, or alpha",
        "PNG and TGA images have the alpha, too."
      ))
      .validate: f =>
        if Layer.films.contains(f) then success
        else failure(s"--film must be gbuffer or rgba, found `$f`")
      .action(set((f, s) => s.copy(layers = s.layers ++ Layer.films(f)))),
    opt[Unit]("store-time")
      .text("store the render time in the image file; equal images are then different files")
      .action(setOutput((_, w) => w.copy(storeTime = true))),
    opt[Seq[String]]("report").unbounded().valueName("FILE[,FILE]")
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
    opt[Option[WatchAddress]]("watch").valueName("[PORT]")
      .text(OptionText(
        "serve a live page of the image, on this machine only; with ADDRESS:PORT, to anyone who " +
          "has the link",
        "[The live page](WATCHING.md)."
      ))
      .action((a, o) => o.copy(watch = Some(a.getOrElse(WatchAddress(None, None))))),
    opt[Unit]("watch-after")
      .text("keep the live page after rendering, until Ctrl-C or its button `end`")
      .action((_, o) => o.copy(watchAfter = true)),
    opt[(String, Int)]("display-server").valueName("HOST[:PORT]")
      .text(OptionText(
        s"show the image in the viewer tev (default port: ${TevDisplay.DefaultPort})",
        "[tev](https://github.com/Tom94/tev) must be running; pbrt-v4 has the same option."
      ))
      .action((a, o) => o.copy(displayServer = Some(a))),
    parsedAs,
    defines,
    keepGoing,
    color,
    explain,
    quiet,
    verbose(", the time of each phase, and what --explain prints"),
    sampler,
    fireflies
  ) ++ SwitchTable.render ++ FilmTable.render ++ ClusterTable.options ++
    DisplayTable.options ++ TextureTable.options ++ TextureTable.scenes ++ LimitTable.options

  val resume: Vector[Row] = Vector(
    threads,
    samples("samples per pixel; more than planned adds samples")
  ) ++ FilmTable.resume ++ TextureTable.options ++ TextureTable.scenes ++
    Vector(quiet, verbose(", and the time of each phase"))

  val merge: Vector[Row] = Vector(
    opt[Seq[String]]('o', "outfile").required().unbounded().valueName("FILE[,FILE]")
      .text(s"output image, ${OutputFormat.listed()}; or .film: the merged film")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f))
  ) ++ FilmTable.merge ++ Vector(quiet, verbose(""))

  val check: Vector[Row] =
    Vector(
      parsedAs, defines, keepGoing, color, explain, quiet, verbose(", and what --explain prints")
    ) ++ LimitTable.options

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
    dialect("only types and parameters of this pbrt version"),
    opt[Unit]("markdown")
      .text("print the whole reference as a Markdown page, docs/REFERENCE.md")
      .action((_, o) => o.copy(pages = o.pages :+ Page.Reference)),
    opt[String]('o', "outfile").valueName("FILE")
      .text("where to write the page (default: standard output)")
      .action((f, o) => o.copy(outfiles = Vector(f)))
  )

  val convert: Vector[Row] = Vector(
    opt[Dialect]("to").valueName("v4|v3")
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
      .action((n, o) => o.copy(bake = Some(n))),
    parsedAs,
    defines,
    quiet,
    verbose("")
  ) ++ LimitTable.options

  val view: Vector[Row] = Vector[Row](
    opt[Seq[String]]('o', "outfile").unbounded().valueName("FILE[,FILE]")
      .text(s"picture to write, ${OutputFormat.listed(Contents.Display)} (default: the terminal)")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
    opt[Int]("columns").valueName("N")
      .text("pictures per row of a contact sheet (default: about as many as rows)")
      .validate(atLeast("columns", 1))
      .action((n, o) => o.copy(columns = Some(n))),
    quiet
  ) ++ DisplayTable.options

  val preview: Vector[Row] = Vector[Row](
    opt[Seq[String]]('o', "outfile").unbounded().valueName("FILE[,FILE]")
      .text("picture to write (default: the scene's name with -preview.png, in this folder)")
      .action((f, o) => o.copy(outfiles = o.outfiles ++ f)),
    threads,
    crop,
    parsedAs,
    defines,
    explain,
    quiet,
    verbose("")
  ) ++ DisplayTable.options ++ LimitTable.options

  val image: Vector[Row] = (ImageTable.options :+ quiet) ++ DisplayTable.shown

  val average: Vector[Row] = (ImageTable.average :+ quiet) ++ DisplayTable.shown

  val reference: Vector[Row] =
    ReferenceTable.options ++ TextureTable.options ++ Vector(
      threads,
      crop,
      parsedAs,
      defines,
      keepGoing,
      color,
      sampler,
      FilmTable.every,
      quiet,
      verbose(", and what --explain prints")
    ) ++ LimitTable.options
