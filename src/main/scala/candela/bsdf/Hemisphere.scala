package candela.bsdf

import candela.math.*
import candela.sampling.Warp

/** The few questions that every lobe asks about directions of the local frame. */
private[bsdf] object Hemisphere:

  /** A cosine below this is no more than the rounding of a unit vector, and what divides by it may
    * overflow: the direction lies in the surface, and takes and brings no light.
    */
  inline val Horizon = 1e-10f

  /** Do both lie on the same side of the surface, and not in it? */
  inline def same(a: Vec3, b: Vec3): Boolean = a.z * b.z > Horizon * Horizon

  /** Does one of the two lie in the surface? */
  inline def isLevel(a: Vec3, b: Vec3): Boolean = Math.abs(a.z * b.z) <= Horizon * Horizon

  inline def absCos(w: Vec3): Float = Math.abs(w.z)

  /** The mirror image in the surface: of a direction on the other side, the one that isotropic and
    * axis-aligned anisotropic lobes can't tell from it.
    */
  inline def flipped(w: Vec3): Vec3 = Vec3(w.x, w.y, -w.z)

  /** `w` in a frame in which `wo` lies above the surface, or back from there. */
  inline def seenFrom(wo: Vec3, w: Vec3): Vec3 = if wo.z < 0f then flipped(w) else w

  /** `w`, or its mirror image, whichever lies above the surface. */
  inline def above(w: Vec3): Vec3 = if w.z < 0f then flipped(w) else w

  /** Ideal reflection about the normal. */
  inline def mirrored(w: Vec3): Vec3 = Vec3(-w.x, -w.y, w.z)

  /** Ideal reflection of `w` about the unit vector `m`; `cosine` is `w dot m`. */
  inline def reflected(w: Vec3, m: Vec3, cosine: Float): Vec3 =
    val c = 2f * cosine
    Vec3(c * m.x - w.x, c * m.y - w.y, c * m.z - w.z)

  /** The density per solid angle of `cosineSample`. */
  inline def cosinePdf(w: Vec3): Float = Math.abs(w.z) * InvPi

  /** A direction in the hemisphere of `side`, with a density proportional to its cosine. */
  def cosineSample(side: Vec3, u1: Float, u2: Float): Vec3 =
    val w = Warp.cosineHemisphere(u1, u2)
    Vec3(w.x, w.y, if side.z < 0f then -w.z else w.z)
