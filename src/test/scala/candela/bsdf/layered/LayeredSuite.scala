package candela.bsdf.layered

import candela.bsdf.{Bsdf, BsdfLaws, ConductorReflectance, Directions, Lambert, Statistics}
import candela.bsdf.microfacet.{Conductor, TrowbridgeReitz}
import candela.color.Rgb
import candela.math.*
import candela.sampling.HenyeyGreenstein
import candela.textures.{ConstantFloat, ConstantRgb}

class LayeredSuite extends BsdfLaws:
  private val copper = ConductorReflectance(Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.6f, 2.4f))

  private def rough(alpha: Float) = TrowbridgeReitz(alpha, alpha)
  private def lambert(albedo: Float) = Lambert(Rgb.gray(albedo))

  private def layered(
      top: TrowbridgeReitz,
      base: Bsdf,
      eta: Float = 1.5f,
      thickness: Float = 0.1f,
      albedo: Rgb = Rgb.Black,
      g: Float = 0f,
      maxDepth: Int = 10,
      share: Float = 0f,
      seed: Long = 1
  ): Layered =
    val gloss = rough(0.3f)
    Layered(
      Layers(top, eta, base, thickness, albedo, g, maxDepth, walks = 1, gloss, share),
      seed
    )

  private val white = Rgb(0.9f, 0.8f, 0.7f)

  private def walked(name: String, bsdf: Bsdf): Unit = obeysLaws(name, bsdf, isWalked = true)
  walked("rough coat, diffuse base", layered(rough(0.4f), lambert(0.8f)))
  walked(
    "smooth coat, rough metal",
    layered(rough(0f), Conductor(rough(0.4f), copper), share = 0.8f)
  )
  walked("rough coat, rough metal", layered(rough(0.3f), Conductor(rough(0.5f), copper)))
  walked("rough coat, mirror", layered(rough(0.5f), Conductor(rough(0f), copper)))
  walked(
    "cloudy coat, diffuse base",
    layered(rough(0f), lambert(0.5f), thickness = 1f, albedo = white)
  )
  walked(
    "rough cloudy coat",
    layered(rough(0.4f), lambert(0.5f), thickness = 2f, albedo = white, g = 0.6f)
  )
  walked(
    "cloudy coat, mirror",
    layered(rough(0f), Conductor(rough(0f), copper), albedo = white, g = -0.5f)
  )
  walked("medium without interface", layered(rough(0.4f), lambert(0.2f), eta = 1f, albedo = white))
  walked("nothing goes below", layered(rough(0.4f), lambert(0.5f), maxDepth = 0))

  /** The mean of the values of many surfaces that differ in their random numbers only. */
  private def mean(make: Long => Bsdf, wo: Vec3, wi: Vec3, count: Int): Statistics =
    val values = Statistics()
    for seed <- 0 until count do values.add(make(seed).f(wo, wi).g)
    values

  private val pairs = Seq(
    (Directions.at(10, 0), Directions.at(40, 130)),
    (Directions.at(50, 60), Directions.at(50, 200)),
    (Directions.at(75, 0), Directions.at(30, 20))
  )

  for (alpha, albedo, depth) <- Seq((0f, 0.8f, 10), (0.2f, 0.8f, 10), (0.6f, 0.5f, 3)) do
    test(s"alpha $alpha, diffuse base of $albedo, $depth events: values have the exact mean"):
      val top = rough(alpha)
      val baseHits = (depth + 1) / 2
      val series = BaseSeries.OfColor(Rgb.gray(albedo), baseHits, baseHits)
      val exact = CoatedDiffuse(series, top, Coats().of(top, 1.5f, 0.1f))
      for (wo, wi) <- pairs do
        val walks = mean(
          seed => layered(top, lambert(albedo), maxDepth = depth, seed = seed),
          wo,
          wi,
          10000
        )
        val expected = exact.f(wo, wi).g
        // 0.5 %: the tables of rough coats
        val off = Math.abs(walks.mean - expected)
        assert(off < 4.5 * walks.error + 5e-3 * expected, s"$walks, not $expected, at $wo $wi")

  test("of an odd number of events, sampled directions leave one out, as in PBRT 4"):
    val random = java.util.SplittableRandom(5)
    val top = rough(0f)
    val wo = Directions.at(30, 0)
    def power(bsdf: Int => Bsdf): Statistics =
      val powers = Statistics()
      for i <- 0 until 40000 do
        def u() = random.nextDouble().toFloat
        powers.add(bsdf(i).sample(wo, u(), u(), u()).weight.g)
      powers
    for depth <- 1 to 4 do
      val layers = LayerMedium(
        ConstantFloat(0.1f),
        ConstantRgb(Rgb.Black),
        ConstantFloat(0f),
        depth,
        walks = 1
      )
      val coat = Coats().of(top, 1.5f, 0.1f)
      val series = BaseSeries.OfColor(Rgb.gray(0.9f), layers.baseHits, layers.sampledBaseHits)
      val exact = CoatedDiffuse(series, top, coat)
      val walks = power(i => layered(top, lambert(0.9f), maxDepth = depth, seed = i))
      val summed = power(_ => exact)
      val even = power: i =>
        layered(top, lambert(0.9f), maxDepth = depth / 2 * 2, seed = i)
      def agree(a: Statistics, b: Statistics) =
        Math.abs(a.mean - b.mean) < 4.5 * (a.error + b.error)
      assert(agree(walks, summed) && agree(walks, even), s"$walks, $summed, $even, $depth events")

  test("light that is scattered once in a medium without an interface has its closed form"):
    val (thickness, g) = (0.7, 0.4f)
    def make(seed: Long) = layered(
      rough(0f),
      lambert(0f),
      eta = 1f,
      thickness = thickness.toFloat,
      albedo = Rgb.gray(0.8f),
      g = g,
      maxDepth = 1,
      seed = seed
    )
    for (wo, wi) <- pairs do
      val (o, i) = (wo.z.toDouble, wi.z.toDouble)
      val turn = 1 + g * g + 2 * g * (wo dot wi).toDouble // light turns from -wi to wo
      val phase = (1 - g * g) / (4 * Math.PI * Math.pow(turn, 1.5))
      // ∫ exp(-τ (1/o + 1/i)) dτ / (o i) over the thickness
      val expected = 0.8 * phase * (1 - Math.exp(-thickness * (1 / o + 1 / i))) / (o + i)
      val walks = mean(make, wo, wi, 10000)
      assert(Math.abs(walks.mean - expected) < 4.5 * walks.error, s"$walks, not $expected")

  test("a smooth coat on a smooth metal scatters in the mirror direction only"):
    val bsdf = layered(rough(0f), Conductor(rough(0f), copper))
    val random = java.util.SplittableRandom(1)
    for wo <- Directions.few; _ <- 0 until 200 do
      val s = bsdf.sample(wo, random.nextFloat(), random.nextFloat(), random.nextFloat())
      assert(s.isSpecular || s.pdf == 0f)
      if s.pdf > 0f then assert((s.wi - Vec3(-wo.x, -wo.y, wo.z)).length < 1e-4f): Unit // rounding

  test("more walks make values less noisy, not different"):
    val (wo, wi) = pairs.head
    def make(walks: Int)(seed: Long) = Layered(
      Layers(rough(0.3f), 1.5f, lambert(0.5f), 0.5f, white, 0f, 10, walks),
      seed * 99
    )
    val (one, eight) = (mean(make(1), wo, wi, 10000), mean(make(8), wo, wi, 10000))
    assert(Math.abs(one.mean - eight.mean) < 4.5 * Math.hypot(one.error, eight.error))
    assert(eight.error < 0.5 * one.error)

  test("a medium that scatters forwards turns light less"):
    val random = java.util.SplittableRandom(3)
    for g <- Seq(-0.7f, 0f, 0.5f, 0.9f) do
      val phase = HenyeyGreenstein(g)
      val cosine = Statistics()
      val w = Directions.at(70, 30)
      for _ <- 0 until 20000 do
        cosine.add(phase.sample(-w, random.nextFloat(), random.nextFloat()) dot w)
      assert(Math.abs(cosine.mean - g) < 4.5 * cosine.error, s"$cosine, not $g")
      val total = Directions.integrals(1, 1, fine = 300)(v => phase.value(-w, v)).sum
      assert(Math.abs(total - 1) < 4e-3, s"g=$g: $total") // the grid, where the peak is narrow
