package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.Sampler
import candela.scene.Scene

/** Path tracing through participating media: a path is scattered by surfaces and between them, and
  * light that is sampled at its points is dimmed on its way, through surfaces that are only borders
  * of media, too.
  *
  * @param maxDepth most scattering events of a path
  * @param rouletteAfter     scattering events that no path ends before
  * @param rouletteThreshold throughput below which a path may end early
  * @param regularizes       as in [[PathTracer]]
  * @param seesThrough       as in [[SubsurfacePathTracer]], where light travels beneath surfaces
  *
  * Sources: see [[PathTracer]] for surfaces, [[candela.media.PathWeights]] for the weights of
  * colours; both kinds of densities are combined by the power heuristic as Miller, Georgiev and
  * Jarosz 2019 do by the balance heuristic.
  */
final class VolumePathTracer(
    scene: Scene,
    media: SceneMedia,
    maxDepth: Int,
    rouletteAfter: Int,
    rouletteThreshold: Float,
    seesThrough: Boolean,
    regularizes: Boolean = false
) extends LightTransport(scene):
  private val work = MediumWork()
  private val weights = work.weights
  private val visibility = MediumVisibility(scene, media, work)
  private val probe = SubsurfaceProbe(scene)

  /** Is the point that is being lit a surface beneath which light travels? */
  private var atBoundary = false

  protected def over(scene: Scene): VolumePathTracer =
    VolumePathTracer(scene, media, maxDepth, rouletteAfter, rouletteThreshold, seesThrough,
      regularizes)

  override def raysTraced: Long = rays + visibility.raysTraced + probe.raysTraced

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    val hero = if media.isChromatic then (sampler.next1D() * 3f).toInt else 0
    work.start(hero)
    work.random.seed(sampler.next1D(), sampler.next1D())
    visibility.start(ray.time)
    var light = Rgb.Black
    var medium = media.camera
    var depth = 0
    var etaScale = 1f // undoes the radiance scaling of refraction, so that roulette sees the energy
    var isSpread = false
    var alive = true
    while alive do
      rays += 1
      val met = scene.closest(ray, hit)
      val scattered =
        if medium < 0 then -1f
        else media.media(medium).follow(ray, sampler.next1D(), depth < maxDepth, work)
      if weights.isDead then alive = false
      else if scattered >= 0f then
        if depth == maxDepth then alive = false
        else
          depth += 1
          light += scatter(ray, scattered, medium, sampler)
          isSpread = regularizes
          alive = survives(depth, etaScale, sampler)
      else if !met then
        light += weights.throughput * escaped(
          ray,
          (i, source) =>
            val l = weights.lightDensity
            if l > 0f then misWeight(l * selected(i) * source.pdf(lastP, ray.direction)) else 1f
        )
        alive = false
      else
        scene.surface(ray, hit, at)
        val wo = -ray.direction
        if at.areaLight >= 0 then light += weights.throughput * emitted(wo)
        if scene.isInterface(at) then
          medium = media.beyond(at, ray.direction, medium)
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
        else if depth == maxDepth then alive = false
        else
          depth += 1
          var bsdf = if isSpread then scene.bsdf(at).regularized else scene.bsdf(at)
          var towards = wo
          atBoundary = scene.isSubsurface(at.material)
          light += lightOnSurface(bsdf, towards, medium, sampler)
          var local = at.frame.toLocal(towards)
          draw(bsdf, local, sampler)
          weights.scale(bounce.weight)
          val inside = if local.z * bounce.wi.z < 0f then scene.bssrdf(at) else null
          if inside == null then etaScale *= square(bounce.eta)
          else if !weights.isDead then
            weights.scale(probe.enter(at, inside, ray.time, sampler, at))
            if !weights.isDead then
              atBoundary = false
              isSpread = regularizes
              bsdf = inside.entry
              towards = at.frame.n
              local = Vec3.Z
              light += lightOnSurface(bsdf, towards, medium, sampler)
              draw(bsdf, local, sampler)
              weights.scale(bounce.weight)
          isSpread ||= regularizes && !bounce.isSpecular
          weights.turn(if bounce.isSpecular then 0f else bounce.pdf)
          keepPlace()
          val wi = at.frame.toWorld(bounce.wi)
          medium = media.beyond(at, wi, medium)
          ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
          scene.scattered(ray, at, towards, wi, bounce.isSpecular, bounce.eta)
          val goesOn = bounce.isSpecular || isOpenSide(wi, towards, bsdf)
          alive = goesOn && survives(depth, etaScale, sampler)
    light + Rgb(work.glowR, work.glowG, work.glowB)

  /** Scatters the path at parameter `t` of the ray; light that comes to it there. */
  private def scatter(ray: Ray, t: Float, medium: Int, sampler: Sampler): Rgb =
    val p = ray.at(t)
    val wo = -ray.direction
    val phase = media.media(medium).phase
    var light = Rgb.Black
    if scene.lights.length > 0 then
      val choice = sampler.next1D()
      sampler.next2D()
      if chooseLight(p, Vec3.Zero, choice, sampler) then
        val value = phase.value(wo, lightSample.wi)
        if visibility.reaches(p, lightSample, medium) then
          light = arriving(value) * value
    sampler.next2D()
    val wi = phase.sample(wo, sampler.x, sampler.y)
    weights.turn(phase.value(wo, wi))
    lastP.become(p)
    lastN.become(Vec3.Zero)
    ray.set(p, wi, Float.PositiveInfinity)
    ray.differential.isKnown = false
    light

  /** One sample of the light that a surface in `medium` scatters to `wo`. */
  private def lightOnSurface(bsdf: Bsdf, wo: Vec3, medium: Int, sampler: Sampler): Rgb =
    val choice = sampler.next1D()
    sampler.next2D()
    if bsdf.isSpecular || scene.lights.length == 0 then Rgb.Black
    else if !chooseLight(at.p, at.frame.n, choice, sampler) then Rgb.Black
    else
      val local = at.frame.toLocal(wo)
      val towards = at.frame.toLocal(lightSample.wi)
      val wi = onSide(towards, local, bsdf)
      val f = if isOpenSide(lightSample.wi, wo, bsdf) then bsdf.f(local, wi) else Rgb.Black
      val origin = at.offsetOrigin(lightSample.wi)
      val first = media.beyond(at, lightSample.wi, medium)
      if f.isBlack || !visibility.reaches(origin, lightSample, first) then Rgb.Black
      else
        // What BSDF sampling sends through such a surface doesn't meet the light
        val isAlone = seesThrough && atBoundary && local.z * wi.z < 0f
        arriving(if isAlone then 0f else bsdf.pdf(local, towards)) * f * Math.abs(wi.z)

  // Of the light that was chosen last
  private var chosenIsDelta = false

  /** Samples a light for `p`; false if it brings none. */
  private def chooseLight(p: Vec3, n: Vec3, choice: Float, sampler: Sampler): Boolean =
    scene.selection.choose(p, n, choice, chosen)
    if chosen.light < 0 then false
    else
      val source = scene.lights(chosen.light)
      chosenIsDelta = source.isDelta
      source.sample(p, sampler.x, sampler.y, lightSample)
      lightSample.pdf > 0f && !lightSample.radiance.isBlack

  /** What arrives of the light sample along the path, over its density; weighted for the other way
    * to find it, by a direction of density `scatterPdf`.
    */
  private def arriving(scatterPdf: Float): Rgb =
    val w = weights
    val s = work.shadow
    val byLight = chosen.probability * lightSample.pdf *
      (w.ur * s.lr + w.ug * s.lg + w.ub * s.lb) * (1f / 3f)
    val byDirection =
      if chosenIsDelta then 0f
      else scatterPdf * (w.ur * s.ur + w.ug * s.ug + w.ub * s.ub) * (1f / 3f)
    if !(byLight > 0f) then Rgb.Black
    else
      val weight = LightTransport.powerHeuristic(byLight, byDirection) / byLight
      w.throughput * s.throughput * lightSample.radiance * weight

  /** Radiance of the light that the path has met, weighted for light sampling. */
  private def emitted(wo: Vec3): Rgb =
    val source = scene.surfaceLight(at)
    val radiance = source.radiance(at, wo)
    val l = weights.lightDensity
    if radiance.isBlack || !(l > 0f) then radiance
    else radiance * misWeight(l * selected(at.areaLight) * source.pdf(lastP, at))

  private def selected(light: Int): Float = scene.selection.probability(lastP, lastN, light)

  /** Weight of a path whose light was met by chance; its density is the unit of `pdf`. */
  private def misWeight(pdf: Float): Float = LightTransport.powerHeuristic(1f, pdf)

  /** Russian roulette. */
  private def survives(depth: Int, etaScale: Float, sampler: Sampler): Boolean =
    if depth > rouletteAfter then
      val q = weights.brightest * etaScale
      if q < rouletteThreshold then weights.gamble(sampler.next1D(), q)
    !weights.isDead
