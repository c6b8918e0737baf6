package candela.bsdf.composite

import candela.bsdf.{
  Bsdf, BsdfLaws, ConstantMaterial, Directions, DisplacedMaterial, FramedMaterial, Fresnel,
  Material,
  SoftTerminatorMaterial
}
import candela.color.{ColorBasis, Rgb}
import candela.geometry.{Frame, ShadingPoint}
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
      GltfAnisotropy(number(anisotropy), number(1f), number(0.5f), 0.5f),
      GltfIridescence(number(film), 1.4f, 100f, 500f, number(0.9f), FilmColors.of(basis)),
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
      GltfAnisotropy(number(1f), number(x), number(y), rotation)
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

  /** Turns the normals of a material. */
  private final class Leaning(inner: Material, n: Vec3) extends DisplacedMaterial(inner):
    def bsdf(at: ShadingPoint): Bsdf =
      at.frame.set(Frame.along(n, Vec3.X))
      inner.bsdf(at)

  /** A rough surface under a coat with another normal. */
  private def underCoat(n: Vec3, coat: Float = 0.8f, roughness: Float = 0.3f): Bsdf =
    val layer = GltfCoat(ConstantFloat(coat), ConstantFloat(roughness))
    val base = ConstantMaterial(surface())
    val raised = SoftTerminatorMaterial(layer, Leaning(_, n), shadows = false)
    CoatedGltf(base, FramedMaterial(raised), ConstantFloat(coat)).bsdf(ShadingPoint())

  private val leaning = Vec3(0.3f, 0f, 1f).normalized
  obeysLaws("coat that leans", underCoat(leaning), isReciprocal = false)

  test("a coat of the same normals is that of the material"):
    val same = underCoat(Vec3.Z)
    val expected = surface(coat = 0.8f, coatRoughness = 0.3f)
    for o <- 0 to 80 by 20; i <- 0 to 80 by 20 do
      val (wo, wi) = (Directions.at(o, 0), Directions.at(i, 70))
      val (a, b) = (same.f(wo, wi), expected.f(wo, wi))
      assert((a - b).map(Math.abs(_)).max <= 1e-5f * b.max)
      assert(Math.abs(same.pdf(wo, wi) / expected.pdf(wo, wi) - 1f) < 1e-4f)

  test("the highlight of a coat is by its own normals, and so is what passes it"):
    val wo = Vec3.Z
    val mirrored = leaning * (2f * (wo dot leaning)) - wo
    val (bare, coated) = (surface(), underCoat(leaning, roughness = 0.1f))
    assert(coated.f(wo, mirrored).g > 10f * bare.f(wo, mirrored).g)
    // Aside from the highlight, at an angle at which the coat reflects much
    val (slanted, aside) = (Vec3(-0.9f, 0f, 0.4f).normalized, Vec3(0f, 0.5f, 0.9f).normalized)
    val dimmed = 1f - 0.8f * ClearcoatReflectance(slanted dot leaning).r
    assert(Math.abs(coated.f(slanted, aside).g / bare.f(slanted, aside).g - dimmed) < 1e-3f)

  test("under a film, neither side of a boundary returns more light than it receives"):
    // The first film reflects more than the bare boundary, the second less
    for (eta, nm, isBrighter) <- Vector((2.2f, 70f, true), (1.22f, 110f, false)) do
      val film = ThinFilm(1f, eta, nm, FilmColors.of(ColorBasis.Srgb))
      val outer = GltfReflectance(Rgb.gray(0.04f), 1f, Rgb.White, 0f, film)
      val boundary = GltfInterface(outer, 1.5f, 1f)
      val bare = Fresnel.dielectric(1f, 1.5f)
      assert(if isBrighter then boundary(1f).max > 2f * bare else boundary(1f).max < 0.5f * bare)
      for i <- 1 to 20 do
        val outside = i / 20f
        val inside = Fresnel.cosRefracted(outside, 1.5f)
        for cosine <- Vector(outside, -inside) do
          val sent = boundary.transmitted(cosine, Fresnel.dielectric(cosine, 1.5f))
          val sum = boundary(cosine).max + sent
          assert(sum <= 1f + 1e-5f && sent >= 0f, s"film $eta at $cosine: $sum")
