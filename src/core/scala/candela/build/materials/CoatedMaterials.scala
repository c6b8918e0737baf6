package candela.build.materials

import candela.diagnostics.Code
import candela.bsdf.{Fresnel, Material}
import candela.bsdf.layered.{
  CoatedConductorMaterial, CoatedDiffuseMaterial, LayerMedium, Varnish,
  VarnishMaterial
}
import candela.bsdf.microfacet.{MetalTexture, Roughness, RoughnessModel}
import candela.build.recipe.*
import candela.color.Rgb
import candela.math.*
import candela.scenefile.Dialect
import candela.textures.{FloatTexture, RgbTexture}

/** Declares the parameters of the medium between a coating and its base. */
private[build] trait LayerFields extends Fields:

  private[build] final class LayerParameters(
      val thickness: Field[FloatTexture],
      val albedo: Field[RgbTexture],
      val g: Field[FloatTexture],
      val depth: Field[Int],
      val walks: Field[Int]
  ):
    def medium(using Site): LayerMedium =
      LayerMedium(thickness(), albedo(), g(), depth(), walks())

  /** Warns of coats that pbrt-v4 evaluates too brightly: where light below a rough interface is
    * spread, its two strategies to cross that have weights of a sum above one.
    */
  protected final def warnOfWeights(coat: Roughness, eta: Float, spreads: Boolean)(using
      site: Site
  ): Unit =
    if site.rules.dialect == Dialect.V4 && spreads && !coat.isSmooth && eta != 1f then
      site.warn(
        Code.UnlikePbrt,
        "pbrt-v4 overestimates rough coats by 1 to 20 % where it samples lights: its image is " +
          "brighter"
      )

  protected final def layerParameters(): LayerParameters = LayerParameters(
    floatTexture("thickness", "thickness of the coating, in mean free paths")(0.01f),
    rgbTexture("albedo", "albedo of the medium inside the coating")(Rgb.Black),
    floatTexture("g", "scattering asymmetry inside the coating, -1 to 1")(0f),
    integer(
      "maxdepth",
      "maximum interactions between the layers",
      range = Range.atLeast(1f).deferred
    )(10),
    integer("nsamples", "random walks per evaluation, if layers are sampled stochastically")(1)
  )

object CoatedDiffuseRecipe
    extends RoughRecipe("coateddiffuse", "diffuse base under a dielectric coating", onlyV4, 0f)
    with LayerFields
    with TintedRecipe:
  protected val tint: Field[RgbTexture] =
    rgbTexture("reflectance", "reflectance of the base, 0 to 1")(Rgb.gray(0.5f))
  private val layers = layerParameters()
  private val eta = spectrum(
    "eta",
    "index of refraction of the coating",
    range = Indices.range
  )(Indices.glass)
  protected def tinted()(using site: Site): (RgbTexture, Site) => Material =
    val basis = site.resources.basis
    val coating = eta()
    val (coat, index) = (roughness(), Indices.scalar(coating))
    warnOfWeights(coat, index, spreads = true)
    val coated =
      CoatedDiffuseMaterial.family(coat, index, layers.medium, site.resources.coats)
    (reflectance, _) =>
      // The spectral reflectance of a constant colour is precomputed
      val bySpectrum = reflectance.constant.map: color =>
        lazy val base = basis.reflectance(color)
        (f: Float => Float) => basis.ofReflectance(nm => f(base(nm)))
      Indices.disperse(coating)(coated(reflectance, bySpectrum))

object RoughPlasticRecipe
    extends RoughRecipe("roughplastic", "plastic, smooth or rough", onlyMitsuba, 0f):
  private val reflectance =
    rgbTexture("reflectance", "reflectance of the base, 0 to 1")(Rgb.gray(0.5f))
  private val specular = rgbTexture("specular", "scale of the coat's reflection")(Rgb.White)
  private val nonlinear =
    bool("nonlinear", "apply the base colour at each interreflection")(false)
  private val interreflection =
    bool("interreflection", "simulate interreflection between coat and base")(true)
  private val eta = float("eta", "index of refraction of the coating", range = Indices.range)(1.49f)
  protected def create()(using site: Site): Material =
    val rough = roughness()
    if !rough.isConstant && interreflection() then
      site.warn(
        Code.Unsupported,
        "the interreflection of \"roughplastic\" uses its roughness at (0, 0)"
      )
    val varnish =
      if !interreflection() then Varnish.Once
      else if nonlinear() then Varnish.Colored
      else Varnish.Plain
    VarnishMaterial(reflectance(), specular(), varnish, rough, eta(), site.resources.coats)

object CoatedConductorRecipe
    extends MaterialRecipe("coatedconductor", "conductor under a dielectric coating", onlyV4)
    with LayerFields
    with MetalFields
    with TintedRecipe:

  /** Roughness of one of the two interfaces. */
  private final class Side(name: String):
    private val isotropic =
      floatTexture(s"$name.roughness", s"$name roughness; 0: smooth", range = Range.nonNegative)(0f)
    private val u = along("u")
    private val v = along("v")
    private def along(axis: String) =
      floatTexture(
        s"$name.${axis}roughness",
        s"$name roughness along $axis",
        shown = s"$name.roughness",
        range = Range.nonNegative
      )(0f)
    def apply()(using Site): Roughness =
      val model = if remap() then RoughnessModel.SquareRootAlpha else RoughnessModel.PlainAlpha
      Roughness(u.given_().getOrElse(isotropic()), v.given_().getOrElse(isotropic()), model)

  private val interface = Side("interface")
  private val conductor = Side("conductor")
  private val remap =
    bool("remaproughness", "remap roughness from [0, 1] to microfacet alpha")(true)
  private val eta = spectrum(
    "interface.eta",
    "index of refraction of the coating",
    range = Indices.range
  )(Indices.glass)
  private val index = metalIndex("conductor.", tint = true)
  private val layers = layerParameters()
  protected val tint: Field[RgbTexture] = index.reflectance.get

  override protected def create()(using Site): Material =
    if tint.given_().isDefined then super.create()
    else
      val outside = Indices.scalar(eta())
      coated(outside)(metal(index, outside), spectral(index, outside))

  protected def tinted()(using Site): (RgbTexture, Site) => Material =
    val outside = Indices.scalar(eta())
    val withMetal = coated(outside)
    val metal = tintedMetal(index, outside)
    (reflectance, site) =>
      val spectrum = tintedSpectrum(reflectance, outside)
      withMetal(metal(reflectance, spectrum, site), spectrum)

  /** By the metal, and its reflectance by cosine and wavelength, if there is one.
    *
    * @param outside index of the coating
    */
  private def coated(outside: Float)(using
      Site
  ): (MetalTexture, Option[Float => Float => Float]) => Material =
    val coat = eta()
    val medium = layers.medium
    val (below, above) = (conductor(), interface())
    val scatters = !medium.albedo.constant.exists(_.isBlack)
    warnOfWeights(above, outside, spreads = scatters || !below.isSmooth)
    (metal, spectrum) =>
      Indices.disperse(coat):
        CoatedConductorMaterial(
          metal,
          below,
          above,
          outside,
          medium,
          spectrum.flatMap(mirrored(_, outside, medium)).map(Spectra.underWhite(_))
        )

  /** Reflectance of a smooth conductor under a smooth coating that at most absorbs: the geometric
    * series of internal reflections.
    */
  private def mirrored(
      metal: Float => Float => Float,
      eta: Float,
      medium: LayerMedium
  ): Option[Float => Float => Float] =
    for
      thickness <- medium.thickness.constant
      albedo <- medium.albedo.constant if albedo.isBlack
    yield cosTheta =>
      val outer = Fresnel.dielectric(cosTheta, eta)
      val inside = Fresnel.cosRefracted(cosTheta, eta)
      // Absorption on the way down and up
      val transmittance = if inside > 0f then exp(-2f * Math.max(thickness, 0f) / inside) else 0f
      val base = metal(Math.max(inside, 0f))
      nm =>
        val trip = base(nm) * transmittance
        var sum = 0f
        for _ <- 0 until medium.sampledBaseHits do sum = trip * (1f + outer * sum)
        outer + square(1f - outer) * sum
