package candela.cli

import candela.base.{Problem, SceneError}
import candela.report.{RenderData, RenderPage, RenderReport}

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.util.Locale

/** Where reports go: `.html` for people, `.json` and `.csv` for machines. */
object ReportFiles:
  private val Endings = Vector("html", "json", "csv")

  /** Looks, before rendering, whether the files can be written.
    *
    * @throws SceneError if not
    */
  def checked(names: Vector[String]): Vector[Path] =
    val paths = names.map(OutputFiles.path).distinct
    val problems = paths.flatMap: path =>
      val folder = path.toAbsolutePath.getParent
      if !Endings.contains(ending(path)) then
        val help = Some("reports are written as .html, .json or .csv")
        Some(Problem.general(s"can't write the report `$path`", help))
      else if !Files.isDirectory(folder) then
        Some(Problem.general(s"can't write `$path`: there is no folder `$folder`"))
      else if Files.isDirectory(path) then
        Some(Problem.general(s"can't write the report `$path`: it is a folder"))
      else None
    if problems.nonEmpty then throw SceneError(problems)
    paths

  def write(paths: Vector[Path], report: RenderReport): Unit =
    for path <- paths do
      val text = ending(path) match
        case "html" => RenderPage.html(report)
        case "json" => RenderData.json(report)
        case _ => RenderData.csv(report)
      val _ = Files.write(path, text.getBytes(UTF_8))

  def ending(path: Path): String =
    val name = path.getFileName.toString
    name.drop(name.lastIndexOf('.') + 1).toLowerCase(Locale.ROOT)
