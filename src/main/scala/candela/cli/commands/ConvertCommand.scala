package candela.cli.commands

import candela.base.Figures
import candela.diagnostics.{Problem, SceneError, Severity}
import candela.io.WholeFile
import candela.build.TextureValues
import candela.cli.files.{FileRegister, FilmName, Output, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.convert.{Baking, Converter, SceneText, SideFiles}
import candela.job.{Render, SceneFormat, SceneName}
import candela.scenefile.{Dialect, Excerpts, Parser, SceneDescription, SceneFiles}

import java.io.{BufferedWriter, OutputStreamWriter, Writer}
import java.nio.channels.Channels
import java.nio.charset.StandardCharsets
import java.nio.file.Path
import java.util.Locale

/** `candela convert`: writes a scene in another dialect, or reformats it in its own. */
final class ConvertCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded(Render.withinLimits()(convert()))

  private def convert(): ExitCode =
    val target = options.outfiles.headOption.map: name =>
      OutputFiles.ofText(name, "convert writes scenes of pbrt", "pbrt")(!_.hasDialects)
    val output = Output(target.toVector, "scene", options.files.head)
    val register = FileRegister()
    val folder =
      if target.isEmpty && options.control.limits.sandbox then
        folderOf(OutputFiles.path(options.files.head))
      else target.fold(Path.of(""))(folderOf)
    if options.control.limits.sandbox then register.confine(Vector(folder))
    register.read(options.files.map(OutputFiles.path))
    register.check(output)
    val file = SceneName.existing(options.files.head)
    val scene = Parser.validated(Render.read(file, options.settings.reading, options.building))
    // The output keeps neither comments nor includes.
    register.read(SceneFiles.of(scene))
    register.write(output)
    val film = FilmName.problem(scene)
    for p <- film if p.severity == Severity.Error do throw SceneError(p)
    val to = options.to.getOrElse(scene.dialect.base)
    val files = SideFiles(
      folder,
      side => register.check(Output(Vector(side), "side file", options.files.head))
    )
    files.completing:
      val baking = options.bake.map(Baking(_, TextureValues.last(_).map(f => f(_, _, _))))
      val converted = Converter.convert(scene, to, files, options.toPly.orElse(meshSize), baking)
      val warnings = scene.warnings ++ film ++ Excerpts.fill(converted.warnings)
      report.warnings(warnings, all = options.verbose)
      target match
        case Some(path) =>
          WholeFile.write(path): channel =>
            val stream = Channels.newOutputStream(channel)
            write(converted.scene, OutputStreamWriter(stream, StandardCharsets.UTF_8))
          if !options.quiet then
            for added <- scene.additions do terminal.err.println(s"${options.files.head}: $added")
            terminal.out.println(s"wrote $path  ${summary(to, warnings)}")
        case None => write(converted.scene, terminal.data)
      terminal.out.flush()
    ExitCode.Done

  private def folderOf(file: Path): Path = Option(file.getParent).getOrElse(Path.of(""))

  /** Meshes that come from files go to files. */
  private def meshSize: Option[Int] =
    Option.when(SceneFormat.of(Path.of(options.files.head)).keepsMeshesApart):
      ConvertCommand.LargeMesh

  private def summary(to: Dialect, warnings: Vector[Problem]): String =
    val dialect = to.toString.toLowerCase(Locale.ROOT)
    if warnings.isEmpty then dialect
    else s"$dialect, ${Figures.count(warnings.distinct.size, "warning")}"

  private def write(scene: SceneDescription, to: Writer): Unit =
    val writer = BufferedWriter(to, 1 << 16)
    SceneText.write(scene, writer)
    writer.flush()

object ConvertCommand:
  /** Triangles from which on such a mesh becomes a PLY file. */
  private val LargeMesh = 100
