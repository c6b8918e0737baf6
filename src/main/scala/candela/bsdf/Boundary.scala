package candela.bsdf

import candela.math.*

/** The interface between the outside and the inside of a layered surface, seen from either.
  *
  * Directions are in a frame in which the side of `o` is above: `o.z` ≥ 0. `relative` is the index
  * beyond the interface over that on the side of `o`. Powers are counted, not radiances: those
  * differ by the square of the index, which a path that comes out again has gained and lost.
  *
  * @param eta index of refraction inside over that outside; greater than 0
  */
private[bsdf] final class Boundary(val distribution: TrowbridgeReitz, val eta: Float):

  /** Without a change of index nothing is bent, however rough the interface. */
  val isSmooth: Boolean = distribution.isSmooth || eta == 1f

  /** A facet that `o` meets. */
  def facet(o: Vec3, u1: Float, u2: Float): Vec3 =
    if isSmooth then Vec3.Z else distribution.sample(o, u1, u2)

  /** What the roughness leaves of power that a drawn facet sends from `o` to `i`. */
  def weight(o: Vec3, i: Vec3, m: Vec3): Float =
    if isSmooth then 1f else distribution.sampleWeight(o, i, m)

  /** Where the facet sends `o` on the other side, with z < 0; zero if nowhere. */
  def refracted(o: Vec3, m: Vec3, relative: Float): Vec3 =
    val cosM = o dot m
    val cosT = if cosM > 0f then Fresnel.cosRefracted(cosM, relative) else -1f
    if cosT <= 0f then Vec3.Zero
    else
      val i = Fresnel.refracted(o, m, cosM, cosT, relative)
      if i.z < 0f then i else Vec3.Zero

  /** Where the facet sends `o` on the same side; zero if nowhere. */
  def reflected(o: Vec3, m: Vec3): Vec3 =
    val cosM = o dot m
    if cosM <= 0f then Vec3.Zero
    else
      val i = Hemisphere.reflected(o, m, cosM)
      if i.z > 0f then i else Vec3.Zero

  /** The part of the power that a facet of a rough interface sends from `o` to `i` beyond, per
    * solid angle of `i` and cosine: the transmitted value times the square of the index.
    */
  def crossing(o: Vec3, i: Vec3): Float =
    val m = RoughDielectric.facet(o, i, eta)
    if m.isZero then 0f
    else
      val passed = 1f - Fresnel.dielectric(o dot m, eta)
      val spread = 4f * (o dot m) * RoughDielectric.jacobian(o, i, m, eta)
      passed * distribution.d(m) * distribution.visibility(o, i, m) * spread

  /** The density, per solid angle of `i`, with which facets drawn for `o` send it there, of those
    * that refract.
    */
  def crossingPdf(o: Vec3, i: Vec3): Float =
    val m = RoughDielectric.facet(o, i, eta)
    if m.isZero then 0f
    else distribution.pdf(o, m) * RoughDielectric.jacobian(o, i, m, eta)
