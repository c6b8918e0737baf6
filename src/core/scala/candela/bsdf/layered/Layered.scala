package candela.bsdf.layered

import candela.bsdf.{Bsdf, BsdfFlags, BsdfSample, Fresnel, Hemisphere}
import candela.bsdf.microfacet.{MicrofacetReflection, TrowbridgeReitz}
import candela.color.Rgb
import candela.math.*
import candela.sampling.{HenyeyGreenstein, SampleHash}

/** The layers of a surface: a base, a medium, and an interface above.
  *
  * @param base      BSDF of the base: reflective only and not dispersive
  * @param thickness of the medium, in mean free paths, at least 0
  * @param albedo    single-scattering albedo of the medium; 0 only absorbs
  * @param maxDepth  maximum number of events below the interface: at the base, in the medium, and
  *                  internal reflections; leaving counts, too, if the direction is sampled, as in
  *                  PBRT 4
  * @param walks     random walks averaged per evaluation, at least 1
  * @param gloss     roughness of a glossy base, for the pdf of its lobe
  * @param share     fraction of the pdf below the interface that is the lobe's, in [0, 1); the rest
  *                  is cosine-weighted
  */
final class Layers(
    topDistribution: TrowbridgeReitz,
    eta: Float,
    val base: Bsdf,
    val thickness: Float,
    val albedo: Rgb,
    asymmetry: Float,
    val maxDepth: Int,
    val walks: Int,
    gloss: TrowbridgeReitz = TrowbridgeReitz(1f, 1f),
    val share: Float = 0f
):
  private[bsdf] val top = Boundary(topDistribution, eta)
  private[bsdf] val phase = HenyeyGreenstein(clamp(asymmetry, -0.99f, 0.99f))
  val isClear: Boolean = albedo.isBlack || thickness <= 0f

  /** Approximate lobe of the base seen from outside. Refraction widens it by `eta`. Each of the two
    * passages through a rough interface deflects light by (eta − 1) times the microfacet slope,
    * equivalent to reflection by microfacets of half that slope.
    */
  private[bsdf] val lobe: TrowbridgeReitz =
    def along(base: Float, interface: Float) =
      Math.min(sqrt(square(eta * base) + 0.5f * square((eta - 1f) * interface)), 1f)
    if share <= 0f then gloss
    else
      TrowbridgeReitz(
        along(gloss.alphaX, topDistribution.alphaX),
        along(gloss.alphaY, topDistribution.alphaY)
      )

  private[bsdf] lazy val regularized: Layers = Layers(
    topDistribution.regularized, eta, base.regularized, thickness, albedo, asymmetry, maxDepth,
    walks, gloss.regularized, share
  )

  /** Transmittance over this vertical distance, in mean free paths. */
  private[bsdf] def attenuation(distance: Float, w: Vec3): Float =
    Coat.attenuation(distance, Math.abs(w.z)).toFloat

/** Any base under a rough or smooth interface, with an absorbing and scattering medium in between:
  * an average of random walks.
  *
  * Values are Monte Carlo estimates, deterministic in the directions and `seed`. Directions are
  * sampled by random walks, too. Their weights are unbiased; `pdf` is approximate and only steers
  * MIS, which any such approximation leaves unbiased.
  *
  * Source: Guo, Hašan and Zhao, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs",
  * SIGGRAPH Asia 2018; PBRT 4th ed., §14.3. Unlike there, the two strategies for crossing the
  * interface use densities in the same variable, so that their MIS weights sum to one.
  */
final class Layered(layers: Layers, seed: Long) extends Bsdf:
  import Layered.*
  private val top = layers.top

  def f(wo: Vec3, wi: Vec3): Rgb =
    if !Hemisphere.isSameSide(wo, wi) then Rgb.Black
    else
      val o = Hemisphere.above(wo)
      val i = Hemisphere.above(wi)
      var sum = Rgb.Black
      var walk = 0
      while walk < layers.walks do
        sum += connected(o, i, hash(hash(seed + walk, wo), wi))
        walk += 1
      val interior = sum * (1f / (layers.walks * top.eta * top.eta))
      if top.isSmooth then interior
      else
        val m = (o + i).normalized
        val facets = top.distribution.d(m) * top.distribution.visibility(o, i, m)
        interior + Rgb.gray(Fresnel.dielectric(o dot m, top.eta) * facets)

  /** One random walk from `o` with a next-event connection to `i` at each event. */
  private def connected(o: Vec3, i: Vec3, seed: Long): Rgb =
    val path = LayerPath(layers, seed)
    val outer = top.facet(i, path.next(), path.next())
    val inner = top.refracted(i, outer, top.eta)
    val entry = top.facet(o, path.next(), path.next())
    val entered = top.refracted(o, entry, top.eta)
    if inner.isZero || entered.isZero then Rgb.Black
    else
      val exit = -inner
      val passed = transmitted(i, outer) * top.weight(i, inner, outer)
      val exitPdf = if top.isSmooth then Float.PositiveInfinity else top.crossingPdf(i, inner)
      path.start(entered, transmitted(o, entry) * top.weight(o, entered, entry))
      var sum = Rgb.Black
      var events = 0
      while events < layers.maxDepth && !path.isOver do
        path.roulette(events)
        if !path.isOver then
          val event = path.advance()
          events += 1
          if event == LayerPath.Top then path.reflectAtTop()
          else
            val distance = layers.thickness - path.height
            var pdf = 0f
            if event == LayerPath.Base then
              if !layers.base.isSpecular then
                val w = heuristic(exitPdf, layers.base.pdf(-path.w, exit))
                val contribution = path.throughput * layers.base.f(-path.w, exit)
                sum += contribution * (w * passed * layers.attenuation(distance, exit))
              path.scatterAtBase(path.next(), path.next())
              pdf = path.basePdf
            else
              path.throughput = path.throughput * layers.albedo
              val scattered = layers.phase.value(-path.w, exit)
              val w = heuristic(exitPdf, scattered)
              val factor = w * scattered * passed * layers.attenuation(distance, exit) / exit.z
              sum += path.throughput * factor
              if top.isSmooth && layers.base.isSpecular then
                sum += path.throughput * mirrored(path, exit) * (passed / exit.z)
              val wo = -path.w
              path.scatterInMedium()
              pdf = layers.phase.value(wo, path.w)
            if !top.isSmooth && path.w.z > 0f then
              val crossing = top.crossing(i, -path.w)
              if crossing > 0f then
                val w = heuristic(pdf, top.crossingPdf(i, -path.w))
                sum += path.throughput * (w * crossing * layers.attenuation(distance, path.w))
      sum

  /** Light scattered in the medium at `path` towards `exit` via a specular base, including all
    * further trips to a smooth interface. Random walks can't sample these specular paths.
    */
  private def mirrored(path: LayerPath, exit: Vec3): Rgb =
    val across = layers.attenuation(layers.thickness, exit)
    val base = layers.base.sample(exit, 0.5f, 0.5f, 0.5f).weight
    val toExit = layers.phase.value(-path.w, exit) *
      layers.attenuation(layers.thickness - path.height, exit)
    val toBase = layers.phase.value(-path.w, Hemisphere.flipped(exit)) *
      layers.attenuation(path.height, exit)
    val reflected = Fresnel.dielectric(exit.z, 1f / top.eta)
    val trip = base * (reflected * across * across)
    val first = base * (toBase * across) + trip * toExit
    // Geometric series of further trips
    first / trip.map(c => 1f - Math.min(c, 0.999f))

  private def transmitted(o: Vec3, m: Vec3): Float =
    1f - Fresnel.dielectric(Math.max(o dot m, 0f), top.eta)

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !Hemisphere.isSameSide(wo, wi) then 0f
    else
      val o = Hemisphere.above(wo)
      val m = (o + Hemisphere.above(wi)).normalized
      // Below 1, since at grazing angles microfacets that face the light transmit it
      val reflected = Math.min(Fresnel.dielectric(o.z, top.eta), 0.95f)
      val share = layers.share
      val gloss = if share > 0f then share * MicrofacetReflection.pdf(layers.lobe, o, m) else 0f
      val interior = (1f - reflected) * (gloss + (1f - share) * Hemisphere.cosinePdf(wi))
      if top.isSmooth then interior
      else interior + reflected * MicrofacetReflection.pdf(top.distribution, o, m)

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val o = Hemisphere.above(wo)
    val m = top.facet(o, u1, u2)
    val cosM = o dot m
    if o.z == 0f || cosM <= 0f then BsdfSample.Absorbed
    else
      val reflected = Fresnel.dielectric(cosM, top.eta)
      if choice < reflected then
        val i = top.reflected(o, m)
        if i.isZero then BsdfSample.Absorbed
        else buildSample(wo, i, Rgb.gray(top.weight(o, i, m)), top.isSmooth, reflected)
      else
        val below = top.refracted(o, m, top.eta)
        if below.isZero then BsdfSample.Absorbed
        else
          val numbers = Vec3(choice, u1, u2)
          val path = LayerPath(layers, hash(hash(seed, wo), numbers))
          path.start(below, top.weight(o, below, m))
          walk(wo, path, u1, u2, 1f - reflected)

  private def walk(wo: Vec3, path: LayerPath, u1: Float, u2: Float, chance: Float): BsdfSample =
    var result = BsdfSample.Absorbed
    var events = 0
    while events < layers.maxDepth && !path.isOver do
      path.roulette(events)
      if !path.isOver then
        val event = path.advance()
        if event == LayerPath.Top then
          val wi = path.scatterAtTop()
          if !wi.isZero then result = buildSample(wo, wi, path.throughput, path.isSpecular, chance)
        // A smooth interface leaves the stratified samples unused
        else if event == LayerPath.Base then
          if events == 0 && top.isSmooth then path.scatterAtBase(u1, u2)
          else path.scatterAtBase(path.next(), path.next())
        else
          path.throughput = path.throughput * layers.albedo
          path.scatterInMedium()
        events += 1
    result

  /** @param i      sampled direction in the upper hemisphere
    * @param chance probability of the sample, if specular
    */
  private def buildSample(
      wo: Vec3,
      i: Vec3,
      weight: Rgb,
      isSpecular: Boolean,
      chance: Float
  ): BsdfSample =
    val wi = Hemisphere.seenFrom(wo, i)
    val density = if isSpecular then chance else pdf(wo, wi)
    if density > 0f && !weight.isBlack then BsdfSample(wi, weight, density, isSpecular)
    else BsdfSample.Absorbed

  def flags: BsdfFlags =
    val common = BsdfFlags.Glossy | BsdfFlags.Choosing
    if layers.base.isDiffuse || !layers.albedo.isBlack then common | BsdfFlags.Diffuse else common
  override def regularized: Bsdf = Layered(layers.regularized, seed)

private object Layered:

  /** Hashes a direction, or any three numbers, into a seed. */
  def hash(seed: Long, v: Vec3): Long =
    val xy = bits(v.x).toLong << 32 | (bits(v.y) & 0xffffffffL)
    SampleHash.mix64(SampleHash.mix64(seed ^ xy) + bits(v.z))

  private def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  /** MIS weight (power heuristic) of a direction sampled with pdf `a` against pdf `b`; infinite `a`
    * means that no other strategy can sample it. Source: Veach 1997, §9.2.4, β = 2.
    */
  def heuristic(a: Float, b: Float): Float =
    if a == Float.PositiveInfinity then 1f
    else if a <= 0f then 0f
    else
      val r = b / a
      1f / (1f + r * r)
