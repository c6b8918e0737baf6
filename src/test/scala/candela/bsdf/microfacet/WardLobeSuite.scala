package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, Directions}
import candela.color.Rgb

class WardLobeSuite extends BsdfLaws:
  import WardVariant.*
  private def lobe(variant: WardVariant, u: Float, v: Float) = WardLobe(Rgb.White, u, v, variant)

  obeysLaws("balanced", lobe(Balanced, 0.3f, 0.3f))
  obeysLaws("anisotropic", lobe(Balanced, 0.15f, 0.5f))
  obeysLaws("narrow", lobe(Balanced, 0.01f, 0.01f), isNarrow = true)
  obeysLaws("original", lobe(Original, 0.3f, 0.2f))
  obeysLaws("Dür's", lobe(Duer, 0.3f, 0.3f), isPassive = false)

  test("the values are those of the three papers"):
    val (wo, wi) = (Directions.at(40, 20), Directions.at(60, 170))
    val (u, v) = (0.25, 0.4)
    val h = wo + wi
    val bell = Math.exp(-(h.x * h.x / (u * u) + h.y * h.y / (v * v)) / (h.z * h.z))
    val area = Math.PI * u * v
    val expected = Map(
      Original -> bell / (4 * area * Math.sqrt(wo.z * wi.z)),
      Duer -> bell / (4 * area * wo.z * wi.z),
      Balanced -> bell * (h dot h) / (area * Math.pow(h.z, 4))
    )
    for (variant, value) <- expected do
      val found = WardLobe(Rgb.White, u.toFloat, v.toFloat, variant).f(wo, wi).g
      assert(Math.abs(found / value - 1) < 1e-4, variant)
