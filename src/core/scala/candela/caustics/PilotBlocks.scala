package candela.caustics

import candela.base.loop
import candela.film.View
import candela.math.square

/** Places on the film, in pixels, evenly spread for any number of them: the additive recurrence of
  * the plastic number.
  *
  * Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: his R₂.
  */
private[candela] final class SpreadPlaces(view: View):
  def x(k: Int): Double = coordinate(k, 0.7548776662466927, view.width)
  def y(k: Int): Double = coordinate(k, 0.5698402909980532, view.height)
  private def coordinate(k: Int, step: Double, size: Int): Double = ((k + 1) * step) % 1.0 * size

/** Blocks of the image, and the moments of what was found there. Mutable. */
private final class PilotBlocks(view: View):
  import PilotBlocks.*
  private val size = Math.max(1.0, Math.max(view.width, view.height) / Across)
  private val columns = Math.ceil(view.width / size).toInt
  private val rows = Math.ceil(view.height / size).toInt
  private val count = columns * rows
  private val pairs = new Array[Int](count)
  private val sum, spread, splat = new Array[Double](count)

  /** Second moments of light paths. */
  private val lightMoments = new Array[Double](count)

  // Of each block, by the magnitude of what a path from the camera finds
  private val lightByMagnitude, excessByMagnitude = new Array[Double](count * Magnitudes)

  /** Rays of all pairs. */
  var rays = 0L

  def raysPerPath: Double = rays.toDouble / (2 * pairs.sum)

  def contains(x: Float, y: Float): Boolean =
    x >= 0f && y >= 0f && x < view.width && y < view.height

  private def block(x: Float, y: Float): Int =
    Math.min((y / size).toInt, rows - 1) * columns + Math.min((x / size).toInt, columns - 1)

  /** Adds two samples of a pixel. */
  def addPair(x: Int, y: Int, first: Float, second: Float): Unit =
    val i = block(x + 0.5f, y + 0.5f)
    pairs(i) += 1
    sum(i) += (first + second) * 0.5
    spread(i) += square((first - second).toDouble) * 0.5

  /** Adds what others found. */
  def add(other: PilotBlocks): Unit =
    rays += other.rays
    loop(count)(i => pairs(i) += other.pairs(i))
    for (mine, their) <- tables.zip(other.tables) do loop(mine.length)(i => mine(i) += their(i))

  private def tables = Vector(sum, spread, splat, lightMoments, lightByMagnitude, excessByMagnitude)

  /** Calls `use` with each block that has pairs. */
  def foreach(use: Int => Unit): Unit = loop(count)(i => if pairs(i) > 0 then use(i))

  /** Samples of the block. */
  def samples(block: Int): Int = 2 * pairs(block)

  /** Mean of the block's samples. */
  def mean(block: Int): Double = sum(block) / pairs(block)

  /** Mean of all samples. */
  def meanOfAll: Double = sum.sum / pairs.sum

  /** Variance of a sample of the block among those of its pixel. */
  def variance(block: Int): Double = spread(block) / pairs(block)

  /** Adds light of a light path.
    *
    * @param light  weighted, if there is one light path for a pixel
    * @param unweighted the same, if the camera's paths left it to light paths
    * @param ratio  density of the light path to that of the same path from the camera
    */
  def addSplat(x: Float, y: Float, light: Double, unweighted: Double, ratio: Double): Unit =
    val i = block(x, y)
    splat(i) += light
    lightMoments(i) += square(light)
    val magnitude = Math.getExponent(unweighted * ratio) - Dimmest
    val bin = i * Magnitudes + Math.max(0, Math.min(magnitude, Magnitudes - 1))
    lightByMagnitude(bin) += unweighted
    // Second moment of paths from the camera alone, less that of these beside light paths
    excessByMagnitude(bin) += (square(unweighted) - square(unweighted - light)) * ratio

  /** Relative variances of a sample, summed over blocks: of paths from the camera beside light
    * paths, and others.
    *
    * Light that the camera's paths find so seldom that it is brighter than `usual` samples of the
    * mean is a speck where it is found. Most images of as many samples have none: so its variance
    * counts no more than if this light was missing there.
    *
    * @param lightPaths how many there were
    * @param usual      samples of a pixel
    */
  def variances(lightPaths: Int, usual: Double): Variances =
    var byPaths, excess, byLight = 0.0
    eachBlock(lightPaths): (i, mean, unit, pixels, scale) =>
      if pairs(i) > 0 then byPaths += unit * pixels * spread(i) / pairs(i)
      val specks = Math.getExponent(usual * mean) - Dimmest
      var rare, frequent, light = 0.0
      loop(Magnitudes): k =>
        val bin = i * Magnitudes + k
        if k >= specks then
          rare += excessByMagnitude(bin)
          light += lightByMagnitude(bin)
        else frequent += excessByMagnitude(bin)
      val missing = usual * square(scale * light) / pixels
      excess += unit * (scale * frequent + Math.min(scale * rare, missing))
      byLight += unit * scale * lightMoments(i)
    Variances(byPaths, excess, byLight)

  /** Calls `use` with each block, its mean, the weight of its variance, its size in pixels, and
    * what a light path stands for.
    */
  private def eachBlock(lightPaths: Int)(use: (Int, Double, Double, Double, Double) => Unit): Unit =
    val scale = view.pixels.toDouble / lightPaths
    val pixels = Array.tabulate(count): i =>
      val (w, h) = (view.width - (i % columns) * size, view.height - (i / columns) * size)
      Math.min(w, size) * Math.min(h, size)
    val means = Array.tabulate(count): i =>
      (if pairs(i) == 0 then 0.0 else sum(i) / pairs(i)) + scale * splat(i) / pixels(i)
    val mean = means.sum / count
    loop(count): i =>
      use(i, means(i), 1.0 / (square(means(i)) + square(Floor * mean)), pixels(i), scale)

private object PilotBlocks:
  /** Relative variances.
    *
    * @param byPaths of paths from the camera beside light paths
    * @param excess  what they have more without these
    * @param byLight of light paths, one for a sample
    */
  final case class Variances(byPaths: Double, excess: Double, byLight: Double)

  /** Along the longer side. */
  inline val Across = 12.0

  /** Part of the mean brightness below which blocks count no more. */
  inline val Floor = 0.1

  /** Samples per pixel of a typical image. */
  inline val UsualSamples = 1024.0

  /** More samples than any image has. */
  inline val EndlessSamples = 1e30

  /** Powers of two, from this one on, that brightness is told apart by. */
  inline val Dimmest = -32
  inline val Magnitudes = 80
