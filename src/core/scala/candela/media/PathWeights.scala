package candela.media

import candela.color.{MutableRgb, Rgb}
import candela.math.*

/** Weights of a path through media, in three colours. Mutable, one per worker and purpose.
  *
  * In chromatic media, one colour (the hero) drives all random decisions, and the path is weighted
  * as if each of the three might have done so: the balance heuristic over the three. Each number is
  * divided by the density with which the hero samples this path. [[balance]] then scales all nine
  * so that the mean of `ur`, `ug` and `ub` is 1: `r`, `g`, `b` are then the throughput of the
  * balance heuristic.
  *
  * Sources: Wilkie et al., "Hero Wavelength Spectral Sampling", EGSR 2014; Miller, Georgiev,
  * Jarosz, "A null-scattering path integral formulation of light transport", TOG 38(4), 2019; PBRT
  * 4th ed., §14.2.
  */
final class PathWeights:
  /** The colour that drives sampling: 0, 1 or 2. */
  var hero: Int = 0

  /** Throughput (in pbrt-v4 `beta`). */
  var r, g, b = 1f

  /** Pdf of this path by each colour (`r_u`). */
  var ur, ug, ub = 1f

  /** Density of light sampling over the path's own (`r_l`), without that of choosing the point on
    * the light; 0: light sampling can't sample this path.
    */
  var lr, lg, lb = 0f

  /** Does the path carry the first colour only? */
  var isAlone: Boolean = false

  def start(colour: Int, lightRatio: Float): Unit =
    hero = colour
    isAlone = false
    setThroughput(1f, 1f, 1f)
    setDensity(1f, 1f, 1f)
    setLight(lightRatio, lightRatio, lightRatio)

  /** Becomes those of another path. */
  def set(from: PathWeights): Unit =
    hero = from.hero
    isAlone = from.isAlone
    setThroughput(from.r, from.g, from.b)
    setDensity(from.ur, from.ug, from.ub)
    setLight(from.lr, from.lg, from.lb)

  private inline def setThroughput(cr: Float, cg: Float, cb: Float): Unit =
    r = cr
    g = cg
    b = cb

  private inline def setDensity(pr: Float, pg: Float, pb: Float): Unit =
    ur = pr
    ug = pg
    ub = pb

  private inline def setLight(pr: Float, pg: Float, pb: Float): Unit =
    lr = pr
    lg = pg
    lb = pb

  def ofHero(r: Float, g: Float, b: Float): Float =
    if hero == 0 then r else if hero == 1 then g else b

  def isDead: Boolean = r == 0f && g == 0f && b == 0f

  /** Makes the path's light not a number: its sample is discarded, and counted. */
  def discard(): Unit = scale(Float.NaN)
  def isLost: Boolean = r.isNaN

  def throughput: Rgb = Rgb(r, g, b)
  def brightest: Float = Math.max(r, Math.max(g, b))
  def lightRatio: Float = (lr + lg + lb) * (1f / 3f)

  /** Goes on with the first colour, a hero wavelength, in place of all three. Whichever drove
    * sampling so far, from here on the first does.
    */
  def keepHero(): Unit =
    isAlone = true
    hero = 0
    setThroughput(r * 3f, 0f, 0f)
    setDensity(ur + (ug + ub), 0f, 0f)
    setLight(lr + (lg + lb), 0f, 0f)

  def scale(c: Rgb): Unit = scale(c.r, c.g, c.b)
  def scale(c: MutableRgb): Unit = scale(c.r, c.g, c.b)
  def scale(s: Float): Unit = scale(s, s, s)

  inline def scale(sr: Float, sg: Float, sb: Float): Unit =
    r *= sr
    g *= sg
    b *= sb

  def scaleDensity(sr: Float, sg: Float, sb: Float): Unit =
    ur *= sr
    ug *= sg
    ub *= sb

  def scaleLight(sr: Float, sg: Float, sb: Float): Unit =
    lr *= sr
    lg *= sg
    lb *= sb

  private inline def scaleAll(sr: Float, sg: Float, sb: Float): Unit =
    scale(sr, sg, sb)
    scaleDensity(sr, sg, sb)
    scaleLight(sr, sg, sb)

  /** Starts a segment in a direction of this pdf; 0: light sampling misses what it meets. */
  def startSegment(pdf: Float): Unit =
    val l = if pdf > 0f then 1f / pdf else 0f
    setLight(ur * l, ug * l, ub * l)

  /** Passes the optical depths `t` without a collision, for throughput and both kinds of pdf. */
  def pass(tr: Float, tg: Float, tb: Float): Unit =
    if tr != tg || tg != tb then
      val th = ofHero(tr, tg, tb)
      // Differences first: both exponentials may underflow to 0
      val er = exp(th - tr)
      val eg = exp(th - tg)
      val eb = exp(th - tb)
      scaleAll(er, eg, eb)

  /** Rescales the mean of the pdfs to 1. */
  def balance(): Unit =
    if ur != ug || ug != ub || ur != 1f then
      val sum = ur + ug + ub
      if sum > 0f then
        val s = 3f / sum
        scaleAll(s, s, s)
      else scale(0f)

  /** Russian roulette: ends the path unless `u` is below the probability of going on. */
  def roulette(u: Float, probability: Float): Unit =
    scale(if u < probability then 1f / probability else 0f)
