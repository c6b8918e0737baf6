package candela.mitsuba

import candela.color.Rgb
import candela.scenefile.{Dialect, Param}

/** Translates BSDFs that contain no others. */
private[mitsuba] final class BasicSurfaces(session: Session, colors: Colors, textures: Textures):

  def apply(in: Asked): Surface = in.plugin.name match
    case "diffuse" =>
      made(in, "diffuse", isOneSided = true)(color(in, "reflectance", 0.5f, "reflectance"))
    case "dielectric" => dielectric(in, isRough = false)
    case "roughdielectric" => dielectric(in, isRough = true)
    case "thindielectric" =>
      in.lose("using 1", "specular_reflectance", "specular_transmittance")
      made(in, "thindielectric", isOneSided = false)(
        Param.float("eta", in.at, Indices.relative(in, "bk7").toFloat)
      )
    case "conductor" => conductor(in, isRough = false)
    case "roughconductor" => conductor(in, isRough = true)
    case "plastic" => plastic(in, Vector(Param.float("roughness", in.at, 0f)))
    case "roughplastic" => plastic(in, roughness(in))
    case "principled" | "principledthin" => principled(in, in.plugin.name == "principledthin")
    case "null" => made(in, "interface", isOneSided = false)()
    case "measured" =>
      val file = in.text("filename").flatMap(session.file(_, in.atOf("filename"), "using grey"))
      file.fold(grey(in)): path =>
        made(in, "measured", isOneSided = true)(
          Param.string("filename", in.atOf("filename"), session.named(path))
        )
    case _ =>
      Plugins.unsupported(in.plugin, "using a diffuse reflectance of 0.5", session)
      in.ignore(in.plugin.properties.map(_.name)*)
      grey(in)

  def grey(in: Asked): Surface =
    made(in, "diffuse", isOneSided = true)(Textures.rgb("reflectance", Textures.Fallback, in.at))

  private def made(in: Asked, name: String, isOneSided: Boolean, dialect: Option[Dialect] = None)(
      params: Param*
  ): Surface =
    Surface(session.declare("Material", name, in.at, params, dialect), isOneSided)

  private def color(in: Asked, property: String, default: Float, name: String): Param =
    val shade = colors.shade(in, property, Rgb.gray(default), Role.Reflectance)
    textures.color(name, shade, in.atOf(property))

  /** Alpha as it is, in both directions. */
  private def roughness(in: Asked): Vector[Param] =
    // Only GGX is common to both
    if in.word("distribution", "beckmann", "beckmann", "ggx") == "beckmann" then
      session.warn(
        in.atOf("distribution"),
        s"the distribution `beckmann` of ${in.plugin.shown} is not supported; using `ggx`",
        Some("""write <string name="distribution" value="ggx"/> to compare with Mitsuba""")
      )
    in.ignore("sample_visible")
    val along =
      for
        (axis, name) <- Vector("u" -> "alpha_u", "v" -> "alpha_v") if in.has(name)
      yield textures.number(s"${axis}roughness", in, name, 0.1)
    val all = if along.nonEmpty then along else both(in)
    all :+ Param.bool("remaproughness", in.at, false)

  private def both(in: Asked): Vector[Param] =
    Vector("uroughness", "vroughness").map(textures.number(_, in, "alpha", 0.1))

  private def dielectric(in: Asked, isRough: Boolean): Surface =
    val eta = Indices.relative(in, "bk7").toFloat
    val rough = if isRough then roughness(in) else Vector.empty
    def scale(name: String) =
      colors.given_(in, name, Role.Reflectance).filter(!_.constant.contains(Rgb.White))
    val (reflected, refracted) = (scale("specular_reflectance"), scale("specular_transmittance"))
    if reflected.isEmpty && refracted.isEmpty then
      made(in, "dielectric", isOneSided = false)(Param.float("eta", in.at, eta) +: rough*)
    else
      // pbrt-v4 has no colours of glass, v3 has
      val tints = Vector("Kr" -> reflected, "Kt" -> refracted).map: (name, shade) =>
        textures.color(name, shade.getOrElse(Shade.Constant(Rgb.White)), in.at)
      made(in, "glass", isOneSided = false, Some(Dialect.V3))(
        Param.float("eta", in.at, eta) +: (tints ++ rough)*
      )

  private def conductor(in: Asked, isRough: Boolean): Surface =
    val rough = if isRough then roughness(in) else Vector.empty
    val tint = colors.given_(in, "specular_reflectance", Role.Reflectance)
      .filter(!_.constant.contains(Rgb.White))
    in.ignore("ext_eta")
    if in.text("material").contains("none") then mirror(in, tint, rough)
    else
      if tint.isDefined then
        session.warn(
          in.atOf("specular_reflectance"),
          s"`specular_reflectance` of ${in.plugin.shown} is not supported; using 1"
        )
      val (eta, k) = Indices.metal(in.text("material", "Cu"), in)
      val params = Vector("eta" -> eta, "k" -> k).map: (name, default) =>
        textures.color(name, colors.shade(in, name, default, Role.Plain), in.atOf(name))
      made(in, "conductor", isOneSided = true)((params ++ rough)*)

  /** Mitsuba's perfect mirror, of which roughness is a blur. */
  private def mirror(in: Asked, tint: Option[Shade], rough: Vector[Param]): Surface =
    in.ignore("eta", "k")
    val shade = tint.getOrElse(Shade.Constant(Rgb.White))
    if rough.isEmpty then
      made(in, "mirror", isOneSided = true, Some(Dialect.V3))(textures.color("Kr", shade, in.at))
    else
      made(in, "conductor", isOneSided = true)(
        textures.color("reflectance", shade, in.at) +: rough*
      )

  /** A coat on a diffuse base. Without `nonlinear`, Mitsuba leaves out that light which the coat
    * reflects back is coloured by the base again: a coated base of another colour looks so.
    */
  private def plastic(in: Asked, rough: Vector[Param]): Surface =
    val eta = Indices.relative(in, "polypropylene")
    in.lose("using 1", "specular_reflectance")
    val base = colors.shade(in, "diffuse_reflectance", Rgb.gray(0.5f), Role.Reflectance)
    val inner = Indices.diffuseReflectance(eta).toFloat
    val seen =
      if in.flag("nonlinear", false) then base
      else
        base match
          case Shade.Constant(c) => Shade.Constant(c.map(r => r / (1 - inner + r * inner)))
          case textured =>
            session.warn(
              in.at,
              s"the colour of a textured ${in.plugin.shown} is that of `nonlinear`: less " +
                "saturated colours become darker"
            )
            textured
    made(in, "coateddiffuse", isOneSided = true)(
      (textures.color("reflectance", seen, in.atOf("diffuse_reflectance")) +:
        Param.float("eta", in.at, eta.toFloat) +:
        rough)*
    )

  /** Disney's BSDF, of which v3's is another edition. */
  private def principled(in: Asked, isThin: Boolean): Surface =
    session.warn(in.at, s"${in.plugin.shown} is approximated by pbrt-v3's \"disney\"")
    val eta =
      in.number("eta").getOrElse:
        2 / (1 - Math.sqrt(0.08 * in.number("specular", 0.5))) - 1
    val numbers = Vector(
      "roughness" -> ("roughness", 0.5),
      "anisotropic" -> ("anisotropic", 0.0),
      "metallic" -> ("metallic", 0.0),
      "spec_trans" -> ("spectrans", 0.0),
      "spec_tint" -> ("speculartint", 0.0),
      "sheen" -> ("sheen", 0.0),
      "sheen_tint" -> ("sheentint", 0.0),
      "flatness" -> ("flatness", 0.0),
      "clearcoat" -> ("clearcoat", 0.0),
      "clearcoat_gloss" -> ("clearcoatgloss", 0.0),
      "diff_trans" -> ("difftrans", 0.0)
    ).filter((property, _) => in.has(property) || property == "clearcoat_gloss")
      .map { case (property, (name, default)) => textures.number(name, in, property, default) }
    in.ignore(
      "main_specular_sampling_rate", "clearcoat_sampling_rate",
      "diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
      "spec_trans_sampling_rate", "diff_trans_sampling_rate", "diffuse_sampling_rate"
    )
    val isOpaque = !isThin && !in.has("spec_trans")
    made(in, "disney", isOpaque, Some(Dialect.V3))(
      (color(in, "base_color", 0.5f, "color") +:
        Param.float("eta", in.at, eta.toFloat) +:
        Param.bool("thin", in.at, isThin) +:
        numbers)*
    )
