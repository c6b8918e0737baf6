package candela.bench.robustness

import candela.bsdf.{
  Bsdf, ConductorReflectance, DielectricReflectance, DiffuseTransmission, FullReflectance, Lambert,
  Lobes, OrenNayar, Scaled, SentThrough
}
import candela.bsdf.composite.{DisneyMaterial, DisneyParameters, Hair, HairShape}
import candela.bsdf.layered.{BaseSeries, CoatedDiffuse, Coats, Layered, Layers}
import candela.bsdf.measured.HalfAngleReflection
import candela.bsdf.microfacet.{
  Conductor, CosinePower, Dielectric, FresnelBlend, MicrofacetReflection, Passthrough,
  ThinDielectric, TrowbridgeReitz
}
import candela.bsdf.subsurface.NormalizedFresnel
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{ConstantFloat, ConstantRgb}

/** A class of BSDFs, at the ends of its parameters.
  *
  * @param quick trials of each of them in every run of the tests
  * @param variants names and BSDFs
  */
final case class BsdfKind(name: String, quick: Int, variants: Seq[(String, Bsdf)])

object ExtremeBsdfs:
  private val gray = Rgb.gray(0.5f)
  private val indices = Seq(1f, Math.nextUp(1f), 1 + 1e-4f, 1 + 1e-3f, 0.999f, 0.2f, 1e-3f, 1e3f)
  private val alphas =
    Seq((0f, 0f), (1e-3f, 1e-3f), (0f, 1e-3f), (1e-4f, 1f), (1f, 1f), (30f, 1e-2f))

  private def glossy(a: (Float, Float)) = TrowbridgeReitz(a._1, a._2)
  private val metals = Seq(
    "no index at all" -> ConductorReflectance(Rgb.Black, Rgb.Black),
    "index 1e-6" -> ConductorReflectance(Rgb.gray(1e-6f), Rgb.gray(1e-6f)),
    "index 1e6" -> ConductorReflectance(Rgb.gray(1e6f), Rgb.gray(1e6f)),
    "index 1" -> ConductorReflectance(Rgb.White, Rgb.Black),
    "critical index" -> ConductorReflectance(Rgb.gray(0.5f), Rgb.gray(1e-20f))
  )

  private val diffuse = Seq[(String, Bsdf)](
    "matte of albedo 1" -> Lambert(Rgb.White),
    "clay of 90 degrees" -> OrenNayar(Rgb.White, 90f),
    "a sheet" -> DiffuseTransmission(gray, gray),
    "a pane of index 1" -> ThinDielectric(1f),
    "a pane of index 1e3" -> ThinDielectric(1e3f),
    "varnish" -> FresnelBlend(gray, Rgb.gray(0.04f), TrowbridgeReitz(1e-3f, 1e-3f)),
    "white varnish" -> FresnelBlend(Rgb.White, Rgb.White, CosinePower(Float.PositiveInfinity))
  )

  private def glass =
    for eta <- indices; a <- alphas
    yield s"glass of index $eta and roughness $a" -> Dielectric(glossy(a), eta)

  private def metal =
    for (name, curve) <- metals; a <- alphas
    yield s"metal of $name and roughness $a" -> Conductor(glossy(a), curve)

  private def powers =
    for e <- Seq(0f, 1f, 1e4f, Float.PositiveInfinity, Float.NaN)
    yield s"metal of exponent $e" -> MicrofacetReflection(CosinePower(e), FullReflectance)

  private def hair =
    for h <- Seq(-1f, 0f, 1f); beta <- Seq(0f, 0.3f, 1f); eta <- Seq(1f, 1.55f, 10f)
    yield s"hair at $h of roughness $beta and index $eta" ->
      Hair(h, eta, Rgb(0f, 1f, 1e6f), HairShape(beta, beta, 2f))

  private def coats =
    for a <- Seq(0f, 1f); thick <- Seq(0f, 100f); eta <- Seq(Math.nextUp(1f), 1.5f, 20f)
    yield
      val top = TrowbridgeReitz(a, a)
      val coat = Coats().of(top, eta, thick)
      s"coated diffuse of index $eta, roughness $a, thickness $thick" ->
        CoatedDiffuse(BaseSeries.OfColor(Rgb.White, 50, 50), top, coat)

  private def layers =
    val mirror = Conductor(glossy((0f, 0f)), metals(2)._2)
    for
      a <- Seq(0f, 1e-3f, 1f)
      (words, base) <- Seq("matte" -> Lambert(Rgb.White), "a mirror" -> mirror)
      (thick, g) <- Seq((0f, 0f), (1e-3f, 0.99f), (100f, -0.99f))
    yield
      val top = TrowbridgeReitz(a, a)
      val gloss = TrowbridgeReitz(0.5f, 0.5f)
      val stack = Layers(top, 1.5f, base, thick, Rgb.White, g, 100, 1, gloss, share = 0.5f)
      s"$words under a coat of roughness $a, thickness $thick" ->
        new Layered(stack, 1)

  private def disney =
    for ends <- 0 until 64 yield
      def end(bit: Int) = ConstantFloat((ends >> bit & 1).toFloat)
      val isThin = (ends & 16) != 0
      val p = DisneyParameters(
        ConstantRgb(Rgb(1f, 0.5f, 0f)),
        end(0),
        ConstantFloat(1.5f),
        end(1),
        end(2),
        end(3),
        end(2),
        end(3),
        end(4),
        end(5),
        end(5),
        isThin,
        end(2),
        end(1)
      )
      s"disney $ends" -> DisneyMaterial(p).bsdf(ShadingPoint())

  private def tables =
    Seq[(String, Bsdf)](
      "a table of a tenth" -> HalfAngleReflection(Array.fill(3 * 90 * 90 * 180)(0.1f)),
      "what light gets in through" -> NormalizedFresnel(1.33f),
      "a boundary of index 1 + 1e-7" -> NormalizedFresnel(Math.nextUp(1f))
    )

  private def mixtures =
    val gloss = MicrofacetReflection(glossy((1e-3f, 1f)), DielectricReflectance(1.5f), gray)
    Seq[(String, Bsdf)](
      "nothing in a mixture" -> Lobes.Builder().result,
      "gloss, matte and a veil" -> Lobes.Builder()
        .add(Passthrough(Rgb.gray(1e-6f)), 1e-6f)
        .add(Lambert(gray), 0.5f)
        .add(gloss, 1e-3f)
        .result,
      "gloss sent through" -> SentThrough(gloss),
      "glass, scaled to 1e-30" -> Scaled(Dielectric(glossy((0.1f, 0.1f)), 1.5f), Rgb.gray(1e-30f))
    )

  val all: Seq[BsdfKind] = Seq(
    BsdfKind("diffuse and varnished surfaces", 4000, diffuse),
    BsdfKind("glass", 4000, glass),
    BsdfKind("metals", 4000, metal),
    BsdfKind("metals with an exponent", 4000, powers),
    BsdfKind("hair", 4000, hair),
    BsdfKind("coated diffuse", 4000, coats),
    BsdfKind("layers", 1500, layers),
    BsdfKind("disney", 2000, disney),
    BsdfKind("tables", 4000, tables),
    BsdfKind("mixtures", 4000, mixtures)
  )
