package candela.bidirectional

import candela.base.loop
import candela.film.View

/** Places on the film, in pixels, evenly spread for any number of them: the additive recurrence of
  * the plastic number.
  *
  * Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: his R₂.
  */
private[bidirectional] final class SpreadPlaces(view: View):
  def x(k: Int): Double = at(k, 0.7548776662466927, view.width)
  def y(k: Int): Double = at(k, 0.5698402909980532, view.height)
  private def at(k: Int, step: Double, size: Int): Double = ((k + 1) * step) % 1.0 * size

/** Blocks of the image, and the moments of what was found there. Mutable. */
private final class PilotBlocks(view: View):
  import PilotBlocks.*
  private val size = Math.max(1.0, Math.max(view.width, view.height) / Across)
  private val columns = Math.ceil(view.width / size).toInt
  private val rows = Math.ceil(view.height / size).toInt
  private val count = columns * rows
  private val pairs = new Array[Int](count)
  private val sum, spread, splat, alone, rest, own, saved = new Array[Double](count)

  /** Rays of all pairs. */
  var rays = 0L

  def raysPerPath: Double = rays.toDouble / (2 * pairs.sum)

  def contains(x: Float, y: Float): Boolean =
    x >= 0f && y >= 0f && x < view.width && y < view.height

  /** Adds by how much the second moments of a pair of guided samples are below those of unguided
    * ones.
    */
  def addSaving(x: Int, y: Int, moment: Double): Unit = saved(block(x + 0.5f, y + 0.5f)) += moment

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
    loop(count): i =>
      pairs(i) += other.pairs(i)
      for (mine, their) <- all.zip(other.all) do mine(i) += their(i)

  private def all = Vector(sum, spread, splat, alone, rest, own, saved)

  /** Adds light of a light path.
    *
    * @param light   of the whole image, if there is one light path for a pixel
    * @param byPaths second moment that paths from the camera would have alone
    * @param beside  that they have beside light paths
    * @param byLight that the light path has
    */
  def addSplat(
      x: Float,
      y: Float,
      light: Double,
      byPaths: Double,
      beside: Double,
      byLight: Double
  ): Unit =
    val i = block(x, y)
    splat(i) += light
    alone(i) += byPaths
    rest(i) += beside
    own(i) += byLight

  /** Relative variances of a sample, summed over blocks: of paths from the camera beside light
    * paths, what they have more without them, and that of light paths.
    *
    * @param lightPaths how many there were
    */
  def variances(lightPaths: Int): (Double, Double, Double) =
    var byPaths, more, byLight = 0.0
    each(lightPaths): (i, unit, pixels, scale) =>
      if pairs(i) > 0 then byPaths += unit * pixels * spread(i) / pairs(i)
      more += unit * scale * (alone(i) - rest(i))
      byLight += unit * scale * own(i)
    (byPaths, more, byLight)

  /** Likewise of guided paths, and what unguided ones have more. */
  def savings(): (Double, Double) =
    var guided, more = 0.0
    each(1): (i, unit, pixels, _) =>
      if pairs(i) > 0 then
        guided += unit * pixels * spread(i) / pairs(i)
        more += unit * pixels * saved(i) / (2 * pairs(i))
    (guided, more)

  /** Calls `use` with each block, the weight of its variance, its size in pixels, and what a light
    * path stands for.
    */
  private def each(lightPaths: Int)(use: (Int, Double, Double, Double) => Unit): Unit =
    val scale = view.pixels.toDouble / lightPaths
    val pixels = Array.tabulate(count): i =>
      val (w, h) = (view.width - (i % columns) * size, view.height - (i / columns) * size)
      Math.min(w, size) * Math.min(h, size)
    val means = Array.tabulate(count): i =>
      (if pairs(i) == 0 then 0.0 else sum(i) / pairs(i)) + scale * splat(i) / pixels(i)
    val mean = means.sum / count
    loop(count)(i => use(i, 1.0 / (square(means(i)) + square(Floor * mean)), pixels(i), scale))

  private def square(x: Double): Double = x * x

private object PilotBlocks:
  /** Along the longer side. */
  inline val Across = 12.0

  /** Part of the mean brightness below which blocks count no more. */
  inline val Floor = 0.1
