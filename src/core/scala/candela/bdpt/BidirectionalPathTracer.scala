package candela.bdpt

import candela.aov.LightParts
import candela.cameras.Camera
import candela.color.Rgb
import candela.film.Splats
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.integrators.{Integrator, LightConnection, LightTransport}
import candela.math.*
import candela.media.SceneMedia
import candela.sampling.{RandomStream, Sampler}
import candela.scene.Scene

/** Bidirectional path tracing: each sample traces a camera and a light subpath, and connects every
  * pair of camera and light vertices, light vertices to the camera (light tracing), and camera
  * vertices to sampled lights. All strategies for the same path are combined by MIS.
  *
  * Unlike path tracing, it finds caustics from point lights.
  *
  * @param imageCamera   the image's camera; if it can't project points to the film, light tracing
  *                      is disabled and that light is missing
  * @param splats        receives the splats of light tracing
  * @param maxDepth      maximum number of scattering events of a full path
  * @param rouletteDepth as in [[Subpath]], for either subpath
  * @param compresses    as in [[Subpath]]
  * @param regularizes   as in [[candela.integrators.PathTracer]], for each subpath separately
  * @param sceneMedia    participating media, if there are any
  * @param strategies    to be told apart, if they are
  *
  * Sources: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, §10; PBRT 3rd
  * ed., §16.3; weights as in [[PartialWeights]].
  */
final class BidirectionalPathTracer(
    scene: Scene,
    imageCamera: Camera,
    splats: Splats,
    maxDepth: Int,
    rouletteDepth: Int,
    compresses: Boolean,
    regularizes: Boolean = false,
    sceneMedia: SceneMedia | Null = null,
    strategies: Strategies | Null = null
) extends Integrator
    with ChainPaths:
  import BidirectionalPaths.*
  import PartialWeights.mis

  private val ownMedia, lightMedia: PathMedia | Null =
    if sceneMedia == null then null else PathMedia(scene, sceneMedia)
  private val lightPaths = LightPaths(
    scene, maxDepth, rouletteDepth, compresses, weighsAll = true, regularizes, media = lightMedia
  )
  private val path = Subpath(carriesLight = false, compresses, rouletteDepth)
  private val vertex = PathVertex(scene)
  private val point = vertex.point
  private val connection = LightConnection(scene)
  private val hit = Hit()
  private val shadowRay = Ray()
  private val shadowHit = Hit()
  private var rays = 0L

  // Contributions to a sample below this share of what it has found so far are minor
  private var minor = 0f
  private var estimate = Rgb.Black
  private val dice = RandomStream()

  // Vertex at which the current direction of the camera subpath was sampled
  private val lastP, lastN = MutableVec3()

  // As in 1 / (1 + ratios), the weight of the last emission that was hit
  private var hitRatios = 0.0

  private val recorder: StrategyRecorder | Null =
    if strategies == null then null else StrategyRecorder(strategies, splats)
  private val camera = CameraConnection(scene, imageCamera, splats, lightMedia, recorder)

  override def lightParts: LightParts | Null = if recorder == null then null else recorder.parts

  def raysTraced: Long =
    rays + connection.raysTraced + lightPaths.raysTraced + camera.raysTraced +
      ofMedia(ownMedia) + ofMedia(lightMedia)

  private def ofMedia(media: PathMedia | Null): Long =
    if media == null then 0L else media.raysTraced

  override def lastMaterial: Int = point.material

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    // What is minor by its weight may be much without it
    val keepsMinor = strategies != null && !strategies.isWeighted
    radiance(ray, sampler, sampler, sampler, if keepsMinor then 0f else MinorShare)

  /** As [[radiance]], with separate samplers.
    *
    * @param light  samples the light subpath and its connections to the camera
    * @param joins  samples the connections of camera vertices to lights
    * @param onward samples the continuation of the camera subpath
    */
  def radiance(
      ray: Ray,
      light: Sampler,
      joins: Sampler,
      onward: Sampler
  ): Rgb =
    // Chance in the connections would make the function that chains explore rugged
    radiance(ray, light, joins, onward, minorShare = 0f)

  private def radiance(
      ray: Ray,
      light: Sampler,
      joins: Sampler,
      onward: Sampler,
      minorShare: Float
  ): Rgb =
    minor = minorShare
    if recorder != null then recorder.parts.clear()
    shadowRay.time = ray.time
    camera.startSample(ray.time)
    connection.startPath(ray.time)
    val hero =
      if sceneMedia != null && sceneMedia.isChromatic then (light.next1D() * 3f).toInt else 0
    // What leads away from the camera matters most: it has the same dimensions in all samples
    light.skipTo(LightRequests)
    lightPaths.trace(ray.time, light, hero)
    camera.connect(lightPaths, isWeighted = true, light)
    onward.skipTo(CameraRequests)
    val media = ownMedia
    if media == null || sceneMedia == null then fromCamera(ray, joins, onward)
    else
      media.startPath(hero, sceneMedia.camera, ray.time, onward)
      fromCamera(ray, joins, onward) + media.glow

  private def fromCamera(ray: Ray, joins: Sampler, onward: Sampler): Rgb =
    val eye = ray.origin
    estimate = Rgb.Black
    path.throughput = Rgb.White
    path.isSpecularSoFar = true
    path.isAlone = false
    path.weights.dVCM = 0.0
    path.weights.dVC = 0.0
    var edges = 0
    var alive = true
    while alive do
      rays += 1
      edges += 1
      val isHit = scene.closest(ray, hit)
      val collision = collide(ray, edges, onward)
      if isAbsorbed then alive = false
      else if collision < 0f && !isHit then
        estimate += carried * environment(ray, edges)
        alive = false
      else if !placeVertex(ray, collision) then edges -= 1
      else
        val wo = vertex.wo
        val cosine = vertex.cosine(wo)
        val distance =
          if sceneMedia == null then ray.tMax.toDouble else (point.p - lastP).length.toDouble
        if edges > 1 then path.weights.arrive(distance, cosine)
        else
          val density = camera.density(eye, point.p)
          path.weights.dVCM = if density > 0f then mis(1.0 / (density.toDouble * cosine)) else 0.0
        if point.areaLight >= 0 && cosine > 0f then
          estimate += carried * emitted(edges, wo, distance)
        alive = edges <= maxDepth && cosine > 0f
        if alive then
          vertex.edges = edges
          if !vertex.isInMedium then
            vertex.evaluate(regularizes && !path.isSpecularSoFar)
            if scene.isDispersive then path.disperse(vertex)
          if !vertex.bsdf.isSpecular then
            estimate += carried * direct(joins)
            estimate += carried * connected(joins)
          alive = edges <= maxDepth && path.scatter(vertex, ray, onward)
          lastP.set(point.p)
          lastN.set(vertex.lightNormal)
          val media = ownMedia
          if media != null then media.medium = media.towards(vertex, ray.direction)
    estimate

  /** Throughput of the camera subpath. */
  private def carried: Rgb =
    val media = ownMedia
    if media == null then path.throughput else path.throughput * media.throughput

  private def isAbsorbed: Boolean =
    val media = ownMedia
    media != null && media.isAbsorbed

  /** The ray's parameter of a collision with a medium; −1: none. */
  private def collide(ray: Ray, edges: Int, sampler: Sampler): Float =
    val media = ownMedia
    if media == null then -1f
    else
      val glow = media.glow
      val t = media.follow(ray, path.throughput, emits = edges <= maxDepth, sampler)
      path.throughput = Rgb.White
      if recorder != null then recorder.add(0, edges + 1, media.glow - glow, 0.0)
      t

  /** Puts the vertex at the collision or on the surface that was hit; false if that is an
    * interface, which the ray passes.
    */
  private def placeVertex(ray: Ray, collision: Float): Boolean =
    val media = ownMedia
    if media != null && collision >= 0f then media.scatter(vertex, ray, collision)
    else vertex.hit(ray, hit)
    if media == null then true
    else if !vertex.isInMedium && scene.isPassed(ray, hit, vertex.point) then
      media.passThrough(vertex, ray)
      false
    else
      media.mark(vertex)
      true

  /** MIS weight of emission hit by the camera subpath, given the pdfs of light sampling and of
    * light emission for the same path.
    */
  private def hitWeight(sampled: Double, emitted: Double): Float =
    val w = path.weights
    val bySampling = mis(sampled) * w.dVCM
    val byEmission = mis(emitted) * w.dVC
    hitRatios = bySampling + byEmission
    (1 / (1 + bySampling + byEmission)).toFloat

  /** Light of infinite lights along a ray that left the scene. */
  private def environment(ray: Ray, edges: Int): Rgb =
    hitRatios = 0.0
    LightTransport.environment(
      scene,
      ray,
      (i, source) =>
        if edges == 1 then 1f
        else
          val w = ray.direction
          val p = lastP
          val sampled = scene.selection.probability(p, lastN, i) * source.pdf(p, w)
          val emitted = source.emissionPdf(scene.ball, p, Vec3.Zero, -w)
          hitWeight(sampled.toDouble, lightPaths.chance(i).toDouble * emitted)
      ,
      (_, light) => record(0, edges + 1, light, hitRatios)
    )

  /** Emission of the surface hit. */
  private def emitted(edges: Int, wo: Vec3, distance: Double): Rgb =
    val source = scene.surfaceLight(point)
    val radiance = source.radiance(point, wo)
    hitRatios = 0.0
    val light =
      if radiance.isBlack || edges == 1 then radiance
      else if source.isShownOnly then if path.isSpecularSoFar then radiance else Rgb.Black
      else
        val index = point.areaLight
        val perArea = vertex.cosine(wo) / (distance * distance)
        val p = lastP
        val chosen = scene.selection.probability(p, lastN, index)
        val sampled = chosen.toDouble * source.pdf(p, point) * perArea
        val emitted = source.emissionPdf(scene.ball, point.p, point.geometricNormal, wo)
        radiance * hitWeight(sampled, lightPaths.chance(index).toDouble * emitted)
    record(0, edges + 1, light, hitRatios)
    if recorder != null && edges == 1 then recorder.parts.addEmission(light)
    light

  /** Tells what a strategy has brought, before the throughput of the camera subpath.
    *
    * @param s     vertices of the light subpath
    * @param t     vertices of the camera subpath
    * @param light weighted by 1 / (1 + misRatios)
    */
  private inline def record(s: Int, t: Int, light: Rgb, misRatios: Double): Unit =
    if recorder != null then recorder.add(s, t, carried * light, misRatios)

  /** Connects the camera vertex to a sampled light. */
  private def direct(sampler: Sampler): Rgb =
    val choice = sampler.next1D(matters = connection.isRandom)
    sampler.next2D()
    val p = point.p
    if !connection.choose(
        p,
        vertex.lightNormal,
        choice
      ) || !connection.samplePoint(p, sampler.x, sampler.y)
    then
      Rgb.Black
    else
      val sample = connection.sample
      val wi = connection.wi
      val f = vertex.received(wi)
      val media = ownMedia
      val passed =
        if f.isBlack then Rgb.Black
        else if media != null then media.fromLight(vertex, sample)
        else if connection.isBlocked(point) then Rgb.Black
        else Rgb.White
      if passed.isBlack then Rgb.Black
      else
        val emission = lightPaths.chance(connection.index) * connection.emissionPdf
        val byLight =
          emission.toDouble * vertex.cosine(wi) /
            (connection.probability.toDouble * connection.spread(p))
        val byBsdf =
          if connection.isDelta then 0.0 else mis(vertex.pdf(wi).toDouble / connection.pdf)
        val misRatios = byBsdf + path.weights.sum(byLight, vertex.reversePdf(wi).toDouble)
        val weight = vertex.shadingCosine(wi) / (connection.pdf * (1 + misRatios))
        val light = f * sample.radiance.toRgb * weight.toFloat * passed
        record(1, vertex.edges + 1, light, misRatios)
        light

  /** Factor of a contribution, before its shadow ray is traced: Russian roulette ends most of the
    * minor ones. What has been found so far depends on none of this, so the mean stays.
    *
    * Source: Veach 1997, §10.3.3, roulette for shadow rays, with a threshold for each sample.
    */
  private def connectionRoulette(contribution: Float, threshold: Float): Float =
    if !(contribution < threshold) then 1f
    else if dice.next() * threshold < contribution then threshold / contribution
    else 0f

  /** Connects the camera vertex to all light vertices. */
  private def connected(joins: Sampler): Rgb =
    if minor > 0f then dice.seed(joins.next1D(), vertex.edges.toFloat)
    val carries = carried.largest
    connected(if carries > 0f then minor * estimate.largest / carries else 0f)

  private def connected(threshold: Float): Rgb =
    var sum = Rgb.Black
    var i = 0
    while i < lightPaths.count do
      val lit = lightPaths(i)
      if lit.edges + vertex.edges <= maxDepth then sum += connected(lit, threshold)
      i += 1
    sum

  private def connected(lit: PathVertex, threshold: Float): Rgb =
    val d = lit.point.p - point.p
    val distance2 = d.lengthSquared
    val wi = d * (1f / sqrt(distance2))
    val reversed = -wi
    if !(distance2 > 0f) then Rgb.Black
    else
      val onward = vertex.pdf(wi)
      // A camera path could not continue this way
      val f = if onward > 0f then vertex.received(wi) else Rgb.Black
      val g = if !f.isBlack && lit.isReachable(reversed) then lit.sent(reversed) else Rgb.Black
      if g.isBlack then Rgb.Black
      else
        val vertexCosine = vertex.cosine(wi)
        val litCosine = lit.cosine(reversed)
        val toLit = onward.toDouble * litCosine / distance2
        val toHere = lit.pdf(reversed).toDouble * vertexCosine / distance2
        val misRatios = path.weights.sum(toHere, vertex.reversePdf(wi).toDouble) +
          lit.weights.sum(toLit, lit.reversePdf(reversed).toDouble)
        val cosines = vertex.shadingCosine(wi) * lit.sentCosine(reversed)
        // If both subpaths carry their hero alone, each stands for all three wavelengths
        val shares = if lit.isAlone && path.isAlone then 1f / 3f else 1f
        val weight = (cosines / (distance2 * (1 + misRatios))).toFloat * shares
        val contribution = f * g * lit.throughput * weight
        val light = contribution * connectionRoulette(contribution.largest, threshold)
        val media = ownMedia
        val arriving =
          if light.isBlack then light
          else if media != null then light * media.betweenVertices(vertex, lit, wi)
          else if isHidden(lit.point, wi, litCosine) then Rgb.Black
          else light
        record(lit.edges + 1, vertex.edges + 1, arriving, misRatios)
        arriving

  /** Whether `other`, in the direction `wi`, is occluded from the camera vertex. */
  private def isHidden(other: ShadingPoint, wi: Vec3, cosine: Float): Boolean =
    val origin = point.offsetOrigin(wi)
    val end = other.offsetOrigin(-wi)
    shadowRay.set(origin, end - origin, LightConnection.shadowEnd(cosine))
    rays += 1
    scene.isOccluded(shadowRay, shadowHit)

private[candela] object BidirectionalPaths:
  /** Share of what a sample has found so far; smaller contributions are subject to roulette. */
  val MinorShare = 0.1f

  // Where the sampler's requests for each subpath begin: behind those for the camera ray, and
  // behind all that a camera subpath can need
  val CameraRequests = 8
  val LightRequests = 1 << 20
