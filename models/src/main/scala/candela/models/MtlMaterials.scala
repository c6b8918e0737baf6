package candela.models

import candela.base.NumberedNames
import candela.color.Rgb
import candela.diagnostics.Code
import candela.image.{ImageError, ImageFiles}
import candela.scenefile.{Declaration, MaterialRef, Param}

import scala.collection.mutable

/** Translates materials of MTL to that of glTF, as Blender's importer translates them to its own.
  *
  * Source: Blender 5.0, source/blender/io/wavefront_obj/importer/obj_import_mtl.cc.
  */
private[models] final class MtlMaterials(session: Session, pictures: Pictures):
  import MtlMaterials.*

  private val unusedNames = NumberedNames()
  private val named = mutable.LinkedHashMap.empty[String, Declaration]
  private val files = mutable.HashMap.empty[String, String]

  def result(): Vector[(String, Declaration)] = named.toVector

  /** @param hasColors whether vertices have colours, which scale that of the material */
  def apply(m: MtlMaterial, hasColors: Boolean): Surface =
    val d = session.declare(
      "Material",
      "gltf",
      m.at,
      reflection(m, hasColors) ++ layers(m) ++
        passing(m) ++ relief(m)
    )
    val name = unusedNames(if m.name.isEmpty then "material" else m.name)
    named(name) = d
    Surface(MaterialRef.Named(name, m.at), opacity(m), emission(m), "")

  private def reflection(m: MtlMaterial, hasColors: Boolean): Vector[Param] =
    val image = picture(m, "color")
    // What an image shows is not scaled: exporters write any Kd beside one
    val color = if image.isDefined then Rgb.White else m.rgb("kd").getOrElse(Rgb.gray(0.8f))
    val illumination = m.number("illum").fold(-1)(_.toInt)
    val highlights = m.numbers.get("ks").fold(if illumination == 2 then 1f else 0f)(_.sum / 3)
    val phong = m.number("ns") match
      case None => if illumination == 2 then 0f else 1f
      case Some(exponent) => 1f - Math.sqrt(unit(exponent / MaxExponent)).toFloat
    val metal =
      if Reflecting(illumination) then m.numbers.get("ka").fold(1f)(_.sum / 3) else 0f
    val roughness = m.number("pr").getOrElse(phong)
    Vector(
      pictures.colorOf("color", color.map(unit), image, m.at, hasColors),
      number(m, "metallic", m.number("pm").getOrElse(metal), "metallic"),
      number(m, "roughness", roughness, "roughness"),
      Param.float("eta", m.at, refraction(m, illumination))
    ) ++ specular(m, highlights)

  /** Beside an image, the number is 1. */
  private def number(m: MtlMaterial, name: String, usual: Float, kind: String): Param =
    val image = picture(m, kind)
    val scale = if image.isDefined then 1f else unit(usual)
    pictures.numberOf(name, scale, image, channel(m, kind), m.at)

  private def channel(m: MtlMaterial, kind: String): String =
    m.maps.get(kind).flatMap(_.channel) match
      case Some("r") => "r"
      case Some("g") => "g"
      case Some("b") => "b"
      case Some("m") => "a"
      case _ => "all"

  /** The average of Ks is the level of Blender's Principled BSDF: 0.5 is the reflectance that the
    * index of refraction has at normal incidence, 0 none.
    */
  private def specular(m: MtlMaterial, level: Float): Vector[Param] =
    picture(m, "specular") match
      case Some(p) =>
        val doubled = pictures.colorOf("specularcolor", Rgb.gray(2f), Some(p), m.at)
        Vector(doubled)
      case None if level <= 0f => Vector(Param.float("specular", m.at, 0f))
      case None if level == 0.5f => Vector.empty
      case None => Vector(Picture.rgb("specularcolor", Rgb.gray(2f * level), m.at))

  private def refraction(m: MtlMaterial, illumination: Int): Float =
    m.number("ni").map(Math.max(_, 1f)).getOrElse:
      if Passing(illumination) && illumination != 4 && illumination != 9 then 1f else 1.5f

  private def layers(m: MtlMaterial): Vector[Param] =
    def gray(name: String, x: Float) = Picture.rgb(name, Rgb.gray(unit(x)), m.at)
    val sheen = picture(m, "sheen").map(p =>
      pictures.colorOf("sheencolor", Rgb.White, Some(p), m.at)
    ).orElse(m.number("ps").filter(_ > 0f).map(gray("sheencolor", _)))
    val coat = m.number("pc").filter(_ > 0f).toVector.flatMap: thickness =>
      Vector(
        Param.float("clearcoat", m.at, unit(CoatOfThickness * thickness)),
        Param.float("clearcoatroughness", m.at, m.number("pcr").fold(UsualCoatRoughness)(unit))
      )
    val stretch = m.number("aniso").filter(_ != 0f).toVector.flatMap: strength =>
      val turns = m.number("anisor").getOrElse(0f)
      Vector(
        Param.float("anisotropy", m.at, unit(strength)),
        Param.float("anisotropyrotation", m.at, (turns * 2 * Math.PI).toFloat)
      )
    sheen.toVector.flatMap(Vector(_, Param.float("sheenroughness", m.at, 0.5f))) ++ coat ++ stretch

  /** Light passes where `illum` says so: many exporters write Tf beside opaque materials. */
  private def passing(m: MtlMaterial): Vector[Param] =
    val passed = m.numbers.get("tf").map(_.sum / 3).getOrElse(0f)
    val illumination = m.number("illum").fold(-1)(_.toInt)
    if passed <= 0f then Vector.empty
    else if !Passing(illumination) then
      if passed < 1f then
        val help = Some("illum 4, 6, 7 and 9 are of transparent materials")
        session.warn(
          m.at,
          s"`Tf` of `${m.name}` has no effect without illum",
          Code.IdleParameter,
          help
        )
      Vector.empty
    else
      Vector(
        Param.float("transmission", m.at, unit(passed)),
        Param.bool("thin", m.at, false)
      )

  private def opacity(m: MtlMaterial): Vector[Param] =
    val alpha = m.number("d").orElse(m.number("tr").map(1f - _)).getOrElse(1f)
    val image = picture(m, "opacity")
    if image.isEmpty && alpha >= 1f then Vector.empty
    else
      val channel = this.channel(m, "opacity")
      val scale = if image.isDefined then 1f else unit(alpha)
      Vector(pictures.numberOf(
        "alpha",
        scale,
        image,
        if channel == "all" then "opacity" else channel,
        m.at
      ))

  private def emission(m: MtlMaterial): Option[Declaration] =
    val image = picture(m, "emission")
    val color = if image.isDefined then Rgb.White else m.rgb("ke").getOrElse(Rgb.Black)
    Option.when(color.max > 0f)(pictures.light(color.map(Math.max(_, 0f)), image, true, m.at))

  /** Images of relief are normal maps, as in Blender, unless they are grey: the unit of heights is
    * not known.
    */
  private def relief(m: MtlMaterial): Vector[Param] =
    val kind = if m.maps.contains("normals") then "normals" else "relief"
    val image = picture(m, kind).filter: p =>
      val isOfNormals = kind == "normals" || !isGray(p)
      if !isOfNormals then
        session.warn(p.at, "heights are not supported, as their unit is not known; left out")
      isOfNormals
    image.toVector.flatMap(p => pictures.normalMap(p, m.maps(kind).bump.toDouble))

  private def isGray(p: Picture): Boolean =
    try
      session.folder.locate(p.file, Some(p.at)).exists: file =>
        val image = ImageFiles.load(file).toImage
        val colors = image.colorChannels
        (0 until image.width * image.height).forall: i =>
          colors.forall(c =>
            image.data(i * image.channels + c) ==
              image.data(i * image.channels + colors.head)
          )
    catch case _: ImageError => false // which is reported when it is used

  private val pictureOf = mutable.HashMap.empty[MtlMap, Picture]

  private def picture(m: MtlMaterial, kind: String): Option[Picture] = m.maps.get(kind).map: map =>
    pictureOf.getOrElseUpdate(
      map, {
        val ((su, sv), (du, dv)) = (map.scale, map.offset)
        Picture(
          files.getOrElseUpdate(map.file, pictures.fileName(m.folder, map.file, map.at)),
          map.second,
          Vector(su, 0f, du, 0f, sv, dv),
          map.wrap,
          isSmooth = true,
          map.at
        )
      }
    )

private[models] object MtlMaterials:
  /** The exponent of Phong that is as smooth as can be. */
  val MaxExponent = 1000f

  /** Of Disney's clear coat. */
  val CoatOfThickness = 0.25f
  private val UsualCoatRoughness = 0.03f

  /** Values of `illum` whose surfaces reflect their surroundings, or let light pass. */
  private val Reflecting = Set(3, 4, 5, 6, 7, 8)
  private val Passing = Set(4, 6, 7, 9)

  private def unit(x: Float): Float = Math.max(0f, Math.min(x, 1f))

  extension (m: MtlMaterial)
    private def rgb(statement: String): Option[Rgb] =
      m.numbers.get(statement).map(c => Rgb(c(0), c(1), c(2)))
