package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

/** Makes the plainest [[Material]] that is right: without varying textures, one [[Bsdf]]. */
object MaterialFactory:

  def matte(kd: RgbTexture, sigma: FloatTexture): Material =
    fold(MatteMaterial(kd, sigma), isFixed(kd) && isFixed(sigma))

  def diffuse(reflectance: RgbTexture): Material =
    fold(DiffuseMaterial(reflectance), isFixed(reflectance))

  def diffuseTransmission(r: RgbTexture, t: RgbTexture, scale: Float): Material =
    fold(DiffuseTransmissionMaterial(r, t, scale), isFixed(r) && isFixed(t))

  def translucent(
      kd: RgbTexture,
      ks: RgbTexture,
      reflect: RgbTexture,
      transmit: RgbTexture,
      roughness: Roughness,
      edition: Edition
  ): Material =
    fold(
      TranslucentMaterial(kd, ks, reflect, transmit, roughness, edition),
      Seq(kd, ks, reflect, transmit).forall(isFixed) && roughness.isConstant
    )

  def mix(first: Material, second: Material, amount: RgbTexture): Material =
    val isPlain = Seq(first, second).forall(m => m.isConstant || (m eq InterfaceMaterial))
    fold(MixedMaterial(first, second, amount), isPlain && isFixed(amount))

  /** @param thickness in mean free paths of the coat's absorption
    * @param scattering albedo of the medium between coat and base
    * @param maxDepth  how many times light may meet coat or base from within
    * @param bySpectrum applies a function to the reflectance, wavelength by wavelength, if that is
    *                  known: what goes back and forth under the coat grows faster than its colour
    * @return None if the medium scatters or the thickness varies: then layers must be walked
    */
  def coatedDiffuse(
      reflectance: RgbTexture,
      roughness: Roughness,
      thickness: FloatTexture,
      scattering: RgbTexture,
      eta: Float,
      maxDepth: Int,
      coats: Coats,
      bySpectrum: Option[(Float => Float) => Rgb] = None
  ): Option[Material] =
    for
      depth <- thickness.constant
      _ <- scattering.constant.filter(_.max <= 0f)
    yield
      val family =
        if roughness.isConstant then
          IArray(coats.of(roughness.trowbridgeReitz(ShadingPoint()), eta, depth))
        else coats.family(eta, depth)
      // Light meets the base first, then coat and base in turn.
      val hits = (maxDepth + 1) / 2
      bySpectrum.filter(_ => isFixed(reflectance) && roughness.isConstant) match
        case Some(colored) =>
          def series(coat: Coat) = colored(CoatedDiffuse.series(_, coat, hits))
          ConstantMaterial(
            new CoatedDiffuse(series, roughness.trowbridgeReitz(ShadingPoint()), family(0)),
            roughness.isAnisotropic
          )
        case None =>
          val material = CoatedDiffuseMaterial(reflectance, roughness, family, hits)
          fold(material, isFixed(reflectance) && roughness.isConstant)

  /** A diffuse surface under a coat, by walks between the two. */
  def layeredDiffuse(
      reflectance: RgbTexture,
      roughness: Roughness,
      eta: Float,
      medium: LayerMedium
  ): Material = LayeredDiffuseMaterial(reflectance, roughness, eta, medium)

  /** A metal under a coat: smooth on smooth if that can be summed, else by walks between the two.
    *
    * @param metal    as seen from within the coat
    * @param mirrored what a smooth metal and a smooth coat reflect together at the cosine, if that
    *                 is known
    */
  def coatedConductor(
      metal: MetalTexture,
      bottom: Roughness,
      top: Roughness,
      eta: Float,
      medium: LayerMedium,
      mirrored: Option[Float => Rgb]
  ): Material =
    def isSmooth(r: Roughness) = r.isConstant && r.trowbridgeReitz(ShadingPoint()).isSmooth
    val walked = LayeredConductorMaterial(metal, bottom, top, eta, medium)
    mirrored.filter(_ => isSmooth(bottom) && (isSmooth(top) || (top.isConstant && eta == 1f))) match
      case Some(curve) =>
        SummedConductorMaterial(Mirror(Rgb.White, TabulatedReflectance.of(256)(curve)), walked)
      case None => walked

  def substrate(kd: RgbTexture, ks: RgbTexture, roughness: Roughness): Material =
    fold(SubstrateMaterial(kd, ks, roughness), isFixed(kd) && isFixed(ks) && roughness.isConstant)

  def mirror(kr: RgbTexture): Material = fold(MirrorMaterial(kr), isFixed(kr))

  def shinyMetal(ks: RgbTexture, kr: RgbTexture, roughness: Roughness): Material =
    fold(ShinyMetalMaterial(ks, kr, roughness), isFixed(ks) && isFixed(kr) && roughness.isConstant)

  def conductor(metal: MetalTexture, roughness: Roughness): Material =
    fold(ConductorMaterial(metal, roughness), metal.isConstant && roughness.isConstant)

  def conductor(curve: ReflectanceCurve, roughness: Roughness): Material =
    conductor(UniformMetal(curve), roughness)

  def conductor(eta: RgbTexture, k: RgbTexture, roughness: Roughness): Material =
    conductor(IndexedMetal(eta, k), roughness)

  def conductor(reflectance: RgbTexture, roughness: Roughness): Material =
    conductor(TintedMetal(reflectance), roughness)

  /** PBRT 4's dielectric, and PBRT 3's glass. */
  def dielectric(
      kr: RgbTexture,
      kt: RgbTexture,
      eta: FloatTexture,
      roughness: Roughness
  ): Material =
    fold(
      DielectricMaterial(kr, kt, eta, roughness, compresses = true),
      isFixed(kr) && isFixed(kt) && isFixed(eta) && roughness.isConstant
    )

  def dielectric(eta: Float, roughness: Roughness): Material =
    dielectric(White, White, ConstantFloat(eta), roughness)

  /** Glass whose index depends on the wavelength (in nm).
    *
    * @param usual the index where no wavelength is asked for
    */
  def dispersive(eta: Float => Float, usual: Float, roughness: Roughness): Material =
    fold(DispersiveMaterial(eta, usual, roughness), roughness.isConstant)

  /** PBRT 2's glass: always smooth, and refraction doesn't change radiance. */
  def oldGlass(kr: RgbTexture, kt: RgbTexture, eta: FloatTexture): Material =
    fold(
      DielectricMaterial(kr, kt, eta, Smooth, compresses = false),
      isFixed(kr) && isFixed(kt) && isFixed(eta)
    )

  def thinDielectric(eta: Float): Material =
    ConstantMaterial(ThinDielectric(if eta == 0f then 1f else eta))

  /** PBRT 2's translucent surfaces: always smooth. */
  def reflectingInterface(kr: RgbTexture, eta: FloatTexture): Material =
    fold(ReflectingInterfaceMaterial(kr, eta), isFixed(kr) && isFixed(eta))

  def plastic(kd: RgbTexture, ks: RgbTexture, roughness: Roughness, edition: Edition): Material =
    fold(
      PlasticMaterial(kd, ks, roughness, edition),
      isFixed(kd) && isFixed(ks) && roughness.isConstant
    )

  def uber(
      kd: RgbTexture,
      ks: RgbTexture,
      kr: RgbTexture,
      kt: RgbTexture,
      opacity: RgbTexture,
      eta: FloatTexture,
      roughness: Roughness,
      edition: Edition
  ): Material =
    fold(
      UberMaterial(kd, ks, kr, kt, opacity, eta, roughness, edition),
      Seq(kd, ks, kr, kt, opacity).forall(isFixed) && isFixed(eta) && roughness.isConstant
    )

  def disney(parameters: DisneyParameters): Material =
    val surface = fold(DisneyMaterial(parameters), parameters.isConstant)
    if parameters.isSubsurface then
      val inside = Interior.fold(DisneyInterior(parameters), parameters.isConstant)
      SubsurfaceMaterial(surface, inside, alongTangents = true)
    else surface

  private val White = ConstantRgb(Rgb.White)
  private val Zero = ConstantFloat(0f)
  private val Smooth = Roughness(Zero, Zero, RoughnessModel.PlainAlpha)

  private def isFixed(texture: RgbTexture): Boolean = texture.constant.isDefined
  private def isFixed(texture: FloatTexture): Boolean = texture.constant.isDefined

  /** No texture looks at the point if all are constant. */
  private def fold(material: Material, isFixed: Boolean): Material =
    if isFixed then ConstantMaterial(material.bsdf(ShadingPoint()), material.isAnisotropic)
    else material
