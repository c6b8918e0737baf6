package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.{Sampler, Wavelengths}
import candela.scene.Scene

/** Unidirectional path tracing with next-event estimation, multiple importance sampling and Russian
  * roulette.
  *
  * @param maxDepth most scattering events of a path
  * @param rouletteAfter     scattering events that no path ends before
  * @param rouletteThreshold throughput below which a path may end early
  * @param regularizes are BSDFs regularized that a path meets after a bounce that is not specular?
  * @param wavelengths if a surface splits light: a path takes one of them at the first such surface
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9 and §10; PBRT 4th ed.,
  * §13.4.
  */
final class PathTracer(
    scene: Scene,
    maxDepth: Int,
    rouletteAfter: Int,
    rouletteThreshold: Float,
    wavelengths: Option[Wavelengths] = None,
    regularizes: Boolean = false
) extends LightTransport(scene):

  private val dispersion: Dispersion | Null = wavelengths.map(Dispersion(_)).orNull

  // Owned, so that a path makes no garbage: what it has brought so far and what more will count
  // for, and the directions at the last surface, in the world and in its frame
  private val light, throughput = Rgb.Black.copy
  private val wo, wi, local = Vec3(0f, 0f, 0f)

  override def splitsLight: Boolean = wavelengths.isDefined

  protected def over(scene: Scene): PathTracer =
    PathTracer(scene, maxDepth, rouletteAfter, rouletteThreshold, wavelengths, regularizes)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    shadowRay.time = ray.time
    if dispersion != null then dispersion.begin()
    light.become(Rgb.Black)
    throughput.become(Rgb.White)
    var depth = 0
    var etaScale = 1f // undoes the radiance scaling of refraction, so that roulette sees the energy
    var lastPdf = 0f // of the direction just sampled; 0: no light sample competed with it
    var isSpread = false
    var alive = true
    while alive do
      rays += 1
      if !scene.closest(ray, hit) then
        light.addProduct(throughput, escaped(ray, lastPdf))
        alive = false
      else
        scene.surface(ray, hit, at)
        wo.become(-ray.direction)
        light.become(light + metLight(throughput, wo, lastPdf))
        if depth == maxDepth then alive = false
        else if scene.isInterface(at) then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
        else
          depth += 1
          val met = if isSpread then scene.bsdf(at).regularized else scene.bsdf(at)
          val bsdf = if dispersion == null then met else dispersion.choose(met, sampler)
          if dispersion != null then throughput.scaleBy(dispersion.weight)
          light.addProduct(throughput, anyLight(bsdf, wo, sampler))
          local.become(at.frame.toLocal(wo))
          draw(bsdf, local, sampler)
          throughput.scaleBy(bounce.weight)
          isSpread ||= regularizes && !bounce.isSpecular
          lastPdf = if bounce.isSpecular then 0f else bounce.pdf
          keepPlace()
          etaScale *= square(bounce.eta)
          wi.become(at.frame.toWorld(bounce.wi))
          ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
          scene.scattered(ray, at, wo, wi, bounce.isSpecular, bounce.eta)
          alive = !throughput.isBlack && (bounce.isSpecular || isOpenSide(wi, wo, bsdf))
          if alive && depth > rouletteAfter then
            throughput.scaleBy(
              LightTransport.roulette(throughput, etaScale, rouletteThreshold, sampler)
            )
            alive = !throughput.isBlack
    light.copy
