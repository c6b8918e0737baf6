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
      under: Varnish,
      top: Roughness,
      specular: Rgb = Rgb.White,
      eta: Float = 1.5f
  ): Bsdf =
    VarnishMaterial(ConstantRgb(color), ConstantRgb(specular), under, top, eta, Coats())
      .bsdf(ShadingPoint())

  private val smooth = Roughness.Smooth
  private val alpha = ConstantFloat(0.3f)
  private val rough = Roughness(alpha, alpha, RoughnessModel.Gaussian)
  obeysLaws("smooth", varnish(Varnish.Plain, smooth))
  obeysLaws("rough", varnish(Varnish.Colored, rough))

  private val (wo, wi) = (Directions.at(40, 0), Directions.at(65, 130))
  private def passes(w: Vec3) = 1 - Fresnel.dielectric(w.z, 1.5f)

  test("under a smooth coat the base is Mitsuba's formula"):
    // 0.59683: diffuse light that the inside of index 1.5 reflects, by Mitsuba's fit
    for (under, c) <- Seq((Varnish.Colored, 0.5f), (Varnish.Plain, 1f)) do
      val expected = 0.5 / (1 - 0.59683 * c) * passes(wo) * passes(wi) / (Math.PI * 2.25)
      assert(Math.abs(varnish(under, smooth).f(wo, wi).g / expected - 1) < 1e-3)

  test("under a smooth coat of a high index the base reflects more than it should, as Mitsuba's"):
    def passing(w: Vec3) = 1 - Fresnel.dielectric(w.z, 3f)
    // 0.93554: Mitsuba 3.9.1's fresnel_diffuse_reflectance(1 / 3); by quadrature 0.885
    val expected = 0.5 / (1 - 0.93554) * passing(wo) * passing(wi) / (Math.PI * 9)
    val found = varnish(Varnish.Plain, smooth, eta = 3f).f(wo, wi).g
    assert(Math.abs(found / expected - 1) < 1e-3)
    assert(varnish(Varnish.Plain, smooth, eta = 6f).f(wo, wi).g > 0f)

  obeysLaws("without interreflection", varnish(Varnish.Once, rough))

  test("without interreflection the base is as under a smooth coat, and leaves it once"):
    val expected = 0.5 * passes(wo) * passes(wi) / Math.PI
    assert(Math.abs(varnish(Varnish.Once, smooth).f(wo, wi).g / expected - 1) < 1e-3)
    // The coat's reflection is the same as that of others
    val near = Directions.at(40, 180)
    def top(under: Varnish, r: Roughness) =
      varnish(under, r).f(wo, near).g - varnish(under, r, Rgb(1f, 0f, 1f)).f(wo, near).g
    assert(Math.abs(top(Varnish.Once, rough) / top(Varnish.Plain, rough) - 1) < 1e-4)
    val base = varnish(Varnish.Once, rough, Rgb.Black).f(wo, wi).g
    assert(Math.abs(base / expected - 1) < 1e-3)

  test("the coat's own reflection has the colour asked for"):
    val near = Directions.at(40, 180)
    val full = varnish(Varnish.Colored, rough).f(wo, near)
    val half = varnish(Varnish.Colored, rough, Rgb(0.5f, 1f, 1f)).f(wo, near)
    val none = varnish(Varnish.Colored, rough, Rgb(0f, 1f, 1f)).f(wo, near)
    assert(half.g == full.g && none.r < 0.5f * full.r)
    assert(Math.abs(half.r - 0.5f * (full.r + none.r)) < 1e-5f * full.r)
