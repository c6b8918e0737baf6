package candela.media

import candela.color.Rgb
import candela.math.*

/** What a path through media carries, in three colours. Mutable, one per worker and purpose.
  *
  * Where a medium treats colours differently, one of them (the hero) decides by chance what
  * happens, and the path is weighted as if each of the three might have decided: the balance
  * heuristic over the three. So all numbers here are those of each colour over the hero's density,
  * scaled such that the densities `u` have a mean of 1: the throughput is then that of the combined
  * estimate.
  *
  * Sources: Wilkie et al., "Hero Wavelength Spectral Sampling", EGSR 2014; Miller, Georgiev,
  * Jarosz,
  * "A null-scattering path integral formulation of light transport", TOG 38(4), 2019; PBRT 4th ed.,
  * §14.2.
  */
final class PathWeights:
  /** The colour by which chance decides: 0, 1 or 2. */
  var hero: Int = 0

  /** Throughput. */
  var r, g, b = 1f

  /** Density with which this path is made, by each colour. */
  var ur, ug, ub = 1f

  /** Density with which light sampling would have made it, but for the choice of the point on the
    * light; 0: it could not.
    */
  var lr, lg, lb = 0f

  def start(colour: Int, lightDensity: Float): Unit =
    hero = colour
    r = 1f
    g = 1f
    b = 1f
    ur = 1f
    ug = 1f
    ub = 1f
    lr = lightDensity
    lg = lightDensity
    lb = lightDensity

  def ofHero(r: Float, g: Float, b: Float): Float =
    if hero == 0 then r else if hero == 1 then g else b

  def isDead: Boolean = r == 0f && g == 0f && b == 0f
  def throughput: Rgb = Rgb(r, g, b)
  def brightest: Float = Math.max(r, Math.max(g, b))
  def lightDensity: Float = (lr + lg + lb) * (1f / 3f)

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

  /** A direction was just chosen with this density (0: no light sampling competes with it). */
  def turn(pdf: Float): Unit =
    val l = if pdf > 0f then 1f / pdf else 0f
    lr = ur * l
    lg = ug * l
    lb = ub * l

  /** Passes the optical depths `t` without a collision, for all three kinds of numbers. */
  def pass(tr: Float, tg: Float, tb: Float): Unit =
    if tr != tg || tg != tb then
      val th = ofHero(tr, tg, tb)
      // Differences first: both of two exponentials may be 0
      val er = exp(th - tr)
      val eg = exp(th - tg)
      val eb = exp(th - tb)
      r *= er
      g *= eg
      b *= eb
      scaleDensity(er, eg, eb)
      scaleLight(er, eg, eb)

  /** Brings the mean of the densities back to 1. */
  def balance(): Unit =
    if ur != ug || ug != ub || ur != 1f then
      val sum = ur + ug + ub
      if sum > 0f then
        val s = 3f / sum
        scale(s)
        scaleDensity(s, s, s)
        scaleLight(s, s, s)
      else scale(0f)

  /** Lets a faint path end with probability 1 − `chance`, and makes up for it otherwise. */
  def gamble(u: Float, chance: Float): Unit = scale(if u < chance then 1f / chance else 0f)
