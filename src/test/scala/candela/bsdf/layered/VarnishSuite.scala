package candela.bsdf.layered

import candela.bsdf.{Bsdf, BsdfLaws, Directions, Fresnel}
import candela.bsdf.microfacet.{Roughness, RoughnessModel}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb}

class VarnishSuite extends BsdfLaws:
  private val color = Rgb(0.2f, 0.5f, 0.9f)

  private def varnish(
      nonlinear: Boolean,
      top: Roughness,
      specular: Rgb = Rgb.White
  ): Bsdf =
    VarnishMaterial(ConstantRgb(color), ConstantRgb(specular), nonlinear, top, 1.5f)
      .bsdf(ShadingPoint())

  private val smooth = Roughness.Smooth
  private val alpha = ConstantFloat(0.3f)
  private val rough = Roughness(alpha, alpha, RoughnessModel.Gaussian)
  obeysLaws("smooth", varnish(nonlinear = false, smooth))
  obeysLaws("rough", varnish(nonlinear = true, rough))

  private val (wo, wi) = (Directions.at(40, 0), Directions.at(65, 130))
  private def passes(w: Vec3) = 1 - Fresnel.dielectric(w.z, 1.5f)

  test("under a smooth coat the base is Mitsuba's formula"):
    // 0.5963: diffuse light that the inside of index 1.5 reflects, by quadrature of Fresnel's terms
    for (nonlinear, c) <- Seq((true, 0.5f), (false, 1f)) do
      val expected = 0.5 / (1 - 0.5963 * c) * passes(wo) * passes(wi) / (Math.PI * 2.25)
      assert(Math.abs(varnish(nonlinear, smooth).f(wo, wi).g / expected - 1) < 1e-3)

  test("the coat's own reflection has the colour asked for"):
    val near = Directions.at(40, 180)
    val full = varnish(nonlinear = true, rough).f(wo, near)
    val half = varnish(nonlinear = true, rough, Rgb(0.5f, 1f, 1f)).f(wo, near)
    val none = varnish(nonlinear = true, rough, Rgb(0f, 1f, 1f)).f(wo, near)
    assert(half.g == full.g && none.r < 0.5f * full.r)
    assert(Math.abs(half.r - 0.5f * (full.r + none.r)) < 1e-5f * full.r)
