package candela.measure

import candela.base.loop
import candela.image.Image

/** FLIP: perceived difference when flipping between two images, 0 to 1 per pixel.
  *
  * Applies to displayed images: linear radiance clamped to [0, 1], which is also the tone mapping
  * of Candela's PNG files.
  *
  * Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference
  * Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.
  */
object Flip:

  /** The paper's default viewing conditions: a screen 0.7 m wide with 3840 pixels, at a distance of
    * 0.7 m.
    */
  val PixelsPerDegree: Double = 0.7 * 3840 / 0.7 * Math.PI / 180

  // §4.1.3: exponent of colour differences, and the part of the range for small ones.
  private val ColorExponent = 0.7
  private val SmallPart = 0.4
  private val SmallRange = 0.95

  // §4.2: exponent of feature differences.
  private val FeatureExponent = 0.5

  /** Error of each pixel; 0 where one image isn't finite, which is as if both were black there. */
  def map(pair: ImagePair, pixelsPerDegree: Double = PixelsPerDegree): Image =
    val finite = pair.withBlackGaps
    val image = Opponent.of(finite.image)
    val reference = Opponent.of(finite.reference)
    val colors = colorDifference(image, reference, pixelsPerDegree)
    val features = featureDifference(image, reference, pixelsPerDegree)
    val data = new Array[Float](pair.width * pair.height)
    loop(data.length): i =>
      if pair.isFinite(i % pair.width, i / pair.width) then
        data(i) = Math.pow(colors(i), 1 - features(i)).toFloat
    Image(pair.width, pair.height, Vector("Y"), data)

  /** Mean over the pixels that are finite in both images. */
  def mean(pair: ImagePair): Double =
    val errors = map(pair).data
    var sum = 0.0
    var count = 0
    loop(errors.length): i =>
      if pair.isFinite(i % pair.width, i / pair.width) then
        sum += errors(i)
        count += 1
    sum / count

  private def colorDifference(a: Opponent, b: Opponent, ppd: Double): Array[Double] =
    val labA = a.filtered(ppd).lab
    val labB = b.filtered(ppd).lab
    val maxDistance = Math.pow(Lab.distance(Lab.Green, Lab.Blue), ColorExponent)
    val small = SmallPart * maxDistance
    Array.tabulate(labA.size): i =>
      val d = Math.pow(Lab.distance(labA(i), labB(i)), ColorExponent)
      if d < small then SmallRange / small * d
      else SmallRange + (d - small) / (maxDistance - small) * (1 - SmallRange)

  private def featureDifference(a: Opponent, b: Opponent, ppd: Double): Array[Double] =
    val kernels = FeatureKernels(ppd)
    def magnitude(o: Opponent, kernel: Array[Double]): Array[Double] =
      val luminance = o.luminance
      val x = luminance.convolved(kernel, kernels.smooth).data
      val y = luminance.convolved(kernels.smooth, kernel).data
      Array.tabulate(x.length)(i => Math.hypot(x(i), y(i)))
    def difference(kernel: Array[Double]): Array[Double] =
      magnitude(a, kernel).zip(magnitude(b, kernel)).map((p, q) => Math.abs(p - q))
    val edges = difference(kernels.edge)
    val points = difference(kernels.point)
    Array.tabulate(edges.length): i =>
      Math.pow(Math.max(edges(i), points(i)) / Math.sqrt(2), FeatureExponent)

/** Edge and point detectors: first and second derivatives of a Gaussian, §4.2. */
private final class FeatureKernels(pixelsPerDegree: Double):
  /** Edge width of maximum sensitivity, in degrees. */
  private val width = 0.082
  private val deviation = 0.5 * width * pixelsPerDegree
  private val radius = Math.ceil(3 * deviation).toInt

  val smooth: Array[Double] =
    val values = sampled(gaussian)
    values.map(_ / values.sum)
  val edge: Array[Double] = balanced(sampled(x => -x * gaussian(x)))
  val point: Array[Double] =
    balanced(sampled(x => (x * x / (deviation * deviation) - 1) * gaussian(x)))

  private def gaussian(x: Double): Double = Math.exp(-x * x / (2 * deviation * deviation))

  private def sampled(f: Double => Double): Array[Double] =
    Array.tabulate(2 * radius + 1)(i => f((i - radius).toDouble))

  /** Normalised: positive values sum to 1, negative ones to −1. */
  private def balanced(values: Array[Double]): Array[Double] =
    val positive = values.filter(_ > 0).sum
    val negative = -values.filter(_ < 0).sum
    values.map(v => if v > 0 then v / positive else v / negative)
