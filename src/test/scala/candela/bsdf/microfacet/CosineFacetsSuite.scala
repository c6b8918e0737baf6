package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, Directions, FullReflectance}
import candela.math.*

class CosineFacetsSuite extends BsdfLaws:
  for (u, v) <- Seq((0.3f, 0.3f), (0.2f, 0.6f)) do
    obeysLaws(s"$u, $v", MicrofacetReflection(CosineFacets(u, v), FullReflectance))
  obeysLaws(
    "narrow",
    MicrofacetReflection(CosineFacets(0.005f, 0.005f), FullReflectance),
    isNarrow = true
  )

  test("the projected area of the facets is 1"):
    for (u, v) <- Seq((1f, 1f), (0.4f, 0.4f), (0.2f, 0.5f)) do
      val facets = CosineFacets(u, v)
      val area = Directions.integrals(1, 1, fine = 400): m =>
        if m.z > 0f then facets.d(m) * m.z else 0f
      assert(Math.abs(area.sum - 1) < 2e-3, (u, v)) // steps of a quarter of a degree

  test("the peak is as high as Beckmann's"):
    for alpha <- Seq(0.05f, 0.3f, 0.8f) do
      val ratio = CosineFacets(alpha, alpha).d(Vec3.Z) / Beckmann(alpha, alpha).d(Vec3.Z)
      assert(Math.abs(ratio - 1f) < 1e-4f)

  test("the value is that of Mitsuba 0.6's distribution"):
    val (u, v) = (0.3, 0.5)
    val m = Directions.at(25, 35)
    val (ex, ey) = (2 / (u * u) - 2, 2 / (v * v) - 2)
    val s2 = m.x * m.x + m.y * m.y
    val exponent = (ex * m.x * m.x + ey * m.y * m.y) / s2
    val expected = Math.sqrt((ex + 2) * (ey + 2)) / (2 * Math.PI) * Math.pow(m.z, exponent)
    assert(Math.abs(CosineFacets(u.toFloat, v.toFloat).d(m) / expected - 1) < 1e-4)
