package candela.mitsuba

import candela.io.SceneFolder

import java.nio.file.Path

import scala.collection.mutable

/** What an object may contain, as the reader asks for it.
  *
  * @param name    of an object that needs none, its element: `<bsdf>`
  * @param kind    its element, or elements
  * @param default empty: there is none
  */
final case class Query(name: String, kind: String, default: String)

/** A type of Mitsuba, and what objects of it may contain. */
final case class DescribedPlugin(element: String, name: String, parameters: Vector[Query]):
  /** With the parameter of this name alone, if there is one. */
  def withParameter(name: String): Option[DescribedPlugin] =
    val named = parameters.filter(_.name.equalsIgnoreCase(name))
    Option.when(named.nonEmpty)(copy(parameters = named))

/** Describes the types that are read: an empty object of each is read, and what the reader asks of
  * it is noted.
  */
object TypeReference:
  /** By element, in its order. */
  val elements: Vector[String] = Vector(
    "shape", "bsdf", "emitter", "texture", "sensor", "film", "rfilter", "sampler", "integrator",
    "medium", "volume", "phase", "subsurface"
  )

  def types(element: String): Vector[String] = Plugins.read.getOrElse(element, Vector.empty)

  def describe(element: String, name: String): DescribedPlugin =
    val ofVersion = Vector("3.0.0", "0.6.0").map(parameters(element, name, _)).find(_.nonEmpty)
    DescribedPlugin(element, name, ofVersion.getOrElse(Vector.empty))

  private def parameters(element: String, name: String, version: String): Vector[Query] =
    val entries = mutable.LinkedHashMap.empty[String, Query]
    def observe(in: Properties): Unit =
      if in.plugin.kind == element && in.plugin.name == name then
        for a <- in.queries do
          if entries.get(a.name).forall(_.kind.isEmpty) then entries(a.name) = a
    val text = s"<scene version=\"$version\">${sceneOf(element, name)}</scene>"
    val file = Path.of("scene.xml")
    MitsubaScene.observe(file, SceneFolder.of(file), text)(observe)
    entries.values.filter(_.kind.nonEmpty).toVector

  /** The object, where such objects may be. */
  private def sceneOf(element: String, name: String): String =
    def in(outer: String, kind: String)(inner: String) = s"<$outer type=\"$kind\">$inner</$outer>"
    val label = element match
      case "texture" => " name=\"reflectance\""
      case "medium" => " name=\"interior\""
      case "volume" => " name=\"sigma_t\""
      case _ => ""
    val empty = s"<$element type=\"$name\"$label/>"
    element match
      case "emitter" if name == "area" => in("shape", "sphere")(empty)
      case "texture" => in("shape", "sphere")(in("bsdf", "diffuse")(empty))
      case "medium" | "subsurface" => in("shape", "sphere")(empty)
      case "film" | "sampler" => in("sensor", "perspective")(empty)
      case "rfilter" => in("sensor", "perspective")(in("film", "hdrfilm")(empty))
      case "phase" | "volume" =>
        val medium = if element == "phase" then "homogeneous" else "heterogeneous"
        in("shape", "sphere")(s"<medium type=\"$medium\" name=\"interior\">$empty</medium>")
      case _ => empty
