package candela.sampling

/** A density over [0, 1) that is constant on n equal bins; an all-zero function counts as a uniform
  * one. Immutable.
  *
  * Source: PBRT 3rd ed., §13.3.1.
  */
final class Distribution1D(values: Array[Float]):
  require(values.length > 0, "no values")

  private val cdf = new Array[Float](values.length + 1)

  /** ∫ of the function that the values describe, over [0, 1). */
  val integral: Double = Cdf.write(values, 0, values.length, cdf, 0) / values.length

  def size: Int = cdf.length - 1

  /** The place for `u` in [0, 1), itself in [0, 1). */
  def sample(u: Float): Float =
    val bin = Cdf.find(cdf, 0, size, u)
    Cdf.place(bin, Cdf.within(cdf, 0, bin, u), size)

  /** The density of `sample` at `x`; 0 outside of [0, 1]. */
  def pdf(x: Float): Float =
    if x < 0f || x > 1f then 0f
    else
      val bin = Cdf.binOf(x, size)
      (cdf(bin + 1) - cdf(bin)) * size
