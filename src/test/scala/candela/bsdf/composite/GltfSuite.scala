package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfLaws, Directions}
import candela.color.{ColorBasis, Rgb}
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb}

class GltfSuite extends BsdfLaws:
  private val color = Rgb(0.8f, 0.4f, 0.2f)

  private def surface(
      color: Rgb = color,
      metallic: Float = 0f,
      roughness: Float = 0.6f,
      eta: Float = 1.5f,
      specular: Float = 1f,
      specularColor: Rgb = Rgb.White,
      transmission: Float = 0f,
      isThin: Boolean = true,
      coat: Float = 0f,
      coatRoughness: Float = 0.4f,
      sheen: Rgb = Rgb.Black,
      sheenRoughness: Float = 0.5f,
      anisotropy: Float = 0f,
      film: Float = 0f,
      sheet: Float = 0f,
      basis: ColorBasis = ColorBasis.Srgb
  ): Bsdf =
    def number(x: Float) = ConstantFloat(x)
    GltfMaterial(GltfParameters(
      ConstantRgb(color),
      number(metallic),
      number(roughness),
      eta,
      number(specular),
      ConstantRgb(specularColor),
      number(transmission),
      isThin,
      number(coat),
      number(coatRoughness),
      ConstantRgb(sheen),
      number(sheenRoughness),
      GltfStretch(number(anisotropy), number(1f), number(0.5f), 0.5f),
      GltfFilm(number(film), 1.4f, 100f, 500f, number(0.9f), FilmColors.of(basis)),
      number(sheet),
      ConstantRgb(Rgb(0.2f, 0.9f, 0.5f))
    )).bsdf(ShadingPoint())

  obeysLaws("dielectric", surface())
  obeysLaws("metal", surface(metallic = 1f))
  obeysLaws("blend", surface(metallic = 0.4f, anisotropy = 0.7f))
  obeysLaws("coloured highlights", surface(specular = 0.6f, specularColor = Rgb(2f, 0.5f, 0.1f)))
  obeysLaws("thin wall", surface(transmission = 0.7f))
  obeysLaws("volume", surface(transmission = 0.9f, isThin = false))
  obeysLaws("coated", surface(coat = 0.8f), isReciprocal = false)
  obeysLaws("oily plastic", surface(film = 0.8f))
  obeysLaws("tempered metal", surface(film = 1f, metallic = 1f))
  obeysLaws("bubble", surface(film = 1f, transmission = 1f))
  obeysLaws("oily glass", surface(Rgb.White, film = 1f, transmission = 1f, isThin = false))
  obeysLaws("paper", surface(sheet = 0.6f))
  obeysLaws(
    "wax",
    surface(sheet = 0.6f, transmission = 0.5f, isThin = false),
    isReciprocal = false
  )
  obeysLaws("cloth", surface(sheen = Rgb(0.9f, 0.5f, 0.3f)))

  /** The sample implementation of the specification, appendix B.3.5. */
  private def appendixB(metallic: Double, roughness: Double, o: Int, i: Int, azimuth: Int) =
    val (wo, wi) = (Directions.at(o, 0), Directions.at(i, azimuth))
    val h = (wo + wi).normalized
    val (nl, nv, nh, vh) =
      (wi.z.toDouble, wo.z.toDouble, h.z.toDouble, (wo dot h).toDouble)
    val alpha2 = Math.pow(roughness, 4)
    val d = alpha2 / (Math.PI * Math.pow(nh * nh * (alpha2 - 1) + 1, 2))
    def root(c: Double) = Math.sqrt(alpha2 + (1 - alpha2) * c * c)
    val visibility = 1 / (2 * (nv * root(nl) + nl * root(nv)))
    val weight = Math.pow(1 - vh, 5)
    def channel(c: Double) =
      val dielectric = 0.04 + 0.96 * weight
      val layered = (1 - dielectric) * c / Math.PI + dielectric * d * visibility
      val metal = (c + (1 - c) * weight) * d * visibility
      (1 - metallic) * layered + metallic * metal
    (wo, wi, Vector(channel(color.r), channel(color.g), channel(color.b)))

  test("values are those of appendix B"):
    for
      metallic <- Seq(0f, 0.3f, 1f); roughness <- Seq(0.2f, 0.5f, 1f)
      o <- Seq(0, 30, 70); i <- Seq(5, 50, 80); azimuth <- Seq(20, 170)
    do
      val (wo, wi, expected) = appendixB(metallic, roughness, o, i, azimuth)
      val f = surface(metallic = metallic, roughness = roughness).f(wo, wi)
      for (value, e) <- Vector(f.r, f.g, f.b).zip(expected) do
        assert(Math.abs(value - e) <= 1e-4 * e + 1e-6, s"$metallic $roughness $o $i $azimuth")

  test("a sheet sends through what its share says, and the rest back"):
    val (wo, wi) = (Directions.at(20, 0), Directions.at(40, 30))
    val below = Vec3(wi.x, wi.y, -wi.z)
    val (plain, sheet) = (surface(roughness = 1f), surface(roughness = 1f, sheet = 0.25f))
    val black = surface(Rgb.Black, roughness = 1f)
    val base = plain.f(wo, wi) - black.f(wo, wi)
    val back = sheet.f(wo, wi) - black.f(wo, wi)
    val sent = sheet.f(wo, below)
    for (a, b) <- Vector(back.r -> base.r * 0.75f, sent.r -> base.r / 0.8f * 0.2f * 0.25f) do
      assert(Math.abs(a - b) < 1e-5f * b + 1e-6f, s"$a, $b")
    assert(plain.f(wo, below).isBlack && sheet.isTransmissive && !plain.isTransmissive)

  test("highlights are stretched in the direction of the texture, turned by the angle"):
    def stretched(x: Float, y: Float, rotation: Float) =
      val number = ConstantFloat(_)
      GltfStretch(number(1f), number(x), number(y), rotation)
    def tangent(x: Float, y: Float, rotation: Float) =
      val at = ShadingPoint()
      stretched(x, y, rotation).turn(at)
      at.frame.s.toVec3
    def near(a: Vec3, b: Vec3) = (a - b).length < 1e-6f
    assert(near(tangent(1f, 0.5f, 0f), Vec3.X) && near(tangent(0.5f, 1f, 0f), Vec3.Y))
    assert(near(tangent(0.5f, 0.9f, Math.PI.toFloat / 2), Vec3.X * -1f))
    assert(near(tangent(0f, 0.5f, 0f), Vec3.X * -1f))

  test("fibres over black reflect what their albedo says, and white ones lose little"):
    for degrees <- Seq(10, 45, 75); roughness <- Seq(0.3f, 0.6f, 1f) do
      val wo = Directions.at(degrees, 0)
      val bsdf = CharlieSheen(Rgb.White, roughness * roughness)
      val n = 64
      val samples =
        for a <- 0 until n; b <- 0 until n
        yield bsdf.sample(wo, 0f, (a + 0.5f) / n, (b + 0.5f) / n).weight.r
      val albedo = samples.sum / samples.size
      assert(Math.abs(albedo - SheenAlbedo(wo.z, roughness)) < 0.03f * albedo + 0.01f, s"$degrees")
