package candela.film

/** A reconstruction filter: how much a sample counts that lies (`dx`, `dy`) pixels from a pixel's
  * centre. Zero beyond the radii; need not be normalised, may be negative.
  *
  * All filters here are products of a function of x and one of y, which makes them cheap to
  * tabulate and to sample; see [[FilterSampler]].
  */
abstract class Filter(val radiusX: Float, val radiusY: Float):
  require(radiusX > 0f && radiusY > 0f, s"filter radii $radiusX, $radiusY")

  def x(dx: Float): Float
  def y(dy: Float): Float
  final def apply(dx: Float, dy: Float): Float = x(dx) * y(dy)
