package candela.bsdf.composite

import candela.bsdf.Directions
import candela.bsdf.microfacet.{SeparableTrowbridgeReitz, TrowbridgeReitz}
import candela.color.Rgb

class DisneySuite extends BurleySuite(DisneyMaterial(_)):
  // From below, the interface reflects all beyond the critical angle, and the broad part as much as
  // from above
  obeysLaws("plain", material(), isPassive = false)
  obeysLaws("tinted metal", material(metallic = 0.7f, specularTint = 0.5f, anisotropic = 0.6f))
  obeysLaws("cloth", material(color = Rgb.gray(0.3f), sheen = 0.5f, sheenTint = 1f, roughness = 1f))
  obeysLaws("clear coat", material(color = Rgb.gray(0.3f), clearcoat = 1f))
  obeysLaws(
    "sharp clear coat",
    material(clearcoat = 1f, clearcoatGloss = 1f),
    isNarrow = true,
    isPassive = false
  )
  obeysLaws("refracting", material(transmission = 0.7f))
  // What it refracts is compressed, what it passes as paper does is not
  obeysLaws(
    "sheet",
    material(isThin = true, flatness = 0.5f, diffTrans = 1.2f, transmission = 0.3f),
    isReciprocal = false
  )
  obeysLaws("black", material(color = Rgb.Black))

  private val (wo, wi) = (Directions.at(40, 0), Directions.at(65, 130))

  test("the values of Burley's formulas, written out"):
    val c = Rgb(0.6f, 0.4f, 0.2f)
    val d = (wi dot (wo + wi).normalized).toDouble
    def weight(cosine: Double) = Math.pow(1 - cosine, 5)
    val (o, i) = (weight(wo.z), weight(wi.z))
    val retro = 2 * 0.6 * d * d
    val base = (1 - o / 2) * (1 - i / 2) + retro * (o + i + o * i * (retro - 1))
    val sheen = 0.8 * weight(d) * 1.0
    val expected = c.r * base / Math.PI + sheen
    val broad = DisneyDiffuse(c, Rgb.Black, c, Rgb.gray(0.8f), 0.6f)
    assert(Math.abs(broad.f(wo, wi).r - expected) < 1e-5 * expected) // rounding

  test("the sheen of full tint has the hue of the colour"):
    val green = Rgb(0f, 0.4f, 0f)
    val without = material(color = green).f(wo, wi)
    val cloth = material(color = green, sheen = 1f, sheenTint = 1f).f(wo, wi)
    assert(cloth.g > without.g && Math.abs(cloth.r - without.r) < 1e-6f)

  test("inside glass, a sample weighs what its microfacet reflects or lets through"):
    val clear = material(color = Rgb.White, transmission = 1f, roughness = 0.2f)
    for degrees <- Seq(100, 120, 130, 150, 175); i <- 0 until 64 do
      val s = clear.sample(
        Directions.at(degrees, 20),
        (i + 0.5f) / 64,
        (i * 7 % 64 + 0.5f) / 64,
        (i * 11 % 64 + 0.5f) / 64
      )
      // Refraction to the outside compresses light by the square of the index
      assert(s.weight.max <= (if s.wi.z > 0f then 2.26f else 1.001f), s"$degrees°, ${s.weight}")

  test("facets of separable masking let pass no more than correlated ones"):
    val separable = SeparableTrowbridgeReitz(0.3f, 0.5f)
    val correlated = TrowbridgeReitz(0.3f, 0.5f)
    val m = (wo + wi).normalized
    val ratio = separable.visibility(wo, wi, m) / correlated.visibility(wo, wi, m)
    assert(ratio < 1f && ratio > 0.5f)

  test("without a change of index light passes straight on"):
    val clear = material(Rgb.White, index = 1f, roughness = 0.5f, sheenTint = 0f,
      transmission = 1f, diffTrans = 0f)
    val drawn = Iterator
      .tabulate(200)(k => clear.sample(wo, k / 200f, 0.5f, 0.5f))
      .filter(s => s.pdf > 0f && s.wi.z < 0f)
      .toVector
    assert(drawn.nonEmpty && drawn.forall(_.wi == -wo))
