package candela.scene

import candela.accel.Accelerator
import candela.bsdf.{Bsdf, Bssrdf}
import candela.color.Rgb
import candela.geometry.{Ball, Hit, Ray, ShadingPoint}
import candela.lights.{EnvironmentLight, Light, LightGroups, LightSelection, SurfaceLight}
import candela.math.Vec3

/** Geometry, materials, lights and media of a scene. Immutable; shared by all workers.
  *
  * @param surfaces        numbered as the accelerator's primitives; instances follow
  * @param sidesByGeometry whether the geometric normal separates reflection from transmission, as
  *   in pbrt-v2 and v3, which prevents light leaks; pbrt-v4 uses the shading normal only
  * @param footprints      present if textures need footprints, or displacements need partial
  *   derivatives
  * @param report          receives every scattering surface; see [[reported]]
  * @param lightGroups     present if light is to be divided by them
  */
final class Scene(
    private[candela] val surfaces: Surfaces,
    instanced: Instanced,
    accelerator: Accelerator,
    private[candela] val materials: SceneMaterials,
    val lights: Array[Light],
    val selection: LightSelection,
    val sidesByGeometry: Boolean,
    footprints: Option[Footprints] = None,
    report: Option[PathReport] = None,
    val lightGroups: Option[LightGroups] = None
):
  private val pathReport: PathReport | Null = report.orNull

  private val firstInstance = surfaces.count
  private val footprintRule: Footprints | Null = footprints.orNull
  private val hasFootprints = footprints.isDefined

  /** The infinite lights among `lights`, with their indices. */
  val environments: Array[EnvironmentLight] = lights.map(_.asEnvironment).filter(_ != null)
  val environmentIndex: Array[Int] =
    lights.indices.filter(lights(_).asEnvironment != null).toArray

  private val surfaceLights: Array[SurfaceLight] = lights.map(_.asSurface)

  /** Bounding sphere of all surfaces. */
  lazy val ball: Ball = Ball.enclosing(accelerator.bounds)

  def closest(ray: Ray, hit: Hit): Boolean = accelerator.closest(ray, hit)

  def isOccluded(ray: Ray, hit: Hit): Boolean = accelerator.isOccluded(ray, hit)

  /** Returns an empty point for `surface` to fill, with all that the materials need.
    *
    * @param always whether footprints are needed even where no material reads them
    */
  def newPoint(always: Boolean = false): ShadingPoint =
    ShadingPoint(wantsPartials = hasFootprints, always)

  /** Updates the differential of a ray just spawned at `at`. */
  def scattered(
      ray: Ray,
      at: ShadingPoint,
      wo: Vec3,
      wi: Vec3,
      isSpecular: Boolean,
      eta: Float
  ): Unit =
    val rule = footprintRule
    if rule != null then rule.scattered(ray, at, wo, wi, isSpecular, eta)

  /** Continues a ray in its direction, through the interface at `at`. */
  def passThrough(ray: Ray, at: ShadingPoint): Unit =
    val direction = ray.direction
    val hidesSky = ray.hidesSky
    ray.set(at.offsetOrigin(direction), direction, Float.PositiveInfinity)
    ray.hidesSky = hidesSky
    val rule = footprintRule
    if rule != null then rule.passed(ray)

  /** Computes the geometry of the hit that `closest` found. */
  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val primitive = hit.primitive
    val rule = footprintRule
    at.startHit(followed = rule != null && ray.differential.isKnown)
    if primitive < firstInstance then surfaces.fill(primitive, ray, hit, at)
    else instanced.fill(primitive - firstInstance, ray, hit, at)
    if rule != null && at.hasPartials then rule.setFootprint(ray, at)

  /** Computes the place of a hit at the ray's time, as it is at `time`. */
  def surfaceAt(ray: Ray, hit: Hit, time: Float, at: ShadingPoint): Unit =
    val primitive = hit.primitive
    at.startHit(followed = false)
    if primitive < firstInstance then surfaces.fill(primitive, ray, hit, at)
    else instanced.fillAt(primitive - firstInstance, ray, hit, time, at)

  /** Index of what was hit: the world's meshes and other shapes, then the instances. */
  def objectIndex(hit: Hit): Int =
    if hit.primitive < firstInstance then surfaces.partOf(hit.primitive)
    else surfaces.partCount + hit.primitive - firstInstance

  /** Whether light passes this surface unscattered. */
  def isInterface(at: ShadingPoint): Boolean = interfaces(at.material)

  private val interfaces = materials.interfaces

  /** Whether paths pass openings of surfaces as if these were interfaces. */
  val hasVeils: Boolean = !surfaces.veils.isEmpty || instanced.hasVeils

  /** Whether paths pass the surface that `ray` just hit, at `at`, unscattered. */
  def isPassed(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    isInterface(at) || hasVeils && isOpen(ray, hit, at)

  private def isOpen(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    val primitive = hit.primitive
    if primitive < firstInstance then
      !surfaces.veils.isEmpty && surfaces.isOpen(primitive, ray, at)
    else instanced.isOpen(primitive - firstInstance, ray, hit, at)

  /** Whether any surface is an interface; shadow rays must then examine their hits. */
  val hasInterfaces: Boolean = materials.hasInterfaces

  /** Whether light that passes this surface keeps its direction, though some may be reflected. */
  def isPane(at: ShadingPoint): Boolean = panes(at.material)

  private val panes = materials.panes
  val hasPanes: Boolean = materials.hasPanes

  /** Transmittance of the thin dielectric `at` for light in direction `w`. */
  def straight(at: ShadingPoint, w: Vec3): Rgb =
    val pane = materials(at.material).bsdf(at)
    val passed = pane.straight(at.frame.toLocal(w))
    val report = pathReport
    if report != null then report.passes(at, passed)
    passed

  /** Traces a ray through interfaces to the closest other surface and computes its geometry; false
    * if the ray escapes.
    */
  def closestBehindInterfaces(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    var isHit = closest(ray, hit)
    if isHit then surface(ray, hit, at)
    while isHit && isPassed(ray, hit, at) do
      passThrough(ray, at)
      isHit = closest(ray, hit)
      if isHit then surface(ray, hit, at)
    isHit

  def bsdf(at: ShadingPoint): Bsdf =
    val scattering = materials(at.material).bsdf(at)
    val report = pathReport
    if report == null then scattering else report.scatters(at, scattering)

  /** The same geometry with other materials and lights, in the same order; light sampling keeps its
    * probabilities.
    */
  def recolored(materials: SceneMaterials, lights: Array[Light]): Scene = copy(materials, lights)

  /** The same scene with the footprints of another camera, if it needs any. */
  def withFootprints(other: => Footprints): Scene =
    if footprints.isEmpty then this else copy(footprints = Some(other))

  /** Returns the same scene, reporting one path. */
  def reported(report: PathReport): Scene =
    val reportedLights = lights.zipWithIndex.map((l, i) => ReportedLights.of(l, i, report))
    copy(lights = reportedLights, report = Some(report))

  private def copy(
      materials: SceneMaterials = materials,
      lights: Array[Light] = lights,
      footprints: Option[Footprints] = footprints,
      report: Option[PathReport] = report
  ): Scene =
    Scene(
      surfaces, instanced, accelerator, materials, lights, selection, sidesByGeometry, footprints,
      report, lightGroups
    )

  private val casterMaterials = materials.casters

  /** Whether any surface may cast caustics. */
  def mayHaveCasters: Boolean = materials.hasCasters

  /** Whether this surface casts caustics. */
  def isCaster(at: ShadingPoint): Boolean = casterMaterials(at.material)

  /** The surfaces that cast caustics. */
  def casters: Casters = materials.castersAmong(surfaces, instanced)

  /** Whether any surface is dispersive. */
  val isDispersive: Boolean = materials.isDispersive

  /** Whether any surface has subsurface scattering. */
  val hasSubsurface: Boolean = materials.hasSubsurface

  /** Whether this material has subsurface scattering. */
  def isSubsurface(material: Int): Boolean = materials.isSubsurface(material)

  /** The BSSRDF at `at`; null if the material has none. */
  def bssrdf(at: ShadingPoint): Bssrdf | Null = materials(at.material).bssrdf(at)

  /** One material may have several indices. */
  def isSameMaterial(a: Int, b: Int): Boolean = materials.isSame(a, b)

  /** The light whose surface `at` is on; requires `at.areaLight` ≥ 0. */
  def surfaceLight(at: ShadingPoint): SurfaceLight = surfaceLights(at.areaLight)
