package candela.photons

import candela.color.Rgb
import candela.geometry.Ray
import candela.integrators.{Interfaces, LightTransport, PassIntegrator, SurfaceWalk}
import candela.sampling.Sampler
import candela.scene.Scene

/** Stochastic progressive photon mapping: camera subpaths end at diffuse surfaces, or after
  * `maxDepth` events, and gather the photons of their pass, numbered as their sample.
  *
  * It finds caustics from point lights, also those seen via specular surfaces. Direct light is
  * sampled as by a path tracer. Surfaces without a diffuse lobe are followed, as in pbrt-v3 and
  * pbrt-v4. At the others directions sampled by narrow lobes (with a pdf above a limit) are
  * followed, and photons account for all others: together they cover all indirect light exactly
  * once.
  *
  * @param maxDepth   maximum number of scattering events of the camera subpath
  * @param interfaces what they are to light sampling. Where they stop it, emitters without a BSDF
  *   are
  *                   invisible; where they are weighed, paths look for light beyond the surface
  *                   where they gather
  *
  * Sources: Hachisuka and Jensen, "Stochastic Progressive Photon Mapping", SIGGRAPH Asia 2009;
  * [[PhotonMaps]] for the radius; PBRT 3rd ed., §16.2.
  */
private[candela] final class PhotonMapper(
    scene: Scene,
    maxDepth: Int,
    settings: PhotonSettings,
    passes: PhotonPasses,
    interfaces: Interfaces = Interfaces.Open
) extends SurfaceWalk(scene, interfaces = interfaces)
    with PassIntegrator:
  import PhotonMapper.Sharp

  private val tracer = WholePhotons(scene, settings)
  private val looksBeyond = scene.hasInterfaces && interfaces == Interfaces.Weighed
  private var photons = PhotonMap(Array.empty, paths = 1, radius = 1f) // none yet

  def startPass(pass: Int, isStopped: () => Boolean): Boolean =
    val prepared = passes(pass, tracer, isStopped)
    for map <- prepared do photons = map
    prepared.isDefined

  override def raysTraced: Long = super.raysTraced + tracer.raysTraced

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    startPath(cameraRay, sampler)
    // Photons of dispersive scenes have one wavelength
    if scene.isDispersive then path.terminateSecondary()
    var hasGathered = false
    while goesOn do
      if !intersect() then addEnvironment()
      else
        val isInterface = vertex.isInterface
        if !isInterface || !interfaces.stopsLight then addEmission()
        if isInterface then passThrough()
        else if path.depth == maxDepth || hasGathered then end()
        else
          evaluate()
          val isLast = path.depth == maxDepth - 1
          val follows =
            if settings.gathersGloss || vertex.bsdf.isDiffuse then Sharp
            else 0f
          addOneLight(follows, sampler)
          // Beyond the last event paths find emission only
          val limit = if isLast && !settings.gathersGloss then Float.PositiveInfinity else follows
          if !vertex.bsdf.isSpecular && limit > 0f then
            addScattered(photons.gather(vertex, limit))
          scatter(sampler)
          leaveVertex()
          if !(vertex.bounce.isSpecular || vertex.bounce.pdf > follows) then
            if looksBeyond then hasGathered = true else end()
    L.toRgb

  /** Next-event estimation, without MIS for directions in which paths end.
    *
    * @param follows pdf above which directions are followed
    */
  private def addOneLight(follows: Float, sampler: Sampler): Unit =
    if sampleLight(sampler) then
      connectBy(weight =
        wi =>
          val pdf = vertex.localPdf(wi)
          val competes = pdf > follows || looksBeyond
          if competes then LightTransport.powerHeuristic(connection.pdf, pdf)
          else 1f
      )

object PhotonMapper:
  /** Pdf limit of narrow lobes: three times that of a diffuse surface along its normal. */
  private[candela] inline val Sharp = 0.95f
