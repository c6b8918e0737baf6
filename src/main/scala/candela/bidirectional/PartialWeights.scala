package candela.bidirectional

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
