package candela.bsdf

import candela.color.Rgb
import candela.math.*

class SoftTerminatorSuite extends BsdfLaws:
  private val lambert = Lambert(Rgb(0.2f, 0.5f, 0.9f))
  private val base = Directions.at(35, 20)
  private val soft = SoftTerminator(lambert, base, 0.06f)
  obeysLaws("shadowed", soft, isReciprocal = false)
  obeysLaws("flat", SoftTerminator(lambert, Vec3.Z, 0f))

  private val wo = Directions.at(10, 0)

  test("light from below the surface is blocked, though it is above the bump"):
    val wi = Directions.at(65, 200)
    assert(wi.z > 0f && (wi dot base) < 0f)
    assert(soft.f(wo, wi).isBlack && soft.pdf(wo, wi) == 0f)

  test("the shadowing is that of Estevez et al."):
    val wi = Directions.at(40, 110)
    val cos = wi dot base
    val tan2 = (1 - cos * cos) / (cos * cos)
    val expected = 2 / (1 + Math.sqrt(1 + 0.06 * tan2)) * lambert.f(wo, wi).r
    assert(Math.abs(soft.f(wo, wi).r - expected) < 1e-5 * expected) // rounding

  test("a normal that faces away is turned about that of the surface"):
    // Above the surface, below the bump
    val seen = Directions.at(100, 20)
    assert(seen.z < 0f && (seen dot base) > 0f)
    val image = base * (2f * base.z) - Vec3.Z
    val wi = image
    val power = soft.f(seen, wi).r * Math.abs(wi.z)
    assert(Math.abs(power - lambert.f(Vec3.Z, Vec3.Z).r * passed) < 1e-5f)

  /** Light along the bump's normal that passes. */
  private def passed: Float =
    val tan2 = (1 - base.z * base.z) / (base.z * base.z)
    2f / (1f + sqrt(1f + 0.06f * tan2))
