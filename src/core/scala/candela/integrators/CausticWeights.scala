package candela.integrators

import candela.cameras.Camera
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.scene.{Casters, Scene}

/** Weights of what camera paths find against what light paths find that begin at casters, and reach
  * the camera by a vertex that is not specular. Immutable.
  *
  * Along a path, [[PathState.rival]] is the ratio of both densities, as far as it is known: at
  * each vertex, the density with which the light path would have come here by that with which the
  * camera's has. All densities are those of BSDFs and phase functions alone, guided or not, and
  * those of distances in media are left out: they only weigh, and are the same on both sides.
  *
  * What the camera's path finds by either of its techniques is multiplied by one minus the light
  * path's weight, (p₀² + p₁²) / (p₀² + p₁² + p²): p₀ is the density of the path itself, p₁ that of
  * a light sample at its last vertex, and p that of the light path.
  *
  * @param camera    that light paths are connected to
  * @param perSample light paths per camera sample
  *
  * Source: Veach 1997, §10.2; the recursion as in Georgiev 2012, for one competitor.
  */
final class CausticWeights(scene: Scene, casters: Casters, camera: Camera, perSample: Float):

  /** The path has met a surface, and its BSDF is known. */
  def arrive(eye: Vec3, vertex: SurfaceVertex, path: PathState): Unit =
    val cosine = vertex.cosine(vertex.wo)
    if path.depth == 1 then path.rival = begun(eye, vertex.at.p, cosine)
    else if path.rival > 0.0 then path.rival = if cosine > 0f then path.rival / cosine else 0.0

  /** The path leaves for `wi`, by `vertex.bounce`.
    *
    * @param ray how it came to the vertex
    */
  def leave(vertex: SurfaceVertex, ray: Ray, hit: Hit, wi: Vec3, path: PathState): Unit =
    path.rivalAtLight = 0.0
    if path.rival > 0.0 then
      val bounce = vertex.bounce
      val pdf = if bounce.isSpecular then 0f else vertex.localPdf(bounce.wi)
      path.ownPdf = pdf
      if path.depth == 1 then
        path.rival = if pdf > 0f then path.rival * (vertex.cosine(wi) / pdf) else 0.0
      else
        val back =
          if bounce.isSpecular then 1.0
          else vertex.bsdf.pdf(bounce.wi, vertex.localWo).toDouble / pdf
        if scene.isCaster(vertex.at) then
          path.rivalAtLight = path.rival * back * casters.density(ray, hit, vertex.at)
        path.rival *= back * vertex.cosine(wi)
      if !(path.rival < Double.PositiveInfinity) then path.rival = 0.0
      if !(path.rivalAtLight < Double.PositiveInfinity) then path.rivalAtLight = 0.0

  /** The path is scattered at `p` in a medium.
    *
    * @param pdf of the phase function
    */
  def scatterInMedium(eye: Vec3, p: Vec3, pdf: Float, path: PathState): Unit =
    path.rivalAtLight = 0.0
    // Phase functions are symmetric: farther on, both densities are the same
    if path.depth == 1 then path.rival = if pdf > 0f then begun(eye, p, 1f) / pdf else 0.0

  private def begun(eye: Vec3, p: Vec3, cosine: Float): Double =
    val density = camera.density(eye, p)
    if density > 0f && cosine > 0f then perSample / (density.toDouble * cosine) else 0.0

  /** Factor of what the camera's path finds where it has met a lamp.
    *
    * @param pdf solid-angle density of the point of the lamp, seen from the last vertex
    */
  def ofEmission(light: Int, pdf: Float, path: PathState): Float =
    if !scene.lights(light).isCausticSource then 1f
    else
      val p = path.lastP
      val rival = path.rivalAtLight * scene.selection.probability(p, Vec3.Zero, light) * pdf
      val sampled =
        if path.ownPdf > 0f then
          scene.selection.probability(p, path.lastN, light).toDouble * pdf / path.ownPdf
        else 0.0
      rest(1.0 + square(sampled), rival)

  /** Factor of a light sample at the vertex.
    *
    * @param localWi direction to the lamp
    */
  def ofSample(
      connection: LightConnection,
      vertex: SurfaceVertex,
      localWi: Vec3,
      ray: Ray,
      hit: Hit,
      path: PathState
  ): Float =
    if !scene.lights(connection.index).isCausticSource || !scene.isCaster(vertex.at) then 1f
    else
      val chosen = scene.selection.probability(vertex.at.p, Vec3.Zero, connection.index)
      val back = vertex.reversePdf(connection.wi).toDouble
      val begun = casters.density(ray, hit, vertex.at) * chosen.toDouble / connection.probability
      val met =
        if connection.isDelta then 0.0 else vertex.localPdf(localWi).toDouble / connection.pdf
      rest(1.0 + square(met), path.rival * back * begun)

  private def rest(own: Double, rival: Double): Float = (own / (own + square(rival))).toFloat

  private def square(x: Double): Double = x * x
