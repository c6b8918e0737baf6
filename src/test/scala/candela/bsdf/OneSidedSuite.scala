package candela.bsdf

import candela.color.Rgb

class OneSidedSuite extends BsdfLaws:
  obeysLaws("diffuse", OneSided(Lambert(Rgb(0.2f, 0.5f, 0.9f))))

  test("it equals the BSDF within from above, and is black from below"):
    val (inner, outer) = (Lambert(Rgb.White), OneSided(Lambert(Rgb.White)))
    val (wo, wi) = (Directions.at(20, 0), Directions.at(70, 130))
    assert(outer.f(wo, wi) == inner.f(wo, wi))
    assert(outer.pdf(wo, wi) == inner.pdf(wo, wi))
    assert(outer.f(-wo, -wi) == Rgb.Black)
    assert(outer.pdf(-wo, -wi) == 0f)
    assert(outer.sample(-wo, 0.5f, 0.3f, 0.6f).weight == Rgb.Black)
