package candela.caustics

import candela.base.loop
import candela.bdpt.{LightPaths, PathMedia, PathVertex}
import candela.photons.{PassedPhotons, PhotonMap, PhotonMaps, PhotonTracer, Photons}
import candela.color.Rgb
import candela.film.View
import candela.geometry.Ray
import candela.integrators.{
  Integrator, LightTransport, MediumSegment, PassIntegrator, PhotonLight, SurfaceVertex
}
import candela.sampling.Sampler
import candela.scene.{Casters, PathReport, Scene}

/** Traces photons that casters alone have scattered, and, if media shall have all light from
  * photons, the others that arrive in media.
  *
  * @param bringsAll shall they?
  */
private final class CausticPhotons(scene: Scene, light: CausticLight, bringsAll: Boolean, seed: Int)
    extends PhotonTracer(seed):
  private val pathMedia = light.pathMedia(scene)
  private val paths = light.photonPaths(scene, pathMedia)
  private val mediumPaths: LightPaths | Null =
    if bringsAll then CausticPhotons.mediumPaths(scene, light, pathMedia) else null

  def raysTraced: Long =
    paths.raysTraced + (if pathMedia == null then 0L else pathMedia.raysTraced) +
      (if mediumPaths == null then 0L else mediumPaths.raysTraced)

  protected def trace(time: Float, sampler: Sampler, photons: Photons): Unit =
    paths.trace(time, sampler)
    loop(paths.count): k =>
      val vertex = paths(k)
      add(vertex, if vertex.isInMedium then vertex.medium else PhotonMap.Surface, 1f, photons)
    val extra = mediumPaths
    if extra != null && sampler.next1D() < CausticPhotons.OfOthers then
      extra.trace(time, sampler, hero = (sampler.next1D() * 3f).toInt)
      loop(extra.count): k =>
        val vertex = extra(k)
        if vertex.isInMedium && !vertex.isCaustic then
          add(vertex, vertex.medium, 1f / CausticPhotons.OfOthers, photons)

  private def add(vertex: PathVertex, place: Int, times: Float, photons: Photons): Unit =
    val edges = if vertex.isAlone then -vertex.edges else vertex.edges
    photons.add(vertex.point.p, vertex.wo, vertex.throughput * times, edges, place)

private[candela] object CausticPhotons:
  /** Paths of other light for each that begins at a caster: it is less uneven, and each leaves
    * several photons.
    */
  inline val OfOthers = 0.25f

  /** Paths of all light in media. */
  def mediumPaths(scene: Scene, light: CausticLight, pathMedia: PathMedia | Null): LightPaths =
    LightPaths(
      scene,
      light.maxDepth,
      LightTransport.SubpathRouletteDepth,
      light.compresses,
      weighsAll = false,
      media = pathMedia,
      casters = light.casters
    )

/** The photons of the current pass. Mutable, one per worker. */
private final class MappedPhotons(
    scene: Scene,
    casters: Casters,
    maxDepth: Int,
    bringsAll: Boolean
) extends PhotonLight(scene, casters, maxDepth, bringsAll):
  var map: PhotonMap = PhotonMap(Array.empty, paths = 1, radius = 1f) // none yet
  private val passed = PassedPhotons()

  protected def gather(vertex: SurfaceVertex, most: Int, isAlone: Boolean): Rgb =
    // The edge to the vertex is none of a caster
    map.gather(vertex, Float.PositiveInfinity, most + 1, isAlone)

  protected def along(
      segment: MediumSegment,
      most: Int,
      isAlone: Boolean,
      isSeen: Boolean
  ): Unit =
    val tree = if isSeen then map.inMedia else map.fewInMedia
    val photons = tree.data
    tree.query(segment.ray, segment.medium, most, passed)
    var i = 0
    while i < passed.count && segment.goTo(passed.t(i)) do
      val photon = passed.offset(i)
      // As at surfaces
      val share = if isAlone && photons(photon + PhotonMap.EdgesOffset) < 0f then 1f / 3f else 1f
      val factor = tree.perArea * share
      segment.add(
        photons(photon + 3),
        photons(photon + 4),
        photons(photon + 5),
        photons(photon + 6) * factor,
        photons(photon + 7) * factor,
        photons(photon + 8) * factor
      )
      i += 1

private final class CausticGatherer(
    source: CausticPhotons,
    passes: CausticPasses,
    photons: MappedPhotons,
    paths: Integrator
) extends PassIntegrator:

  def startPass(pass: Int, isStopped: () => Boolean): Boolean =
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
  * @param bringsAll as for [[candela.integrators.PhotonLight]]
  * @param tracer takes caustics from the photons
  * @param paths  light paths of a pass; 0: one per pixel
  *
  * Sources: Jensen, "Global Illumination using Photon Maps", EGWR 1996: its caustics map;
  * [[PhotonMaps]] for the radius.
  */
final class CausticPasses(
    scene: Scene,
    light: CausticLight,
    radius: Float,
    bringsAll: Boolean,
    seed: Int,
    view: View,
    tracer: (Scene, PhotonLight) => Integrator,
    paths: Int = 0
) extends PhotonMaps(radius, asked = paths, view):

  def integrator(report: Option[PathReport]): PassIntegrator =
    val reporting = report.fold(scene)(scene.reported)
    val photons = MappedPhotons(reporting, light.casters, light.maxDepth, bringsAll)
    val source = CausticPhotons(reporting, light, bringsAll, seed)
    CausticGatherer(source, this, photons, tracer(reporting, photons))
