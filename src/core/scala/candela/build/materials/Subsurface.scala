package candela.build.materials

import candela.diagnostics.{Code, Suggest}
import candela.bsdf.Material
import candela.bsdf.microfacet.{
  DielectricMaterial, ReflectingInterfaceMaterial, Roughness, RoughnessModel
}
import candela.bsdf.subsurface.{
  CoefficientInterior, DiffuseDipoleInterior, DipoleInterior, Interior, ProfileTable,
  ReflectanceInterior, SubsurfaceMaterial
}
import candela.build.media.{MeasuredMedia, MediumCoefficients}
import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

/** Base of materials with a BSSRDF: the parameters of the dielectric boundary. */
abstract class BssrdfRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect]
) extends MaterialRecipe(name, meaning, dialects):
  private val kr = rgbTexture("Kr", "scale of reflection", untilV3)(Rgb.White)
  private val kt = rgbTexture("Kt", "scale of refraction", onlyV3)(Rgb.White)
  protected val eta: Field[Float] = float(
    "eta",
    "index of refraction",
    sinceV3,
    range = Indices.range
  )(1.33f)
  protected val index: Field[FloatTexture] =
    floatTexture("index", "index of refraction", onlyV2, range = Indices.range)(1.3f)
  private val isotropic =
    floatTexture(
      "roughness",
      "roughness along u and v; 0: smooth",
      onlyV4,
      range = Range.nonNegative
    )(0f)
  private val alongV3 =
    floatTexture(
      "uroughness",
      "roughness along u; 0: smooth",
      onlyV3,
      range = Range.nonNegative
    )(0f)
  private val acrossV3 =
    floatTexture(
      "vroughness",
      "roughness along v; 0: smooth",
      onlyV3,
      range = Range.nonNegative
    )(0f)
  private val alongV4 =
    floatTexture(
      "uroughness", "roughness along u", onlyV4, shown = "roughness", range = Range.nonNegative
    )(0f)
  private val acrossV4 =
    floatTexture(
      "vroughness", "roughness along v", onlyV4, shown = "roughness", range = Range.nonNegative
    )(0f)
  private val remap =
    bool("remaproughness", "remap roughness from [0, 1] to microfacet alpha", sinceV3)(true)
  protected val g: Field[Float] = float(
    "g",
    "scattering asymmetry",
    sinceV3,
    range = Range(-1f, 1f).limited
  )(0f)

  protected def interior()(using Site): Interior

  protected def create()(using site: Site): Material =
    SubsurfaceMaterial(boundary(), interior(), alongTangents = site.dialect == Dialect.V3)

  private def boundary()(using site: Site): Material = site.dialect match
    case Dialect.V2 => ReflectingInterfaceMaterial(kr(), index())
    case Dialect.V3 =>
      val model = if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
      val rough = Roughness(alongV3(), acrossV3(), model, smoothAtZero = true)
      new DielectricMaterial(kr(), kt(), ConstantFloat(eta()), rough)
    case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf =>
      val model = if remap() then RoughnessModel.SquareRootAlpha else RoughnessModel.PlainAlpha
      val across = acrossV4.given_().getOrElse(isotropic())
      DielectricMaterial(eta(), Roughness(alongV4.given_().getOrElse(isotropic()), across, model))

  protected def table(g: Float)(using site: Site): ProfileTable =
    site.resources.profiles.of(g, eta())

object SubsurfaceRecipe
    extends BssrdfRecipe("subsurface", "subsurface scattering by coefficients", every):
  private val measuredName =
    string("name", "name of a measured material, instead of the coefficients", shown = "none")("")
  private val sigmaA =
    rgbTexture(
      "sigma_a",
      "absorption coefficient",
      unit = "1/mm",
      role = SpectrumRole.Unbounded
    )(Milk.absorption)
  private val reduced =
    rgbTexture("sigma_prime_s", "reduced scattering coefficient", onlyV2, "1/mm",
      role = SpectrumRole.Unbounded)(Milk.scattering)
  private val sigmaS =
    rgbTexture(
      "sigma_s", "scattering coefficient", sinceV3, "1/mm", role = SpectrumRole.Unbounded
    )(Milk.scattering)
  private val scale = float("scale", "scale of the coefficients")(1f)
  private val reflectance =
    rgbTexture(
      "reflectance",
      "diffuse reflectance, instead of the coefficients",
      onlyV4,
      shown = "none"
    )(Rgb.Black)
  private val meanFreePath =
    rgbTexture(
      "mfp", "mean free path, with `reflectance`", onlyV4, "mm", role = SpectrumRole.Unbounded
    )(Rgb.White)

  /** Whole milk, pbrt's default. */
  private def Milk = MeasuredMedia.coefficients("Wholemilk", Dialect.V4).get

  protected def interior()(using site: Site): Interior =
    val measured = measuredName.given_().filter(_.nonEmpty).flatMap(named)
    site.dialect match
      case Dialect.V4 if measuredName.given_().exists(_.nonEmpty) => measuredInterior(measured)
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf => ofColors()
      case Dialect.V3 =>
        // Measured coefficients are reduced, so scattering is isotropic
        val asymmetry = if measured.isDefined then 0f else g()
        byCoefficients(sigmaA, sigmaS, measured.getOrElse(Milk), asymmetry)
      case Dialect.V2 =>
        val milk = measured.getOrElse(Milk)
        val a = sigmaA.given_().getOrElse(ConstantRgb(milk.absorption))
        val s = reduced.given_().getOrElse(ConstantRgb(milk.scattering))
        DipoleInterior(a, s, scale(), index(), DipolePoints.Covered)

  private def named(name: String)(using site: Site): Option[MediumCoefficients] =
    val medium = MeasuredMedia.coefficients(name, site.dialect)
    if medium.isEmpty then
      val pos = site.declaration.param("name").fold(site.declaration.pos)(_.valuesAt)
      val message = s"unknown measured material \"$name\""
      val help = Suggest.help(name, MeasuredMedia.names(site.dialect))
      if site.dialect == Dialect.V4 then
        site.problems.missing(Code.UnknownType, pos, message, "using \"Wholemilk\"", help)
      else
        site.problems.warn(
          Code.UnknownType,
          pos,
          s"$message; using \"Wholemilk\", as in pbrt",
          help
        )
    medium

  private def measuredInterior(measured: Option[MediumCoefficients])(using site: Site): Interior =
    if g() != 0f then site.warn(Code.IdleParameter, "`g` is ignored because `name` is given")
    val medium = measured.getOrElse(Milk)
    coefficients(color(medium.absorption), color(medium.scattering), 0f)

  private def ofColors()(using site: Site): Interior =
    val (a, s, r) = (sigmaA.given_(), sigmaS.given_(), reflectance.given_())
    for (one, other, name) <- Seq((a, s, "sigma_s"), (s, a, "sigma_a")) do
      if one.isDefined && other.isEmpty then
        site.error(
          Code.ExclusiveParameters,
          s"`sigma_a` and `sigma_s` must be given together; `$name` is missing"
        )
    r.filter(_ => a.isEmpty && s.isEmpty) match
      case Some(tint) =>
        ReflectanceInterior(table(g()), tint, meanFreePath(), scale(), eta())
      case None => byCoefficients(sigmaA, sigmaS, Milk, g())

  private def byCoefficients(
      absorption: Field[RgbTexture],
      scattering: Field[RgbTexture],
      default: MediumCoefficients,
      asymmetry: Float
  )(using Site): Interior = coefficients(
    absorption.given_().getOrElse(color(default.absorption)),
    scattering.given_().getOrElse(color(default.scattering)),
    asymmetry
  )

  private def color(c: Rgb)(using site: Site): RgbTexture =
    ConstantRgb(site.resources.basis.unbounded(c))

  private def coefficients(a: RgbTexture, s: RgbTexture, asymmetry: Float)(using Site): Interior =
    CoefficientInterior(table(asymmetry), a, s, scale(), eta())

object KdSubsurfaceRecipe
    extends BssrdfRecipe("kdsubsurface", "subsurface scattering by colour", untilV3):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
  private val path = floatTexture("meanfreepath", "mean free path", onlyV2, "mm")(1f)
  private val paths = rgbTexture("mfp", "mean free path", onlyV3, "mm")(Rgb.White)
  private val scale = float("scale", "scale of the coefficients", onlyV3)(1f)

  protected def interior()(using site: Site): Interior =
    val color = kd()
    if site.dialect == Dialect.V2 then
      DiffuseDipoleInterior(color, path(), index(), DipolePoints.Covered)
    else
      ReflectanceInterior(table(g()), color, paths(), scale(), eta())

private object DipolePoints:
  /** Fraction of a surface that pbrt-v2 accounts for. It places points at a minimum distance until
    * 2,000 in a row fall too near to others, and gives each the area of a disc of that diameter.
    * These discs leave gaps: on a sphere, 201 to 12,264 of them covered 0.50 to 0.48 of it.
    */
  val Covered = 0.49f
