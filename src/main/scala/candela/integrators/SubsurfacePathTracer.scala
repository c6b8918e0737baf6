package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** [[PathTracer]] for scenes in which light travels beneath surfaces: a path that is sent into such
  * a surface comes out where a [[SubsurfaceProbe]] finds one, as a part of the same scattering
  * event.
  *
  * @param seesThrough does light of the sources also go straight through a rough surface, where
  *                    nothing beneath it is in the way? So in pbrt-v3; v4 loses a part of it, that
  *                    which sampling of the BSDF would have found
  * @param regularizes as in [[PathTracer]]
  */
final class SubsurfacePathTracer(
    scene: Scene,
    maxDepth: Int,
    rouletteAfter: Int,
    rouletteThreshold: Float,
    seesThrough: Boolean,
    regularizes: Boolean = false
) extends LightTransport(scene):
  private val probe = SubsurfaceProbe(scene)

  /** Is the point that is being lit the boundary of a medium? */
  private var atBoundary = false

  protected def over(scene: Scene): SubsurfacePathTracer =
    SubsurfacePathTracer(scene, maxDepth, rouletteAfter, rouletteThreshold, seesThrough,
      regularizes)

  override def raysTraced: Long = rays + probe.raysTraced

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    shadowRay.time = ray.time
    var light = Rgb.Black
    var throughput = Rgb.White
    var depth = 0
    var etaScale = 1f // undoes the radiance scaling of refraction, so that roulette sees the energy
    var lastPdf = 0f // of the direction just sampled; 0: no light sample competed with it
    var isSpread = false
    var alive = true
    while alive do
      rays += 1
      if !scene.closest(ray, hit) then
        light += throughput * escaped(ray, lastPdf)
        alive = false
      else
        scene.surface(ray, hit, at)
        var wo = -ray.direction
        light += metLight(throughput, wo, lastPdf)
        if depth == maxDepth then alive = false
        else if scene.isInterface(at) then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
        else
          depth += 1
          var bsdf = if isSpread then scene.bsdf(at).regularized else scene.bsdf(at)
          atBoundary = scene.isSubsurface(at.material)
          light += throughput * anyLight(bsdf, wo, sampler)
          var local = at.frame.toLocal(wo)
          draw(bsdf, local, sampler)
          throughput = throughput * bounce.weight
          val inside = if local.z * bounce.wi.z < 0f then scene.bssrdf(at) else null
          if inside == null then etaScale *= square(bounce.eta)
          else if !throughput.isBlack then
            throughput = throughput * probe.enter(at, inside, ray.time, sampler, at)
            if !throughput.isBlack then
              atBoundary = false
              isSpread = regularizes
              bsdf = inside.entry
              wo = at.frame.n
              local = Vec3.Z
              light += throughput * anyLight(bsdf, wo, sampler)
              draw(bsdf, local, sampler)
              throughput = throughput * bounce.weight
          isSpread ||= regularizes && !bounce.isSpecular
          lastPdf = if bounce.isSpecular then 0f else bounce.pdf
          keepPlace()
          val wi = at.frame.toWorld(bounce.wi)
          ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
          scene.scattered(ray, at, wo, wi, bounce.isSpecular, bounce.eta)
          alive = !throughput.isBlack && (bounce.isSpecular || isOpenSide(wi, wo, bsdf))
          if alive && depth > rouletteAfter then
            throughput = throughput *
              LightTransport.roulette(throughput, etaScale, rouletteThreshold, sampler)
            alive = !throughput.isBlack
    light

  /** What BSDF sampling sends through the boundary doesn't meet the light. */
  override protected def lightWeight(pdf: Float, bsdf: Bsdf, wo: Vec3, wi: Vec3): Float =
    if seesThrough && atBoundary && wo.z * wi.z < 0f then 1f
    else super.lightWeight(pdf, bsdf, wo, wi)
