package candela.mitsuba

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.SceneFolder
import candela.scenefile.{Resolution, SceneDescription}

import java.nio.file.Path

/** A file with a camera: a `<sensor>`, or a `<scene>`, whose first one is taken.
  *
  * @param folder  that names of files are relative to
  * @param defines values of `$name`; those that it hasn't are the scene's
  * @throws SceneError if it is no such file
  */
final class SensorFile(
    file: Path,
    folder: SceneFolder,
    text: String,
    defines: Map[String, String]
):
  private val expanded = MitsubaScene.withExcerpts(file, Some(text)):
    Expansion(file, folder, defines, Some(root), usedElsewhere = defines.keySet).result()

  /** Names of values that it has. */
  def parameters: Set[String] = expanded.parameters

  /** A scene of nothing but the camera, with all problems. */
  def view(keepGoing: Boolean, resolution: Option[Resolution]): SceneDescription =
    val elements = expanded.elements.find(_.tag == "sensor").toVector.flatMap(withReferenced)
    val session = Session(expanded.of(elements), folder, keepGoing, resolution = resolution)
    val ignored = expanded.elements.filterNot(elements.contains)
    for first <- ignored.headOption if elements.nonEmpty do
      val tags = ignored.map(e => s"<${e.tag}>").distinct.sorted.mkString(", ")
      val message = s"of this file only the first <sensor> is taken; ignored: $tags"
      session.warn(Code.Nesting, first.pos, message)
    MitsubaScene.translated(expanded, session, file, folder, Some(text))

  private def root: Element =
    val element = XmlFile.ofText(file.toString, text)
    element.tag match
      case "scene" => element
      case "sensor" => Element("scene", Map("version" -> "3.0.0"), Vector(element), element.pos)
      case tag =>
        val message = s"expected <sensor> or <scene>, found <$tag>"
        throw SceneError(Problem.error(Code.Nesting, element.pos, message))

  /** With the elements of the scene that it refers to. */
  private def withReferenced(e: Element): Vector[Element] =
    def references(e: Element): Vector[String] =
      if e.tag == "ref" then e("id").map(id => expanded.aliases.getOrElse(id, id)).toVector
      else e.children.flatMap(references)
    def grown(elements: Vector[Element]): Vector[Element] =
      val ids = elements.flatMap(references).toSet
      val referenced = expanded.elements.filter(e => e("id").exists(ids) && !elements.contains(e))
      if referenced.isEmpty then elements else grown(elements ++ referenced)
    grown(Vector(e))
