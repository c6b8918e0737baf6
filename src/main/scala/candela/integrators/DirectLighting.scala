package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Light that comes straight from the sources, or by way of mirrors and glass only.
  *
  * @param maxDepth     most specular bounces, plus one
  * @param lightSamples how often each light is sampled at a point; empty: one light, chosen at
  *                     random
  *
  * Where a surface both mirrors and refracts, one of the two is followed at random instead of both:
  * the same mean at a cost that does not double with each bounce.
  * Source: PBRT 3rd ed., §14.3; multiple importance sampling as in Veach 1997, §9.2.
  */
class DirectLighting(
    scene: Scene,
    maxDepth: Int,
    lightSamples: Array[Int],
    volumes: VolumeMarch | Null = null
) extends SpecularWalk(scene, maxDepth, volumes):
  private val bsdfRay = Ray()
  private val bsdfHit = Hit()
  private val met = ShadingPoint()

  protected def over(scene: Scene): DirectLighting =
    DirectLighting(scene, maxDepth, lightSamples, VolumeMarch.copy(volumes))

  override protected def begin(ray: Ray): Unit =
    super.begin(ray)
    bsdfRay.time = ray.time

  protected def direct(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    var sum = Rgb.Black
    if lightSamples.length == 0 then
      scene.selection.choose(at.p, at.frame.n, sampler.next1D(), chosen)
      if chosen.light >= 0 then
        sum = estimate(chosen.light, chosen.probability, bsdf, wo, sampler)
    else
      var light = 0
      while light < lightSamples.length do
        var i = 0
        while i < lightSamples(light) do
          sum += estimate(light, 1f, bsdf, wo, sampler) * (1f / lightSamples(light))
          i += 1
        light += 1
    sum

  /** One sample of the light and one of the BSDF, combined. */
  private def estimate(light: Int, selected: Float, bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    sampler.next2D()
    val byLight = sampleLight(light, selected, bsdf, wo, sampler, combined = true)
    if scene.lights(light).isDelta then byLight
    else byLight + byBsdf(light, selected, bsdf, wo, sampler)

  private def byBsdf(light: Int, selected: Float, bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    val choice = sampler.next1D()
    sampler.next2D()
    val bounce = bsdf.sample(at.frame.toLocal(wo), choice, sampler.x, sampler.y)
    // Specular directions are followed by the loop above
    val wi = at.frame.toWorld(bounce.wi)
    if bounce.isSpecular || bounce.weight.isBlack || !isOpenSide(wi, wo, bsdf) then Rgb.Black
    else
      bsdfRay.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
      rays += 1
      if scene.closest(bsdfRay, bsdfHit) then
        scene.surface(bsdfRay, bsdfHit, met)
        if met.areaLight != light then Rgb.Black
        else
          val source = scene.surfaceLight(met)
          val weight = LightTransport.powerHeuristic(bounce.pdf, selected * source.pdf(at.p, met))
          bounce.weight * dimmed(source.radiance(met, -wi)) * (weight / selected)
      else
        val found = scene.environmentIndex.indexOf(light)
        if found < 0 then Rgb.Black
        else
          val source = scene.environments(found)
          val weight = LightTransport.powerHeuristic(bounce.pdf, selected * source.pdf(at.p, wi))
          bounce.weight * dimmed(source.radiance(at.p, wi)) * (weight / selected)

  private def dimmed(light: Rgb): Rgb =
    val march = volumes
    if march == null then light else light * march.dimming(bsdfRay, stepsToLights)
