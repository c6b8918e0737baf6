package candela.media

import candela.color.Rgb
import candela.math.*

/** Weights of a path through media, in three colours. Mutable, one per worker and purpose.
  *
  * In chromatic media, one colour (the hero) drives all random decisions, and the path is weighted
  * as if each of the three might have done so: the balance heuristic over the three. All numbers
  * are those of each colour over the hero's pdf, scaled to a mean of 1 for the pdfs `u`: the
  * throughput is then that of the combined estimator.
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

  /** Pdf of this path by light sampling (`r_l`), without that of the point on the light; 0 if light
    * sampling could not generate it.
    */
  var lr, lg, lb = 0f

  /** Does the path carry the first colour only? */
  var isAlone: Boolean = false

  def start(colour: Int, lightDensity: Float): Unit =
    hero = colour
    isAlone = false
    r = 1f
    g = 1f
    b = 1f
    ur = 1f
    ug = 1f
    ub = 1f
    lr = lightDensity
    lg = lightDensity
    lb = lightDensity

  /** Becomes those of another path. */
  def set(from: PathWeights): Unit =
    hero = from.hero
    isAlone = from.isAlone
    r = from.r
    g = from.g
    b = from.b
    ur = from.ur
    ug = from.ug
    ub = from.ub
    lr = from.lr
    lg = from.lg
    lb = from.lb

  def ofHero(r: Float, g: Float, b: Float): Float =
    if hero == 0 then r else if hero == 1 then g else b

  def isDead: Boolean = r == 0f && g == 0f && b == 0f

  /** Makes the path's light not a number: its sample is discarded, and counted. */
  def lose(): Unit = scale(Float.NaN)
  def isLost: Boolean = r.isNaN

  def throughput: Rgb = Rgb(r, g, b)
  def brightest: Float = Math.max(r, Math.max(g, b))
  def lightDensity: Float = (lr + lg + lb) * (1f / 3f)

  /** Goes on with the first colour, a hero wavelength, in place of all three. Whichever drove
    * sampling so far, from here on the first does.
    */
  def keepHero(): Unit =
    isAlone = true
    hero = 0
    r *= 3f
    g = 0f
    b = 0f
    ur += ug + ub
    ug = 0f
    ub = 0f
    lr += lg + lb
    lg = 0f
    lb = 0f

  def scale(c: Rgb): Unit =
    r *= c.r
    g *= c.g
    b *= c.b

  def scale(s: Float): Unit =
    r *= s
    g *= s
    b *= s

  def scaleDensity(sr: Float, sg: Float, sb: Float): Unit =
    ur *= sr
    ug *= sg
    ub *= sb

  def scaleLight(sr: Float, sg: Float, sb: Float): Unit =
    lr *= sr
    lg *= sg
    lb *= sb

  /** Starts a new segment in a direction of this pdf (0 if light sampling does not compete with
    * it).
    */
  def turn(pdf: Float): Unit =
    val l = if pdf > 0f then 1f / pdf else 0f
    lr = ur * l
    lg = ug * l
    lb = ub * l

  /** Passes the optical depths `t` without a collision, for throughput and both kinds of pdf. */
  def pass(tr: Float, tg: Float, tb: Float): Unit =
    if tr != tg || tg != tb then
      val th = ofHero(tr, tg, tb)
      // Differences first: both exponentials may underflow to 0
      val er = exp(th - tr)
      val eg = exp(th - tg)
      val eb = exp(th - tb)
      r *= er
      g *= eg
      b *= eb
      scaleDensity(er, eg, eb)
      scaleLight(er, eg, eb)

  /** Rescales the mean of the pdfs to 1. */
  def balance(): Unit =
    if ur != ug || ug != ub || ur != 1f then
      val sum = ur + ug + ub
      if sum > 0f then
        val s = 3f / sum
        scale(s)
        scaleDensity(s, s, s)
        scaleLight(s, s, s)
      else scale(0f)

  /** Russian roulette: terminates a faint path with probability 1 − `chance`, and compensates
    * otherwise.
    */
  def gamble(u: Float, chance: Float): Unit = scale(if u < chance then 1f / chance else 0f)
