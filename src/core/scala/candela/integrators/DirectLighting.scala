package candela.integrators

import candela.color.Rgb
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.sampling.Sampler
import candela.scene.Scene

/** Direct lighting, also by way of specular surfaces.
  *
  * @param maxDepth     specular bounces plus one, at most
  * @param lightSamples samples of each light at a vertex; empty: one light, chosen at random
  * @param interfaces   as in [[SpecularWalk]]
  *
  * Where a surface both reflects and transmits, the path follows one of the two at random: the same
  * mean at a cost that does not double with each bounce.
  * Source: PBRT 3rd ed., §14.3; multiple importance sampling as in Veach 1997, §9.2.
  */
class DirectLighting(
    scene: Scene,
    maxDepth: Int,
    lightSamples: Array[Int],
    volumes: VolumeMarch | Null = null,
    interfaces: Interfaces = Interfaces.Open
) extends SpecularWalk(scene, maxDepth, volumes, interfaces = interfaces):
  private val bsdfRay = Ray()
  private val bsdfHit = Hit()
  private val emitter = ShadingPoint()
  private var bsdfRays = 0L

  override def raysTraced: Long = super.raysTraced + bsdfRays

  override def radiance(ray: Ray, sampler: Sampler): Rgb =
    bsdfRay.time = ray.time
    super.radiance(ray, sampler)

  protected def direct(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    var sum = Rgb.Black
    if lightSamples.length == 0 then
      val choice = sampler.next1D(matters = connection.isRandom)
      if connection.choose(vertex.point.p, vertex.lightNormal, choice) then
        sum = estimate(vertex, sampler)
    else
      var i = 0
      while i < lightSamples.length do
        connection.choose(i)
        var k = 0
        while k < lightSamples(i) do
          sum += estimate(vertex, sampler) * (1f / lightSamples(i))
          k += 1
        i += 1
    sum

  /** One sample of the chosen light and one of the BSDF, combined by the power heuristic. */
  private def estimate(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    sampler.next2D()
    val byLight =
      if !connection.samplePoint(vertex.point.p, sampler.x, sampler.y) then Rgb.Black
      else
        connection.scattered(
          vertex,
          weight = wi => LightTransport.powerHeuristic(connection.pdf, vertex.localPdf(wi))
        )
    if connection.isDelta || connection.isShownOnly then byLight
    else byLight + byBsdf(vertex, sampler)

  /** The sample of the BSDF, if it hits the chosen light. */
  private def byBsdf(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    vertex.draw(sampler)
    val bounce = vertex.bounce
    val wi = vertex.point.frame.toWorld(bounce.wi)
    // The walk follows specular directions
    if bounce.isSpecular || bounce.weight.isBlack || !vertex.isOpen(wi) then Rgb.Black
    else
      bsdfRay.set(vertex.point.offsetOrigin(wi), wi, Float.PositiveInfinity)
      bsdfRays += 1
      val p = vertex.point.p
      val chosen = connection.probability
      if meetsSurface() then
        if emitter.areaLight != connection.index then Rgb.Black
        else
          val source = scene.surfaceLight(emitter)
          val weight = LightTransport.powerHeuristic(bounce.pdf, chosen * source.pdf(p, emitter))
          bounce.weight.toRgb * attenuated(source.radiance(emitter, -wi)) * (weight / chosen)
      else
        val index = scene.environmentIndex.indexOf(connection.index)
        if index < 0 then Rgb.Black
        else
          val source = scene.environments(index)
          val weight = LightTransport.powerHeuristic(bounce.pdf, chosen * source.pdf(p, wi))
          bounce.weight.toRgb * attenuated(source.radiance(p, wi)) * (weight / chosen)

  /** Finds the surface that light from the sampled direction left last. */
  private def meetsSurface(): Boolean =
    if !interfaces.stopsLight then scene.closestBehindInterfaces(bsdfRay, bsdfHit, emitter)
    else
      val isHit = scene.closest(bsdfRay, bsdfHit)
      if isHit then scene.surface(bsdfRay, bsdfHit, emitter)
      isHit

  private def attenuated(radiance: Rgb): Rgb =
    val march = volumes
    if march == null then radiance
    else radiance * march.transmittance(bsdfRay, VolumeMarch.StepsToLights)
