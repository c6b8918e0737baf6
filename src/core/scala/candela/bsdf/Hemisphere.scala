package candela.bsdf

import candela.math.*
import candela.sampling.Warp

/** Geometry of directions in the local shading frame. */
private[bsdf] object Hemisphere:

  /** Cosines below this are within rounding of 0, and dividing by them may overflow: such
    * directions count as grazing and scatter nothing.
    */
  inline val Horizon = 1e-10f

  /** Whether both directions are in the same hemisphere, and neither is grazing. */
  inline def isSameSide(a: Vec3, b: Vec3): Boolean = a.z * b.z > Horizon * Horizon

  /** Whether either direction is grazing. */
  inline def isLevel(a: Vec3, b: Vec3): Boolean = Math.abs(a.z * b.z) <= Horizon * Horizon

  inline def absCos(w: Vec3): Float = Math.abs(w.z)

  /** Reflection across the surface plane. Isotropic and axis-aligned anisotropic lobes don't
    * distinguish a direction from its image.
    */
  inline def flipped(w: Vec3): Vec3 = Vec3(w.x, w.y, -w.z)

  /** Flips `w` if `wo` is below the surface; its own inverse. */
  inline def seenFrom(wo: Vec3, w: Vec3): Vec3 = if wo.z < 0f then flipped(w) else w

  /** `w` or its image across the surface plane, whichever is in the upper hemisphere. */
  inline def above(w: Vec3): Vec3 = if w.z < 0f then flipped(w) else w

  /** Specular reflection about the normal. */
  inline def mirrored(w: Vec3): Vec3 = Vec3(-w.x, -w.y, w.z)

  /** Specular reflection of `w` about the unit vector `m`; `cosine` is `w dot m`. */
  inline def reflected(w: Vec3, m: Vec3, cosine: Float): Vec3 =
    val c = 2f * cosine
    Vec3(c * m.x - w.x, c * m.y - w.y, c * m.z - w.z)

  /** The pdf of [[cosineSample]] with respect to solid angle. */
  inline def cosinePdf(w: Vec3): Float = Math.abs(w.z) * InvPi

  /** Cosine-weighted direction in the hemisphere of `side`. */
  def cosineSample(side: Vec3, u1: Float, u2: Float): Vec3 =
    val w = Warp.cosineHemisphere(u1, u2)
    Vec3(w.x, w.y, if side.z < 0f then -w.z else w.z)
