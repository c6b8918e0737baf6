package candela.bdpt

import candela.color.Rgb
import candela.geometry.{Hit, Ray}
import candela.integrators.EmitterChoice
import candela.lights.{EmittedRay, LightGroups}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.{Casters, Scene}

/** Traces light subpaths, and records the vertices that can be connected to a camera subpath.
  * Mutable, one per worker.
  *
  * @param maxEdges    maximum number of edges of a light subpath
  * @param weighsAll   whether MIS includes camera subpaths that hit lights; if so, no path starts
  *                    at a light whose emission those see on another side
  * @param regularizes as in [[candela.integrators.PathTracer]]
  * @param media       what the paths go through, if anything
  * @param startsAlone whether the hero wavelength alone is of interest from the start
  * @param countsPassed whether passing an interface counts as an edge
  * @param casters     tell [[PathVertex.isCaustic]], if it is of interest
  */
private[candela] final class LightPaths(
    scene: Scene,
    maxEdges: Int,
    rouletteDepth: Int,
    compresses: Boolean,
    weighsAll: Boolean,
    regularizes: Boolean = false,
    startsAlone: Boolean = false,
    media: PathMedia | Null = null,
    countsPassed: Boolean = false,
    casters: Casters | Null = null
) extends LightVertices(scene):
  private val choice = EmitterChoice(scene, l => !(weighsAll && l.isContrary))
  private val start = EmittedRay()
  private val ray = Ray()
  private val hit = Hit()
  private val path = Subpath(carriesLight = true, compresses, rouletteDepth)
  private val lastP = MutableVec3()

  var raysTraced: Long = 0L

  /** Probability of starting a path at the light. */
  def chance(light: Int): Float = choice.chance(light)

  /** Traces a new path, replacing the last.
    *
    * @param hero colour that drives sampling in media
    */
  def trace(time: Float, sampler: Sampler, hero: Int = 0): Unit =
    clear()
    if maxEdges > 0 && !choice.isEmpty then
      val light = choice.sample(sampler)
      emitter = light
      sampler.next2D()
      val u1 = sampler.x
      val u2 = sampler.y
      sampler.next2D()
      scene.lights(light).emit(scene.ball, u1, u2, sampler.x, sampler.y, start)
      path.throughput = start.power * (1f / choice.chance(light))
      if !path.throughput.isBlack && path.throughput.isFinite then
        ray.time = time
        ray.differential.isKnown = false
        ray.set(start.origin, start.direction, Float.PositiveInfinity)
        val pathMedia = media
        if pathMedia != null then
          pathMedia.startPath(hero, pathMedia.mediumAt(light, ray), time, sampler)
        walk(light, sampler)

  private def walk(light: Int, sampler: Sampler): Unit =
    path.isSpecularSoFar = true
    path.isAlone = startsAlone
    val pathMedia = media
    var edges = 0
    var alive = true
    var isByCasters = casters != null && scene.lights(light).isCausticSource
    lastP.set(ray.origin)
    while alive do
      raysTraced += 1
      val isHit = scene.closest(ray, hit)
      var collision = -1f
      if pathMedia != null then
        collision = pathMedia.follow(ray, path.throughput, emits = false, sampler)
        path.throughput = Rgb.White
      alive = collision >= 0f || (isHit && (pathMedia == null || !pathMedia.isAbsorbed))
      if alive then
        edges += 1
        val vertex = next()
        if pathMedia != null && collision >= 0f then pathMedia.scatter(vertex, ray, collision)
        else vertex.hit(ray, hit)
        if !vertex.isInMedium && scene.isPassed(ray, hit, vertex.point) then
          if !countsPassed then edges -= 1
          else alive = edges < maxEdges
          if pathMedia == null then vertex.passThrough(ray) else pathMedia.passThrough(vertex, ray)
        else
          if !vertex.isInMedium then vertex.evaluate(regularizes && !path.isSpecularSoFar)
          if scene.isDispersive then path.disperse(vertex)
          vertex.edges = edges
          val cosine = vertex.cosine(vertex.wo)
          val distance =
            if pathMedia == null then ray.tMax.toDouble
            else (vertex.point.p - lastP).length.toDouble
          if edges == 1 then initWeights(light, vertex, cosine)
          else path.weights.arrive(distance, cosine)
          alive = cosine > 0f
          if pathMedia != null then pathMedia.mark(vertex)
          vertex.isCaustic = isByCasters && edges > 1
          isByCasters &&= casts(vertex, isFirst = edges == 1)
          if alive then
            if !vertex.bsdf.isSpecular then record(vertex, path, pathMedia)
            alive = edges < maxEdges && path.scatter(vertex, ray, sampler)
            lastP.set(vertex.point.p)
            if pathMedia != null then pathMedia.medium = pathMedia.towards(vertex, ray.direction)

  /** May the vertex, which the ray has met, be one of a path of [[CausticPaths]]? */
  private def casts(vertex: PathVertex, isFirst: Boolean): Boolean =
    val causticCasters = casters
    causticCasters != null && !vertex.isInMedium && scene.isCaster(vertex.point) &&
    (!isFirst || causticCasters.density(ray, hit, vertex.point) > 0f)

  /** Initial MIS weights at the first surface: next-event estimation samples this light from there,
    * too, with a position-dependent pdf.
    */
  private def initWeights(light: Int, vertex: PathVertex, cosine: Float): Unit =
    val source = scene.lights(light)
    val point = vertex.point
    val sampled = scene.selection.probability(point.p, vertex.lightNormal, light).toDouble *
      source.connectionPdf(point.p, start)
    val emitted = chance(light).toDouble * start.pdf * cosine
    path.weights.dVCM = PartialWeights.mis(sampled / emitted)
    path.weights.dVC =
      if source.isDelta then 0.0
      else PartialWeights.mis((if start.isInfinite then 1f else start.cosine) / emitted)

/** The vertices of a light path that can be connected to a camera subpath. */
private[candela] abstract class LightVertices(scene: Scene):
  private val groups: LightGroups | Null = scene.lightGroups.orNull

  /** Index of the light where the path begins. */
  protected final var emitter = -1
  private var vertices = Array.fill(LightVertices.InitialSize)(PathVertex(scene))
  private var recorded = 0

  def raysTraced: Long

  /** Number of recorded vertices. */
  final def count: Int = recorded

  /** The group of its light; 0: it is not told. */
  final def group: Int =
    val lightGroups = groups
    if lightGroups == null || emitter < 0 then 0 else lightGroups(emitter)

  /** Vertex `i`. Its throughput is power, not yet divided by solid angle. */
  final def apply(i: Int): PathVertex = vertices(i)

  protected final def clear(): Unit = recorded = 0

  /** The vertex to be recorded next, by [[record]]. */
  protected final def next(): PathVertex =
    if recorded == vertices.length then
      vertices = vertices ++ Array.fill(vertices.length)(PathVertex(scene))
    vertices(recorded)

  /** Records it, at the end of the path so far. */
  protected final def record(vertex: PathVertex, path: Subpath, pathMedia: PathMedia | Null): Unit =
    vertex.throughput =
      if pathMedia == null then path.throughput else path.throughput * pathMedia.throughput
    vertex.isSpecularSoFar = path.isSpecularSoFar
    vertex.isAlone = path.isAlone
    vertex.weights.set(path.weights)
    recorded += 1

private[candela] object LightVertices:
  /** Initial vertex capacity; grows on demand. */
  private val InitialSize = 8
