package candela.integrators

import candela.cameras.Camera
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.scene.{Casters, Scene}

/** Weights of what camera paths find against what light paths find that begin at casters, and reach
  * the camera by a vertex that is not specular. Immutable.
  *
  * Along a path, [[PathHistory.densityRatio]] is the ratio of both densities, as far as it is
  * known: at each vertex, the density with which the light path would have come here by that with
  * which the camera's has. All densities are those of BSDFs and phase functions alone, guided or
  * not, and those of distances in media are left out: they only weigh, and are the same on both
  * sides.
  *
  * What the camera's path finds by either of its techniques is multiplied by one minus the light
  * path's weight, (p₀² + p₁²) / (p₀² + p₁² + p²): p₀ is the density of the path itself, p₁ that of
  * a light sample at its last vertex, and p that of the light path.
  *
  * @param camera    that light paths are connected to
  * @param perSample light paths per camera sample
  *
  * Source: Veach 1997, §10.2; the recursion as in Georgiev 2012, for one other technique.
  */
final class CausticWeights(scene: Scene, casters: Casters, camera: Camera, perSample: Float):

  /** The path has met a surface, and its BSDF is known. */
  def arrive(eye: Vec3, vertex: SurfaceVertex, path: PathHistory): Unit =
    val cosine = vertex.cosine(vertex.wo)
    if path.depth == 1 then path.densityRatio = begun(eye, vertex.point.p, cosine)
    else if path.densityRatio > 0.0 then
      path.densityRatio = if cosine > 0f then path.densityRatio / cosine else 0.0

  /** The path leaves for `wi`, by `vertex.bounce`.
    *
    * @param ray how it came to the vertex
    */
  def leaveVertex(vertex: SurfaceVertex, ray: Ray, hit: Hit, wi: Vec3, path: PathHistory): Unit =
    path.casterRatio = 0.0
    if path.densityRatio > 0.0 then
      val bounce = vertex.bounce
      val pdf = if bounce.isSpecular then 0f else vertex.localPdf(bounce.wi)
      path.bsdfPdf = pdf
      if path.depth == 1 then
        path.densityRatio = if pdf > 0f then path.densityRatio * (vertex.cosine(wi) / pdf) else 0.0
      else
        val reverse =
          if bounce.isSpecular then 1.0
          else vertex.bsdf.pdf(bounce.wi, vertex.localWo).toDouble / pdf
        val begins = startDensity(vertex, ray, hit)
        path.casterRatio = path.densityRatio * reverse * begins
        path.densityRatio *= reverse * vertex.cosine(wi)
      if !(path.densityRatio < Double.PositiveInfinity) then path.densityRatio = 0.0
      if !(path.casterRatio < Double.PositiveInfinity) then path.casterRatio = 0.0

  /** Density with which light paths begin where the ray has met the vertex, per area. */
  private def startDensity(vertex: SurfaceVertex, ray: Ray, hit: Hit): Float =
    if scene.isCaster(vertex.point) then casters.density(ray, hit, vertex.point) else 0f

  /** The path is about to be scattered at `p` in a medium. */
  def arriveInMedium(eye: Vec3, p: Vec3, path: PathHistory): Unit =
    if path.depth == 1 then path.densityRatio = begun(eye, p, 1f)

  /** The path is scattered in a medium.
    *
    * @param pdf of the phase function
    */
  def scatterInMedium(pdf: Float, path: PathHistory): Unit =
    path.casterRatio = 0.0
    path.bsdfPdf = pdf
    // Phase functions are symmetric: farther on, both densities are the same
    if path.depth == 1 then path.densityRatio = if pdf > 0f then path.densityRatio / pdf else 0.0

  private def begun(eye: Vec3, p: Vec3, cosine: Float): Double =
    val density = camera.density(eye, p)
    if density > 0f && cosine > 0f then 1.0 / (density.toDouble * cosine) else 0.0

  /** Factor of what the camera's path finds where it has met an emitter by way of a caster.
    *
    * @param pdf solid-angle density of the point of the emitter, seen from the last vertex
    */
  def ofEmission(light: Int, pdf: Float, path: PathHistory): Float =
    if !scene.lights(light).isCausticSource then 1f
    else
      val p = path.lastP
      val chosen = scene.selection.probability(p, Vec3.Zero, light)
      weight(ofSampled(light, pdf, path), path.casterRatio * chosen * pdf * perSample)

  /** Squared densities of the path itself and of a light sample, relative to its own. */
  private def ofSampled(light: Int, pdf: Float, path: PathHistory): Double =
    if path.bsdfPdf > 0f then
      val chosen = scene.selection.probability(path.lastP, path.lastN, light)
      1.0 + square(chosen.toDouble * pdf / path.bsdfPdf)
    else 1.0

  /** Factor of a light sample at the vertex.
    *
    * @param localWi direction to the emitter
    */
  def ofSample(
      connection: LightConnection,
      vertex: SurfaceVertex,
      localWi: Vec3,
      ray: Ray,
      hit: Hit,
      path: PathHistory
  ): Float =
    if !scene.lights(connection.index).isCausticSource then 1f
    else
      val begins = startDensity(vertex, ray, hit)
      if begins == 0f then 1f
      else
        val chosen = scene.selection.probability(vertex.point.p, Vec3.Zero, connection.index)
        val lightDensity = begins * chosen.toDouble * perSample / connection.probability
        val ratio = path.densityRatio * vertex.reversePdf(connection.wi) * lightDensity
        weight(ofMet(connection, vertex.localPdf(localWi)), ratio)

  /** Squared densities of a light sample and of the path itself, relative to the first.
    *
    * @param pdf of the direction in which it would meet the light
    */
  private def ofMet(connection: LightConnection, pdf: Float): Double =
    1.0 + (if connection.isDelta then 0.0 else square(pdf.toDouble / connection.pdf))

  private def weight(camera: Double, light: Double): Float =
    (camera / (camera + square(light))).toFloat
