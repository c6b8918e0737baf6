package candela.integrators

import candela.color.Rgb
import candela.geometry.{Frame, Hit, Ray}
import candela.sampling.{Sampler, Warp}
import candela.scene.Scene

/** How [[AmbientOcclusion]] measures openness.
  *
  * @param samples  rays per vertex
  * @param start    in scene units: nearer surfaces don't occlude
  * @param end      in scene units: farther surfaces don't occlude
  * @param cosine   sample directions by their cosine?
  * @param weighs   weight directions by their cosine? Else all count the same
  * @param open     value of a point without occlusion
  * @param beyond   what camera rays show that leave the scene
  */
final case class Occlusion(
    samples: Int,
    start: Float,
    end: Float,
    cosine: Boolean,
    weighs: Boolean,
    open: Rgb,
    beyond: Beyond
)

enum Beyond:
  /** The environment. */
  case Sky
  case Black

  /** The value of a point without occlusion. */
  case Open

/** The unoccluded fraction of the hemisphere above a point, whatever the materials and lights.
  *
  * Source: Zhukov, Iones, Kronin, "An Ambient Light Illumination Model", Eurographics Workshop on
  * Rendering 1998.
  */
final class AmbientOcclusion(scene: Scene, rule: Occlusion, volumes: VolumeMarch | Null = null)
    extends SurfaceWalk(scene, volumes):
  import rule.{beyond, cosine, open, samples, weighs}

  private val shadowRay = Ray()
  private val shadowHit = Hit()
  private var shadowRays = 0L

  override def raysTraced: Long = super.raysTraced + shadowRays

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    shadowRay.time = cameraRay.time
    startPath(cameraRay, sampler)
    while goesOn do
      val isHit = intersect()
      marchThroughVolumes(sampler)
      if isHit && vertex.isInterface then passThrough()
      else if isHit then
        addScattered(open * openness(vertex, sampler))
        end()
      else
        beyond match
          case Beyond.Sky => addEnvironment()
          case Beyond.Open => addScattered(open)
          case Beyond.Black => ()
        end()
    L.toRgb

  /** Of the hemisphere around the geometric normal. */
  private def openness(vertex: SurfaceVertex, sampler: Sampler): Float =
    val point = vertex.point
    val frame = Frame.fromZ(point.geometricNormal.facing(vertex.wo))
    sampler.next2D()
    // One point of the sampler, and the others of a sequence that starts there
    var (u1, u2) = (sampler.x, sampler.y)
    var sum = 0f
    var i = 0
    while i < samples do
      val w = if cosine then Warp.cosineHemisphere(u1, u2) else Warp.uniformHemisphere(u1, u2)
      val wi = frame.toWorld(w)
      shadowRay.set(point.offsetOrigin(wi) + wi * rule.start, wi, rule.end - rule.start)
      shadowRays += 1
      // By the cosine, over its mean: 1 is a half of its density
      if !scene.isOccluded(shadowRay, shadowHit) then
        sum += (if weighs && !cosine then 2f * w.z else 1f)
      u1 = AmbientOcclusion.wrapped(u1 + AmbientOcclusion.StepX)
      u2 = AmbientOcclusion.wrapped(u2 + AmbientOcclusion.StepY)
      i += 1
    sum / samples

object AmbientOcclusion:
  /** Of the sequence with the lowest discrepancy known of those that add a constant: Roberts, "The
    * Unreasonable Effectiveness of Quasirandom Sequences", 2018: 1/φ and 1/φ² of the real root of
    * φ³ = φ + 1.
    */
  private inline val StepX = 0.7548776662f
  private inline val StepY = 0.5698402910f

  private inline def wrapped(u: Float): Float = if u >= 1f then u - 1f else u
