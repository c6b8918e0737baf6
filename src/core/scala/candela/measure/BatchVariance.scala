package candela.measure

import candela.base.loop
import candela.image.Image

/** Estimates the variance of each pixel of a progressive image from its successive states.
  *
  * What is added between two states is a batch, and the scatter of the batch means around the image
  * gives the variance of a sample: Σ w (X − X̄)² / (batches − 1), for batches of mean X and weight
  * w. Unbiased for independent samples; overestimates low-discrepancy samples. It excludes bias.
  *
  * Source: West, "Updating mean and variance estimates: an improved method", Communications of the
  * ACM 22(9), 1979.
  *
  * @param pixels number of pixels
  */
final class BatchVariance(pixels: Int, channels: Int):
  private val means = new Array[Float](pixels * channels)
  private val squares = new Array[Float](pixels * channels)
  private val weights = new Array[Float](pixels)
  private val batches = new Array[Byte](pixels)

  /** Adds the next state.
    *
    * @param weight of all samples of each pixel
    */
  def add(image: Image, weight: Array[Float]): Unit =
    require(image.data.length == means.length && weight.length == pixels)
    loop(pixels): pixel =>
      val added = weight(pixel) - weights(pixel)
      if added > 0 && batches(pixel) < Byte.MaxValue then
        loop(channels): c =>
          val index = pixel * channels + c
          val value = image.data(index)
          // The batch mean's distance from the former mean, by the weights of both
          val step = (value - means(index)) / added * weight(pixel)
          squares(index) += added * step * (means(index) + step - value)
          means(index) = value
        weights(pixel) = weight(pixel)
        batches(pixel) = (batches(pixel) + 1).toByte

  /** Variance of the mean of the samples so far; 0 before the second batch. */
  def apply(pixel: Int, channel: Int): Float =
    val count = batches(pixel)
    if count < 2 || weights(pixel) <= 0 then 0
    else Math.max(0f, squares(pixel * channels + channel) / (count - 1) / weights(pixel))

  /** Whether every pixel has an estimate. */
  def isKnown: Boolean = batches.forall(_ > 1)

  /** The standard deviations of all pixels' means: the expected noise. */
  def noise(names: Vector[String], width: Int): Image =
    val data = new Array[Float](means.length)
    loop(data.length)(i => data(i) = Math.sqrt(this(i / channels, i % channels)).toFloat)
    Image(width, pixels / width, names, data)

  /** The expected errors of the last state.
    *
    * @param image its image
    */
  def errors(image: Image): Errors =
    val variances = Array.tabulate(means.length)(i => this(i / channels, i % channels))
    val absolute = variances.map(_.toDouble).sum / means.length
    val relative = LocalMeans(image, variances).relativeMse
    Errors(absolute, relative, None, None, None, Vector.empty)
