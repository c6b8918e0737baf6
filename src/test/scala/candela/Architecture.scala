package candela

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** A source file as the rules of the house see it.
  *
  * @param path from the root of its tree, with slashes: `bsdf/Lambert.scala`
  */
final case class SourceText(path: String, text: String):

  def lines: Vector[String] = text.linesIterator.toVector

  /** The lines without comments and literals: what the rules are about. */
  lazy val code: Vector[String] = SourceText.withoutProse(text).linesIterator.toVector

  /** Its folders, written as a package: `accel.building`; files outside any have none. */
  def folder: Option[String] =
    Option.when(path.contains('/'))(path.take(path.lastIndexOf('/')).replace('/', '.'))

object SourceText:

  /** All Scala sources of a tree, by path. */
  def under(root: Path): Vector[SourceText] =
    Using.resource(Files.walk(root)): found =>
      found.iterator.asScala.toVector
        .filter(_.toString.endsWith(".scala"))
        .map(file =>
          SourceText(
            root.relativize(file).iterator.asScala.mkString("/"),
            Files.readString(file)
          )
        )
        .sortBy(_.path)

  private val prose =
    """(?s)//[^\n]*|/\*.*?\*/|\"\"\".*?\"\"\"+|"(?:\\.|[^"\\\n])*"|'(?:\\[^\n]+?|[^'\\\n])'""".r

  /** The text with comments and literals blanked, each line still where it was. */
  def withoutProse(text: String): String =
    prose.replaceAllIn(text, found => found.matched.filter(_ == '\n'))

/** The rules of docs/ARCHITECTURE.md. Each takes sources and returns what is wrong with them, as
  * `path:line: what`, so that it can be tried on texts with planted violations.
  */
object Architecture:

  /** Lowest first: a package may use those before it. */
  val runtime: Vector[String] = floors(
    "base concurrency diagnostics io math color geometry sampling image textures shapes bsdf " +
      "bsdf.microfacet bsdf.layered " +
      "bsdf.measured bsdf.subsurface bsdf.composite lights media cameras film accel " +
      "accel.building accel.tracing scene aov guiding integrators bdpt photons mlt caustics " +
      "render render.storage"
  )
  val file: Vector[String] = floors("base concurrency diagnostics io math scenefile")

  /** Between the towers: each may use both of them, too. */
  val bridge: Vector[String] = floors(
    "settings build.recipe build.sampling build.film build.cameras build.textures build.media " +
      "build.shapes build.lights build.materials build.integrators build.options build"
  )

  private val common = Set("base", "concurrency", "diagnostics", "io", "math", "color")
  private val measure = common + "image"
  private val report = measure + "measure"
  private val convert =
    measure ++
      Set("build", "build.media", "cameras", "scenefile", "shapes") ++
      "bsdf bsdf.composite bsdf.layered bsdf.microfacet lights sampling".split(' ')
  private val mitsuba = common ++ Set("scenefile", "build.shapes")
  private val models =
    common ++ Set(
      "build.media", "build.shapes", "geometry", "image", "scenefile", "settings", "job"
    )
  private val towers = (runtime ++ file).toSet
  private val job = towers ++ bridge ++ Set("mitsuba", "measure")

  /** Rooms of the program. */
  val program: Vector[String] =
    floors("cli.terminal cli.options cli.files cli.rendering cli.commands cli")

  /** Rooms of the module of benchmarks. */
  val bench: Vector[String] =
    floors("bench.statistics bench.report bench.suite bench.peers bench.robustness bench")

  /** What each package may use beside itself. */
  val allowed: Map[String, Set[String]] =
    def below(tower: Vector[String]) = tower.indices.map(i => tower(i) -> tower.take(i).toSet)
    val rooms = below(bridge).map((room, lower) => room -> (towers ++ lower))
    below(runtime).toMap ++ below(file) ++ rooms ++ Map(
      "measure" -> measure,
      "convert" -> convert,
      "mitsuba" -> mitsuba,
      "job" -> job,
      "api" -> (job + "job"),
      "models" -> models,
      "models.assimp" -> (models + "models"),
      "report" -> report,
      "watch" -> (report ++ Set("film", "aov", "render", "report")),
      "moving" -> (job ++ Set("job", "convert", "report", "watch"))
    ) ++ below(program).map((room, lower) =>
      room -> (job ++ lower ++ Set("job", "convert", "report", "watch", "moving"))
    ) ++ below(bench).map: (room, lower) =>
      val commands = if room == "bench" then program.toSet else Set.empty
      room -> (job ++ lower ++ Set("job", "convert", "report") ++ commands)

  /** Libraries beside Java's and Scala's own, by the beginnings of their names: who knows them. */
  private val libraries = Map(
    "org.lwjgl" -> Set("image", "models.assimp"),
    "org.apache" -> Set("measure", "bench.statistics"),
    "scopt" -> Set("cli.options", "bench"),
    "sun" -> Set("cli", "cli.terminal"),
    "scalatags" -> Set("report", "bench.report"),
    "ujson" -> Set("report", "cli", "bench.report", "models", "models.assimp"),
    "com" -> Set("bench.suite"),
    "jdk" -> Set("accel.tracing")
  )
  private val language = Set("candela", "java", "javax", "scala")

  private val use = raw"\bcandela\s*\.\s*(\w+(?:\s*\.\s*[a-z]\w*)*)".r
  private val vague = raw"\bimport\s+(?:_root_\.)?candela(?:\s*\.\s*[{*]|\s+as\b)".r

  /** A package within another, by its last name alone. */
  private val nested =
    val names = allowed.keys.filter(_.contains('.')).map(_.split('.').last).mkString("|")
    raw"(?<![\w.])(?:$names)(?:\s*\.\s*[A-Z{*]|\s+as\b)".r

  private val imported = raw"^(?:import|export)\s+(?:_root_\.)?((?:org\.)?[a-z]\w*)\.".r
  private val fullName = raw"(?<![\w.])(org\.\w+|com|jdk|scopt|sun)\.\w".r // within code, too
  private val print = (raw"\b(?:println|printf|printStackTrace|Console)\b|\bprint\(|" +
    raw"\bSystem\.(?:out|err|in|exit)\b|\bsys\.exit\b|\.halt\(").r
  private val thread = (raw"\bThread\s*[(:{]|\b(?:extends|new)\s+Thread\b|\bThread\.(?:of|start)|" +
    raw"\b(?:Executors?|ExecutionContext|ForkJoinPool|CompletableFuture|Future|Timer)\b|" +
    raw"\bThreadPoolExecutor\b|\bThreadLocal\b|\.par\b|\bparallelStream\b|\.parallel\b").r

  /** The package within which a name lies: the longest beginning that has a floor. */
  private def packageOf(name: String): Option[String] =
    val parts = name.split(raw"\s*\.\s*")
    parts.indices.reverse.map(i => parts.take(i + 1).mkString(".")).find(allowed.contains)

  /** The package of a file: that of its folder, or of one around it. */
  def home(source: SourceText): Option[String] = source.folder.flatMap(packageOf)

  /** Every file lies in the folder of a package that has its floor, and says so once, on top. */
  def packages(sources: Vector[SourceText]): Vector[String] =
    sources.flatMap: source =>
      val said = source.code.zipWithIndex.filter(_._1.startsWith("package "))
      (source.folder, home(source)) match
        case (Some(folder), None) =>
          Vector(s"${source.path}:1: `$folder` has no floor in docs/ARCHITECTURE.md")
        case (_, Some(home)) if said.map(_._1.trim) == Vector(s"package candela.$home") =>
          Vector.empty
        case (_, home) =>
          val line = said.headOption.fold(1)(_._2 + 1)
          val name = home.getOrElse("<its folder>")
          Vector(s"${source.path}:$line: must say `package candela.$name`, once")

  /** Uses point down: by import or by full name, at places that say which package they mean. */
  def floors(sources: Vector[SourceText]): Vector[String] =
    code(sources): (home, line) =>
      val wrong =
        for
          name <- use.findAllMatchIn(line).map(_.group(1)).toVector
          used = packageOf(name).getOrElse(name.takeWhile(_ != '.'))
          if used != home && !allowed(home)(used) && !line.startsWith("package ")
        yield s"$home may not use $used"
      val hidden = (vague.findFirstIn(line) ++ nested.findFirstIn(line)).headOption
        .map(_ => "name a package of candela in full")
      wrong.distinct ++ hidden

  /** `base` needs but Java and Scala; other libraries stay behind the package they serve. */
  def foreign(sources: Vector[SourceText]): Vector[String] =
    code(sources): (home, line) =>
      val roots = (imported.findAllMatchIn(line) ++ fullName.findAllMatchIn(line)).map(_.group(1))
      for
        root <- roots.toVector.distinct
        if !language(root) && !libraries.getOrElse(root, Set.empty)(home)
      yield s"$home may not use the library `$root`"

  private val printing = program.toSet + "bench"

  /** Results go up as values; what to tell the user, and when to stop, is for `cli` to say. */
  def prints(sources: Vector[SourceText]): Vector[String] =
    code(sources): (home, line) =>
      val found = if printing.contains(home) then None else print.findFirstIn(line)
      found.map(what => s"only cli may print or exit, but here is `$what`")

  /** Only `render` makes threads. A shutdown hook must be one, and is `cli`'s business. */
  def threads(sources: Vector[SourceText]): Vector[String] =
    def may(s: SourceText) =
      home(s).contains("render") || s.path == "cli/terminal/Interrupts.scala"
    code(sources.filterNot(may)): (_, line) =>
      thread.findFirstIn(line).map(what => s"only render may make threads, but here is `$what`")

  private val write = (raw"\bFiles\.(?:write\w*|newOutputStream|newBufferedWriter|newByteChannel|" +
    raw"move|copy|createFile)\b|\bFileOutputStream\((?!FileDescriptor\b)|\b(?:FileWriter|" +
    raw"PrintWriter|RandomAccessFile|FileImageOutputStream)\b|\bImageIO\.write\b|" +
    raw"\bStandardOpenOption\.(?!READ\b)").r

  /** Files are written whole or not at all, by one class; a lock has no content. */
  def writes(sources: Vector[SourceText]): Vector[String] =
    val writers = Set("io/WholeFile.scala", "io/Scratch.scala", "render/storage/FilmLock.scala")
    code(sources.filterNot(s => writers(s.path))): (_, line) =>
      write.findFirstIn(line).map(what => s"only WholeFile may write files, but here is `$what`")

  private val localised =
    "(?<![-\\w}\"$])f\"|\"\\.format\\(|\\.to(?:Lower|Upper)Case\\b(?!\\(Locale)".r

  /** Digits and letters in texts are the same in all countries. */
  def locales(sources: Vector[SourceText]): Vector[String] =
    for
      source <- sources
      (line, i) <- source.lines.zipWithIndex
      what <- localised.findFirstIn(line)
    yield s"${source.path}:${i + 1}: `$what` depends on the locale"

  private val read = (raw"\bFiles\.\w+|\bFileChannel\.open\b|" +
    raw"\b(?:FileInputStream|FileReader|FileImageInputStream|RandomAccessFile)\b|" +
    raw"\bjava\.io\.File\b|\.toFile\b|\bSource\.fromFile\b|" +
    raw"\bInputFile\.(?:asked|again)\b|\bImageFiles\.read\b").r

  /** What scenes name is opened through one door, which can be closed. */
  def reads(sources: Vector[SourceText]): Vector[String] =
    val ofScenes = bridge.toSet ++ Set("scenefile", "mitsuba", "convert", "lights")
    // Excerpts are of files that were read, and side files are written
    val exempt = Set("scenefile/Excerpts.scala", "convert/SideFiles.scala")
    code(sources.filterNot(s => exempt(s.path))): (home, line) =>
      read.findFirstIn(line).filter(_ => ofScenes(home)).map: what =>
        s"only SceneFolder may open what a scene names, but here is `$what`"

  private val documented =
    raw"(?s)/\*\*((?:(?!\*/).)*)\*/\s*((?:[a-z]+(?:\[\w+\])? )*class (\w+))".r
  private val saysMutable = raw"(?:^|[.;,:] )[Mm]utable\b".r
  private val vectorMember =
    raw"\b(var|val|def) (\w+(?:, \w+)*)(\(.*\))?(?:: Vec3\b| = (?=Vec3\b))".r
  private val name = raw"([a-z]\w*(?:\.[a-z]\w*)*)"
  private val branch = raw"\b(?:then|else|=>) $name(?= else |$$)".r
  private val whole = raw"^(?: =)? +$name$$".r

  /** Vectors that a class documented as mutable overwrites are typed so: who gets a `Vec3` from it
    * may keep it.
    */
  def scratch(sources: Vector[SourceText]): Vector[String] =
    for
      source <- sources
      found <- documented.findAllMatchIn(source.text).toVector
      comment = found.group(1).replaceAll(raw"\s*\n\s*\*", "").trim
      if saysMutable.findFirstIn(comment).isDefined || found.group(3).startsWith("Mutable")
      start = source.text.take(found.start(2)).count(_ == '\n')
      (line, wrong) <- scratch(source.code.drop(start), found.group(3))
    yield s"${source.path}:${start + line + 1}: $wrong"

  /** @param code a class and what follows it */
  private def scratch(code: Vector[String], of: String): Vector[(Int, String)] =
    def depth(line: String) = line.takeWhile(_ == ' ').length
    val outer = depth(code(0))
    def within(line: String, depths: Int) =
      line.isBlank || depth(line) > depths || depth(line) == depths && line.trim.startsWith(")")
    val body = (code.head +: code.tail.takeWhile(within(_, outer))).zipWithIndex
    val members = body.filter((line, i) => i == 0 || depth(line) == outer + 2).flatMap: (line, i) =>
      vectorMember.findFirstMatchIn(line).map((_, i))
    val methods = members.collect { case (m, _) if m.group(1) == "def" => m.group(2) }.toSet
    members.flatMap: (member, i) =>
      val name = member.group(2)
      val rest = body.drop(i + 1).map(_._1).takeWhile(within(_, outer + 2)).filterNot(_.isBlank)
      val lines = (member.after.toString +: rest).filterNot(_.trim.matches("va[lr] .*"))
      val results = lines.flatMap(branch.findAllMatchIn) ++
        lines.lastOption.flatMap(whole.findFirstMatchIn)
      val kept = results.map(_.group(1)).filterNot: path =>
        methods(path) || path.endsWith(".toVec3") || path.endsWith(".normalized") ||
          rest.exists(_.trim.startsWith(s"val $path = ")) ||
          Option(member.group(3)).exists(_.contains(s"$path: Vec3"))
      if member.group(1) == "var" then
        Some(i -> s"$of overwrites `$name`: a MutableVec3 says so")
      else
        kept.headOption.map: path =>
          val help = "a MutableVec3 says so, toVec3 copies it"
          i -> s"$of may overwrite `$path`, which `$name` is: $help"

  private val wrapping = raw"\bclass (\w+)[^(\n]*\(".r
  private val wrapped = raw"(\w+): (?:Bsdf|Material|\w*Light)\b(?! =>)".r
  private val wrapper =
    raw"(?s)^\s*extends\b.*?\b\w*(?:Bsdf|CosineSampled|Material|Light)\b.*?:\n".r

  /** A BSDF, material or light made of another one answers as that does what it doesn't change: it
    * hands the other to a base class, which does so, or derives its flags from the other's.
    */
  def wrappers(sources: Vector[SourceText]): Vector[String] =
    for
      source <- sources
      code = source.code.mkString("", "\n", "\n")
      found <- wrapping.findAllMatchIn(code).toVector
      close = closing(code, found.end)
      parents <- wrapper.findFirstIn(code.drop(close)).toVector
      body = code.drop(close + parents.length)
      rest = wrapping.findFirstMatchIn(body).fold(body)(m => body.take(m.start))
      inner <- wrapped.findAllMatchIn(code.slice(found.end, close)).map(_.group(1))
      if !raw"[(,] *$inner *[,)]".r.findFirstIn(parents).isDefined
      if !raw"\b$inner\.flags\b|Flags\.of\($inner\)".r.findFirstIn(rest).isDefined
      line = code.take(found.start).count(_ == '\n') + 1
    yield s"${source.path}:$line: ${found.group(1)} loses the flags of `$inner`"

  /** Where the parenthesis before `from` is closed, behind it. */
  private def closing(code: String, from: Int): Int =
    val depths = code.drop(from).scanLeft(1): (depth, c) =>
      if c == '(' then depth + 1 else if c == ')' then depth - 1 else depth
    from + depths.indexOf(0)

  private val definition =
    (raw"^(?:(?:private|protected)(?:\[\w+\])? |final |abstract |sealed |case |" +
      raw"opaque )*(?:class|object|trait|enum|type) (\w+)").r

  /** One name, one meaning: build calls nothing as the runtime does. */
  def names(sources: Vector[SourceText]): Vector[String] =
    def defined(line: String) = definition.findFirstMatchIn(line).map(_.group(1))
    val taken =
      sources.filter(home(_).exists(runtime.contains)).flatMap(_.code.flatMap(defined)).toSet
    code(sources): (home, line) =>
      defined(line).filter(name => bridge.contains(home) && taken(name))
        .map(name => s"`$name` is the name of a class of the runtime, too")

  private val constant = raw"\bval\s+([A-Z]\w*)\s*(?::[^=]+)?=\s*-?[\d.]".r

  private val capitalised = raw"\b(?:val|def)\s+([A-Z]\w*)".r

  /** The name of a number says what it counts: `MaxDepth`, not `Most` or `MostDepth`. */
  def constants(sources: Vector[SourceText]): Vector[String] =
    for
      source <- sources
      (line, i) <- source.code.zipWithIndex
      fault <-
        constant.findAllMatchIn(line).map(_.group(1)).filter(FunctionWords.contains)
          .map(name => s"`$name` does not say what it counts") ++
          capitalised.findAllMatchIn(line).map(_.group(1))
            .flatMap(name => FunctionWords.prefixed(name).map(n => s"`$name` is usually `$n`"))
    yield s"${source.path}:${i + 1}: $fault"

  private val declaration = raw"\b(?:val|var|def)\s+([a-z]\w*)".r

  /** What is declared is named for what it is: `hit`, not `found`. */
  def declarations(sources: Vector[SourceText]): Vector[String] =
    for
      source <- sources
      (line, i) <- source.code.zipWithIndex
      name <- declaration.findAllMatchIn(line).map(_.group(1))
      if FunctionWords.contains(name) && !FunctionWords.terms(name)
    yield s"${source.path}:${i + 1}: `$name` does not say what it is"

  /** A file fits in the mind, a line on the screen. */
  def sizes(sources: Vector[SourceText]): Vector[String] =
    sources.flatMap: source =>
      val count = source.lines.size
      val long = Option.when(count > MaxLines)(
        s"${source.path}:${MaxLines + 1}: $count lines are more than $MaxLines"
      )
      long ++ source.lines.zipWithIndex.collect:
        case (line, i) if width(line) > MaxColumns =>
          s"${source.path}:${i + 1}: ${width(line)} columns are more than $MaxColumns"

  val MaxLines = 400
  val MaxColumns = 100

  private def width(line: String): Int = line.codePointCount(0, line.length)

  private def floors(names: String): Vector[String] = names.split(" ").toVector

  /** Applies a rule to each line of code of each package, and puts the place before its answers. */
  private def code(sources: Vector[SourceText])(
      rule: (String, String) => IterableOnce[String]
  ): Vector[String] =
    for
      source <- sources
      home <- home(source).toVector
      (line, i) <- source.code.zipWithIndex
      wrong <- rule(home, line).iterator
    yield s"${source.path}:${i + 1}: $wrong"
