package candela.bench.suite

import candela.diagnostics.{Code, Problem, SceneError, SourcePos, Suggest}
import candela.io.FileName
import candela.bench.report.Growth
import candela.job.SceneFormat

import com.typesafe.config.{
  Config, ConfigException, ConfigFactory, ConfigOrigin, ConfigParseOptions
}

import java.nio.file.{Files, Path}
import java.util.regex.PatternSyntaxException

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** Reads suites in HOCON (a superset of JSON with comments); docs/BENCH.md documents the format.
  * File names are relative to the suite's folder.
  */
object SuiteFile:

  /** @throws SceneError if it is invalid */
  def read(path: Path): Suite =
    try
      val options = ConfigParseOptions.defaults.setAllowMissing(false)
      // Includes are found beside a file whose folder is known, and are ignored where they are not
      val file = path.toAbsolutePath
      suite(ConfigFactory.parseFile(file.toFile, options).resolve(), file)
    catch
      case e: ConfigException =>
        // Some of its messages begin with the file
        val reason = e.getMessage.linesIterator.next().stripPrefix(s"${path.toAbsolutePath}: ")
        throw wrong(s"$path: $reason")
      case e: PatternSyntaxException =>
        throw wrong(s"$path: invalid regular expression: ${e.getMessage.linesIterator.next()}")
      case e: SceneError =>
        val absolutePath = path.toAbsolutePath.toString
        throw SceneError(e.problems.map: p =>
          p.copy(pos =
            p.pos.map(at => if at.file == absolutePath then at.copy(file = s"$path") else at)
          ))

  private val suiteKeys = Set("title", "samples", "seconds", "seeds", "timeout") ++
    Set("programs", "scenes")
  private val programKeys = Set("title", "command", "reads", "threads", "edits", "seeded") ++
    Set("color", "thin", "needs", "layer", "family", "counterpart")
  private val sceneKeys = Set("title", "note", "files", "reference", "samples", "seconds") ++
    Set("target", "programs", "needs", "grows")

  private def suite(c: Config, file: Path): Suite =
    // Keys for substitution only start with an underscore: `_flags`.
    checkKeys(c, suiteKeys, "the suite")
    val programNames = named(c, "programs", file)
    val programs = programNames.zipWithIndex.map: (n, i) =>
      val entries = c.getConfig(s"programs.$n")
      checkPrograms(entries, "counterpart", s"program $n", programNames)(singleText)
      program(n, entries, i)
    val scenes = named(c, "scenes", file).map: n =>
      val entries = c.getConfig(s"scenes.$n")
      checkPrograms(entries, "programs", s"scene $n", programNames)(texts)
      scene(n, entries, file.getParent)
    Suite(
      text(c, "title", FileName.stem(file)),
      programs,
      scenes,
      work(c).getOrElse(Work.Samples(Vector(1, 4, 16, 64))),
      positive(c, "seeds", 3),
      if c.hasPath("timeout") then c.getDouble("timeout") else DefaultTimeout
    )

  /** In seconds. */
  val DefaultTimeout = 600.0

  /** In file order, those of included files last. */
  private def named(c: Config, key: String, file: Path): Vector[String] =
    val entries = c.getObject(key)
    val suiteFile = Option(file.toString)
    entries.keySet.asScala.toVector.sortBy: k =>
      val origin = entries.get(k).origin
      (Option(origin.filename) != suiteFile, origin.lineNumber)

  private def program(name: String, c: Config, index: Int): Program =
    checkKeys(c, programKeys, s"program $name")
    val command = if c.hasPath("command") then c.getString("command") else ""
    val words = command.split(' ').toVector.filter(_.nonEmpty)
    filled(c, "command", s"program $name", Commands.Placeholders)
    for w <- words if w.contains(Commands.Self) && w != Commands.Self do
      throw wrong(s"`${Commands.Self}` must be a word of its own in program $name, found `$w`")
    Program(
      name,
      text(c, "title", name),
      words,
      texts(c, "reads"),
      positive(c, "threads", Runtime.getRuntime.availableProcessors),
      if c.hasPath("edits") then c.getConfigList("edits").asScala.toVector.map(edit(_, name))
      else Vector.empty,
      !c.hasPath("seeded") || c.getBoolean("seeded"),
      if c.hasPath("color") then c.getInt("color") else index,
      c.hasPath("thin") && c.getBoolean("thin"),
      if c.hasPath("needs") then texts(c, "needs") else Vector.empty,
      Option.when(c.hasPath("layer"))(c.getString("layer")),
      Option.when(c.hasPath("family"))(c.getString("family")),
      Option.when(c.hasPath("counterpart"))(c.getString("counterpart"))
    )

  private def edit(c: Config, program: String): Edit =
    checkKeys(c, Set("find", "replace"), s"`edits` of program $program")
    filled(c, "replace", s"an edit of program $program", Commands.EditPlaceholders)
    Edit(c.getString("find").r, c.getString("replace"))

  /** Neither a shell's `${NAME}` nor what follows a backslash. */
  private val Placeholder = """(?<![$\\])\{\w+\}""".r

  /** Rejects unknown placeholders, because programs would get them as they are. */
  private def filled(c: Config, key: String, where: String, placeholders: Vector[String]): Unit =
    if c.hasPath(key) then
      for
        placeholder <- Placeholder.findAllIn(c.getString(key))
        if !placeholders.contains(placeholder)
      do
        val message = s"unknown placeholder `$placeholder` in $where"
        throw unknown(message, placeholder, placeholders, c.getValue(key).origin)

  private def checkPrograms(c: Config, key: String, where: String, programNames: Vector[String])(
      names: (Config, String) => Vector[String]
  ): Unit =
    if c.hasPath(key) then
      for name <- names(c, key) if !programNames.contains(name) do
        val message = s"unknown program `$name` in `$key` of $where"
        throw unknown(message, name, programNames, c.getValue(key).origin)

  /** An unknown name, with its place and the nearest known one. */
  private def unknown(
      message: String,
      name: String,
      candidates: Iterable[String],
      origin: ConfigOrigin
  ): SceneError =
    val text =
      for
        file <- Option(origin.filename)
        lines <- Try(Files.readAllLines(Path.of(file)).asScala.toVector).toOption
        // Of a value in parts, the origin is that of the first one
        first = origin.lineNumber - 1
        index = Some(lines.indexWhere(_.contains(name), first)).filter(_ >= 0).getOrElse(first)
        text <- lines.lift(index)
      yield (SourcePos(file, index + 1, math.max(text.indexOf(name), 0) + 1), text)
    val problem =
      Problem.error(Code.SuiteFile, text.map(_._1), message, Suggest.help(name, candidates))
    SceneError(problem.copy(excerpt = text.map(_._2)))

  private def scene(name: String, c: Config, folder: Path): SuiteScene =
    checkKeys(c, sceneKeys, s"scene $name")
    val files = c.getConfig("files")
    SuiteScene(
      name,
      text(c, "title", name),
      text(c, "note", ""),
      files.root.keySet.asScala.map(k => k -> folder.resolve(files.getString(k))).toMap,
      Option.when(c.hasPath("reference"))(folder.resolve(c.getString("reference"))),
      work(c),
      Option.when(c.hasPath("target"))(c.getDouble("target")),
      Option.when(c.hasPath("programs"))(texts(c, "programs")),
      if c.hasPath("needs") then texts(c, "needs") else Vector.empty,
      Option.when(c.hasPath("grows"))(growth(c.getConfig("grows"), name))
    )

  private def growth(c: Config, scene: String): Growth =
    checkKeys(c, Set("of", "size"), s"`grows` of scene $scene")
    val size = c.getDouble("size")
    if !(size > 0) then
      throw wrong(s"`size` must be greater than 0, found `${c.getString("size")}`")
    Growth(c.getString("of"), size)

  private def work(c: Config): Option[Work] =
    if c.hasPath("samples") then
      val counts = unique("samples", c.getIntList("samples").asScala.toVector.map(_.intValue))
      if counts.isEmpty || counts.head < 1 then throw wrong("`samples` must be at least 1")
      Some(Work.Samples(counts))
    else if c.hasPath("seconds") then
      val budgets =
        unique("seconds", c.getDoubleList("seconds").asScala.toVector.map(_.doubleValue))
      if budgets.isEmpty || budgets.head <= 0 then throw wrong("`seconds` must be greater than 0")
      Some(Work.Seconds(budgets))
    else None

  /** In order. */
  private def unique[N: Ordering](key: String, all: Vector[N]): Vector[N] =
    for n <- Work.repeated(all) do throw wrong(s"`$key` has `$n` twice")
    all.sorted

  /** Rejects unknown keys, because a misspelt one must not be ignored. */
  private def checkKeys(c: Config, keys: Set[String], where: String): Unit =
    for key <- c.root.keySet.asScala.toVector.sorted if !keys(key) && !key.startsWith("_") do
      throw unknown(s"unknown key `$key` in $where", key, keys, c.root.get(key).origin)

  private def text(c: Config, key: String, other: String): String =
    if c.hasPath(key) then c.getString(key) else other

  private def singleText(c: Config, key: String): Vector[String] = Vector(c.getString(key))

  private def texts(c: Config, key: String): Vector[String] = c.getStringList(key).asScala.toVector

  private def positive(c: Config, key: String, other: Int): Int =
    val value = if c.hasPath(key) then c.getInt(key) else other
    if value < 1 then throw wrong(s"`$key` must be at least 1, found `$value`")
    value

  private def wrong(message: String): SceneError =
    SceneError(Problem.general(Code.SuiteFile, message))

/** A folder as a suite: all scenes of the known formats, such as `NAME.pbrt`, each with a reference
  * `NAME.exr` if there is one.
  */
object SuiteFolder:

  /** @throws SceneError if there is no scene */
  def read(folder: Path, references: Path): Suite =
    val scenes = scala.util.Using.resource(Files.list(folder)): files =>
      files.iterator.asScala.toVector.filter(SceneFormat.named(_).exists(!_.isMesh)).sorted
    if scenes.isEmpty then
      val help = s"scenes are of ${SceneFormat.inWords}"
      throw SceneError(Problem.general(Code.SuiteFile, s"no scene in $folder", Some(help)))
    val files = scenes.groupBy(SceneFormat.stem)
    suite(
      folder,
      scenes.map: file =>
        val stem = SceneFormat.stem(file)
        // Of several formats
        val name = if files(stem).sizeIs > 1 then file.getFileName.toString else stem
        val reference = references.resolve(s"$stem.exr")
        scene(name, file, Option.when(Files.isRegularFile(reference))(reference))
    )

  /** A single scene, without a reference. */
  def ofScene(file: Path): Suite = suite(file, Vector(scene(SceneFormat.stem(file), file, None)))

  private def suite(source: Path, scenes: Vector[SuiteScene]): Suite = Suite(
    source.toAbsolutePath.getFileName.toString,
    Vector(candela),
    scenes,
    Work.Samples(Vector(1, 4, 16)),
    3,
    SuiteFile.DefaultTimeout
  )

  private val candela: Program =
    val command = "{candela} {scene} --quiet --spp {spp} --seed {seed} --nthreads {threads} " +
      "--outfile {out}"
    val threads = Runtime.getRuntime.availableProcessors
    Program(
      "candela",
      "Candela",
      command.split(' ').toVector,
      Vector("scene"),
      threads,
      Vector.empty,
      isSeeded = true,
      color = 0,
      isThin = false
    )

  private def scene(name: String, file: Path, reference: Option[Path]): SuiteScene =
    SuiteScene(
      name,
      name,
      "",
      Map("scene" -> file),
      reference,
      None,
      None,
      None,
      Vector.empty
    )
