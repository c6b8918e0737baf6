package candela.bench.peers

import candela.color.Rgb
import candela.convert.SideFiles
import candela.math.{clamp, sqrt}
import candela.scenefile.*

import scala.collection.mutable

/** Scale and offset of texture coordinates: meshes are written with those of their texture. */
private[peers] final case class UvMapping(scaleU: Float, scaleV: Float, du: Float, dv: Float)

/** @param mapping of its textures; None if it has none */
private[peers] final case class ExchangeMaterial(id: String, mapping: Option[UvMapping])

/** The materials of a scene as Mitsuba's elements. */
private[peers] final class ExchangeMaterials(
    scene: SceneDescription,
    files: SideFiles,
    values: ExchangeValues
):
  private val named = scene.namedMaterials.toMap
  private val textures = scene.textures.map(t => t.name -> t.texture).toMap
  private val converted =
    mutable.LinkedHashMap.empty[Option[Declaration], (ExchangeMaterial, String)]

  def of(ref: MaterialRef): ExchangeMaterial =
    val declared = ref.declared(named)
    converted.getOrElseUpdate(declared, element(declared, s"m${converted.size}"))._1

  /** Those that shapes have asked for. */
  def elements: Vector[String] = converted.values.map(_._2).toVector

  private var mapping: Option[UvMapping] = None

  private def element(declared: Option[Declaration], id: String): (ExchangeMaterial, String) =
    val d = declared.getOrElse(ExchangeScene.plain("Material", "diffuse"))
    mapping = None
    val text = d.name match
      case "diffuse" =>
        values.rejectOthers(d, "type", "reflectance")
        twoSided(id, s"""<bsdf type="diffuse">${reflectance(d)}</bsdf>""")
      case "conductor" =>
        values.rejectOthers(d, ("type" +: "eta" +: "k" +: "reflectance" +: Roughness)*)
        twoSided(id, rough(d, "conductor", "")(metal(d)))
      case "dielectric" =>
        values.rejectOthers(d, ("type" +: "eta" +: Roughness)*)
        rough(d, "dielectric", s""" id="$id"""")(ior(d))
      case "thindielectric" =>
        values.rejectOthers(d, "type", "eta")
        s"""<bsdf type="thindielectric" id="$id">${ior(d)}</bsdf>"""
      case other =>
        values.reject(s"material \"$other\"")
        ""
    ExchangeMaterial(id, mapping) -> s"  $text"

  private val Roughness = Vector("roughness", "uroughness", "vroughness", "remaproughness")

  private def twoSided(id: String, inner: String) =
    s"""<bsdf type="twosided" id="$id">$inner</bsdf>"""

  private def ior(d: Declaration): String =
    s"""<float name="int_ior" value="${values.index(d, "eta", 1.5f)}"/>""" +
      """<float name="ext_ior" value="1"/>"""

  private def metal(d: Declaration): String =
    val (eta, k) = d.param("reflectance") match
      case Some(p) =>
        val r = values.color(d, p).map(clamp(_, 0f, 0.9999f))
        (Rgb.White, r.map(x => 2f * sqrt(x) / sqrt(1f - x)))
      case None => (index(d, "eta"), index(d, "k"))
    values.rgbElement("eta", eta) + values.rgbElement("k", k)

  /** pbrt's default is copper. */
  private def index(d: Declaration, name: String): Rgb =
    val copper = Param(ParamType.Spectrum, name, d.pos, d.pos, strings = Vector(s"metal-Cu-$name"))
    values.color(d, d.param(name).getOrElse(copper))

  private def rough(d: Declaration, kind: String, id: String)(inner: String): String =
    val isotropic = values.number(d, "roughness", 0f)
    val (u, v) =
      (values.number(d, "uroughness", isotropic), values.number(d, "vroughness", isotropic))
    if u != v then values.reject("anisotropic roughness")
    val isRaw = d.param("remaproughness").exists(_.bools.contains(false))
    val alpha = if isRaw then u else sqrt(u)
    if alpha < Smooth then s"""<bsdf type="$kind"$id>$inner</bsdf>"""
    else
      s"""<bsdf type="rough$kind"$id>$inner<string name="distribution" value="ggx"/>""" +
        s"""<float name="alpha" value="$alpha"/></bsdf>"""

  /** As in pbrt-v4. */
  private val Smooth = 1e-3f

  private def reflectance(d: Declaration): String = d.param("reflectance") match
    case None => values.rgbElement("reflectance", Rgb.gray(0.5f))
    case Some(p) if p.paramType == ParamType.Texture => texture(p.strings.head)
    case Some(p) => values.rgbElement("reflectance", values.color(d, p).map(clamp(_, 0f, 1f)))

  private def texture(name: String): String = textures.get(name) match
    case Some(d) if d.name == "constant" =>
      val c = d.param("value").fold(Rgb.White)(values.color(d, _))
      values.rgbElement("reflectance", c.map(clamp(_, 0f, 1f)))
    case Some(d) if d.name == "imagemap" => image(d)
    case Some(d) =>
      values.reject(s"texture \"${d.name}\"")
      ""
    case None =>
      values.reject(s"texture `$name`")
      ""

  private def image(d: Declaration): String =
    values.rejectOthers(
      d, "filename", "encoding", "filter", "maxanisotropy", "wrap", "scale", "invert",
      "mapping", "uscale", "vscale", "udelta", "vdelta"
    )
    def word(name: String, default: String) =
      d.param(name).flatMap(_.strings.headOption).getOrElse(default)
    if word("mapping", "uv") != "uv" then values.reject("textures that are not by u and v")
    if word("wrap", "repeat") != "repeat" then values.reject("textures that do not repeat")
    mapping = Some(UvMapping(
      values.number(d, "uscale", 1f),
      values.number(d, "vscale", 1f),
      values.number(d, "udelta", 0f),
      values.number(d, "vdelta", 0f)
    ))
    val name = ExchangeImages.texture(d, files, values)
    s"""<texture type="bitmap" name="reflectance"><string name="filename" value="$name"/>""" +
      """<string name="wrap_mode" value="repeat"/><boolean name="raw" value="true"/></texture>"""
