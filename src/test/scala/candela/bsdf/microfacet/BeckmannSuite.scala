package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, Directions, FullReflectance}
import candela.math.*

class BeckmannSuite extends BsdfLaws:
  obeysLaws("round", MicrofacetReflection(Beckmann(0.3f, 0.3f), FullReflectance))
  obeysLaws("stretched", MicrofacetReflection(Beckmann(0.5f, 0.2f), FullReflectance))
  obeysLaws("glass", RoughDielectric(Beckmann(0.4f, 0.4f), 1.5f))

  test("the projected area of all facets is that of the surface"):
    val facets = Beckmann(0.5f, 0.2f)
    val area = Directions.overHemisphere(m => facets.d(m) * m.z.toDouble)
    assert(Math.abs(area - 1) < 1e-3) // the grid's error

  test("facets have no tails: at a slope of four times the roughness almost none are left"):
    val steep = Vec3(1.2f, 0f, 1f).normalized
    val (beckmann, ggx) = (Beckmann(0.3f, 0.3f), TrowbridgeReitz(0.3f, 0.3f))
    assert(beckmann.d(steep) < 1e-4f * ggx.d(steep))
