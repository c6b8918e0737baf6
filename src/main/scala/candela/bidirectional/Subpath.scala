package candela.bidirectional

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** The end of a path on its way through the scene, from the camera or from a light. Mutable.
  *
  * @param carriesLight  does it start at a light?
  * @param compresses    does refraction change radiance by the square of the index? Not in pbrt-v2
  * @param rouletteAfter edges after which a path may end by chance
  */
private[bidirectional] final class Subpath(
    scene: Scene,
    carriesLight: Boolean,
    compresses: Boolean,
    rouletteAfter: Int
):
  var throughput: Rgb = Rgb.White
  var isSpecularSoFar: Boolean = true
  val weights: PartialWeights = PartialWeights()

  /** Scatters the path at `vertex`; false if it ends there. */
  def scatter(vertex: PathVertex, ray: Ray, sampler: Sampler): Boolean =
    val choice = sampler.next1D()
    sampler.next2D()
    val bounce = vertex.bsdf.sample(vertex.local, choice, sampler.x, sampler.y)
    val wi = vertex.at.frame.toWorld(bounce.wi)
    if bounce.weight.isBlack || !(bounce.isSpecular || vertex.isOpen(wi)) then false
    else
      // Refraction spreads radiance over another solid angle, but not light (Veach 1997, §5.2)
      val kept = if compresses then bounce.weight * square(bounce.eta) else bounce.weight
      throughput = throughput *
        (if carriesLight then kept * correction(vertex, wi, bounce.wi.z) else bounce.weight)
      if !bounce.isSpecular then isSpecularSoFar = false
      val cosine = vertex.cosine(wi)
      if bounce.isSpecular then weights.turnSpecular(cosine)
      else weights.turn(cosine, bounce.pdf, vertex.bsdf.pdf(bounce.wi, vertex.local))
      ray.set(vertex.at.offsetOrigin(wi), wi, Float.PositiveInfinity)
      scene.scattered(ray, vertex.at, vertex.wo, wi, bounce.isSpecular, bounce.eta)
      cosine > 0f && !throughput.isBlack && survives(vertex.edges, kept.largest, sampler)

  /** For shading normals, as in [[PathVertex.sentCosine]]. */
  private def correction(vertex: PathVertex, wi: Vec3, z: Float): Float =
    if z == 0f then 0f else vertex.sentCosine(wi) / Math.abs(z)

  /** Russian roulette by how much light the last surface kept; the strategies' weights need not
    * know of it.
    */
  private def survives(edges: Int, kept: Float, sampler: Sampler): Boolean =
    if edges < rouletteAfter || kept >= 1f then true
    else if sampler.next1D() < kept then
      throughput = throughput * (1f / kept)
      true
    else false
