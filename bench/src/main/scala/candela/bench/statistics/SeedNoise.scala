package candela.bench.statistics

import candela.base.loop
import candela.diagnostics.Code
import candela.image.{Image, ImageEdits, ImageError}
import candela.measure.{Errors, Metrics}

/** Errors of images of several seeds from each other, where no reference is given: the variance
  * between the seeds, free of the noise that a reference would have. It reveals no bias.
  */
object SeedNoise:
  /** Seeds from which there is a confidence interval: errors from the mean of two are equal. */
  val Fewest = 3

  /** @throws ImageError if sizes differ */
  def mean(images: Vector[Image]): Image =
    ImageEdits.mean(images.iterator.map(image => s"${image.width}x${image.height}" -> image))

  /** The error of each image of one program and sample count. Their mean is the unbiased variance:
    * an image is nearer to a mean that contains it than to the truth, by (n − 1) / n.
    *
    * @param images one for each seed, three channels
    * @param scale  what errors are relative to: the mean of as many images as there are
    */
  def of(images: Vector[Image], scale: Image): Vector[Errors] =
    require(images.sizeIs >= 2, "noise takes at least two seeds")
    val center = mean(images)
    val correction = images.size / (images.size - 1.0)
    images.map: image =>
      val squares, relatives, sums, scales = new Array[Double](3)
      var count = 0
      loop(image.width * image.height): pixel =>
        val at = 3 * pixel
        def isFinite(a: Image) = (0 until 3).forall(c => java.lang.Float.isFinite(a.data(at + c)))
        if isFinite(image) && isFinite(center) && isFinite(scale) then
          count += 1
          loop(3): c =>
            val difference = image.data(at + c).toDouble - center.data(at + c)
            val relative = difference / (scale.data(at + c) + Metrics.RelativeEpsilon)
            squares(c) += difference * difference
            relatives(c) += relative * relative
            sums(c) += image.data(at + c)
            scales(c) += scale.data(at + c)
      if count == 0 then throw ImageError(Code.NothingFinite, "no pixel is finite in all images")
      def figure(of: Array[Double]) = correction * of.sum / (3.0 * count)
      val ratios =
        Vector.tabulate(3)(c => if sums(c) == scales(c) then 1.0 else sums(c) / scales(c))
      Errors(figure(squares), figure(relatives), None, None, None, ratios)

  /** The same errors, taken apart.
    *
    * An image is in the mean that it is compared with, which makes deviations over the seeds too
    * small. Rare bright paths need the jackknife's factor, (n − 1) / (n − 2) (Efron, Stein, "The
    * jackknife estimate of variance", Annals of Statistics 9, 1981), normal noise its root. Three
    * seeds can't tell the two apart; the factor is the mean of both, of their logarithms.
    *
    * @param images at least three
    */
  def parts(images: Vector[Image], scale: Image): Vector[ErrorParts] =
    require(images.sizeIs >= Fewest, s"parts take at least $Fewest seeds")
    val center = mean(images)
    val all = images.map(ErrorParts.of(_, center, scale, images.size / (images.size - 1.0)))
    val stretch = Math.pow((images.size - 1.0) / (images.size - 2), 0.75)
    def stretched(of: ErrorParts => Array[Double]): Vector[Array[Double]] =
      val values = all.map(of)
      val means = Array.tabulate(values.head.length)(i => values.map(_(i)).sum / values.size)
      values.map(v => Array.tabulate(v.length)(i => means(i) + stretch * (v(i) - means(i))))
    all.lazyZip(stretched(_.squared)).lazyZip(stretched(_.relative)).map: (p, squared, relative) =>
      p.copy(squared = squared, relative = relative)
