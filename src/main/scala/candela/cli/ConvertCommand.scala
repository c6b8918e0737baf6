package candela.cli

import candela.base.{Problem, SceneError, WholeFile}
import candela.build.TextureValues
import candela.convert.{Baking, Converter, Declarations, SceneText, SideFiles}
import candela.mitsuba.MitsubaScene
import candela.scenefile.{Dialect, Excerpts, Parser, SceneDescription}

import java.io.{BufferedWriter, OutputStreamWriter, Writer}
import java.nio.charset.StandardCharsets
import java.nio.file.{Files, Path}

/** `candela convert`: writes a scene in another dialect, or reformats it in its own. */
final class ConvertCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val out = options.outfiles.headOption.map(OutputFiles.path)
    out.foreach(check)
    val scene =
      Parser.whole(SceneLoader.readable(SceneLoader.existing(options.files.head), options))
    out.foreach(keepSource(_, scene))
    val folder = out.flatMap(f => Option(f.getParent)).getOrElse(Path.of(""))
    val to = options.to.getOrElse(scene.dialect)
    val files = SideFiles(folder)
    files.completing:
      val baking = options.bake.map(Baking(_, TextureValues.last(_).map(f => f(_, _, _))))
      val converted = Converter.convert(scene, to, files, options.toPly.orElse(meshSize), baking)
      val warnings = Excerpts.fill(converted.warnings)
      report.warnings(scene.warnings ++ warnings, all = options.verbose)
      out match
        case Some(path) =>
          WholeFile.write(path): file =>
            val writer = Files.newBufferedWriter(file, StandardCharsets.UTF_8)
            try SceneText.write(converted.scene, writer)
            finally writer.close()
          if !options.quiet then terminal.out.println(s"wrote $path  ${summary(to, warnings)}")
        case None => print(converted.scene)
      terminal.out.flush()
    ExitCode.Done

  /** Meshes of Mitsuba scenes come from files, and go to files. */
  private def meshSize: Option[Int] =
    Option.when(MitsubaScene.isNamed(Path.of(options.files.head)))(ConvertCommand.LargeMesh)

  private def summary(to: Dialect, warnings: Vector[Problem]): String =
    val dialect = to.toString.toLowerCase
    if warnings.isEmpty then dialect
    else s"$dialect, ${Figures.count(warnings.size, "warning")}"

  private def print(scene: SceneDescription): Unit =
    val encoder = OutputStreamWriter(terminal.out, StandardCharsets.UTF_8)
    val writer: Writer = BufferedWriter(encoder, 1 << 16)
    SceneText.write(scene, writer)
    writer.flush()

  private def check(path: Path): Unit =
    val folder = Option(path.toAbsolutePath.getParent)
    def fail(why: String) = throw SceneError(Problem.general(s"can't write `$path`: $why"))
    if Files.isDirectory(path) then fail("it is a folder")
    else if !folder.exists(Files.isDirectory(_)) then
      fail(s"no such folder: `${folder.getOrElse(path)}`")
    else if !folder.exists(Files.isWritable) then fail("no write permission in its folder")

  /** Refuses to overwrite an input: the output keeps neither its comments nor its includes. */
  private def keepSource(path: Path, scene: SceneDescription): Unit =
    var sources = Set(options.files.head)
    val _ = Declarations.map(scene): d =>
      sources += d.at.file
      d
    val isSource = Files.exists(path) &&
      sources.exists(s => Files.exists(Path.of(s)) && Files.isSameFile(Path.of(s), path))
    if isSource then
      val help = Some("choose another name with --outfile FILE")
      throw SceneError(Problem.general(s"`$path` is an input file; refusing to overwrite it", help))

object ConvertCommand:
  /** Triangles from which on a mesh of a Mitsuba scene becomes a PLY file. */
  private val LargeMesh = 100
