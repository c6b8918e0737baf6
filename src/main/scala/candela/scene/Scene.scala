package candela.scene

import candela.accel.Accelerator
import candela.bsdf.{Bsdf, Bssrdf, InterfaceMaterial, Material}
import candela.geometry.{Ball, Hit, Ray, ShadingPoint}
import candela.lights.{EnvironmentLight, Light, LightSelection, SurfaceLight}
import candela.math.Vec3
import candela.shapes.Shape

/** A shape that is no triangle, with what it looks like.
  *
  * @param material index into the scene's materials
  * @param light    index into its lights, −1: it does not emit
  * @param inverted do its normals point to the other side where rays meet it than where light
  *                 sampling does? So with some of pbrt's, whose emission is seen on one side while
  *                 what they light lies on the other
  */
final case class ShapeInstance(
    shape: Shape,
    material: Int,
    light: Int,
    inverted: Boolean = false
)

/** All that a ray can meet, and all that lights it. Immutable; shared by all workers.
  *
  * @param surfaces        numbered as the accelerator's primitives; instances follow
  * @param sidesByGeometry does the geometric normal say which directions are reflections? So in
  *                        pbrt-v2 and v3, which thereby keep light from leaking through; pbrt-v4
  *                        goes by the shading normal alone
  * @param footprints      if textures ask for them, or displacements for partial derivatives
  * @param report          is told of every surface that scatters; see [[reported]]
  */
final class Scene(
    surfaces: Surfaces,
    instanced: Instanced,
    accelerator: Accelerator,
    materials: Array[Material],
    val lights: Array[Light],
    val selection: LightSelection,
    val sidesByGeometry: Boolean,
    footprints: Option[Footprints] = None,
    report: Option[PathReport] = None
):
  private val told: PathReport | Null = report.orNull

  private val firstInstance = surfaces.count
  private val footprintRule: Footprints | Null = footprints.orNull
  private val hasFootprints = footprints.isDefined

  /** Those of `lights` that surround the scene, with their indices. */
  val environments: Array[EnvironmentLight] = lights.collect { case e: EnvironmentLight => e }
  val environmentIndex: Array[Int] =
    lights.indices.filter(i => lights(i).isInstanceOf[EnvironmentLight]).toArray

  private val surfaceLights: Array[SurfaceLight] = lights.map:
    case s: SurfaceLight => s
    case _ => null

  /** Holds all surfaces. */
  lazy val ball: Ball = Ball.around(accelerator.bounds)

  def closest(ray: Ray, hit: Hit): Boolean = accelerator.closest(ray, hit)

  def isOccluded(ray: Ray, hit: Hit): Boolean = accelerator.isOccluded(ray, hit)

  /** A point to be filled in by `surface` with all that the materials ask for. */
  def newPoint(): ShadingPoint = ShadingPoint(wantsPartials = hasFootprints)

  /** Tells a ray that was just set on its way from `at` what became of its neighbours. */
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
    ray.set(at.offsetOrigin(direction), direction, Float.PositiveInfinity)
    val rule = footprintRule
    if rule != null then rule.passed(ray)

  /** Works out the geometry of the hit that `closest` found. */
  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val primitive = hit.primitive
    if primitive < firstInstance then surfaces.fill(primitive, ray, hit, at)
    else instanced.fill(primitive - firstInstance, ray, hit, at)
    val rule = footprintRule
    if rule != null && at.wantsPartials then rule.find(ray, at)

  /** Does light pass here as if nothing were there? */
  def isInterface(at: ShadingPoint): Boolean = materials(at.material) eq InterfaceMaterial

  /** Are there surfaces where it does? Then shadow rays must look at what they hit. */
  val hasInterfaces: Boolean = materials.exists(_ eq InterfaceMaterial)

  /** Traces a ray through interfaces to the first other surface and computes its geometry; false if
    * the ray leaves the scene.
    */
  def closestBehindInterfaces(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    var found = closest(ray, hit)
    if found then surface(ray, hit, at)
    while found && isInterface(at) do
      passThrough(ray, at)
      found = closest(ray, hit)
      if found then surface(ray, hit, at)
    found

  def bsdf(at: ShadingPoint): Bsdf =
    val made = materials(at.material).bsdf(at)
    val report = told
    if report == null then made else report.scatters(at, made)

  /** The same scene, of which one path is told. */
  def reported(report: PathReport): Scene =
    val telling = lights.zipWithIndex.map((l, i) => ReportedLights.of(l, i, report))
    Scene(
      surfaces,
      instanced,
      accelerator,
      materials,
      telling,
      selection,
      sidesByGeometry,
      footprints,
      Some(report)
    )

  /** Does any surface split light by wavelength? */
  val isDispersive: Boolean = materials.exists(_.isDispersive)

  /** Does light travel beneath any surface? */
  val hasSubsurface: Boolean = materials.exists(_.isSubsurface)

  /** Does it beneath surfaces of this material? */
  def isSubsurface(material: Int): Boolean = materials(material).isSubsurface

  /** How light travels beneath the surface; null: it does not. */
  def bssrdf(at: ShadingPoint): Bssrdf | Null = materials(at.material).bssrdf(at)

  /** One material may have several numbers. */
  def isSameMaterial(a: Int, b: Int): Boolean = materials(a) eq materials(b)

  /** The light whose surface `at` is on; only if `at.areaLight` ≥ 0. */
  def surfaceLight(at: ShadingPoint): SurfaceLight = surfaceLights(at.areaLight)
