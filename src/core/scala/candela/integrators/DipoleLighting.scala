package candela.integrators

import candela.bsdf.Bssrdf
import candela.color.Rgb
import candela.geometry.{Frame, Ray}
import candela.sampling.Sampler
import candela.scene.Scene

/** [[DirectLighting]], and direct light that enters translucent surfaces and leaves them elsewhere.
  *
  * @param maxDepth     specular bounces plus one, at most
  * @param lightSamples samples of each light at a vertex
  *
  * pbrt-v2 sums the dipole over points distributed on all translucent surfaces (Jensen and Buhler,
  * "A Rapid Hierarchical Rendering Technique for Translucent Materials", SIGGRAPH 2002); here each
  * sample draws its own point of entry, and one light.
  */
final class DipoleLighting(
    scene: Scene,
    maxDepth: Int,
    lightSamples: Array[Int],
    volumes: VolumeMarch | Null = null
) extends DirectLighting(scene, maxDepth, lightSamples, volumes):
  private val probe = SubsurfaceProbe(scene, acrossMaterials = true)
  private val entry = SurfaceVertex(scene)
  private var time = 0f

  override def raysTraced: Long = super.raysTraced + probe.raysTraced

  override def radiance(ray: Ray, sampler: Sampler): Rgb =
    time = ray.time
    super.radiance(ray, sampler)

  override protected def gathered(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    val fromSurface = super.gathered(vertex, sampler)
    val inside = scene.bssrdf(vertex.point)
    if inside == null then fromSurface else fromSurface + beneath(vertex, inside, sampler)

  /** Light that enters elsewhere and leaves at `exit`. */
  private def beneath(exit: SurfaceVertex, inside: Bssrdf, sampler: Sampler): Rgb =
    val weight = probe.enter(exit.point, inside, time, sampler, entry.point)
    val choice = sampler.next1D(matters = connection.isRandom)
    sampler.next2D()
    if weight.isBlack then Rgb.Black
    else
      val leaving = inside.leaving(exit.wo dot exit.point.frame.n)
      // Light arrives at the true surface
      entry.point.frame.set(Frame.fromZ(entry.point.geometricNormal))
      entry.scatterBy(inside.entry, entry.point.frame.n)
      weight * irradiance(choice, sampler) * leaving

  /** Light of one source that enters at `entry`, over π. */
  private def irradiance(choice: Float, sampler: Sampler): Rgb =
    val p = entry.point.p
    if connection.choose(
        p,
        entry.point.frame.n,
        choice
      ) && connection.samplePoint(p, sampler.x, sampler.y)
    then connection.scattered(entry, weight = _ => 1f)
    else Rgb.Black
