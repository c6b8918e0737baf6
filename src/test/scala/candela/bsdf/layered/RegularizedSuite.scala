package candela.bsdf.layered

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.{
  Bsdf, ConductorReflectance, Directions, Lambert, Lobes, OrenNayar, Scaled, SentThrough
}
import candela.bsdf.microfacet.{
  Conductor, Dielectric, Dispersive, FresnelBlend, Passthrough, Roughness, RoughnessModel,
  SmoothDielectric, ThinDielectric, TrowbridgeReitz, UniformMetal
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{ConstantFloat, ConstantRgb}

/** A BSDF regularized is the one that is made of the regularized roughnesses. */
class RegularizedSuite extends AnyFunSuite:
  private val copper = ConductorReflectance(Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.6f, 2.4f))
  private val gray = Rgb.gray(0.5f)
  private val series = BaseSeries.OfColor(gray, 5, 5)
  private val coats = Coats()
  private def rough(alpha: Float) = TrowbridgeReitz(alpha, alpha)
  private def wide(alpha: Float) = rough(alpha).regularized

  private def coated(top: TrowbridgeReitz) =
    CoatedDiffuse(series, top, coats.of(top, 1.5f, 0.01f))
  private def varying(top: TrowbridgeReitz) =
    CoatedDiffuse(series, top, Coats.interpolate(coats.family(1.5f, 0.01f), top))
  private def layered(top: TrowbridgeReitz, base: TrowbridgeReitz) = Layered(
    Layers(top, 1.5f, Conductor(base, copper), 0.2f, Rgb.Black, 0f, 10, 1, base, 0.5f),
    seed = 1
  )
  private def mixed(alpha: TrowbridgeReitz) =
    Lobes(Array(Lambert(gray), Scaled(Conductor(alpha, copper), gray)), Array(0.5f, 0.5f))

  for
    alpha <- Seq(0f, 0.02f, 0.2f, 0.5f)
    (name, make) <- Seq[(String, TrowbridgeReitz => Bsdf)](
      "a metal" -> (Conductor(_, copper)),
      "glass" -> (Dielectric(_, 1.5f, gray)),
      "glass that splits light" -> (t => Dispersive(Dielectric(t, 1.5f))),
      "a coated diffuse surface" -> coated,
      "a coated diffuse surface of varying roughness" -> varying,
      "a coated metal" -> (t => layered(t, t)),
      "a varnish" -> (FresnelBlend(gray, gray, _)),
      "a mixture" -> mixed,
      "what is sent through" -> (t => SentThrough(Conductor(t, copper)))
    )
  do
    test(s"$name of alpha $alpha"):
      val (regularized, expected) = (make(rough(alpha)).regularized, make(wide(alpha)))
      assert(regularized.isSpecular == expected.isSpecular)
      for wo <- Directions.few; wi <- Directions.few do
        assert(regularized.f(wo, wi) == expected.f(wo, wi))
        assert(regularized.pdf(wo, wi) == expected.pdf(wo, wi))

  test("what has no sharp part stays as it is"):
    for bsdf <- Seq(Lambert(gray), OrenNayar(gray, 20f), ThinDielectric(1.5f), Passthrough(gray))
    do assert(bsdf.regularized eq bsdf)
    val old = SmoothDielectric(1.5f, compresses = false)
    assert(old.regularized eq old)

  test("a smooth metal under a smooth coat is a mirror, but regularized it is walked"):
    val medium = LayerMedium(
      ConstantFloat(0.01f),
      ConstantRgb(Rgb.Black),
      ConstantFloat(0f),
      maxDepth = 10,
      walks = 1
    )
    val zero = ConstantFloat(0f)
    val smooth = Roughness(zero, zero, RoughnessModel.PlainAlpha)
    val metal = UniformMetal(copper)
    def material(mirrored: Option[Float => Rgb]) =
      CoatedConductorMaterial(metal, smooth, smooth, 1.5f, medium, mirrored)
    val at = ShadingPoint()
    val summed = material(Some(_ => gray)).bsdf(at)
    val walked = material(None).bsdf(at)
    assert(summed.isSpecular)
    for wo <- Directions.few; wi <- Directions.few do
      assert(summed.regularized.f(wo, wi) == walked.regularized.f(wo, wi))
