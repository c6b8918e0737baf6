package candela.mitsuba

import candela.base.Decimal
import candela.color.Srgb

import java.util.Locale
import scala.util.Try

/** Names and conventions of versions before 2, as those of Mitsuba 3.
  *
  * @param minor version 0.`minor`
  */
private[mitsuba] final class OldNames(minor: Int):
  import OldNames.*

  /** @param parent the tag of the element around it */
  def upgraded(e: Element, parent: String = "scene"): Element =
    val tag = Tags.getOrElse(e.tag, e.tag)
    val isObject = Values.Kinds(tag) && (tag != "spectrum" || e("type").isDefined)
    val oldType = e("type").filter(_ => isObject).map(_.toLowerCase(Locale.ROOT))
    val attributes = e.attributes.map:
      case ("name", text) => "name" -> renamed(OldSurfaces.renamed(e.tag, snake(text)), parent)
      case ("type", _) if isObject => "type" -> typeOf(tag, oldType.get)
      case other => other
    val children = e.children.map(upgraded(_, if isObject then s"$tag ${oldType.get}" else tag))
    val (moved, remaining) = children.partition(c => Moved(c("name").getOrElse("")))
    val inner =
      if tag == "texture" && moved.nonEmpty then remaining :+ toUv(moved, e)
      else children ++ (if isObject then added(e, tag, oldType.get, children) else Vector.empty)
    val formerName = e("name").filterNot(attributes.get("name").contains)
    val plain = Element(tag, attributes, inner, e.pos, formerName, isOld = true)
    tag match
      case "srgb" => decoded(plain)
      // Often `nan`
      case "spectrum" if parent == "integrator field" =>
        text("undefined", e("value").getOrElse(""), plain)
      case "spectrum" if isWhite(plain, parent) || isThree(plain) => plain.copy(tag = "rgb")
      case "boolean" if minor < 4 && attributes.get("name").contains("map_smaller_side") =>
        val axis = if e("value").contains("false") then "larger" else "smaller"
        text("fov_axis", axis, plain)
      case "boolean" if parent.startsWith("film ") && attributes.get("name").contains("alpha") =>
        text("pixel_format", if e("value").contains("true") then "rgba" else "rgb", plain)
      case "rotate" => aboutUnit(plain)
      case "lookat" if e("ox").isDefined => ofNumbers(plain)
      case _ => plain

  /** Names that changed before 0.6. */
  private def renamed(name: String, parent: String): String = (name, parent) match
    case ("intensity", "emitter area" | "emitter constant") => "radiance"
    case ("intensity", "emitter directional") => "irradiance"
    case ("inverted", "shape sphere") => "flip_normals"
    case ("p1", "shape cylinder") if minor < 3 => "p0"
    case ("p2", "shape cylinder") if minor < 3 => "p1"
    case ("intensity_scale", _) => "scale"
    case ("focus_depth", _) => "focus_distance"
    case _ => name

  /** What an object without it had in its version. */
  private def added(
      e: Element,
      tag: String,
      oldType: String,
      children: Vector[Element]
  ): Vector[Element] =
    def hasChild(name: String) = children.exists(_("name").contains(name))
    def value(tag: String, name: String, text: String) =
      Element(tag, Map("name" -> name, "value" -> text), Vector.empty, e.pos)
    (tag, oldType) match
      case ("sensor", "perspective") if minor < 4 && !hasChild("fov_axis") =>
        Vector(value("string", "fov_axis", "smaller"))
      case ("shape", "obj") if minor < 3 && !hasChild("flip_tex_coords") =>
        Vector(value("boolean", "flip_tex_coords", "false"))
      case _ => OldSurfaces.added(e)

  /** A light's spectrum of one value is that of daylight. */
  private def isWhite(e: Element, parent: String): Boolean =
    parent.startsWith("emitter ") && e("type").isEmpty &&
      e("value").exists(v => Decimal.double(v.trim).isDefined)

  /** Without wavelengths there are as many values as spectra have: three, red, green and blue, in
    * the usual build.
    */
  private def isThree(e: Element): Boolean =
    e("type").isEmpty && e("value").exists(v => !v.contains(':') && Values.words(v).size == 3)

  /** As linear colour. */
  private def decoded(e: Element): Element =
    val words = Values.words(e("value").getOrElse(""))
    val encoded =
      if words.length == 1 && words(0).startsWith("#") then
        words(0).drop(1).grouped(2).toVector
          .flatMap(h => Try(Integer.parseInt(h, 16)).toOption).map(_ / 255f)
      else words.toVector.flatMap(Decimal.float)
    val isWhole = encoded.size == 3 || encoded.size == 1 && words.length == 1
    if !isWhole then e.copy(tag = "rgb")
    else
      val linear = encoded.map(Srgb.decode(_)).mkString(" ")
      e.copy(tag = "rgb", attributes = e.attributes.updated("value", linear))

  /** Axes of rotations are normalised. */
  private def aboutUnit(e: Element): Element =
    val axis =
      Seq("x", "y", "z").map(k => k -> e(k).flatMap(t => Decimal.double(t.trim)).getOrElse(0.0))
    val length = Math.sqrt(axis.map((_, c) => c * c).sum)
    if !(length > 0) || length.isInfinite then e
    else e.copy(attributes = e.attributes ++ axis.map((k, c) => k -> (c / length).toString))

  private def text(name: String, value: String, e: Element): Element =
    e.copy(tag = "string", attributes = Map("name" -> name, "value" -> value))

  /** Of version 0.2. */
  private def ofNumbers(e: Element): Element =
    def triple(of: Char) =
      Seq("x", "y", "z").map(axis => e(s"$of$axis").getOrElse("0")).mkString(" ")
    val points = Map("origin" -> triple('o'), "target" -> triple('t'))
    e.copy(attributes = if e("ux").isDefined then points.updated("up", triple('u')) else points)

private[mitsuba] object OldNames:
  /** Those of a scene's version, if it is old; before 0.3, there was none. */
  def of(scene: Element): Option[OldNames] =
    if scene("version").nonEmpty then ofVersion(scene)
    else if scene.children.exists(e => FirstTags(e.tag)) then Some(OldNames(2))
    else Option.when(hasTransform(scene))(OldNames(6))

  /** Whether a transform has the name of 0.6. */
  private def hasTransform(e: Element): Boolean =
    e("name").contains("toWorld") || e.children.exists(hasTransform)

  private def ofVersion(scene: Element): Option[OldNames] =
    val numbers = scene("version").toVector.flatMap(_.split('.')).map(_.toIntOption)
    numbers.headOption.flatten.filter(_ < 2).map: major =>
      OldNames(if major == 1 then 6 else numbers.lift(1).flatten.getOrElse(6))

  private val FirstTags = Set("camera", "luminaire")

  private val Tags = Map("lookAt" -> "lookat", "camera" -> "sensor", "luminaire" -> "emitter")

  /** Types that were renamed before 0.6. */
  private val Types: Map[(String, String), String] = Map(
    ("film", "exrfilm") -> "hdrfilm",
    ("film", "pngfilm") -> "ldrfilm",
    ("integrator", "errctrl") -> "adaptive"
  )

  private def typeOf(tag: String, name: String): String =
    Types.getOrElse((tag, name), OldSurfaces.typeOf(tag, name))

  private val Moved = Set("uoffset", "voffset", "uscale", "vscale", "uvscale")

  /** Offsets and scales of texture coordinates, as the transform that replaced them. */
  private def toUv(moved: Vector[Element], e: Element): Element =
    def value(name: String, default: String) =
      moved.find(_("name").contains(name)).flatMap(_("value")).getOrElse(default)
    def step(tag: String, x: String, y: String) =
      Element(tag, Map("x" -> x, "y" -> y), Vector.empty, e.pos)
    val uniformScale = value("uvscale", "1")
    val steps = Vector(
      step("scale", value("uscale", uniformScale), value("vscale", uniformScale)),
      step("translate", value("uoffset", "0"), value("voffset", "0"))
    )
    Element("transform", Map("name" -> "to_uv"), steps, e.pos)

  /** `to_world` as `toWorld`, `int_ior` as `intIOR`. */
  def camel(name: String): String =
    val words = name.split('_').filter(_.nonEmpty)
    words.take(1).mkString +
      words.drop(1).map(word => if word == "ior" then "IOR" else word.capitalize).mkString

  /** `toWorld` as `to_world`, `intIOR` as `int_ior`. */
  def snake(name: String): String =
    name.replaceAll("(?<=[a-z])(?=[A-Z])", "_").split("(?<=_)").map: part =>
      if part.headOption.exists(_.isUpper) then part.toLowerCase(Locale.ROOT) else part
    .mkString
