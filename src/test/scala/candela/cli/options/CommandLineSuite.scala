package candela.cli.options

import candela.base.Version
import candela.aov.Layer
import candela.bench.BenchOptions
import candela.bench.suite.Work
import candela.cli.terminal.ExitCode
import candela.measure.{Metric, PixelWindow}
import candela.scenefile.Dialect
import candela.settings.{LightGrouping, ReadSettings, RenderRegion}
import candela.watch.WatchAddress

import org.scalatest.funsuite.AnyFunSuite

class CommandLineSuite extends AnyFunSuite:

  private def parse(line: String) = CommandLine.parse(line.split(' ').toVector.filter(_.nonEmpty))

  private val one = Options(files = Vector("a.pbrt"))

  private def in(region: RenderRegion) =
    one.setting(_.copy(region = region))

  private def as(dialect: Dialect) =
    one.setting(_.copy(reading = ReadSettings(dialect = Some(dialect))))

  private def compare(o: CompareOptions) =
    Options(command = Command.Compare, files = Vector("a.exr", "b.exr"), compare = o)

  private val understood = Vector(
    "a.pbrt" -> one,
    "render a.pbrt" -> one,
    "a.pbrt b.pbrt" -> one.copy(files = Vector("a.pbrt", "b.pbrt")),
    "--spp 16 a.pbrt" -> one.setting(_.copy(samples = Some(16))),
    "a.pbrt --spp=16" -> one.setting(_.copy(samples = Some(16))),
    "a.pbrt --seed -3" -> one.setting(_.copy(seed = -3)),
    "a.pbrt --nthreads 3" -> one.controlling(_.copy(threads = 3)),
    "a.pbrt -j 3" -> one.controlling(_.copy(threads = 3)),
    "a.pbrt --quick --quiet --verbose --explain" ->
      one.setting(_.copy(quick = true)).copy(quiet = true, verbose = true, explain = true),
    "a.pbrt --outfile x.exr" -> one.copy(outfiles = Vector("x.exr")),
    "a.pbrt --outfile x.exr,y.png" -> one.copy(outfiles = Vector("x.exr", "y.png")),
    "a.pbrt --outfile lr=0.1,b=2/x,1.exr,y.png" ->
      one.copy(outfiles = Vector("lr=0.1,b=2/x,1.exr", "y.png")),
    "--outfile x.exr a.pbrt --outfile y.png" -> one.copy(outfiles = Vector("x.exr", "y.png")),
    "a.pbrt --cropwindow 0.25,0.75,0,1" ->
      in(RenderRegion.Window(0.25f, 0.75f, 0f, 1f)),
    "a.pbrt --aov albedo,Depth --aov samples" ->
      one.setting(_.copy(layers = Vector(Layer.Albedo, Layer.Depth, Layer.Samples))),
    "a.pbrt --light-groups type" ->
      one.setting(_.copy(layers = Vector(Layer.Lights), lightGroups = Some(LightGrouping.Types))),
    "a.pbrt --light-groups key=point_3,key=spot_4+area" -> one.setting(_.copy(
      layers = Vector(Layer.Lights),
      lightGroups =
        Some(LightGrouping.Named(Vector("key" -> Vector("point_3", "spot_4", "area"))))
    )),
    "a.pbrt --film gbuffer" -> one.setting(_.copy(layers = Layer.gbuffer)),
    "a.pbrt --dialect v2" -> as(Dialect.V2),
    "check a.pbrt --dialect V4 --explain" ->
      as(Dialect.V4).copy(command = Command.Check, explain = true),
    "render check" -> one.copy(files = Vector("check")),
    "a.pbrt --report r.html,r.csv --reference b.exr" ->
      one.copy(reports = Vector("r.html", "r.csv"), reference = Some("b.exr")),
    "a.pbrt --watch" -> one.copy(watch = Some(WatchAddress(None, None))),
    "convert --bake a.pbrt" -> one.copy(command = Command.Convert, bake = Some(1024)),
    "convert --bake 64 a.pbrt" -> one.copy(command = Command.Convert, bake = Some(64)),
    "--watch a.pbrt --watch-after" ->
      one.copy(watch = Some(WatchAddress(None, None)), watchAfter = true),
    "--watch 80 a.pbrt" -> one.copy(watch = Some(WatchAddress(None, Some(80)))),
    "--watch 0.0.0.0:80 a.pbrt" ->
      one.copy(watch = Some(WatchAddress(Some("0.0.0.0"), Some(80)))),
    "--watch=[::1]:80 a.pbrt" -> one.copy(watch = Some(WatchAddress(Some("::1"), Some(80)))),
    "a.pbrt --display-server localhost" ->
      one.copy(displayServer = Some(("localhost", 14158))),
    "a.pbrt --display-server 10.0.0.2:99" -> one.copy(displayServer = Some(("10.0.0.2", 99))),
    "bench s.conf --samples 4,1 --seeds 5 --programs a,b --scenes c --report x.html" ->
      Options(
        command = Command.Bench,
        files = Vector("s.conf"),
        reports = Vector("x.html"),
        module = Some(BenchOptions(
          work = Some(Work.Samples(Vector(1, 4))),
          seeds = Some(5),
          programs = Vector("a", "b"),
          scenes = Vector("c")
        ))
      ),
    "bench s.conf --denoise --seconds 8,0.5" -> Options(
      command = Command.Bench,
      files = Vector("s.conf"),
      module = Some(BenchOptions(work = Some(Work.Seconds(Vector(0.5, 8))), denoise = true))
    ),
    "compare a.exr b.exr" ->
      Options(command = Command.Compare, files = Vector("a.exr", "b.exr")),
    "compare --max-relmse 1% a.exr b.exr" ->
      compare(CompareOptions(limits = Vector(Limit("max-relmse", "relative MSE", 0.01)))),
    "compare --max-relmse 0.01 a.exr b.exr" ->
      compare(CompareOptions(limits = Vector(Limit("max-relmse", "relative MSE", 0.01)))),
    "compare a.exr b.exr --crop 8,-16,4,12 --per-channel --channels R,Z" ->
      compare(
        CompareOptions(
          crop = Some(PixelWindow(8, 24, 4, 12)),
          channels = Some(Vector("R", "Z")),
          perChannel = true
        )
      ),
    "compare a.exr b.exr --difference d.exr --heatmap h.png --heatmap-metric mae" ->
      compare(
        CompareOptions(
          difference = Some("d.exr"),
          heatMap = Some("h.png"),
          heatMapMetric = Metric.Mae
        )
      )
  )

  for (line, options) <- understood do
    test(s"`$line` is understood"):
      assert(parse(line) == Right(options))

  private val refused = Vector(
    "" -> "scene.pbrt",
    "--quiet" -> "`candela render` needs a file: scene.pbrt...",
    "--spp" -> "--spp needs a value: N",
    "--spp= a.pbrt" -> "--spp needs a value: N",
    "-o" -> "--outfile needs a value: FILE[,FILE]",
    "--spp 4 --spp 8 a.pbrt" -> "--spp is given twice",
    "--quiet --quiet a.pbrt" -> "--quiet is given twice",
    "-j 2 --nthreads 2 a.pbrt" -> "--nthreads is given twice",
    "--guiding=on --keep-going=0 a.pbrt" -> "--keep-going takes no value, found `0`",
    "--frames 3-1 a%d.pbrt" -> "with first <= last, e.g. 0-350x10, found `3-1`",
    "--seed 99999999999 a.pbrt" -> "--seed must be at most 2147483647, found `999",
    "--tonemap filmik a.pbrt" -> "found `filmik`; did you mean `filmic`?",
    "--aov albdo a.pbrt" -> "found `albdo`; did you mean `albedo`?",
    "--film gbufer a.pbrt" -> "--film must be gbuffer or rgba, found `gbufer`",
    "--define x a.xml" -> "--define must be NAME=VALUE, found `x`",
    "preview --spp 4 a.pbrt" ->
      "`candela preview` has no option `--spp`; `render`, `move`, `resume` and `reference` have it",
    "--spark fake --thumbnail auto a.pbrt" -> "--spark can't be combined with --thumbnail",
    "--spark fake --write-partial-images a.pbrt" ->
      "--spark can't be combined with --write-partial-images",
    "merge a.film" -> "`candela merge` needs --outfile FILE[,FILE]",
    "rneder a.pbrt" -> "`rneder` is not a command; did you mean `render`?",
    "diff a.exr b.exr" -> "`diff` is not a command; did you mean `compare`?",
    "hlep" -> "`hlep` is not a command; did you mean `help`?",
    "help rendr" -> "`rendr` is not a command; did you mean `render`?",
    "help nothing" -> "`nothing` is not a command",
    "--spp 0 a.pbrt" -> "--spp must be at least 1, found `0`",
    "--spp many a.pbrt" -> "--spp must be a whole number, found `many`",
    "--spp 2.5 a.pbrt" -> "--spp must be a whole number, found `2.5`",
    "--nthreads 0 a.pbrt" -> "--nthreads must be at least 1, found `0`",
    "--cropwindow 0.5,0.5,0,1 a.pbrt" -> "--cropwindow must be x0,x1,y0,y1",
    "--cropwindow 0,x,0,1 a.pbrt" -> "found `x` in `0,x,0,1`",
    "--pixelbounds 0,1.5,0,4 a.pbrt" -> "found `1.5` in `0,1.5,0,4`",
    "--pixel 3,y a.pbrt" -> "found `y` in `3,y`",
    "--aov depth,albdo a.pbrt" -> "found `albdo` in `depth,albdo`; did you mean `albedo`?",
    "--light-groups key=a,b a.pbrt" -> "found `b` in `key=a,b`",
    "--limit files=3,byte=1 a.pbrt" -> "found `byte=1` in `files=3,byte=1`; did you mean `bytes`?",
    "--cropwindow 0,1,0 a.pbrt" -> "--cropwindow must be x0,x1,y0,y1",
    "--cropwindow 0,2,0,1 a.pbrt" -> "--cropwindow must be x0,x1,y0,y1",
    "--cropwindow 0,NaN,0,1 a.pbrt" -> "--cropwindow must be x0,x1,y0,y1",
    "--fireflies clamp a.pbrt" -> "found `clamp`",
    "convert --to v5 a.pbrt" -> "--to must be v4 or v3, found `v5`",
    "--dialect v5 a.pbrt" -> "--dialect must be v2, v3 or v4, found `v5`",
    "--light-groups types a.pbrt" -> "--light-groups must be statement, type, or names",
    "--light-groups key=a,b a.pbrt" -> "--light-groups must be statement, type, or names",
    "--light-groups my-key=a a.pbrt" -> "--light-groups must be statement, type, or names",
    "-Dfocus a.pbrt" -> "-D needs a value, as in -Dfocus=VALUE",
    "--sp 4 a.pbrt" -> "`candela render` has no option `--sp`; did you mean `--spp`?",
    "--outfle=x.exr a.pbrt" -> "did you mean `--outfile`?",
    "-outfle x.exr a.pbrt" -> "did you mean `--outfile`?",
    "--integrator bdpt a.pbrt" -> ("`candela render` has no option `--integrator`; " +
      "the scene has it, in its Integrator statement"),
    "--xyzzy a.pbrt" -> "`candela render` has no option `--xyzzy`",
    "check --spp 4 a.pbrt" -> "`candela check` has no option `--spp`",
    "check --scene-cache a.pbrt" -> "`candela check` has no option `--scene-cache`",
    "--texture-memory 100k a.pbrt" -> "--texture-memory must be at least 1M, found 100 kB",
    "--outfile x.exr a.pbrt b.pbrt" -> "--outfile needs a single scene",
    "--error 2 a.pbrt" -> "e.g. 2% or 0.02; did you mean 2%?",
    "--report x.html a.pbrt b.pbrt" -> "--report needs a single scene",
    "--reference x.exr a.pbrt" -> "--reference needs --report",
    "--watch a.pbrt b.pbrt" -> "--watch needs a single scene",
    "--watch=no a.pbrt" -> "--watch must be PORT or ADDRESS:PORT",
    "--watch abc a.pbrt" -> "--watch must be PORT or ADDRESS:PORT, e.g. 0.0.0.0:8642, found `abc`",
    "a.pbrt --watch host:abc" -> "found `host:abc`",
    "--watch 70000 a.pbrt" -> "--watch must be PORT or ADDRESS:PORT",
    "--watch-after a.pbrt" -> "--watch-after needs --watch",
    "--display-server localhost: a.pbrt" -> "--display-server must be HOST:PORT",
    "--display-server x a.pbrt b.pbrt" -> "--display-server needs a single scene",
    "bench s.conf --seeds 0" -> "--seeds must be at least 1, found `0`",
    "compare a.exr" -> "reference",
    "compare a.exr b.exr c.exr" -> "takes image and reference; unexpected argument `c.exr`",
    "compare --max-relmse -1 a.exr b.exr" -> "--max-relmse must be at least 0, found `-1.0`",
    "compare --crop 1,2,3 a.exr b.exr" -> "--crop must be x0,x1,y0,y1 in pixels",
    "compare --heatmap-metric psnr a.exr b.exr" ->
      "--heatmap-metric must be one of mse, rmse, mae, relmse, flip"
  )

  for (line, message) <- refused do
    test(s"`$line` is bad usage: $message"):
      val answer = parse(line).left.toOption.get
      assert(answer.code == ExitCode.BadUsage)
      assert(answer.err.contains(message), answer.err)
      assert(answer.err.linesIterator.next().startsWith("error: "))
      assert(answer.out.isEmpty)

  test("an option that resembles none gets no suggestion, nor a value that is named already"):
    for line <- Vector("--xyzzy a.pbrt", "--sensor sensor a.xml") do
      assert(!parse(line).left.toOption.get.err.contains("did you mean"), line)

  private def help(line: String, columns: Int = 80): Vector[String] =
    val answer = CommandLine.parse(line.split(' ').toVector, columns).left.toOption.get
    assert(answer.code == ExitCode.Done && answer.err.isEmpty, line)
    answer.lines

  test("--help lists every command, and says how to see their options"):
    for line <- Vector("--help", "-h", "help", "a.pbrt --help", "-help", "--quick -h") do
      val text = help(line).mkString("\n")
      for c <- Command.values do assert(text.contains(s"\n  ${c.word} "), s"${c.word} in `$line`")
      assert(text.contains("`candela help COMMAND`") && text.contains("Exit codes"))

  test("help of a command, asked for in any way, has its options and no others"):
    for c <- Command.values do
      val text = help(s"${c.word} --help")
      assert(text.head.startsWith(s"usage: candela ${c.word}"))
      for line <- Vector(s"help ${c.word}", s"${c.word} -h", s"${c.word} x --help") do
        assert(help(line) == text, line)
      val listed = text.flatMap("^  (?:-\\w, )?--([a-z-]+)".r.findFirstMatchIn(_)).map(_.group(1))
      assert(listed.toSet == CommandTable.of(c).names.toSet + "help", c.word)

  test("help fits the terminal"):
    val lines = "help" +: Command.values.toVector.map(c => s"help ${c.word}")
    for columns <- Vector(80, 60); line <- lines do
      val tooLong = help(line, columns).filter(_.length > columns)
      assert(tooLong.isEmpty, line)

  test("-o is --outfile"):
    for line <- Vector("-o x.exr a.pbrt", "a.pbrt -o x.exr") do
      assert(parse(line) == Right(one.copy(outfiles = Vector("x.exr"))))
    assert(parse("merge a.film -o x.exr").toOption.get.outfiles == Vector("x.exr"))

  test("a name that is not UTF-8 is refused: all such names would be one"):
    for line <- Vector("a.pbrt --outfile \uFFFD.exr", "image \uFFFD.exr -o b.exr", "\uFFFD.pbrt") do
      val answer = parse(line).left.toOption.get
      assert(answer.code == ExitCode.BadUsage && answer.err.contains("is not UTF-8"), line)

  test("--version prints version, commit, the Java that runs it, and whether SIMD kernels do"):
    for line <- Vector("--version", "version", "-V") do
      val answer = parse(line).left.toOption.get
      assert(answer.code == ExitCode.Done && answer.lines.size == 3)
      val Vector(program, java, kernels) = answer.lines: @unchecked
      assert(program.matches(
        s"candela ${Version.current}(-SNAPSHOT)?(, commit [0-9a-f]{12}\\+?)?"
      ))
      assert(java.startsWith(s"Java ${System.getProperty("java.vm.version")}, "))
      assert(kernels.matches("SIMD kernels: (active|none: .*)"))

  test("a file of a command's name, or nearly, is a file"):
    assert(parse("render version") == Right(one.copy(files = Vector("version"))))
    assert(parse("viw.pbrt") == Right(one.copy(files = Vector("viw.pbrt"))))

  test("no word behind a single dash is so long that memory does not suffice for its parts"):
    for (count, more) <- Vector(1000 -> "", 100_000 -> "", 100_000 -> "check ") do
      val answer = parse(s"${more}a.pbrt -${"x" * count}").left.toOption.get
      assert(answer.err.startsWith(s"error: no option begins with `-${"x" * 19}`"))
      assert(answer.code == ExitCode.BadUsage)
