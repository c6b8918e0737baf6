package candela.bidirectional

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.geometry.Ray
import candela.integrators.{LightTransport, PassIntegrator}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Stochastic progressive photon mapping: paths from the camera end where surfaces scatter light
  * widely, and gather there the photons of their pass, which is that of their sample's number.
  *
  * It finds light of points by way of mirrors and glass that is seen by way of these, too. Light
  * that comes straight from its source is sampled as by a path tracer. Of the rest, what a surface
  * scatters sharply (with a density above a limit) is followed, and the photons stand for all other
  * directions: together that is all of it, once.
  *
  * @param maxDepth most scattering events of the part of a path that starts at the camera
  *
  * Sources: Hachisuka and Jensen, "Stochastic Progressive Photon Mapping", SIGGRAPH Asia 2009;
  * [[PhotonPasses]] for the radius; PBRT 3rd ed., §16.2.
  */
private[bidirectional] final class PhotonMapper(
    scene: Scene,
    maxDepth: Int,
    settings: PhotonSettings,
    passes: PhotonPasses
) extends LightTransport(scene)
    with PassIntegrator:
  import PhotonMapper.Sharp

  private val tracer = PhotonTracer(scene, settings)
  private val vertex = PathVertex(scene)
  at = vertex.at
  private var photons = PhotonMap(Array.empty, paths = 1, radius = 1f) // none yet

  def begin(pass: Int): Unit = photons = passes(pass, tracer)

  protected def over(scene: Scene): PhotonMapper =
    PhotonMapper(scene, maxDepth, settings, passes)

  override def raysTraced: Long = rays + tracer.raysTraced

  /** Directions that are not followed are the light's alone. */
  override protected def lightWeight(pdf: Float, bsdf: Bsdf, wo: Vec3, wi: Vec3): Float =
    val chosen = bsdf.pdf(wo, wi)
    if chosen > Sharp then LightTransport.powerHeuristic(pdf, chosen) else 1f

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    shadowRay.time = ray.time
    var light = Rgb.Black
    var throughput = Rgb.White
    var depth = 0
    var lastPdf = 0f
    var alive = true
    while alive do
      rays += 1
      if !scene.closest(ray, hit) then
        light += throughput * escaped(ray, lastPdf)
        alive = false
      else
        scene.surface(ray, hit, at)
        light += metLight(throughput, -ray.direction, lastPdf)
        if depth == maxDepth then alive = false
        else if scene.isInterface(at) then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
        else
          depth += 1
          vertex.look(ray.direction)
          if !vertex.bsdf.isSpecular then
            light += throughput * anyLight(vertex.bsdf, vertex.wo, sampler)
            light += throughput * photons.gather(vertex, Sharp)
          draw(vertex.bsdf, vertex.local, sampler)
          val wi = at.frame.toWorld(bounce.wi)
          throughput = throughput * bounce.weight
          lastPdf = if bounce.isSpecular then 0f else bounce.pdf
          keepPlace()
          ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
          scene.scattered(ray, at, vertex.wo, wi, bounce.isSpecular, bounce.eta)
          alive = !throughput.isBlack &&
            (bounce.isSpecular || (bounce.pdf > Sharp && vertex.isOpen(wi)))
    light

object PhotonMapper:
  /** Three times that of a matte surface along its normal. */
  private[bidirectional] inline val Sharp = 0.95f
