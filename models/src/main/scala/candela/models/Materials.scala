package candela.models

import candela.base.NumberedNames
import candela.color.Rgb
import candela.diagnostics.Code
import candela.scenefile.{Declaration, MaterialRef, Param}

import scala.collection.mutable

/** What a primitive of some material is made of.
  *
  * @param shape    parameters of the shape: its alpha, and whether it is open from behind
  * @param interior name of the medium inside; empty: none
  */
private[models] final case class Surface(
    material: MaterialRef,
    shape: Vector[Param],
    emission: Option[Declaration],
    interior: String
)

/** Translates materials, each once.
  *
  * Source: glTF 2.0 specification, §3.9, and the extensions KHR_materials_*.
  */
private[models] final class Materials(
    file: GltfFile,
    session: Session,
    textures: Textures,
    media: Media
):
  private val entries = file.root.list("materials")
  private val surfaces = mutable.HashMap.empty[(Option[Int], Boolean), Surface]
  private val unusedNames = NumberedNames()
  private val named = mutable.LinkedHashMap.empty[String, Declaration]
  private val translated = MtlMaterials(session, textures)

  def result(): Vector[(String, Declaration)] = named.toVector ++ translated.result()

  /** @param index     of the material; none: the default
    * @param hasColors whether vertices have colours
    */
  def apply(index: Option[Json], hasColors: Boolean): Surface =
    surfaces.getOrElseUpdate(
      (index.map(_.size), hasColors), {
        val entry = index.fold(Materials.default(session))(_.element(entries, "materials"))
        warnOfOthers(entry)
        index.flatMap(i => file.library.lift(i.size)) match
          case Some(m) => translated(m, hasColors)
          case None => filled(entry, hasColors)
      }
    )

  private def warnOfOthers(entry: Json): Unit =
    for e <- entry("extensions"); name <- e.names if !Materials.Supported(name) do
      e(name).foreach(x => session.warn(x.at, s"`$name` is not supported; ignored"))

  private def base(entry: Json): Json =
    entry("pbrMetallicRoughness").getOrElse(Materials.default(session))

  private def filled(entry: Json, hasColors: Boolean): Surface =
    val medium = media.extras(entry)
    val inside = medium.map(media.inside)
    if medium.exists(_("surface").exists(!_.flag)) then
      for e <- entry("emissiveFactor") if emission(entry).isDefined do
        session.warn(e.at, "a material without a surface emits nothing")
      val interface = session.declare("Material", "interface", entry.at, Nil)
      Surface(MaterialRef.Inline(interface), Vector.empty, None, inside.getOrElse(""))
    else if entry.extension("KHR_materials_unlit").isDefined then unlit(entry, hasColors)
    else surface(entry, hasColors, inside)

  /** @param inside name of the medium, if there is one beside that of KHR_materials_volume */
  private def surface(entry: Json, hasColors: Boolean, inside: Option[String]): Surface =
    val passes = entry.extension("KHR_materials_transmission")
    val volume = passes.orElse(entry.extension("KHR_materials_diffuse_transmission"))
      .flatMap(_ => entry.extension("KHR_materials_volume"))
      .filter(_.number("thicknessFactor", 0, Limits.NonNegative) > 0)
    val isFilled = volume.isDefined || inside.isDefined
    val specularGlossiness = entry.extension("KHR_materials_pbrSpecularGlossiness")
    val params = specularGlossiness.fold(reflection(entry, hasColors))(glossiness(_, hasColors)) ++
      passes.toVector.flatMap: t =>
        Vector(
          textures.number(
            "transmission",
            t.factor("transmissionFactor", 0),
            t("transmissionTexture"),
            "r",
            t.at
          ),
          Param.bool("thin", t.at, !isFilled)
        )
    val all = params ++ coat(entry) ++ sheen(entry) ++ anisotropy(entry) ++ iridescence(entry) ++
      diffuseTransmission(entry) ++ dispersion(entry, isFilled && passes.isDefined) ++
      normals(entry, "normalTexture")
    // Two normal maps share a parameter
    val d = session.declare("Material", "gltf", entry.at, all.distinctBy(_.name))
    val alpha = specularGlossiness.fold(opacity(entry, base(entry), "baseColor", hasColors)): o =>
      opacity(entry, o, "diffuse", hasColors)
    // What is behind a volume's boundary matters
    val sides = if isFilled then None else culling(entry)
    val interior = inside.orElse(volume.map(media.absorbing)).getOrElse("")
    val emitted = emission(entry)
    if emitted.isDefined && alpha.nonEmpty && interior.nonEmpty then
      session.warn(entry.at, "where its alpha lets paths through, they do not enter its medium")
    Surface(name(entry, d), alpha ++ sides, emitted, interior)

  private def culling(entry: Json): Option[Param] =
    Option.unless(entry.flag("doubleSided"))(Param.bool("cullbackfaces", entry.at, true))

  private def name(entry: Json, d: Declaration): MaterialRef =
    val wanted = entry.text("name").filter(_.nonEmpty)
      .getOrElse(s"material ${entry.pointer.drop("/materials/".length)}".trim)
    val unique = unusedNames(wanted)
    named(unique) = d
    MaterialRef.Named(unique, entry.at)

  private def reflection(entry: Json, hasColors: Boolean): Vector[Param] =
    val pbr = base(entry)
    val color = Materials.rgb(pbr, "baseColorFactor", Rgb.White, count = 4)
    val metallicRoughness = pbr("metallicRoughnessTexture")
    val specular = entry.extension("KHR_materials_specular")
    Vector(
      textures.color("color", color, pbr("baseColorTexture"), pbr.at, hasColors),
      textures.number("metallic", pbr.factor("metallicFactor", 1), metallicRoughness, "b", pbr.at),
      textures.number("roughness", pbr.factor("roughnessFactor", 1), metallicRoughness, "g", pbr.at)
    ) ++
      entry.extension("KHR_materials_ior")
        .map(e => Param.float("eta", e.at, refraction(e).toFloat)) ++
      specular.toVector.flatMap: s =>
        val tint = Materials.rgb(s, "specularColorFactor", Rgb.White, Limits.NonNegative)
        Vector(
          textures.number(
            "specular",
            s.factor("specularFactor", 1),
            s("specularTexture"),
            "a",
            s.at
          ),
          textures.color("specularcolor", tint, s("specularColorTexture"), s.at)
        )

  /** 0 is a dielectric that reflects all light. */
  private def refraction(e: Json): Double =
    if e.number("ior", 1.5) == 0 then 0 else e.number("ior", 1.5, Limits(1))

  /** A dielectric whose reflectance is the specular colour. */
  private def glossiness(e: Json, hasColors: Boolean): Vector[Param] =
    val color = Materials.rgb(e, "diffuseFactor", Rgb.White, count = 4)
    val specular = Materials.rgb(e, "specularFactor", Rgb.White)
    val specularGlossinessTexture = e("specularGlossinessTexture")
    Vector(
      textures.color("color", color, e("diffuseTexture"), e.at, hasColors),
      textures.color("specularcolor", specular, specularGlossinessTexture, e.at),
      textures.number(
        "roughness",
        e.factor("glossinessFactor", 1),
        specularGlossinessTexture,
        "a",
        e.at,
        isInverted = true
      ),
      Param.float("metallic", e.at, 0f),
      Param.float("eta", e.at, 0f)
    )

  private def coat(entry: Json): Vector[Param] =
    entry.extension("KHR_materials_clearcoat").toVector.flatMap: c =>
      val factor = c.factor("clearcoatFactor", 0)
      val rough = c.factor("clearcoatRoughnessFactor", 0)
      Vector(
        textures.number("clearcoat", factor, c("clearcoatTexture"), "r", c.at),
        textures.number("clearcoatroughness", rough, c("clearcoatRoughnessTexture"), "g", c.at)
      ) ++ normals(c, "clearcoatNormalTexture", "clearcoat")

  private def sheen(entry: Json): Vector[Param] =
    entry.extension("KHR_materials_sheen").toVector.flatMap: s =>
      val color = Materials.rgb(s, "sheenColorFactor", Rgb.Black)
      val rough = s.factor("sheenRoughnessFactor", 0)
      Vector(
        textures.color("sheencolor", color, s("sheenColorTexture"), s.at),
        textures.number("sheenroughness", rough, s("sheenRoughnessTexture"), "a", s.at)
      )

  private def anisotropy(entry: Json): Vector[Param] =
    entry.extension("KHR_materials_anisotropy").toVector.flatMap: a =>
      val strength = a.factor("anisotropyStrength", 0)
      val info = a("anisotropyTexture")
      val direction = info.toVector.flatMap: _ =>
        Vector("anisotropyx" -> "r", "anisotropyy" -> "g").map: (name, channel) =>
          textures.number(name, 1, info, channel, a.at)
      Vector(
        textures.number("anisotropy", strength, info, "b", a.at),
        Param.float("anisotropyrotation", a.at, a.number("anisotropyRotation", 0).toFloat)
      ) ++ direction

  private def iridescence(entry: Json): Vector[Param] =
    entry.extension("KHR_materials_iridescence").toVector.flatMap: f =>
      def nm(member: String, default: Double) =
        Param.float(_, f.at, f.number(member, default, Limits.NonNegative).toFloat)
      val thickness = f("iridescenceThicknessTexture")
      val weight = f.factor("iridescenceFactor", 0)
      Vector(
        textures.number("iridescence", weight, f("iridescenceTexture"), "r", f.at),
        Param.float("iridescenceeta", f.at, f.number("iridescenceIor", 1.3, Limits(1)).toFloat),
        nm("iridescenceThicknessMinimum", 100)("iridescencemin"),
        nm("iridescenceThicknessMaximum", 400)("iridescencemax")
      ) ++ thickness.map(t => textures.number("iridescencethickness", 1, Some(t), "g", f.at))

  private def diffuseTransmission(entry: Json): Vector[Param] =
    entry.extension("KHR_materials_diffuse_transmission").toVector.flatMap: d =>
      val share = d.factor("diffuseTransmissionFactor", 0)
      val color = Materials.rgb(d, "diffuseTransmissionColorFactor", Rgb.White)
      val name = "diffusetransmission"
      Vector(
        textures.number(name, share, d("diffuseTransmissionTexture"), "a", d.at),
        textures.color(s"${name}color", color, d("diffuseTransmissionColorTexture"), d.at)
      )

  private def dispersion(entry: Json, refracts: Boolean): Option[Param] =
    entry.extension("KHR_materials_dispersion").flatMap: d =>
      val strength = d.number("dispersion", 0, Limits.NonNegative)
      if strength > 0 && !refracts then
        session.warn(d.at, "only volumes that transmit light disperse it; ignored")
      Option.when(strength > 0 && refracts)(Param.float("dispersion", d.at, strength.toFloat))

  private def normals(entry: Json, member: String, prefix: String = ""): Vector[Param] =
    for
      info <- entry(member).toVector
      p <- textures.picture(info).toVector
      param <- textures.normalMap(p, info.number("scale", 1), prefix)
    yield param

  /** @param prefix of the factor and the texture of the colour, whose alpha it is */
  private def opacity(entry: Json, color: Json, prefix: String, hasColors: Boolean): Vector[Param] =
    def alpha = textures.number(
      "alpha",
      color.numbers(s"${prefix}Factor", 4, Limits.Unit).fold(1.0)(_.last),
      color(s"${prefix}Texture"),
      "a",
      entry.at,
      hasColors
    )
    entry.text("alphaMode").getOrElse("OPAQUE") match
      case "OPAQUE" => Vector.empty
      case "BLEND" => Vector(alpha)
      case "MASK" =>
        val cutoff = entry.number("alphaCutoff", 0.5, Limits.NonNegative).toFloat
        Vector(alpha, Param.float("alphacutoff", entry.at, cutoff))
      case other =>
        entry.required("alphaMode").fail(s"expected OPAQUE, MASK or BLEND, found `$other`")

  private def emission(entry: Json): Option[Declaration] =
    val factor = Materials.rgb(entry, "emissiveFactor", Rgb.Black, Limits.NonNegative)
    // Many exporters write more than the specification allows, and importers use it
    for member <- entry("emissiveFactor") if factor.max > 1f do
      val message = s"`emissiveFactor` should be ${Limits.Unit}, found "
      val help = Some("KHR_materials_emissive_strength scales it beyond 1")
      val values = Limits.text(member.numbers(3))
      session.warn(member.at, s"$message$values, which is used", Code.ParameterValue, help)
    val strength = entry.extension("KHR_materials_emissive_strength")
      .fold(1.0)(_.number("emissiveStrength", 1, Limits.NonNegative))
    val color = factor * strength.toFloat
    Option.when(color.max > 0f)(light(entry, color, entry("emissiveTexture")))

  private def light(entry: Json, color: Rgb, info: Option[Json]): Declaration =
    textures.light(color, info.flatMap(textures.picture), entry.flag("doubleSided"), entry.at)

  /** A colour that no light changes: that of an emitter that reflects nothing. */
  private def unlit(entry: Json, hasColors: Boolean): Surface =
    if hasColors then
      session.warn(entry.at, "colours of vertices of an unlit material are not supported")
    val pbr = base(entry)
    val color = Materials.rgb(pbr, "baseColorFactor", Rgb.White, count = 4)
    val black = Vector(Picture.rgb("reflectance", Rgb.Black, entry.at))
    val d = session.declare("Material", "diffuse", entry.at, black)
    val emitted = Option.when(color.max > 0f)(light(entry, color, pbr("baseColorTexture")))
    Surface(
      name(entry, d),
      opacity(entry, pbr, "baseColor", hasColors) ++ culling(entry),
      emitted,
      ""
    )

private[models] object Materials:
  /** The colour of a member, or a default: the first three of `count` numbers. */
  def rgb(
      entry: Json,
      member: String,
      default: Rgb,
      limits: Limits = Limits.Unit,
      count: Int = 3
  ): Rgb =
    entry.numbers(member, count, limits).fold(default): c =>
      Rgb(c(0).toFloat, c(1).toFloat, c(2).toFloat)

  def default(session: Session): Json = Json(ujson.Obj(), "", session)

  val Supported: Set[String] = Set(
    "unlit", "ior", "specular", "transmission", "volume", "clearcoat",
    "sheen", "anisotropy", "emissive_strength", "pbrSpecularGlossiness", "iridescence",
    "diffuse_transmission", "dispersion"
  ).map("KHR_materials_" + _)
