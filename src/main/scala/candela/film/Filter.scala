package candela.film

/** A reconstruction filter: how much a sample counts that lies (`dx`, `dy`) pixels from a pixel's
  * centre. Zero beyond the radii; need not be normalised, may be negative.
  */
abstract class Filter(val radiusX: Float, val radiusY: Float):
  def apply(dx: Float, dy: Float): Float
