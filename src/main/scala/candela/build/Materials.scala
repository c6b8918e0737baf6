package candela.build

import candela.bsdf.{
  ConductorReflectance, Edition, Fresnel, InterfaceMaterial, Material, MaterialFactory as Make,
  ReflectanceCurve, Roughness, StrongConductorReflectance, RoughnessModel, TabulatedReflectance
}
import candela.color.{Colorimetry, Rgb, Upsampling}

import candela.scenefile.Dialect

/** Recipes of materials: what the dialects call them, and their parameters. */
object Materials:
  private val instead = "a grey diffuse surface is used"

  val all: Recipes[Material] = Recipes(
    "material",
    Vector(
      Matte, Plastic, Metal, Glass, Mirror, Uber, Substrate, Interface(""), Interface("none"),
      Interface("interface"), Diffuse, CoatedDiffuse, Conductor, Dielectric, ThinDielectric,
      DiffuseTransmission, Measured
    ),
    Vector(
      "mix", "measured", "fourier", "hair", "subsurface", "kdsubsurface", "translucent",
      "shinymetal",
      "coatedconductor", "disney"
    ).map(_ -> instead).toMap
  )

  /** Of shapes that no material was given for, or one that is not supported. */
  val default: Material = Make.diffuse(candela.textures.ConstantRgb(Rgb.gray(0.5f)))

  def build(site: Site): Material = all.build(site).getOrElse(default)

  abstract class MaterialRecipe(name: String, dialects: Set[Dialect])
      extends Recipe[Material](name, dialects):
    notYet("bumpmap", "the surface is smooth")
    notYet("displacement", "the surface is smooth")
    notYet("normalmap", "the surface is smooth")

  /** The parameters of roughness that many materials share. */
  abstract class RoughRecipe(name: String, dialects: Set[Dialect], default: Float)
      extends MaterialRecipe(name, dialects):
    private val both = floatTexture("roughness", "of the surface; 0: smooth")(default)
    private val u = floatTexture("uroughness", "along u; default: `roughness`", sinceV3)(default)
    private val v = floatTexture("vroughness", "along v; default: `roughness`", sinceV3)(default)
    private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", sinceV3)(true)

    protected def roughness(smoothAtZero: Boolean = false)(using site: Site): Roughness =
      val model = site.dialect match
        case Dialect.V2 => RoughnessModel.BlinnExponent
        case Dialect.V3 =>
          if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
        case Dialect.V4 =>
          if remap() then RoughnessModel.SquareRootAlpha else RoughnessModel.PlainAlpha
      val (along, across) = (u.given_().getOrElse(both()), v.given_().getOrElse(both()))
      Roughness(along, across, model, smoothAtZero)

  object Matte extends MaterialRecipe("matte", untilV3):
    private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
    private val sigma = floatTexture("sigma", "Oren–Nayar's spread of facets, degrees")(0f)
    protected def make()(using Site): Material = Make.matte(kd(), sigma())

  object Plastic extends RoughRecipe("plastic", untilV3, 0.1f):
    private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
    private val ks = rgbTexture("Ks", "factor of the gloss")(Rgb.gray(0.25f))
    protected def make()(using site: Site): Material =
      Make.plastic(kd(), ks(), roughness(), edition(site.dialect))

  object Uber extends RoughRecipe("uber", untilV3, 0.1f):
    private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
    private val ks = rgbTexture("Ks", "factor of the gloss")(Rgb.gray(0.25f))
    private val kr = rgbTexture("Kr", "factor of mirror reflection")(Rgb.Black)
    private val kt = rgbTexture("Kt", "factor of refraction", onlyV3)(Rgb.Black)
    private val opacity = rgbTexture("opacity", "what does not pass straight through")(Rgb.White)
    private val eta = floatTexture("eta", "index of refraction", onlyV3)(1.5f)
    private val index = floatTexture("index", "index of refraction")(1.5f)
    protected def make()(using site: Site): Material =
      val n = eta.given_().getOrElse(index())
      Make.uber(kd(), ks(), kr(), kt(), opacity(), n, roughness(), edition(site.dialect))

  private def edition(dialect: Dialect): Edition =
    if dialect == Dialect.V2 then Edition.Second else Edition.Third

  object Mirror extends MaterialRecipe("mirror", untilV3):
    private val kr = rgbTexture("Kr", "reflectance")(Rgb.gray(0.9f))
    protected def make()(using Site): Material = Make.mirror(kr())

  object Substrate extends MaterialRecipe("substrate", untilV3):
    private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
    private val ks = rgbTexture("Ks", "gloss at normal incidence")(Rgb.gray(0.5f))
    private val u = floatTexture("uroughness", "along u")(0.1f)
    private val v = floatTexture("vroughness", "along v")(0.1f)
    private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", onlyV3)(true)
    protected def make()(using site: Site): Material =
      val model =
        if site.dialect == Dialect.V2 then RoughnessModel.AnisotropicExponents
        else if remap() then RoughnessModel.PolynomialAlpha
        else RoughnessModel.BoundedAlpha
      Make.substrate(kd(), ks(), Roughness(u(), v(), model))

  object Glass extends MaterialRecipe("glass", untilV3):
    private val kr = rgbTexture("Kr", "factor of reflection")(Rgb.White)
    private val kt = rgbTexture("Kt", "factor of refraction")(Rgb.White)
    private val eta = floatTexture("eta", "index of refraction", onlyV3)(1.5f)
    private val index = floatTexture("index", "index of refraction")(1.5f)
    private val u = floatTexture("uroughness", "along u; 0: smooth", onlyV3)(0f)
    private val v = floatTexture("vroughness", "along v; 0: smooth", onlyV3)(0f)
    private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", onlyV3)(true)
    protected def make()(using site: Site): Material =
      if site.dialect == Dialect.V2 then Make.oldGlass(kr(), kt(), index())
      else
        val model = if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
        val rough = Roughness(u(), v(), model, smoothAtZero = true)
        Make.dielectric(kr(), kt(), eta.given_().getOrElse(index()), rough)

  /** Copper, where no metal is named. */
  private def copper(quantity: String): SpectralValue =
    SpectralValue.Wavelengths(Colorimetry.named(s"metal-Cu-$quantity").get)

  object Metal extends RoughRecipe("metal", untilV3, 0.01f):
    private val eta = spectrum("eta", "index of refraction")(copper("eta"))
    private val k = spectrum("k", "absorption coefficient")(copper("k"))
    protected def make()(using site: Site): Material =
      def rgb(v: SpectralValue): Rgb = v match
        case SpectralValue.Color(c) => c
        case SpectralValue.Wavelengths(s) =>
          Spectra.toRgb(s, SpectrumRole.Reflectance, site.dialect)
      val (n, a) = (rgb(eta()), rgb(k()))
      // pbrt-v2 has the approximation for strongly absorbing metals
      val curve =
        if site.dialect == Dialect.V2 then StrongConductorReflectance(n, a)
        else ConductorReflectance(n, a)
      Make.conductor(curve, roughness())

  object Diffuse extends MaterialRecipe("diffuse", onlyV4):
    private val reflectance = rgbTexture("reflectance", "0 to 1")(Rgb.gray(0.5f))
    protected def make()(using Site): Material = Make.diffuse(reflectance())

  object DiffuseTransmission extends MaterialRecipe("diffusetransmission", onlyV4):
    private val reflectance = rgbTexture("reflectance", "0 to 1")(Rgb.gray(0.25f))
    private val transmittance = rgbTexture("transmittance", "0 to 1")(Rgb.gray(0.25f))
    private val scale = float("scale", "factor of both")(1f)
    protected def make()(using Site): Material =
      Make.diffuseTransmission(reflectance(), transmittance(), scale())

  object CoatedDiffuse extends RoughRecipe("coateddiffuse", onlyV4, 0f):
    private val reflectance = rgbTexture("reflectance", "of the base, 0 to 1")(Rgb.gray(0.5f))
    private val thickness = floatTexture("thickness", "of the coat, mean free paths")(0.01f)
    private val albedo = rgbTexture("albedo", "of the medium in the coat")(Rgb.Black)
    private val eta = spectrum("eta", "index of refraction of the coat")(Indices.glass)
    private val depth = integer("maxdepth", "most interactions within the layers")(10)
    irrelevant(
      "g",
      "nsamples"
    ) // of a medium that scatters; of the random walk that is not needed here
    protected def make()(using site: Site): Material =
      val coats = site.resources.coats
      val basis = site.resources.basis
      // A colour that is the same everywhere can be scattered by wavelength, once and for all
      val bySpectrum = reflectance().constant.map: color =>
        val base = Upsampling.spectrum(basis.toSrgb(color))
        (f: Float => Float) =>
          basis.fromSrgb(Colorimetry.rgb(nm => f(base(nm)), Colorimetry.White.D65))
      Make
        .coatedDiffuse(
          reflectance(), roughness(), thickness(), albedo(), Indices.one(eta()), depth(), coats,
          bySpectrum
        )
        .getOrElse {
          site.warn(s"a coat that scatters or varies in thickness is not supported yet: $instead")
          Make.diffuse(reflectance())
        }

  object Conductor extends RoughRecipe("conductor", onlyV4, 0f):
    private val eta = spectrum("eta", "index of refraction")(copper("eta"))
    private val k = spectrum("k", "absorption coefficient")(copper("k"))
    private val reflectance =
      rgbTexture("reflectance", "at normal incidence, instead of eta and k")(Rgb.White)
    protected def make()(using site: Site): Material =
      reflectance.given_() match
        case Some(r) => Make.conductor(r, roughness())
        case None =>
          val curve = reflectanceOf(Indices.spectrum(eta()), Indices.spectrum(k()))
          Make.conductor(curve, roughness())

    /** Fresnel's equations by wavelength, seen under white light, for each angle. */
    private def reflectanceOf(eta: Float => Float, k: Float => Float)(using
        site: Site
    ): ReflectanceCurve =
      TabulatedReflectance.of(128): cosTheta =>
        val reflected = Colorimetry.rgb(
          nm => Fresnel.conductor(cosTheta, eta(nm), k(nm)),
          Colorimetry.White.D65
        )
        site.resources.basis.fromSrgb(reflected)

  object Dielectric extends RoughRecipe("dielectric", onlyV4, 0f):
    private val eta = spectrum("eta", "index of refraction")(Indices.glass)
    protected def make()(using Site): Material =
      Make.dielectric(Indices.one(eta()), roughness())

  object ThinDielectric extends MaterialRecipe("thindielectric", onlyV4):
    private val eta = spectrum("eta", "index of refraction")(Indices.glass)
    protected def make()(using Site): Material = Make.thinDielectric(Indices.one(eta()))

  /** pbrt-v2's tables of measured reflectance. Where the file is missing pbrt-v2 says so and
    * renders a surface that reflects nothing; so do we.
    */
  object Measured extends MaterialRecipe("measured", onlyV2):
    private val filename = string("filename", "a .brdf file")("")
    protected def make()(using site: Site): Material =
      val path = site.declaration.folder.resolve(filename().replace('\\', '/'))
      if java.nio.file.Files.isRegularFile(path) then
        site.warn(s"material \"measured\" is not supported yet: $instead")
        default
      else
        site.warn(s"no file `${filename()}`: the surface is black, as pbrt-v2 renders it")
        Make.diffuse(candela.textures.ConstantRgb(Rgb.Black))

  final class Interface(name: String) extends MaterialRecipe(name, sinceV3):
    protected def make()(using Site): Material = InterfaceMaterial

  /** Indices of refraction that may come as spectra. */
  private object Indices:
    val glass: SpectralValue = SpectralValue.Color(Rgb.gray(1.5f))

    def spectrum(v: SpectralValue): Float => Float = v match
      case SpectralValue.Wavelengths(s) => s(_)
      case SpectralValue.Color(c) => Upsampling.unbounded(c)

    /** The index at the sodium line (589.3 nm), by which glass is named; dispersion is not
      * modelled.
      */
    def one(v: SpectralValue)(using site: Site): Float = v match
      case SpectralValue.Color(c) => c.average
      case SpectralValue.Wavelengths(s) =>
        if s.values.distinct.length > 1 then
          site.warn("dispersion is not supported yet: the index of refraction at 589 nm is used")
        s(589.3f)
