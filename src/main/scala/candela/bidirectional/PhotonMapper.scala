package candela.bidirectional

import candela.color.Rgb
import candela.geometry.Ray
import candela.integrators.{LightTransport, PassIntegrator, SceneIntegrator, Walk}
import candela.sampling.Sampler
import candela.scene.Scene

/** Stochastic progressive photon mapping: camera subpaths end at surfaces that scatter widely, and
  * gather the photons of their pass, numbered as their sample.
  *
  * It finds caustics from point lights, also those seen via specular surfaces. Direct light is
  * sampled as by a path tracer. For indirect light, directions sampled by narrow lobes (with a pdf
  * above a limit) are followed, and photons account for all others: together they cover all light
  * exactly once.
  *
  * @param maxDepth maximum number of scattering events of the camera subpath
  *
  * Sources: Hachisuka and Jensen, "Stochastic Progressive Photon Mapping", SIGGRAPH Asia 2009;
  * [[PhotonPasses]] for the radius; PBRT 3rd ed., §16.2.
  */
private[bidirectional] final class PhotonMapper(
    scene: Scene,
    maxDepth: Int,
    settings: PhotonSettings,
    passes: PhotonPasses
) extends SceneIntegrator(scene)
    with PassIntegrator:
  import PhotonMapper.Sharp

  private val tracer = PhotonTracer(scene, settings)
  private val walk = Walk(scene)
  private var photons = PhotonMap(Array.empty, paths = 1, radius = 1f) // none yet

  def begin(pass: Int): Unit = photons = passes(pass, tracer)

  protected def over(scene: Scene): PhotonMapper =
    PhotonMapper(scene, maxDepth, settings, passes)

  def raysTraced: Long = walk.raysTraced + tracer.raysTraced
  override def lastMaterial: Int = walk.vertex.at.material

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    val vertex = walk.vertex
    walk.begin(ray, sampler)
    // Photons of dispersive scenes have one wavelength
    if scene.isDispersive then walk.keepHero()
    while walk.goesOn do
      if !walk.intersect() then walk.addEnvironment()
      else
        walk.addEmission()
        if vertex.isInterface then walk.passThrough()
        else if walk.depth == maxDepth then walk.end()
        else
          walk.evaluate()
          addOneLight(sampler)
          if !vertex.bsdf.isSpecular then walk.add(photons.gather(vertex, Sharp))
          walk.scatter(sampler)
          walk.leave()
          if !(vertex.bounce.isSpecular || vertex.bounce.pdf > Sharp) then walk.end()
    walk.radiance.toRgb

  /** Next-event estimation, without MIS for directions in which paths end. */
  private def addOneLight(sampler: Sampler): Unit =
    if walk.sampleOneLight(sampler) then
      val light = walk.light
      walk.addLight(weight =
        wi =>
          val pdf = walk.vertex.localPdf(wi)
          if pdf > Sharp then LightTransport.powerHeuristic(light.pdf, pdf) else 1f
      )

object PhotonMapper:
  /** Pdf limit of narrow lobes: three times that of a diffuse surface along its normal. */
  private[bidirectional] inline val Sharp = 0.95f
