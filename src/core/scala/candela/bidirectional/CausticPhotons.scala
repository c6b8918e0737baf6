package candela.bidirectional

import candela.color.Rgb
import candela.film.View
import candela.geometry.Ray
import candela.integrators.{Integrator, PassIntegrator, PhotonLight, SurfaceVertex}
import candela.sampling.Sampler
import candela.scene.{Casters, PathReport, Scene}

/** Traces photons that casters alone have scattered. */
private final class CausticPhotons(protected val paths: CausticPaths, seed: Int)
    extends PhotonTracer(seed):

  def raysTraced: Long = paths.raysTraced

  protected def trace(time: Float, sampler: Sampler): Unit = paths.trace(time, sampler)

  protected def store(vertex: PathVertex, photons: Photons): Unit =
    val edges = if vertex.isAlone then -vertex.edges else vertex.edges
    photons.add(vertex.at.p, vertex.wo, vertex.throughput, edges)

/** The photons of the current pass. Mutable, one per worker. */
private final class MappedPhotons(scene: Scene, casters: Casters, maxDepth: Int)
    extends PhotonLight(scene, casters, maxDepth):
  var map: PhotonMap = PhotonMap(Array.empty, paths = 1, radius = 1f) // none yet

  protected def around(vertex: SurfaceVertex, most: Int, isAlone: Boolean): Rgb =
    // The edge to the vertex is none of a caster
    map.gather(vertex, Float.PositiveInfinity, most + 1, isAlone)

private final class CausticGatherer(
    source: CausticPhotons,
    passes: CausticPasses,
    photons: MappedPhotons,
    paths: Integrator
) extends PassIntegrator:

  def begin(pass: Int, isStopped: () => Boolean): Boolean =
    val prepared = passes(pass, source, isStopped)
    for map <- prepared do photons.map = map
    prepared.isDefined

  def radiance(ray: Ray, sampler: Sampler): Rgb = paths.radiance(ray, sampler)
  def raysTraced: Long = paths.raysTraced + source.raysTraced
  override def lastMaterial: Int = paths.lastMaterial

/** Path tracing that takes caustics from the photon map of its pass.
  *
  * @param light  its paths leave the photons
  * @param radius of the first pass
  * @param tracer takes caustics from the photons
  *
  * Sources: Jensen, "Global Illumination using Photon Maps", EGWR 1996: its caustics map;
  * [[PhotonMaps]] for the radius.
  */
final class CausticPasses(
    scene: Scene,
    light: CausticLight,
    radius: Float,
    seed: Int,
    view: View,
    tracer: (Scene, PhotonLight) => Integrator
) extends PhotonMaps(radius, asked = 0, view):

  def integrator(report: Option[PathReport]): PassIntegrator =
    val over = report.fold(scene)(scene.reported)
    val photons = MappedPhotons(over, light.casters, light.maxDepth)
    val source = CausticPhotons(light.photonPaths(over), seed)
    CausticGatherer(source, this, photons, tracer(over, photons))
