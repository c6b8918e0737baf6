package candela.aov

import candela.bsdf.{Bsdf, DirectionalAlbedo}
import candela.color.{ColorBasis, Rgb}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.scene.{Scene, SurfaceNames}

/** The first visible surface of a camera ray, source of the AOVs with any integrator. Properties
  * are computed on demand. Mutable, one per worker.
  *
  * @param output        transform from world space to that of the AOVs, at the time of a ray
  * @param basis         of the scene's colours
  * @param names         of what can be seen
  * @param motion        projection of moving points, if the camera has one
  * @param hidesEmitters whether the camera sees through emitters
  * @param skyCovers     whether samples of the sky count as covered
  * @param firstHit      what the ray meets first, if a layer asks for it
  * @param media         that cover what is behind them, if there are any and a layer asks
  */
final class VisibleSurface(
    val scene: Scene,
    output: Motion,
    basis: ColorBasis,
    names: SurfaceNames = SurfaceNames.Empty,
    motionOnFilm: Option[ScreenMotion] = None,
    hidesEmitters: Boolean = false,
    skyCovers: Boolean = false,
    firstHit: Option[FirstHit] = None,
    media: Option[MediaTransmittance] = None
):
  private val ray = Ray()
  private val map = new Array[Double](Motion.Work)
  private val wo = MutableVec3()
  private var bsdf: Bsdf | Null = null
  private var isHit = false
  private var distance = 0f
  private var sample = 0
  private val ownFirst: FirstHit | Null = firstHit.map(_.copy()).orNull
  private val ownMedia: MediaTransmittance | Null = media.map(_.copy()).orNull
  private val moved: ScreenMotion | Null = motionOnFilm.map(_.copy()).orNull

  // What is seen through specular surfaces; traced once per camera ray, when asked for
  private lazy val reflection = SpecularView(scene)
  private var isReflectionKnown = false

  /** The light of the camera ray, if the integrator divides it. */
  var lightParts: LightParts | Null = null

  /** What the sample counts, before its filter weight. */
  var weight: Float = 1f

  /** The intersection, in world space. */
  val hit: Hit = Hit()
  val point: ShadingPoint = scene.newPoint(always = true)

  def copy(): VisibleSurface =
    VisibleSurface(
      scene, output, basis, names, motionOnFilm, hidesEmitters, skyCovers, firstHit, media
    )

  /** Traces a camera ray through interfaces; leaves the ray unchanged.
    *
    * @param sample number of the pixel's sample
    */
  def trace(from: Ray, sample: Int = 0): Unit =
    this.sample = sample
    if ownFirst != null then ownFirst.trace(from)
    ray.set(from.origin, from.direction, from.tMax)
    ray.time = from.time
    ray.differential.copy(from.differential)
    val media = ownMedia
    if media != null then media.start(ray, sample)
    var goesOn = true
    while goesOn do
      isHit = scene.closest(ray, hit)
      if isHit then scene.surface(ray, hit, point)
      goesOn = isHit &&
        (scene.isPassed(ray, hit, point) || hidesEmitters && point.areaLight >= 0)
      if media != null then
        media.pass(ray)
        if goesOn then media.cross(point, ray.direction)
      if goesOn then scene.passThrough(ray, point)
    if isHit then record(from, scene.bsdf(point))

  /** Records the hit in `at`. */
  private[aov] def record(from: Ray, scattering: Bsdf): Unit =
    isHit = true
    isReflectionKnown = false
    bsdf = scattering
    wo.set(-from.dx, -from.dy, -from.dz)
    distance = (point.p - from.origin).length
    output.write(from.time, map, 0)

  /** False if the ray missed; all other properties are then stale. */
  def isThere: Boolean = isHit

  /** From 0 to 1 in the mean, also of a ray that missed. */
  def coverage: Float =
    val media = ownMedia
    if isHit || skyCovers then 1f else if media == null then 0f else 1f - media.mean

  /** What the ray meets first; exists if a layer asks for it. */
  def first: FirstHit = ownFirst.nn

  def p: Vec3 = vector(point.p) + Vec3(map(3).toFloat, map(7).toFloat, map(11).toFloat)

  /** Unit normals facing the ray origin. */
  def n: Vec3 = normal(point.geometricNormal.facing(wo))
  def shadingNormal: Vec3 = normal(point.frame.n.facing(wo))

  /** Change of z to the next sample to the right, and below. */
  def dzdx: Float = if point.wantsPartials then vector(point.dpdx).z else 0f
  def dzdy: Float = if point.wantsPartials then vector(point.dpdy).z else 0f

  /** Distance from the ray origin, in scene units. */
  def depth: Float = distance

  /** Hemispherical-directional reflectance towards the camera, in linear sRGB. */
  def albedo: Rgb =
    val scattering = bsdf
    if scattering == null then Rgb.Black
    else basis.toSrgb(DirectionalAlbedo(scattering, point.frame.toLocal(wo)))

  /** A part of the light. Undivided light is what the first surface emits. */
  def light(part: Int): Rgb =
    val divided = lightParts
    if divided != null then divided(part)
    else if isThere && part == LightParts.Emission then emitted
    else Rgb.Black

  /** Radiance emitted towards the camera, in linear sRGB. */
  private def emitted: Rgb =
    if point.areaLight < 0 then Rgb.Black
    else basis.toSrgb(scene.surfaceLight(point).radiance(point, wo))

  /** Motion on the film while the shutter is open, in pixels. */
  def motion: Vec3 =
    val projection = moved
    if projection == null || hit.primitive < 0 then Vec3.Zero
    else
      val spare = reflection.point
      scene.surfaceAt(ray, hit, projection.shutter.open, spare)
      val opening = spare.p.toVec3
      scene.surfaceAt(ray, hit, projection.shutter.close, spare)
      projection.of(opening, spare.p.toVec3)

  /** Identifiers of [[Cryptomatte]]; 0: unknown. */
  def objectId: Float =
    if hit.primitive < 0 then 0f else names.objectId(scene.objectIndex(hit))
  def materialId: Float = names.materialId(point.material)

  /** The albedo of the first surface that is not specular, times the weight of the path there; the
    * environment counts as white.
    */
  def albedoBehind: Rgb =
    if !isSpecular then albedo
    else
      reflect()
      basis.toSrgb(reflection.albedo)

  /** The normal there; where the path escapes, that of the first surface. */
  def normalBehind: Vec3 =
    if !isSpecular then shadingNormal
    else
      reflect()
      if reflection.isHit then normal(reflection.n) else shadingNormal

  private def isSpecular: Boolean =
    val scattering = bsdf
    scattering != null && scattering.isSpecular

  private def reflect(): Unit =
    if !isReflectionKnown then
      isReflectionKnown = true
      val scattering = bsdf
      if scattering != null then reflection.follow(ray, point, wo, scattering, sample)

  private def vector(v: Vec3): Vec3 = Vec3(
    (map(0) * v.x + map(1) * v.y + map(2) * v.z).toFloat,
    (map(4) * v.x + map(5) * v.y + map(6) * v.z).toFloat,
    (map(8) * v.x + map(9) * v.y + map(10) * v.z).toFloat
  )

  /** Transforms by the transposed inverse. */
  private def normal(n: Vec3): Vec3 = Vec3(
    (map(12) * n.x + map(16) * n.y + map(20) * n.z).toFloat,
    (map(13) * n.x + map(17) * n.y + map(21) * n.z).toFloat,
    (map(14) * n.x + map(18) * n.y + map(22) * n.z).toFloat
  ).normalized
