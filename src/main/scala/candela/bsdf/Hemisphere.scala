package candela.bsdf

import candela.math.*
import candela.sampling.Warp

/** The few questions that every lobe asks about directions of the local frame. */
private[bsdf] object Hemisphere:

  /** Do both lie strictly on the same side of the surface? */
  inline def same(a: Vec3, b: Vec3): Boolean = a.z * b.z > 0f

  inline def absCos(w: Vec3): Float = Math.abs(w.z)

  /** The mirror image in the surface: of a direction on the other side, the one that isotropic and
    * axis-aligned anisotropic lobes can't tell from it.
    */
  inline def flipped(w: Vec3): Vec3 = Vec3(w.x, w.y, -w.z)

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
    if side.z < 0f then flipped(w) else w
