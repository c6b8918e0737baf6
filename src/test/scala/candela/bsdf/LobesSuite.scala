package candela.bsdf

import candela.bsdf.microfacet.{
  MicrofacetReflection, Mirror, Passthrough, SmoothDielectric, TrowbridgeReitz
}
import candela.color.Rgb
import candela.math.*

class LobesSuite extends BsdfLaws:
  private val gloss =
    MicrofacetReflection(TrowbridgeReitz(0.3f, 0.3f), DielectricReflectance(1.5f), Rgb.gray(0.5f))
  private val diffuse = Lambert(Rgb(0.1f, 0.4f, 0.2f))

  obeysLaws("gloss on a base", Lobes(Array(diffuse, gloss), Array(0.7f, 0.3f)))
  obeysLaws(
    "everything",
    Lobes.Builder()
      .add(Passthrough(Rgb.gray(0.2f)), 0.2f)
      .add(diffuse, 0.4f)
      .add(gloss, 0.05f)
      .add(SmoothDielectric(1.5f, Rgb.gray(0.1f), Rgb.gray(0.1f)), 0.1f)
      .result
  )
  obeysLaws(
    "two kinds of mirror",
    Lobes(Array(Mirror(Rgb.gray(0.5f)), Passthrough(Rgb.gray(0.5f))), Array(0.5f, 0.5f)),
    isLossless = true
  )

  test("values add up; densities by their probabilities"):
    val sum = Lobes(Array(diffuse, gloss), Array(0.7f, 0.3f))
    val (wo, wi) = (Directions.at(30, 0), Directions.at(35, 170))
    // One rounding each.
    assert((sum.f(wo, wi) - diffuse.f(wo, wi) - gloss.f(wo, wi)).map(c => Math.abs(c)).max < 1e-6f)
    val pdf = 0.7f * diffuse.pdf(wo, wi) + 0.3f * gloss.pdf(wo, wi)
    assert(Math.abs(sum.pdf(wo, wi) - pdf) < 1e-6f)

  test("a specular sample keeps its lobe's weight over the probability of its choice"):
    val half = Lobes(Array(diffuse, Mirror(Rgb.gray(0.5f))), Array(0.75f, 0.25f))
    val s = half.sample(Directions.at(30, 0), 0.8f, 0.5f, 0.5f)
    assert(s.isSpecular && s.weight == Rgb.gray(2f) && s.pdf == 0.25f)
    assert(!half.isSpecular && !half.isTransmissive)

  test("the choice left over decides within the lobe"):
    val glass = Lobes(Array(diffuse, SmoothDielectric(1.5f)), Array(0.5f, 0.5f))
    // The second half is the glass; 4 % of it at its start reflects.
    assert(glass.sample(Vec3.Z, 0.51f, 0f, 0f).wi.z > 0f)
    assert(glass.sample(Vec3.Z, 0.53f, 0f, 0f).wi.z < 0f)

  test("the builder leaves out what is black, and makes no sum of one"):
    assert(Lobes.Builder().add(diffuse, 0f).add(gloss, 1f).result eq gloss)
    val s = Lobes.Builder().result.sample(Vec3.Z, 0.5f, 0.5f, 0.5f)
    assert(s.pdf == 0f && s.weight.isBlack)
