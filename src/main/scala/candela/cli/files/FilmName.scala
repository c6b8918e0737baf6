package candela.cli.files

import candela.diagnostics.{Code, Problem, SourcePos}
import candela.scenefile.{Excerpts, SceneDescription}

import java.nio.file.Path

import scala.util.Try

/** The image file that a scene names: it may be anywhere. */
private[cli] object FilmName:

  /** Where the name is. */
  def position(scene: SceneDescription): Option[SourcePos] =
    scene.film.flatMap(_.param("filename")).map(_.valuesAt)

  /** What is to be said of a name that leads out of the folder where images go: the current one; of
    * a confined scene, its own, which it must not leave.
    */
  def problem(scene: SceneDescription): Option[Problem] =
    for
      p <- scene.film.flatMap(_.param("filename"))
      name <- p.strings.headOption
      path <- Try(Path.of(name)).toOption
      kind <- leaving(path)
      problem = pathProblem(scene, p.valuesAt, name, kind)
    yield Excerpts.fill(Vector(problem), Excerpts.sources(scene.text)).head

  private def leaving(path: Path): Option[String] =
    if path.isAbsolute then Some("an absolute path")
    else
      Option.when((0 until path.getNameCount).exists(path.getName(_).toString == "..")):
        "a path through `..`"

  private def pathProblem(
      scene: SceneDescription,
      at: SourcePos,
      name: String,
      kind: String
  ): Problem =
    if scene.folder.isConfined then
      val message = s"expected an image in the scene's folder, found $kind: `$name`"
      Problem.error(Code.ImageName, at, message, Some("--outfile FILE says where the image goes"))
    else
      val workingFolder = Path.of("").toAbsolutePath
      val target = workingFolder.resolve(name).normalize
      val relative = Try(workingFolder.relativize(target)).getOrElse(target)
      val message = s"the scene names its image by $kind; from this folder, it goes to `$relative`"
      Problem.warning(Code.ImageName, at, message, Some("--outfile FILE sends it elsewhere"))
