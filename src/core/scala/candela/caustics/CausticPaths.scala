package candela.caustics

import candela.bdpt.{LightVertices, PartialWeights, PathMedia, PathVertex, Subpath}
import candela.color.Rgb
import candela.geometry.{Hit, Ray}
import candela.integrators.{LightConnection, LightTransport, PhotonLight}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.{CasterPoint, Casters, Scene}

/** Traces light paths that begin at surfaces which cast caustics. Records the vertices behind the
  * first that can be connected to the camera: what lies in a caustic, and what that lights.
  * Mutable, one per worker.
  *
  * A path begins at a point of a caster, which [[candela.scene.Casters]] sample. Light sampling
  * there finds the emitter, so that paths are aimed at casters whatever sends the light: small
  * emitters, suns and skies.
  *
  * @param maxEdges   maximum number of scattering events
  * @param compresses as in [[Subpath]]
  * @param findsAll   also trace light that paths from the camera cannot find
  * @param beneath    do paths travel beneath surfaces? Those that do are the camera's alone
  * @param media      what the paths go through, if anything. Light that it scatters before the
  *                   first caster is left to the camera's paths
  * @param onlyToFirst record vertices that receive photons, up to the first that is no caster
  */
private[candela] final class CausticPaths(
    scene: Scene,
    casters: Casters,
    maxEdges: Int,
    compresses: Boolean,
    findsAll: Boolean,
    beneath: Boolean = false,
    media: PathMedia | Null = null,
    onlyToFirst: Boolean = false
) extends LightVertices(scene):
  private val connection = LightConnection(scene)
  private val path =
    Subpath(carriesLight = true, compresses, LightTransport.SubpathRouletteDepth, evaluates = true)
  private val point = CasterPoint()
  private val ray = Ray()
  private val hit = Hit()
  private var rays = 0L

  def raysTraced: Long = rays

  /** Where the path begins, among all places of casters, from 0 to 1. */
  def casterPosition: Double = point.areaFraction

  /** Traces a new path, replacing the last. */
  def trace(time: Float, sampler: Sampler): Unit =
    clear()
    ray.time = time
    path.throughput = Rgb.White
    sampler.next2D()
    val choice = Casters.choice(sampler.x, sampler.y)
    sampler.next2D()
    val isSampled = casters.sample(choice, sampler.x, sampler.y, ray, point)
    val choiceOfEmitter = sampler.next1D(matters = connection.isRandom)
    sampler.next2D()
    if isSampled && connection.choose(point.p, Vec3.Zero, choiceOfEmitter) then
      emitter = connection.index
      val light = scene.lights(emitter)
      if light.isCausticSource && connection.samplePoint(point.p, sampler.x, sampler.y) then
        val vertex = next()
        if arrive(vertex, sampler) then follow(vertex, light.isDelta, sampler)

  /** Traces the ray from the emitter to the sampled point; false if something is in the way. */
  private def arrive(vertex: PathVertex, sampler: Sampler): Boolean =
    val sample = connection.sample
    val origin =
      if sample.isInfinite then point.p + connection.wi * (CausticPaths.Beyond * scene.ball.radius)
      else LightConnection.end(sample)
    ray.differential.isKnown = false
    ray.set(origin, (point.p - origin).normalized, Float.PositiveInfinity)
    val pathMedia = media
    if pathMedia != null then
      val hero = (sampler.next1D() * 3f).toInt
      pathMedia.startPath(hero, pathMedia.mediumAt(connection.index, ray), ray.time, sampler)
    travel(vertex, sampler) && !vertex.isInMedium && casters.isMet(point, hit, vertex.point)

  /** Traces the ray to where it is scattered next; false if it is nowhere. */
  private def travel(vertex: PathVertex, sampler: Sampler): Boolean =
    val pathMedia = media
    var isOpen = true
    var isHit = false
    while isOpen do
      rays += 1
      isHit = scene.closest(ray, hit)
      var collision = -1f
      if pathMedia != null then
        collision = pathMedia.follow(ray, path.throughput, emits = false, sampler)
        path.throughput = Rgb.White
        isHit &&= !pathMedia.isAbsorbed
      if pathMedia != null && collision >= 0f then
        pathMedia.scatter(vertex, ray, collision)
        isHit = !pathMedia.isAbsorbed
        isOpen = false
      else
        if isHit then vertex.hit(ray, hit)
        isOpen = isHit && scene.isPassed(ray, hit, vertex.point)
        if isOpen then
          if pathMedia == null then vertex.passThrough(ray) else pathMedia.passThrough(vertex, ray)
    isHit

  private def follow(first: PathVertex, isDelta: Boolean, sampler: Sampler): Unit =
    path.isSpecularSoFar = true
    path.isAlone = false
    path.throughput = Rgb.White
    val pathMedia = media
    var last = first
    if pathMedia != null then pathMedia.mark(first)
    val cosine = first.cosine(first.wo)
    val perArea = casters.density(ray, hit, first.point)
    evaluate(first, edges = 1)
    val pdf = perArea.toDouble * connection.pdf
    var alive = cosine > 0f && pdf > 0.0
    if alive then
      path.throughput = path.throughput * connection.sample.radiance.toRgb * (cosine / pdf).toFloat
      // Light sampling from here chooses the emitter by another normal
      val chosen =
        scene.selection.probability(first.point.p, first.lightNormal, connection.index)
      path.weights.dVCM = PartialWeights.mis(chosen.toDouble / connection.probability / perArea)
      path.weights.dVC = if isDelta then 0.0 else PartialWeights.mis(1.0 / pdf)
      alive = scatter(first, sampler) && (findsAll || !(isDelta && first.bounce.isSpecular))
    var edges = 1
    while alive do
      edges += 1
      if pathMedia != null then pathMedia.medium = pathMedia.towards(last, ray.direction)
      val vertex = next()
      alive = travel(vertex, sampler)
      if alive then
        evaluate(vertex, edges)
        val slant = vertex.cosine(vertex.wo)
        path.weights.arrive(1.0, slant)
        alive = slant > 0f
        if alive then
          if pathMedia != null then pathMedia.mark(vertex)
          if isRecorded(vertex) then
            record(vertex, path, pathMedia)
          alive = edges < maxEdges && goesOn(vertex) && scatter(vertex, sampler)
          last = vertex

  private def isRecorded(vertex: PathVertex): Boolean =
    if onlyToFirst then PhotonLight.receives(scene, vertex) else !vertex.bsdf.isSpecular

  private def goesOn(vertex: PathVertex): Boolean =
    !onlyToFirst || !vertex.isInMedium && scene.isCaster(vertex.point)

  private def evaluate(vertex: PathVertex, edges: Int): Unit =
    if !vertex.isInMedium then vertex.evaluate()
    if scene.isDispersive then path.disperse(vertex)
    vertex.edges = edges

  /** Only the camera's path and light sampling at the first caster compete: none of the other
    * strategies of [[BidirectionalPathTracer]].
    */
  private def scatter(vertex: PathVertex, sampler: Sampler): Boolean =
    val goesOn = path.scatter(vertex, ray, sampler)
    path.weights.dVCM = 0.0
    goesOn && !(beneath && isEntered(vertex))

  private def isEntered(vertex: PathVertex): Boolean =
    !vertex.isInMedium && scene.isSubsurface(vertex.point.material) &&
      vertex.crosses(vertex.bounce.wi)

private object CausticPaths:
  /** Where rays from infinite emitters start, in radii of the scene. */
  private inline val Beyond = 2.1f
