package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.lights.EnvironmentLight
import candela.sampling.Sampler
import candela.scene.Scene

/** Parts of the estimators that all light transport algorithms share. */
object LightTransport:
  /** The first scattering event after which Russian roulette may end a path. As in pbrt-v2 and v3;
    * in v4 it is the second, which costs more in noise than it saves in time:
    * docs/decisions/0016-shared-samples.md.
    */
  inline val RouletteDepth = 5

  /** Likewise of a subpath, from the camera or from a light. */
  inline val SubpathRouletteDepth = 4

  /** Weight of a path whose companion wavelengths end: its hero stands for all three. */
  val Hero: Rgb = Rgb(3f, 0f, 0f)

  /** Multiple importance sampling: weight of a sample of density `a` that a second technique draws
    * with density `b`.
    *
    * Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, §9.2.4, β =
    * 2.
    */
  def powerHeuristic(a: Float, b: Float): Float =
    if a == Float.PositiveInfinity then 1f
    else
      val r = b / a
      1f / (1f + r * r)

  /** Russian roulette: the factor of the throughput; 0 ends the path.
    *
    * @param throughput largest component, without the radiance scaling of refraction; below the
    *                   threshold it is the probability of going on
    */
  def roulette(throughput: Float, threshold: Float, sampler: Sampler): Float =
    if throughput >= threshold then 1f
    else if sampler.next1D() < throughput then 1f / throughput
    else 0f

  /** Radiance of the environment along a ray that left the scene, unless it is hidden from the ray;
    * each light times `weight` of its index and itself.
    *
    * @param contribution receives each light's index and contribution
    */
  inline def environment(
      scene: Scene,
      ray: Ray,
      inline weight: (Int, EnvironmentLight) => Float,
      inline contribution: (Int, Rgb) => Unit = (_, _) => ()
  ): Rgb =
    var r, g, b = 0f
    var i = 0
    val end = if ray.hidesSky then 0 else scene.environments.length
    while i < end do
      val source = scene.environments(i)
      val w = weight(scene.environmentIndex(i), source)
      val arriving = source.radiance(ray.origin, ray.direction)
      r += arriving.r * w
      g += arriving.g * w
      b += arriving.b * w
      contribution(scene.environmentIndex(i), arriving * w)
      i += 1
    Rgb(r, g, b)
