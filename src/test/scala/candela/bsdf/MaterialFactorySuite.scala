package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}
import org.scalatest.funsuite.AnyFunSuite

class MaterialFactorySuite extends AnyFunSuite:
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

  private def coated(reflectance: RgbTexture, roughness: Roughness): Option[Material] =
    MaterialFactory.coatedDiffuse(
      reflectance, roughness, number(0.01f), gray(0f), 1.5f, 10, Coats()
    )

  private def uber(opacity: RgbTexture, edition: Edition): Material = MaterialFactory.uber(
    gray(0.25f), gray(0.25f), gray(0.1f), gray(0.1f), opacity, number(1.5f),
    rough(0.1f), edition
  )

  test("without varying textures the BSDF is made once; with one, at every point"):
    val fixed = Seq(
      MaterialFactory.matte(gray(0.5f), number(0f)),
      MaterialFactory.diffuse(gray(0.5f)),
      MaterialFactory.diffuseTransmission(gray(0.5f), gray(0.5f), 1f),
      coated(gray(0.5f), rough(0.2f)).get,
      MaterialFactory.substrate(gray(0.5f), gray(0.5f), rough(0.1f)),
      MaterialFactory.mirror(gray(0.9f)),
      MaterialFactory.conductor(FullReflectance, rough(0.1f)),
      MaterialFactory.conductor(gray(0.2f), gray(3f), rough(0.1f)),
      MaterialFactory.conductor(gray(0.9f), rough(0.1f)),
      MaterialFactory.dielectric(1.5f, rough(0f)),
      MaterialFactory.oldGlass(gray(1f), gray(1f), number(1.5f)),
      MaterialFactory.thinDielectric(1.5f),
      MaterialFactory.plastic(gray(0.5f), gray(0.2f), rough(0.1f), Edition.Third),
      uber(gray(1f), Edition.Third)
    )
    for material <- fixed do assert(material.isInstanceOf[ConstantMaterial])
    val roughness = Roughness(FromU, number(0.1f), RoughnessModel.PlainAlpha)
    val varying = Seq(
      MaterialFactory.matte(GrayFromV, number(0f)),
      MaterialFactory.matte(gray(0.5f), FromU),
      MaterialFactory.diffuse(GrayFromV),
      MaterialFactory.diffuseTransmission(gray(0.5f), GrayFromV, 1f),
      coated(GrayFromV, rough(0.2f)).get,
      MaterialFactory.substrate(gray(0.5f), GrayFromV, rough(0.1f)),
      MaterialFactory.mirror(GrayFromV),
      MaterialFactory.conductor(FullReflectance, roughness),
      MaterialFactory.conductor(gray(0.2f), GrayFromV, rough(0.1f)),
      MaterialFactory.conductor(GrayFromV, rough(0.1f)),
      MaterialFactory.dielectric(1.5f, roughness),
      MaterialFactory.oldGlass(gray(1f), gray(1f), FromU),
      MaterialFactory.plastic(gray(0.5f), gray(0.2f), roughness, Edition.Third),
      uber(GrayFromV, Edition.Third)
    )
    for material <- varying do
      assert(!material.isInstanceOf[ConstantMaterial])
      val s = material.bsdf(point(0.3f, 0.4f)).sample(wo, 0.5f, 0.4f, 0.3f)
      assert(s.weight.isFinite)

  test("textures are looked up where the ray met the surface"):
    val matte = MaterialFactory.matte(GrayFromV, FromU)
    assert(matte.bsdf(point(0f, 0.25f)).f(wo, wi) == Lambert(Rgb.gray(0.25f)).f(wo, wi))
    val clay = OrenNayar(Rgb.gray(0.5f), 30f)
    assert(matte.bsdf(point(30f, 0.5f)).f(wo, wi) == clay.f(wo, wi))

  test("a varying roughness of a coat keeps its own gloss over a coat between two of a family"):
    val roughness = Roughness(FromU, FromU, RoughnessModel.PlainAlpha)
    val varying = coated(gray(0.5f), roughness).get.bsdf(point(0.25f, 0f))
    val fixed = coated(gray(0.5f), rough(0.25f)).get.bsdf(point(0f, 0f))
    assert(varying.f(wo, wi) == fixed.f(wo, wi)) // 0.25 is one of the family
    val between = coated(gray(0.5f), roughness).get.bsdf(point(0.505f, 0f))
    val exact = coated(gray(0.5f), rough(0.505f)).get.bsdf(point(0f, 0f))
    // The family's error, twice: in and out.
    assert(Math.abs(between.f(wo, wi).r - exact.f(wo, wi).r) < 0.006f * exact.f(wo, wi).r)

  test("reflectances are held to their range"):
    val most = Lambert(Rgb.White).f(wo, wi)
    assert(MaterialFactory.diffuse(gray(7f)).bsdf(point(0f, 0f)).f(wo, wi) == most)
    assert(MaterialFactory.matte(gray(-1f), number(0f)).bsdf(point(0f, 0f)).f(wo, wi).isBlack)
    val both = MaterialFactory.diffuseTransmission(gray(0.9f), gray(0.2f), 2f).bsdf(point(0f, 0f))
    assert(both.f(wo, wi) == most && both.f(wo, -wi).r == 0.4f * InvPi)
    assert(MaterialFactory.matte(gray(1f), number(500f)).bsdf(point(0f, 0f)).f(wo, wi) ==
      OrenNayar(Rgb.White, 90f).f(wo, wi))

  test("coats with a scattering medium or varying thickness are refused"):
    def coat(thickness: FloatTexture, scattering: RgbTexture) = MaterialFactory.coatedDiffuse(
      gray(0.5f), rough(0.2f), thickness, scattering, 1.5f, 10, Coats()
    )
    assert(coat(number(0.01f), gray(0.1f)).isEmpty)
    assert(coat(number(0.01f), GrayFromV).isEmpty)
    assert(coat(FromU, gray(0f)).isEmpty)
    assert(coat(number(0.01f), gray(0f)).isDefined)

  test("half the depth of a coat is how often light meets the base"):
    def f(depth: Int) = MaterialFactory
      .coatedDiffuse(gray(0.9f), rough(0f), number(0.01f), gray(0f), 1.5f, depth, Coats())
      .get.bsdf(point(0f, 0f)).f(wo, wi).r
    assert(f(1) < f(3) && f(3) == f(4) && f(4) < f(5))
    assert(f(10) > 1.9f * f(1))

  test("plastic of both editions reflects all past 42 degrees, the third only from above"):
    def specular(edition: Edition, side: Float) =
      val bsdf = MaterialFactory
        .plastic(gray(0f), gray(1f), rough(0.3f), edition)
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
    assert(weight(MaterialFactory.oldGlass(gray(1f), gray(1f), number(1.5f))) == 1f)
    val dielectric = weight(MaterialFactory.dielectric(1.5f, rough(0f)))
    assert(Math.abs(dielectric - 1 / 2.25f) < 1e-6f) // rounding
    assert(weight(MaterialFactory.dielectric(0f, rough(0f))) == 1f) // an index of 0 is none
