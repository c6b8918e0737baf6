package candela.integrators

import candela.bsdf.{Bsdf, DipoleBssrdf}
import candela.color.Rgb
import candela.geometry.Frame
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** [[DirectLighting]], and what comes straight from the sources into translucent surfaces and out
  * of them again elsewhere.
  *
  * @param maxDepth     most specular bounces, plus one
  * @param lightSamples how often each light is sampled at a point
  *
  * PBRT 2 sums the dipole over points that it has laid out on all translucent surfaces (Jensen and
  * Buhler, "A Rapid Hierarchical Rendering Technique for Translucent Materials", SIGGRAPH 2002);
  * here each sample draws a place of its own, and light from one source.
  */
final class DipoleLighting(
    scene: Scene,
    maxDepth: Int,
    lightSamples: Array[Int],
    volumes: VolumeMarch | Null = null
) extends DirectLighting(scene, maxDepth, lightSamples, volumes):
  private val probe = SubsurfaceProbe(scene, acrossMaterials = true)
  private val entry = scene.newPoint()

  override protected def over(scene: Scene): DipoleLighting =
    DipoleLighting(scene, maxDepth, lightSamples, VolumeMarch.copy(volumes))

  override def raysTraced: Long = super.raysTraced + probe.raysTraced

  override protected def gathered(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    val fromSurface = super.gathered(bsdf, wo, sampler)
    scene.bssrdf(at) match
      case dipole: DipoleBssrdf => fromSurface + beneath(dipole, wo, sampler)
      case _ => fromSurface

  private def beneath(dipole: DipoleBssrdf, wo: Vec3, sampler: Sampler): Rgb =
    val weight = probe.enter(at, dipole, shadowRay.time, sampler, entry)
    val choice = sampler.next1D()
    sampler.next2D()
    if weight.isBlack then Rgb.Black
    else
      val leaving = dipole.leaving(wo dot at.frame.n)
      val exit = at
      at = entry
      at.frame = Frame.around(at.geometricNormal) // light arrives at the true surface
      val arrived = irradiance(dipole, choice, sampler)
      at = exit
      weight * arrived * leaving

  /** Light that enters at `at`, over π. */
  private def irradiance(dipole: DipoleBssrdf, choice: Float, sampler: Sampler): Rgb =
    scene.selection.choose(at.p, at.frame.n, choice, chosen)
    if chosen.light < 0 then Rgb.Black
    else
      val selected = chosen.probability
      sampleLight(chosen.light, selected, dipole.entry, at.frame.n, sampler, combined = false)
