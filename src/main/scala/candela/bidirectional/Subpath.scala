package candela.bidirectional

import candela.color.Rgb
import candela.geometry.Ray
import candela.integrators.SurfaceVertex
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

/** A vertex of a subpath, from the camera or from a light, that can be connected to the other
  * subpath. Mutable, for reuse.
  */
private[bidirectional] final class PathVertex(scene: Scene) extends SurfaceVertex(scene):
  /** Of the subpath up to here. */
  var throughput: Rgb = Rgb.Black

  /** Edges of the subpath. */
  var edges: Int = 0

  /** Has it met specular surfaces only? */
  var isSpecularSoFar: Boolean = true
  val weights: PartialWeights = PartialWeights()

  /** What the cosine of `wi` to the shading normal becomes for light that goes on to `wi`: shading
    * normals make scattering asymmetric (Veach 1997, §5.3.2).
    */
  def sentCosine(wi: Vec3): Float =
    val slant = cosine(wo)
    if slant > 0f then cosine(wi) * Math.abs(localWo.z) / slant else 0f

/** What the end of a subpath must know of all other ways to make it, so that a whole path is
  * weighted against every other strategy in constant time. Mutable.
  *
  * A path of n edges can be made of two subpaths in n + 1 ways or so; each is weighted by the power
  * heuristic of their densities (Veach 1997, §9.2.4, β = 2). Seen from the end of one subpath, the
  * others that cut it shorter have densities whose ratios to its own are summed up on the way; the
  * last factor, which is known only when the other end is, is left out.
  *
  * Source: Georgiev, "Implementing Vertex Connection and Merging", Saarland University 2012: `near`
  * is its d^VCM, `far` its d^VC.
  */
private[bidirectional] final class PartialWeights:
  /** Of the strategy that cuts the last edge. */
  var near: Double = 0.0

  /** Of those that cut earlier edges. */
  var far: Double = 0.0

  def set(other: PartialWeights): Unit =
    near = other.near
    far = other.far

  /** The path has come `distance` far to a surface under this cosine. */
  def arrive(distance: Double, cosine: Float): Unit =
    val perArea = 1 / PartialWeights.mis(cosine.toDouble)
    near *= PartialWeights.mis(distance * distance) * perArea
    far *= perArea

  /** The path was scattered.
    *
    * @param cosine  of the direction in which it goes on
    * @param pdf     of that direction
    * @param reverse the density of the way back
    */
  def turn(cosine: Float, pdf: Float, reverse: Float): Unit =
    far = PartialWeights.mis(cosine.toDouble / pdf) * (far * PartialWeights.mis(reverse) + near)
    near = PartialWeights.mis(1.0 / pdf)

  /** It was scattered where only one direction was possible: nothing can be joined there. */
  def turnSpecular(cosine: Float): Unit =
    near = 0.0
    far *= PartialWeights.mis(cosine)

  /** The sum over all strategies that cut this subpath.
    *
    * @param pdf     with which the other subpath would have made the last vertex, per area
    * @param reverse with which it would have gone on from there to the last but one
    */
  def sum(pdf: Double, reverse: Double): Double =
    PartialWeights.mis(pdf) * (near + far * PartialWeights.mis(reverse))

private[bidirectional] object PartialWeights:
  /** Of a ratio of densities: squared by the power heuristic. */
  inline def mis(ratio: Double): Double = ratio * ratio
