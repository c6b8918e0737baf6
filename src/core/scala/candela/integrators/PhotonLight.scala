package candela.integrators

import candela.color.Rgb
import candela.geometry.{Hit, Ray}
import candela.scene.{Casters, Scene}

/** Light that photons bring in place of a path: what emitters send, by casters alone, to a surface
  * or a medium that receives it. Of each worker, as the photons are those of a pass.
  *
  * It is gathered along every part of the path in a medium, at every vertex that receives photons
  * and is no caster, and at one that is (a rough one) if none has gathered since the last of these.
  * So a light's way to the camera is cut at one place: the path leaves out what it meets behind
  * casters only, and what light sampling finds there.
  *
  * @param casters   where photons begin
  * @param maxDepth  scattering events of a path, at most
  * @param bringsAll do they bring all light that media scatter? Then paths are not scattered there
  */
abstract class PhotonLight(
    scene: Scene,
    casters: Casters,
    maxDepth: Int,
    private[integrators] val bringsAll: Boolean
):
  import PhotonLight.*
  private val isBrought: Array[Boolean] = scene.lights.map(_.isCausticSource).toArray

  /** Radiance that the vertex reflects of the photons around it, which have met at most `most`
    * casters.
    *
    * @param isAlone does the path carry its hero wavelength only?
    */
  protected def gather(vertex: SurfaceVertex, most: Int, isAlone: Boolean): Rgb

  /** Adds light of photons around the segment that the medium scatters to its begin.
    *
    * @param most         scattering events that a photon may have, the last one included
    * @param isAlone      as for [[gather]]
    * @param isSeen       does the camera see the segment, if by way of casters?
    */
  protected def along(
      segment: MediumSegment,
      most: Int,
      isAlone: Boolean,
      isSeen: Boolean
  ): Unit

  /** Adds what the medium scatters to the path. */
  private[integrators] final def scatter(segment: MediumSegment, path: PathHistory): Unit =
    val events = maxDepth - path.depth
    if events > 0 then
      along(segment, events, path.isAlone, isSeen = path.gatherState < CastersSinceGather)

  /** The path leaves a place in a medium. */
  private[integrators] final def leaveMedium(path: PathHistory): Unit =
    path.gatherState = CastersSinceGather

  /** What the vertex reflects towards the path. */
  private[integrators] final def reflected(vertex: SurfaceVertex, path: PathHistory): Rgb =
    val events = maxDepth - path.depth
    if events > 0 && gathers(vertex, path) then gather(vertex, events, path.isAlone) else Rgb.Black

  private def gathers(vertex: SurfaceVertex, path: PathHistory): Boolean =
    receives(
      scene,
      vertex
    ) && (path.gatherState < CastersSinceGather || !scene.isCaster(vertex.point))

  /** Do they bring what the path meets at the emitter? */
  private[integrators] final def covers(light: Int, path: PathHistory): Boolean =
    path.gatherState == PhotonMayBegin && isBrought(light)

  /** Do they bring what a light sample finds at the vertex, which the ray has met? */
  private[integrators] final def covers(
      light: Int,
      vertex: SurfaceVertex,
      ray: Ray,
      hit: Hit,
      path: PathHistory
  ): Boolean =
    path.gatherState >= CastersSinceGather && isBrought(light) && canBegin(vertex, ray, hit)

  private def canBegin(vertex: SurfaceVertex, ray: Ray, hit: Hit): Boolean =
    scene.isCaster(vertex.point) && casters.density(ray, hit, vertex.point) > 0f

  /** The path leaves the vertex, which `ray` has met, by `vertex.bounce`. */
  private[integrators] final def leaveVertex(
      vertex: SurfaceVertex,
      ray: Ray,
      hit: Hit,
      path: PathHistory
  ): Unit =
    val gatherState = path.gatherState
    path.gatherState =
      if gathers(vertex, path) then
        if vertex.bounce.isSpecular then NoGatherYet else CastersSinceGather
      else if gatherState < CastersSinceGather then gatherState
      else if canBegin(vertex, ray, hit) then PhotonMayBegin
      else if scene.isCaster(vertex.point) then CastersSinceGather
      else NoGatherYet

private[candela] object PhotonLight:
  /** States of [[PathHistory.gatherState]]: no vertex has gathered photons, or one that is no
    * caster has followed without doing so.
    */
  inline val NoGatherYet = -1

  /** Since a vertex that gathered photons, the path has met casters only. */
  inline val CastersSinceGather = 1

  /** Likewise, and a photon may begin at the last of them. */
  inline val PhotonMayBegin = 2

  /** Are photons stored at such a vertex? Not where they would be found in a narrow lobe, or would
    * go on beneath the surface.
    */
  def receives(scene: Scene, vertex: SurfaceVertex): Boolean =
    val bsdf = vertex.bsdf
    vertex.isInMedium || !bsdf.isSpecular && (bsdf.isDiffuse || !bsdf.isNarrow) &&
    !scene.isSubsurface(vertex.point.material)
