package candela.bdpt

import candela.color.Rgb
import candela.geometry.Ray
import candela.integrators.{LightTransport, SurfaceVertex}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** A camera or light subpath during its random walk. Mutable.
  *
  * @param carriesLight  whether it is a light subpath
  * @param compresses    whether refraction scales radiance by the square of the index; not in
  *                      pbrt-v2
  * @param rouletteDepth the first scattering event after which Russian roulette may end it
  * @param evaluates     whether weights take the density of a direction from the BSDF, as others
  *                      do who don't sample it: that of a random walk's may be another
  */
private[candela] final class Subpath(
    carriesLight: Boolean,
    compresses: Boolean,
    rouletteDepth: Int,
    evaluates: Boolean = false
):
  var throughput: Rgb = Rgb.White
  var isSpecularSoFar: Boolean = true

  /** Whether it carries its hero wavelength only. */
  var isAlone: Boolean = false
  val weights: PartialWeights = PartialWeights()

  /** Ends the companions of the hero wavelength where `vertex` is dispersive. */
  def disperse(vertex: PathVertex): Unit =
    if !isAlone && vertex.bsdf.isDispersive then
      isAlone = true
      throughput = throughput * LightTransport.Hero

  /** Scatters the path at `vertex`; false if it ends there. */
  def scatter(vertex: PathVertex, ray: Ray, sampler: Sampler): Boolean =
    vertex.draw(sampler)
    val bounce = vertex.bounce
    val wi = vertex.point.frame.toWorld(bounce.wi)
    if bounce.weight.isBlack || !(bounce.isSpecular || vertex.isOpen(wi)) then false
    else
      // Refraction scales radiance, but not power (Veach 1997, §5.2)
      val powerWeight =
        if carriesLight && !bounce.isSpecular && !vertex.bsdf.isReciprocal then
          vertex.sent(wi) * (Math.abs(bounce.wi.z) / bounce.pdf)
        else if compresses then bounce.weight * square(bounce.eta)
        else bounce.weight.toRgb
      throughput = throughput *
        (if carriesLight && !vertex.isInMedium then
           powerWeight * correction(vertex, wi, bounce.wi.z)
         else bounce.weight.toRgb)
      if !bounce.isSpecular then isSpecularSoFar = false
      val cosine = vertex.cosine(wi)
      if bounce.isSpecular then weights.scatterSpecular(cosine)
      else
        val pdf = if evaluates then vertex.localPdf(bounce.wi) else bounce.pdf
        weights.scatter(cosine, pdf, vertex.bsdf.pdf(bounce.wi, vertex.localWo))
      vertex.spawnRay(ray): Unit
      cosine > 0f && !throughput.isBlack && roulette(vertex.edges, powerWeight.largest, sampler)

  /** Shading normal correction, as in [[PathVertex.sentCosine]]. */
  private def correction(vertex: PathVertex, wi: Vec3, z: Float): Float =
    if z == 0f then 0f else vertex.sentCosine(wi) / Math.abs(z)

  /** Russian roulette by the last surface's weight; MIS weights can ignore it. False ends the path.
    */
  private def roulette(depth: Int, weight: Float, sampler: Sampler): Boolean =
    val factor =
      if depth >= rouletteDepth then LightTransport.roulette(weight, 1f, sampler) else 1f
    if factor > 1f then throughput = throughput * factor
    factor > 0f

/** A vertex of a subpath, from the camera or from a light, that can be connected to the other
  * subpath. Mutable, for reuse.
  */
private[candela] final class PathVertex(scene: Scene) extends SurfaceVertex(scene):
  /** Throughput of the subpath up to here. */
  var throughput: Rgb = Rgb.Black

  /** Number of edges of the subpath up to here. */
  var edges: Int = 0

  /** Whether all earlier vertices are specular. */
  var isSpecularSoFar: Boolean = true

  /** Do paths that begin at casters arrive here, too, as this one does? */
  var isCaustic: Boolean = false

  /** As [[Subpath.isAlone]]. */
  var isAlone: Boolean = false

  /** Index of the medium where the subpath came from, −1: none. */
  var medium: Int = -1

  /** Density of the subpath by each colour; see [[candela.media.PathWeights]]. */
  var ur, ug, ub: Float = 1f
  val weights: PartialWeights = PartialWeights()

  /** Whether a camera path that arrives from `wi` can continue this light subpath backwards.
    *
    * In pbrt-v2 and v3 a BSDF has a value wherever the geometric normal allows reflection, but
    * samples only the side that the shading normal faces. Path tracing thus finds the rest by light
    * sampling alone; for the same image, so must the connections.
    */
  def isReachable(wi: Vec3): Boolean = edges == 1 || reversePdf(wi) > 0f

  /** Cosine factor for light scattered to `wi`, with the correction for shading normals, which make
    * scattering asymmetric (Veach 1997, §5.3.2).
    */
  def sentCosine(wi: Vec3): Float =
    val slant = cosine(wo)
    if isInMedium then 1f
    else if slant > 0f then cosine(wi) * Math.abs(localWo.z) / slant else 0f

/** MIS quantities at the end of a subpath, which allow a full path to be weighted against every
  * other strategy in constant time. Mutable.
  *
  * A path of n edges has about n + 1 strategies, weighted by the power heuristic (Veach 1997,
  * §9.2.4, β = 2). At the end of one subpath, the pdf ratios of all strategies with a shorter
  * subpath are accumulated on the way; the last factor, known only once the other end is, is left
  * out.
  *
  * Source: Georgiev, "Implementing Vertex Connection and Merging", Saarland University 2012: `dVCM`
  * is its d^VCM, `dVC` its d^VC.
  */
private[candela] final class PartialWeights:
  /** Ratio for the strategy that cuts the last edge. */
  var dVCM: Double = 0.0

  /** Sum for the strategies that cut earlier edges. */
  var dVC: Double = 0.0

  def set(other: PartialWeights): Unit =
    dVCM = other.dVCM
    dVC = other.dVC

  /** Converts to area measure on a hit at `distance` under this cosine. */
  def arrive(distance: Double, cosine: Float): Unit =
    val perArea = 1 / PartialWeights.mis(cosine.toDouble)
    dVCM *= PartialWeights.mis(distance * distance) * perArea
    dVC *= perArea

  /** Updates for non-specular scattering.
    *
    * @param cosine  of the sampled direction
    * @param pdf     of the sampled direction
    * @param reverse pdf of the reverse direction
    */
  def scatter(cosine: Float, pdf: Float, reverse: Float): Unit =
    dVC = PartialWeights.mis(cosine.toDouble / pdf) * (dVC * PartialWeights.mis(reverse) + dVCM)
    dVCM = PartialWeights.mis(1.0 / pdf)

  /** Updates for specular scattering: no connection is possible here. */
  def scatterSpecular(cosine: Float): Unit =
    dVCM = 0.0
    dVC *= PartialWeights.mis(cosine)

  /** Sum over all strategies that cut this subpath.
    *
    * @param pdf     area pdf of the last vertex when sampled by the other subpath
    * @param reverse pdf of the last but one vertex when sampled from there
    */
  def sum(pdf: Double, reverse: Double): Double =
    PartialWeights.mis(pdf) * (dVCM + dVC * PartialWeights.mis(reverse))

private[candela] object PartialWeights:
  /** A ratio of pdfs, squared by the power heuristic. */
  inline def mis(ratio: Double): Double = ratio * ratio
