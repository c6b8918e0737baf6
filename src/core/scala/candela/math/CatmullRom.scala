package candela.math

/** Catmull–Rom splines over increasing nodes: the slope at an inner node is that of the line
  * through its neighbours, at the first and last node that of the outermost segment's chord. Equal
  * nodes are allowed: the values jump there.
  *
  * Source: Catmull and Rom, "A Class of Local Interpolating Splines", 1974; as a pdf: PBRT 3rd ed.,
  * §8.6 and §14.1.5.
  */
object CatmullRom:
  /** Result of [[weights]] outside the range of the nodes. */
  inline val Outside = -2

  /** Index of the segment that contains `x`; the nearest if `x` is outside the nodes. It has a
    * length, unless all nodes are equal.
    */
  def piece(nodes: Array[Float], x: Float): Int =
    var low = 0
    var high = nodes.length - 1
    while high - low > 1 do
      val middle = (low + high) >>> 1
      if nodes(middle) <= x then low = middle else high = middle
    while low > 0 && nodes(low) == nodes(low + 1) do low -= 1
    low

  /** The spline at `x` is Σ to(k)·value(first + k), k from 0 to 3; weights of missing nodes are 0.
    *
    * @return first, which may be −1; or [[Outside]]
    */
  def weights(nodes: Array[Float], x: Float, to: Array[Float]): Int =
    val last = nodes.length - 1
    if !(x >= nodes(0) && x <= nodes(last)) then Outside
    else
      val i = piece(nodes, x)
      val width = nodes(i + 1) - nodes(i)
      val t = (x - nodes(i)) / width
      val t2 = t * t
      val t3 = t2 * t
      val slope0 = t3 - 2f * t2 + t
      val slope1 = t3 - t2
      to(1) = 2f * t3 - 3f * t2 + 1f
      to(2) = 3f * t2 - 2f * t3
      if i > 0 then
        val w = slope0 * width / (nodes(i + 1) - nodes(i - 1))
        to(0) = -w
        to(2) += w
      else
        to(0) = 0f
        to(1) -= slope0
        to(2) += slope0
      if i + 2 <= last then
        val w = slope1 * width / (nodes(i + 2) - nodes(i))
        to(1) -= w
        to(3) = w
      else
        to(1) -= slope1
        to(2) += slope1
        to(3) = 0f
      i - 1

  /** The value at `x`; 0 outside the nodes. */
  def value(nodes: Array[Float], values: Array[Float], x: Float): Float =
    if !(x >= nodes(0) && x <= nodes(nodes.length - 1)) then 0f
    else
      val i = piece(nodes, x)
      val t = (x - nodes(i)) / (nodes(i + 1) - nodes(i))
      cubic(nodes, values, i)(t.toDouble).toFloat

  /** The integral from the first node to each node. */
  def integrals(nodes: Array[Float], values: Array[Float]): Array[Float] =
    val sums = new Array[Float](nodes.length)
    var sum = 0.0
    for i <- 0 until nodes.length - 1 do
      val width = nodes(i + 1) - nodes(i)
      if width > 0f then sum += cubic(nodes, values, i).area(1.0) * width
      sums(i + 1) = sum.toFloat
    sums

  /** Samples the spline as a pdf: the position at which the integral is `u` of its total.
    *
    * @param integrals of the same values, by [[integrals]]
    */
  def sample(
      nodes: Array[Float],
      values: Array[Float],
      integrals: Array[Float],
      u: Float
  ): Float =
    val target = u * integrals(integrals.length - 1)
    val i = piece(integrals, target)
    val width = nodes(i + 1) - nodes(i)
    val area = (target - integrals(i)).toDouble / width
    nodes(i) + width * cubic(nodes, values, i).whereAreaIs(area).toFloat

  /** Inverts increasing values: the position of `y`; clamped to the first or last node. */
  def invert(nodes: Array[Float], values: Array[Float], y: Float): Float =
    val last = nodes.length - 1
    if !(y > values(0)) then nodes(0)
    else if !(y < values(last)) then nodes(last)
    else
      val i = piece(values, y)
      val width = nodes(i + 1) - nodes(i)
      nodes(i) + width * cubic(nodes, values, i).whereValueIs(y.toDouble).toFloat

  /** Interpolates the rows of a table at `x`; all 0 outside the nodes. */
  def row(nodes: Array[Float], table: Array[Float], x: Float): Array[Float] =
    val width = table.length / nodes.length
    val blended = new Array[Float](width)
    val w = new Array[Float](4)
    val first = weights(nodes, x, w)
    if first != Outside then
      var k = 0
      while k < 4 do
        if w(k) != 0f then
          val start = (first + k) * width
          var i = 0
          while i < width do
            blended(i) += w(k) * table(start + i)
            i += 1
        k += 1
    blended

  private def cubic(nodes: Array[Float], values: Array[Float], i: Int): CubicPiece =
    val width = nodes(i + 1) - nodes(i)
    val chord = values(i + 1) - values(i)
    val d0 =
      if i > 0 then width * (values(i + 1) - values(i - 1)) / (nodes(i + 1) - nodes(i - 1))
      else chord
    val d1 =
      if i + 2 < nodes.length then
        width * (values(i + 2) - values(i)) / (nodes(i + 2) - nodes(i))
      else chord
    CubicPiece(values(i), values(i + 1), d0, d1)

/** A segment of a cubic spline, over t from 0 to 1.
  *
  * @param f0, f1 values at the ends
  * @param d0, d1 slopes at the ends, by t
  */
final class CubicPiece(f0: Double, f1: Double, d0: Double, d1: Double):
  private val second = 3 * (f1 - f0) - 2 * d0 - d1
  private val third = d0 + d1 + 2 * (f0 - f1)

  def apply(t: Double): Double = f0 + t * (d0 + t * (second + t * third))

  def slope(t: Double): Double = d0 + t * (2 * second + t * 3 * third)

  /** ∫ from 0 to t. */
  def area(t: Double): Double = t * (f0 + t * (d0 / 2 + t * (second / 3 + t * third / 4)))

  /** Position at which the integral from 0 is `target`, for a positive segment. */
  def whereAreaIs(target: Double): Double =
    // The initial guess is exact for a straight line
    val root = Math.sqrt(Math.max(0.0, f0 * f0 + 2 * target * (f1 - f0)))
    val first = if f0 != f1 then (f0 - root) / (f0 - f1) else target / f0
    solve(first, area(_) - target, apply(_))

  /** Position at which the value is `target`, for an increasing segment. */
  def whereValueIs(target: Double): Double = solve(0.5, apply(_) - target, slope(_))

  /** Root of an increasing function, by Newton's method safeguarded by bisection. */
  private inline def solve(
      first: Double,
      inline f: Double => Double,
      inline slope: Double => Double
  ): Double =
    var low = 0.0
    var high = 1.0
    var t = first
    var residual = Double.PositiveInfinity
    while Math.abs(residual) > CubicPiece.MaxResidual && high - low > CubicPiece.MinInterval do
      if !(t >= low && t <= high) then t = 0.5 * (low + high)
      residual = f(t)
      if residual < 0 then low = t else high = t
      if Math.abs(residual) > CubicPiece.MaxResidual then t -= residual / slope(t)
    if t >= low && t <= high then t else 0.5 * (low + high)

object CubicPiece:
  // Far below the resolution of Float
  private inline val MaxResidual = 1e-12
  private inline val MinInterval = 1e-9
