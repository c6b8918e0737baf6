package candela.bidirectional

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler

/** The end of a path on its way through the scene, from the camera or from a light. Mutable.
  *
  * @param carriesLight  does it start at a light?
  * @param compresses    does refraction change radiance by the square of the index? Not in pbrt-v2
  * @param rouletteAfter edges after which a path may end by chance
  */
private[bidirectional] final class Subpath(
    carriesLight: Boolean,
    compresses: Boolean,
    rouletteAfter: Int
):
  var throughput: Rgb = Rgb.White
  var isSpecularSoFar: Boolean = true
  val weights: PartialWeights = PartialWeights()

  /** Scatters the path at `vertex`; false if it ends there. */
  def scatter(vertex: PathVertex, ray: Ray, sampler: Sampler): Boolean =
    vertex.draw(sampler)
    val bounce = vertex.bounce
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
      else weights.turn(cosine, bounce.pdf, vertex.bsdf.pdf(bounce.wi, vertex.localWo))
      vertex.leave(ray): Unit
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
