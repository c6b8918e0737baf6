package candela.measure

import candela.base.loop
import candela.image.Image

/** An image in [[Flip]]'s opponent colour space: luminance, red–green, blue–yellow (linear YCxCz,
  * §4.1.1), one plane each.
  */
private[measure] final class Opponent(val y: Plane, val cx: Plane, val cz: Plane):

  /** Values from 0 to 1. */
  def luminance: Plane = Plane(y.width, y.height, y.data.map(v => (v + 16) / 116))

  /** Filtered by the contrast sensitivity function of each channel. */
  def filtered(pixelsPerDegree: Double): Opponent =
    val kernels = ContrastSensitivity(pixelsPerDegree)
    Opponent(kernels.luminance(y), kernels.redGreen(cx), kernels.blueYellow(cz))

  /** L*a*b* of each pixel, clamped to the display gamut. */
  def lab: Vector[Lab] = Vector.tabulate(y.data.length): i =>
    val ratioY = (y.data(i) + 16) / 116.0
    val ratioX = ratioY + cx.data(i) / 500.0
    val ratioZ = ratioY - cz.data(i) / 200.0
    Lab.ofScreen(Xyz(ratioX, ratioY, ratioZ))

private[measure] object Opponent:

  /** From linear R, G, B, clamped to [0, 1]. */
  def of(image: Image): Opponent =
    val size = image.width * image.height
    val y, cx, cz = new Array[Float](size)
    loop(size): i =>
      def clamped(c: Int) =
        val value = image.data(3 * i + c)
        if java.lang.Float.isFinite(value) then Math.min(1.0, Math.max(0.0, value.toDouble)) else 0
      val ratio = Xyz.ofRgb(clamped(0), clamped(1), clamped(2))
      y(i) = (116 * ratio.y - 16).toFloat
      cx(i) = (500 * (ratio.x - ratio.y)).toFloat
      cz(i) = (200 * (ratio.y - ratio.z)).toFloat
    def plane(data: Array[Float]) = Plane(image.width, image.height, data)
    Opponent(plane(y), plane(cx), plane(cz))

/** CIE XYZ, relative to the white point. */
private[measure] final case class Xyz(x: Double, y: Double, z: Double):

  def clampedToScreen: Xyz =
    // X and Z of the white point are 0.950456 and 1.089058.
    val (a, b, c) = (x * Xyz.WhiteX, y, z * Xyz.WhiteZ)
    def inside(v: Double) = Math.min(1.0, Math.max(0.0, v))
    Xyz.ofRgb(
      inside(3.240479 * a - 1.537150 * b - 0.498535 * c),
      inside(-0.969256 * a + 1.875991 * b + 0.041556 * c),
      inside(0.055648 * a - 0.204043 * b + 1.057311 * c)
    )

private[measure] object Xyz:
  val WhiteX = 0.950456
  val WhiteZ = 1.089058

  /** From linear sRGB; ITU-R BT.709-6. */
  def ofRgb(r: Double, g: Double, b: Double): Xyz = Xyz(
    (0.412453 * r + 0.357580 * g + 0.180423 * b) / WhiteX,
    0.212671 * r + 0.715160 * g + 0.072169 * b,
    (0.019334 * r + 0.119193 * g + 0.950227 * b) / WhiteZ
  )

/** L*a*b* (CIE 15:2004), with a and b scaled by lightness after Hunt, as in §4.1.2. */
private[measure] final case class Lab(l: Double, a: Double, b: Double)

private[measure] object Lab:
  val Green: Lab = ofScreen(Xyz.ofRgb(0, 1, 0))
  val Blue: Lab = ofScreen(Xyz.ofRgb(0, 0, 1))

  /** Clamps to the display gamut first. */
  def ofScreen(xyz: Xyz): Lab =
    val clamped = xyz.clampedToScreen
    val l = 116 * curve(clamped.y) - 16
    val hunt = 0.01 * l
    Lab(
      l,
      hunt * 500 * (curve(clamped.x) - curve(clamped.y)),
      hunt * 200 * (curve(clamped.y) - curve(clamped.z))
    )

  /** HyAB distance: Abasi, Tehran, Fairchild, "Distance metrics for very large color differences",
    * 2020.
    */
  def distance(p: Lab, q: Lab): Double =
    Math.abs(p.l - q.l) + Math.hypot(p.a - q.a, p.b - q.b)

  private val Knee = 6.0 / 29

  private def curve(t: Double): Double =
    if t > Knee * Knee * Knee then Math.cbrt(t) else t / (3 * Knee * Knee) + 4.0 / 29

/** Contrast sensitivity filters of the three channels: sums of Gaussians exp(−π² d² / b), d in
  * degrees, with weights a √(π / b), normalised to 1. The constants are those of the paper's table
  * 1, after Johnson and Fairchild, "A top down description of S-CIELAB and CIEDE2000", 2003.
  */
private[measure] final class ContrastSensitivity(pixelsPerDegree: Double):

  def luminance(plane: Plane): Plane = filtered(plane, Vector((1.0, 0.0047)))
  def redGreen(plane: Plane): Plane = filtered(plane, Vector((1.0, 0.0053)))
  def blueYellow(plane: Plane): Plane = filtered(plane, Vector((34.1, 0.04), (13.5, 0.025)))

  /** Three standard deviations of the widest Gaussian. */
  private val radius =
    Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI * Math.PI)) * pixelsPerDegree).toInt

  private def filtered(plane: Plane, gaussians: Vector[(Double, Double)]): Plane =
    val kernels = gaussians.map((_, b) => kernel(b))
    val weights = gaussians.zip(kernels).map:
      case ((a, b), k) => a * Math.sqrt(Math.PI / b) * k.sum * k.sum
    val responses = kernels.zip(weights).map: (k, weight) =>
      val share = weight / weights.sum
      plane.convolved(k.map(_ / k.sum * share), k.map(_ / k.sum))
    responses.reduce(_ + _)

  private def kernel(b: Double): Array[Double] = Array.tabulate(2 * radius + 1): i =>
    val degrees = (i - radius) / pixelsPerDegree
    Math.exp(-Math.PI * Math.PI * degrees * degrees / b)

/** A scalar image in row order, for the filters of [[Flip]]. */
private[measure] final class Plane(val width: Int, val height: Int, val data: Array[Float]):

  /** Convolves with a separable kernel of odd lengths; the border is clamped. */
  def convolved(alongX: Array[Double], alongY: Array[Double]): Plane =
    val rows = new Array[Float](data.length)
    val radiusX = alongX.length / 2
    loop(height): y =>
      loop(width): x =>
        var sum = 0.0
        loop(alongX.length): k =>
          sum += alongX(k) * data(y * width + inside(x + k - radiusX, width))
        rows(y * width + x) = sum.toFloat
    val result = new Array[Float](data.length)
    val radiusY = alongY.length / 2
    loop(height): y =>
      loop(width): x =>
        var sum = 0.0
        loop(alongY.length): k =>
          sum += alongY(k) * rows(inside(y + k - radiusY, height) * width + x)
        result(y * width + x) = sum.toFloat
    Plane(width, height, result)

  def +(other: Plane): Plane =
    Plane(width, height, Array.tabulate(data.length)(i => data(i) + other.data(i)))

  private def inside(i: Int, size: Int): Int =
    if i < 0 then 0 else if i >= size then size - 1 else i
