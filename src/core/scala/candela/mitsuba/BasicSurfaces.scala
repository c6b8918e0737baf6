package candela.mitsuba

import candela.diagnostics.Code
import candela.color.Rgb
import candela.scenefile.Param

/** Translates BSDFs that contain no others. */
private[mitsuba] final class BasicSurfaces(session: Session, colors: Colors, textures: Textures):

  def apply(in: Properties): Surface = in.plugin.name match
    case "diffuse" =>
      surface(in, "diffuse", isOneSided = true)(
        color(in, reflectance(in), 0.5f, "reflectance")
      )
    case "dielectric" => dielectric(in, isRough = false)
    case "roughdielectric" => dielectric(in, isRough = true)
    case "thindielectric" =>
      surface(in, "thindielectric", isOneSided = false)(
        (Param.float("eta", in.pos, Indices.relative(in, "bk7").toFloat) +: tints(in))*
      )
    case "conductor" => conductor(in, isRough = false)
    case "roughconductor" => conductor(in, isRough = true)
    case "plastic" => plastic(in, Vector(nonlinear(in), Param.float("roughness", in.pos, 0f)))
    case "roughplastic" => plastic(in, nonlinear(in) +: roughness(in))
    case "pplastic" => plastic(in, Param.bool("interreflection", in.pos, false) +: roughness(in))
    case "polarizer" | "circular" => filter(in, 0.5f)
    case "retarder" => filter(in, 1f)
    case "principled" | "principledthin" => principled(in, in.plugin.name == "principledthin")
    case "hair" => hair(in)
    case "null" => surface(in, "interface", isOneSided = false)()
    case "measured" =>
      val at = in.posOf("filename")
      val file = in.text("filename").flatMap(session.file(_, at, Textures.UsingMagenta))
      file.fold(diffuse(in, Textures.Magenta)): path =>
        surface(in, "measured", isOneSided = true)(
          Param.string("filename", at, session.named(path))
        )
    case _ =>
      Plugins.unsupported(in.plugin, "using a diffuse reflectance of 0.5", session)
      in.ignore(in.plugin.properties.map(_.name)*)
      grey(in)

  def grey(in: Properties): Surface = diffuse(in, Textures.Fallback)

  private def diffuse(in: Properties, color: Rgb): Surface =
    surface(in, "diffuse", isOneSided = true)(Textures.rgb("reflectance", color, in.pos))

  /** The same model as pbrt's. */
  private def hair(in: Properties): Surface =
    val scale = in.number("scale", 1).toFloat
    val pigments = Seq("eumelanin" -> 1.3, "pheomelanin" -> 0.2)
    in.note("sigma_a", Colors.Kind)
    val absorption =
      if !in.contains("sigma_a") then
        pigments.map((name, default) => Param.float(name, in.pos, in.number(name, default).toFloat))
      else
        for (name, _) <- pigments if in.contains(name) do
          session.error(
            Code.MissingParameter,
            in.posOf(name),
            s"hair has `sigma_a` or `$name`, not both"
          )
        val shade = colors.shade(in, "sigma_a", Rgb.Black, Role.Unbounded)
        Seq(textures.color("sigma_a", shade, in.posOf("sigma_a"), scale))
    if scale != 1f && !in.contains("sigma_a") then
      session.warn(Code.IdleParameter, in.posOf("scale"), "`scale` is for `sigma_a`; it is ignored")
    def number(name: String, property: String, default: Double) =
      Param.float(name, in.posOf(property), in.number(property, default).toFloat)
    surface(in, "hair", isOneSided = false)(
      absorption ++ Seq(
        Param.float("eta", in.pos, Indices.relative(in, "amber").toFloat),
        number("beta_m", "longitudinal_roughness", 0.3),
        number("beta_n", "azimuthal_roughness", 0.3),
        number("alpha", "scale_tilt", 2)
      )*
    )

  /** The name of a diffuse reflectance: Mitsuba 0.6 knows two. */
  def reflectance(in: Properties): String =
    if in.contains("diffuse_reflectance") then "diffuse_reflectance" else "reflectance"

  def surface(in: Properties, name: String, isOneSided: Boolean)(
      params: Param*
  ): Surface =
    Surface(session.declare("Material", name, in.pos, params), isOneSided)

  def color(in: Properties, property: String, default: Float, name: String): Param =
    val shade = colors.shade(in, property, Rgb.gray(default), Role.Reflectance)
    textures.color(name, shade, in.posOf(property))

  /** Alpha as it is, in both directions. */
  def roughness(in: Properties): Vector[Param] =
    val distribution =
      in.word("distribution", "beckmann", "beckmann", "ggx", "phong", "as") match
        case "as" => "phong"
        case other => other
    in.ignore("sample_visible")
    val perAxis =
      for
        (axis, name) <- Vector("u" -> "alpha_u", "v" -> "alpha_v")
        _ = in.note(name, Textures.NumberKind, "0.1")
        if in.contains(name)
      yield textures.number(s"${axis}roughness", in, name, 0.1)
    val roughnesses = if perAxis.nonEmpty then perAxis else isotropic(in)
    roughnesses ++ Vector(
      Param.bool("remaproughness", in.pos, false),
      Param.string("distribution", in.posOf("distribution"), distribution)
    )

  private def isotropic(in: Properties): Vector[Param] =
    Vector("uroughness", "vroughness").map(textures.number(_, in, "alpha", 0.1))

  /** Colours that scale reflection and transmission, unless they are white. */
  def scales(in: Properties, names: (String, String)*): Vector[Param] =
    for
      (property, name) <- names.toVector
      shade <- colors.givenShade(in, property, Role.Reflectance)
      if !shade.constant.contains(Rgb.White)
    yield textures.color(name, shade, in.posOf(property))

  private def dielectric(in: Properties, isRough: Boolean): Surface =
    val eta = Indices.relative(in, "bk7").toFloat
    val rough = if isRough then roughness(in) else Vector.empty
    surface(in, "dielectric", isOneSided = false)(
      (Param.float("eta", in.pos, eta) +: (tints(in) ++ rough))*
    )

  /** What does nothing to unpolarized light but to absorb it.
    *
    * @param share of the light that it lets pass, times its transmittance
    */
  private def filter(in: Properties, share: Float): Surface =
    val transmittance = colors.shade(in, "transmittance", Rgb.White, Role.Reflectance)
    in.ignore("theta", "delta", "polarizing", "left_handed")
    surface(in, "thindielectric", isOneSided = false)(
      Param.float("eta", in.pos, 1f),
      textures.color("transmittance", transmittance, in.posOf("transmittance"), share)
    )

  private def tints(in: Properties): Vector[Param] = scales(
    in,
    "specular_reflectance" -> "reflectance",
    "specular_transmittance" -> "transmittance"
  )

  private def conductor(in: Properties, isRough: Boolean): Surface =
    val rough = if isRough then roughness(in) else Vector.empty
    val material = in.text("material", if in.plugin.isOld then "Cu" else "none")
    val tint = scales(in, "specular_reflectance" -> "scale")
    in.ignore("ext_eta")
    for name <- Seq("eta", "k") do in.note(name, Colors.Kind)
    val params =
      if material == "none" && (in.plugin.isOld || !in.contains("eta")) then
        // A perfect mirror, of which roughness is a blur
        in.ignore("k")
        Vector(Textures.rgb("eta", Rgb.Black, in.pos), Textures.rgb("k", Rgb.White, in.pos))
      else
        val (eta, k) = if material == "none" then (Rgb.Black, Rgb.White)
        else
          Indices.metal(material, in)
        Vector("eta" -> eta, "k" -> k).map: (name, default) =>
          textures.color(name, colors.shade(in, name, default, Role.Unbounded), in.posOf(name))
    surface(in, "conductor", isOneSided = true)((params ++ tint ++ rough)*)

  /** A coat on a diffuse base. */
  private def plastic(in: Properties, extra: Vector[Param]): Surface =
    val explicitEta = if in.plugin.name == "pplastic" then in.number("eta") else None
    val eta = explicitEta.getOrElse(Indices.relative(in, "polypropylene")).toFloat
    surface(in, "roughplastic", isOneSided = true)(
      (Vector(
        color(in, "diffuse_reflectance", 0.5f, "reflectance"),
        Param.float("eta", in.pos, eta)
      ) ++ scales(in, "specular_reflectance" -> "specular") ++ extra)*
    )

  private def nonlinear(in: Properties): Param =
    Param.bool("nonlinear", in.pos, in.flag("nonlinear", false))

  /** Burley's BSDF, or that of a thin sheet. */
  private def principled(in: Properties, isThin: Boolean): Surface =
    val eta =
      if isThin then textures.number("eta", in, "eta", 1.5)
      else
        val index = in.number("eta").getOrElse:
          2 / (1 - Math.sqrt(0.08 * in.number("specular", 0.5))) - 1
        Param.float("eta", in.pos, index.toFloat)
    val numbers =
      for
        (property, name, default, differs) <- BasicSurfaces.Principled
        _ = in.note(property, Textures.NumberKind, Properties.text(default))
        if differs || in.contains(property)
      yield textures.number(name, in, property, default)
    in.ignore(
      "main_specular_sampling_rate", "clearcoat_sampling_rate",
      "diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
      "diffuse_transmittance_sampling_rate", "specular_transmittance_sampling_rate"
    )
    surface(in, "principled", !isThin && !in.contains("spec_trans"))(
      (color(in, "base_color", 0.5f, "color") +: eta +:
        Param.bool("thin", in.pos, isThin) +: numbers)*
    )

private object BasicSurfaces:
  /** Mitsuba's name, pbrt's, Mitsuba's default, and whether pbrt's differs. */
  private val Principled = Vector(
    ("roughness", "roughness", 0.5, false),
    ("anisotropic", "anisotropic", 0.0, false),
    ("metallic", "metallic", 0.0, false),
    ("spec_trans", "spectrans", 0.0, false),
    ("spec_tint", "speculartint", 0.0, false),
    ("sheen", "sheen", 0.0, false),
    ("sheen_tint", "sheentint", 0.0, true),
    ("flatness", "flatness", 0.0, false),
    ("clearcoat", "clearcoat", 0.0, false),
    ("clearcoat_gloss", "clearcoatgloss", 0.0, true),
    ("diff_trans", "difftrans", 0.0, true)
  )
