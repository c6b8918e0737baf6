package candela.cameras

/** A non-circular aperture, as an image: the transmission over the square around the stop.
  *
  * @param values in rows from the left; the first row is the lowest
  */
final class StopShape(width: Int, height: Int, values: Array[Float]):
  require(values.length == width * height, s"$width × $height")

  /** Radius of the smallest centred disk that contains all non-zero transmission, in radii of the
    * stop; 0 if there is none. An interpolated texel extends by one texel on each side.
    */
  val extent: Double =
    val corners =
      for
        y <- 0 until height
        x <- 0 until width if values(y * width + x) != 0f
        dy <- Seq(-1.0, 1.0)
        dx <- Seq(-1.0, 1.0)
      yield Math.hypot((x + 0.5 + dx) / width * 2 - 1, (y + 0.5 + dy) / height * 2 - 1)
    corners.maxOption.getOrElse(0.0)

  /** Bilinear interpolation between texels, black outside the image.
    *
    * @param x in radii of the stop from the axis, as `y`
    */
  def transmission(x: Double, y: Double): Double =
    val u = (x + 1) / 2 * width - 0.5
    val v = (y + 1) / 2 * height - 0.5
    val u0 = Math.floor(u)
    val v0 = Math.floor(v)
    val tu = u - u0
    val tv = v - v0
    val i = u0.toInt
    val j = v0.toInt
    (1 - tv) * ((1 - tu) * texel(i, j) + tu * texel(i + 1, j)) +
      tv * ((1 - tu) * texel(i, j + 1) + tu * texel(i + 1, j + 1))

  private def texel(x: Int, y: Int): Double =
    if x < 0 || y < 0 || x >= width || y >= height then 0.0 else values(y * width + x)

object StopShape:
  /** Scaled to transmit as much light as the disk inscribed in the square. */
  def asBrightAsDisc(width: Int, height: Int, values: Array[Float]): StopShape =
    val mean = values.map(_.toDouble).sum / values.length
    val scale = if mean > 0 then Math.PI / 4 / mean else 0.0
    StopShape(width, height, values.map(v => (v * scale).toFloat))

/** pbrt-v4's named shapes, 256 texels wide as there. They are flipped vertically. */
object StopShapes:
  private val Size = 256

  /** By name: the transmission at (x, y), in radii of the stop. */
  val all: Map[String, () => StopShape] = Map(
    // A bell that is 0 at the rim of the stop
    "gaussian" -> (() => sampled((x, y) => Math.exp(-(x * x + y * y)) - Math.exp(-1))),
    "square" -> (() => sampled((x, y) => if Math.max(x.abs, y.abs) < 0.5 then 1 else 0)),
    "pentagon" -> (() => polygon(Vector.tabulate(5)(i => corner(0.8, Math.PI * (0.5 + 0.4 * i))))),
    "star" -> (() => polygon(starCorners))
  )

  /** Corners of a pentagram with one point towards −x; the inner corners are where its lines cross.
    */
  private def starCorners =
    val inner = Math.cos(Math.toRadians(72)) / Math.cos(Math.toRadians(36))
    Vector.tabulate(10)(i => corner(if i % 2 == 1 then 1.0 else inner, Math.PI * i / 5))

  private def corner(radius: Double, angle: Double): (Double, Double) =
    (radius * Math.cos(angle), radius * Math.sin(angle))

  /** 1 inside the polygon, 0 outside, by the even–odd rule with a ray to the right. */
  private def polygon(corners: Vector[(Double, Double)]): StopShape =
    val edges = corners.zip(corners.tail :+ corners.head)
    sampled: (x, y) =>
      val crossings = edges.count: (a, b) =>
        (a._2 <= y) != (b._2 <= y) && x < a._1 + (y - a._2) / (b._2 - a._2) * (b._1 - a._1)
      crossings % 2

  private def sampled(value: (Double, Double) => Double): StopShape =
    def coordinate(i: Int) = -1 + 2 * (i + 0.5) / Size
    val texels = Array.tabulate(Size * Size): i =>
      Math.max(0.0, value(coordinate(i % Size), -coordinate(i / Size))).toFloat
    StopShape.asBrightAsDisc(Size, Size, texels)
