package candela.bsdf.composite

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.bsdf.{
  ConstantMaterial, DiffuseMaterial, DiffuseTransmissionMaterial, Directions, FullReflectance,
  Lambert, Material, MatteMaterial, OrenNayar
}
import candela.bsdf.layered.{CoatedDiffuseMaterial, Coats, LayerMedium, LayeredMaterial}
import candela.bsdf.microfacet.{
  ConductorMaterial, DielectricMaterial, DispersiveMaterial, IndexedMetal, MirrorMaterial,
  Roughness,
  RoughnessModel, SubstrateMaterial, ThinDielectricMaterial, TintedMetal, UniformMetal
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

class MaterialSuite extends AnyFunSuite:
  private object FromU extends FloatTexture:
    def apply(at: ShadingPoint): Float = at.u
  private object GrayFromV extends RgbTexture:
    def apply(at: ShadingPoint): Rgb = Rgb.gray(at.v)

  private def gray(v: Float) = ConstantRgb(Rgb.gray(v))
  private def number(v: Float) = ConstantFloat(v)
  private def rough(v: Float, model: RoughnessModel = RoughnessModel.PlainAlpha) =
    Roughness(number(v), number(v), model)
  private def point(u: Float, v: Float): ShadingPoint =
    val at = ShadingPoint()
    at.u = u
    at.v = v
    at

  private val (wo, wi) = (Directions.at(30, 0), Directions.at(50, 140))

  private def medium(
      thickness: FloatTexture = number(0.01f),
      albedo: RgbTexture = gray(0f),
      depth: Int = 10
  ): LayerMedium = LayerMedium(thickness, albedo, number(0f), depth, walks = 1)

  private def coated(
      reflectance: RgbTexture,
      roughness: Roughness,
      medium: LayerMedium = medium()
  ): Material = CoatedDiffuseMaterial(reflectance, roughness, 1.5f, medium, Coats())

  private def uber(opacity: RgbTexture, edition: Edition): Material = UberMaterial(
    gray(0.25f), gray(0.25f), gray(0.1f), gray(0.1f), opacity, number(1.5f),
    rough(0.1f), edition
  )

  test("without varying textures the BSDF is made once; with one, at every point"):
    val fixed = Seq(
      MatteMaterial(gray(0.5f), number(0f)),
      DiffuseMaterial(gray(0.5f)),
      DiffuseTransmissionMaterial(gray(0.5f), gray(0.5f), 1f),
      coated(gray(0.5f), rough(0.2f)),
      SubstrateMaterial(gray(0.5f), gray(0.5f), rough(0.1f)),
      MirrorMaterial(gray(0.9f)),
      ConductorMaterial(UniformMetal(FullReflectance), rough(0.1f)),
      ConductorMaterial(IndexedMetal(gray(0.2f), gray(3f)), rough(0.1f)),
      ConductorMaterial(TintedMetal(gray(0.9f)), rough(0.1f)),
      DielectricMaterial(1.5f, rough(0f)),
      DielectricMaterial.pbrt2Glass(gray(1f), gray(1f), number(1.5f)),
      ThinDielectricMaterial(1.5f, gray(1f), gray(1f)),
      DispersiveMaterial(ThinDielectricMaterial(1.5f, gray(1f), gray(1f))),
      PlasticMaterial(gray(0.5f), gray(0.2f), rough(0.1f), Edition.Third),
      uber(gray(1f), Edition.Third)
    )
    for material <- fixed do
      val folded = material.folded
      assert(folded.resolved.isInstanceOf[ConstantMaterial] && (folded.resolved eq folded.resolved))
      assert(folded.flags == folded.resolved.flags)
    val roughness = Roughness(FromU, number(0.1f), RoughnessModel.PlainAlpha)
    val varying = Seq(
      MatteMaterial(GrayFromV, number(0f)),
      MatteMaterial(gray(0.5f), FromU),
      DiffuseMaterial(GrayFromV),
      DiffuseTransmissionMaterial(gray(0.5f), GrayFromV, 1f),
      coated(GrayFromV, rough(0.2f)),
      SubstrateMaterial(gray(0.5f), GrayFromV, rough(0.1f)),
      MirrorMaterial(GrayFromV),
      ConductorMaterial(UniformMetal(FullReflectance), roughness),
      ConductorMaterial(IndexedMetal(gray(0.2f), GrayFromV), rough(0.1f)),
      ConductorMaterial(TintedMetal(GrayFromV), rough(0.1f)),
      DielectricMaterial(1.5f, roughness),
      DielectricMaterial.pbrt2Glass(gray(1f), gray(1f), FromU),
      PlasticMaterial(gray(0.5f), gray(0.2f), roughness, Edition.Third),
      uber(GrayFromV, Edition.Third)
    )
    for material <- varying do
      assert(material.folded eq material)
      val s = material.bsdf(point(0.3f, 0.4f)).sample(wo, 0.5f, 0.4f, 0.3f)
      assert(s.weight.isFinite)

  test("textures are looked up where the ray met the surface"):
    val matte = MatteMaterial(GrayFromV, FromU)
    assert(matte.bsdf(point(0f, 0.25f)).f(wo, wi) == Lambert(Rgb.gray(0.25f)).f(wo, wi))
    val clay = OrenNayar(Rgb.gray(0.5f), 30f)
    assert(matte.bsdf(point(30f, 0.5f)).f(wo, wi) == clay.f(wo, wi))

  test(
    "a varying roughness of a coat keeps its own gloss over a coat between two of a family",
    Slow
  ):
    val roughness = Roughness(FromU, FromU, RoughnessModel.PlainAlpha)
    val varying = coated(gray(0.5f), roughness).bsdf(point(0.25f, 0f))
    val fixed = coated(gray(0.5f), rough(0.25f)).bsdf(point(0f, 0f))
    assert(varying.f(wo, wi) == fixed.f(wo, wi)) // 0.25 is one of the family
    val between = coated(gray(0.5f), roughness).bsdf(point(0.505f, 0f))
    val exact = coated(gray(0.5f), rough(0.505f)).bsdf(point(0f, 0f))
    // The family's error, twice: in and out.
    assert(Math.abs(between.f(wo, wi).r - exact.f(wo, wi).r) < 0.006f * exact.f(wo, wi).r)

  test("reflectances are held to their range"):
    val most = Lambert(Rgb.White).f(wo, wi)
    assert(DiffuseMaterial(gray(7f)).bsdf(point(0f, 0f)).f(wo, wi) == most)
    assert(MatteMaterial(gray(-1f), number(0f)).bsdf(point(0f, 0f)).f(wo, wi).isBlack)
    val both = DiffuseTransmissionMaterial(gray(0.9f), gray(0.2f), 2f).bsdf(point(0f, 0f))
    assert(both.f(wo, wi) == most && both.f(wo, -wi).r == 0.4f * InvPi)
    assert(MatteMaterial(gray(1f), number(500f)).bsdf(point(0f, 0f)).f(wo, wi) ==
      OrenNayar(Rgb.White, 90f).f(wo, wi))

  test("coats with a scattering medium or varying thickness are walked"):
    def isWalked(medium: LayerMedium) =
      coated(gray(0.5f), rough(0.2f), medium).isInstanceOf[LayeredMaterial]
    assert(isWalked(medium(albedo = gray(0.1f))))
    assert(isWalked(medium(albedo = GrayFromV)))
    assert(isWalked(medium(thickness = FromU)))
    assert(!isWalked(medium()))

  test("half the depth of a coat is how often light meets the base"):
    def f(depth: Int) =
      coated(gray(0.9f), rough(0f), medium(depth = depth)).bsdf(point(0f, 0f)).f(wo, wi).r
    assert(f(1) < f(3) && f(3) == f(4) && f(4) < f(5))
    assert(f(10) > 1.9f * f(1))

  test("plastic of both editions reflects all past 42 degrees, the third only from above"):
    def specular(edition: Edition, side: Float) =
      val bsdf = PlasticMaterial(gray(0f), gray(1f), rough(0.3f), edition)
        .bsdf(point(0f, 0f))
      bsdf.f(Vec3(wo.x, wo.y, wo.z * side), Vec3(-wo.x, wo.y, wo.z * side)).r
    assert(specular(Edition.Second, 1f) == specular(Edition.Second, -1f))
    assert(specular(Edition.Third, 1f) == specular(Edition.Second, 1f))
    assert(specular(Edition.Third, -1f) < specular(Edition.Third, 1f))

  test("opacity takes from everything else what it lets pass"):
    val half = uber(gray(0.5f), Edition.Third).bsdf(point(0f, 0f))
    val whole = uber(gray(1f), Edition.Third).bsdf(point(0f, 0f))
    // Rounding.
    assert(Math.abs(2 * half.f(wo, wi).r - whole.f(wo, wi).r) < 1e-6f)
    val s = half.sample(wo, 0f, 0.5f, 0.5f)
    assert(s.wi == -wo && Math.abs(s.weight.r * s.pdf - 0.5f) < 1e-6f)
    assert(half.isTransmissive)

  test("glass of the second edition leaves radiance as it is, and dielectrics scale it"):
    def weight(material: Material) =
      material.bsdf(point(0f, 0f)).sample(Vec3.Z, 0.99f, 0.5f, 0.5f).weight.r
    assert(weight(DielectricMaterial.pbrt2Glass(gray(1f), gray(1f), number(1.5f))) == 1f)
    val dielectric = weight(DielectricMaterial(1.5f, rough(0f)))
    assert(Math.abs(dielectric - 1 / 2.25f) < 1e-6f) // rounding
    assert(weight(DielectricMaterial(0f, rough(0f))) == 1f) // an index of 0 is none
