package candela.media

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*

/** A heterogeneous medium within a box. Collisions are sampled with a majorant of the extinction;
  * the excess are null collisions (Woodcock tracking).
  *
  * @param toUnit     world space to the unit cube, which the medium fills
  * @param bounds     majorants of the density, per cell
  * @param extinction extinction coefficients at a density of 1, per scene unit
  *
  * Sources: Woodcock et al. 1965; Novák, Georgiev, Hanika, Jarosz, "Monte Carlo Methods for
  * Volumetric Light Transport Simulation", CGF 37(2), 2018, §4.4 (weighted tracking) and §5.1.4
  * (ratio tracking).
  */
abstract class VaryingMedium(
    toUnit: Transform,
    private[media] val bounds: MajorantGrid,
    private[media] val extinction: Rgb
) extends Medium:

  /** Coefficients at a point of the unit cube; those of `glow` only if the medium is emissive. */
  protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit

  final def follow(ray: Ray, first: Float, emits: Boolean, work: MediumWork): Float =
    val w = work.weights
    val point = work.point
    val glows = emits && isEmissive
    var scattered = -1f
    var u = first
    track(ray, w, work)(
      sample =
        val current = u
        u = work.random.next()
        current
      ,
      collide = (t, rateR, rateG, rateB, heroRate, unit) =>
        if glows then addGlow(work, rateR, rateG, rateB, unit)
        val chance = unit * w.ofHero(point.scatterR, point.scatterG, point.scatterB) / heroRate
        val scatters = work.random.next() < chance
        if scatters then
          scattered = t
          scatter(w, point)
        else
          collideUnscattered(w, point, rateR, rateG, rateB, unit, 1f - chance)
          if w.brightest < VaryingMedium.Faint then w.roulette(work.random.next(), 0.5f)
        !scatters
    )
    w.balance()
    scattered

  final def attenuate(ray: Ray, work: MediumWork): Unit =
    val w = work.shadow
    track(ray, w, work)(
      sample = work.random.next(),
      collide = (_, rateR, rateG, rateB, _, unit) =>
        collideUnscattered(w, work.point, rateR, rateG, rateB, unit, 1f)
        if w.brightest < VaryingMedium.Faint * w.lightRatio then
          w.roulette(work.random.next(), 0.5f)
        true
    )

  /** Delta tracking: visits the collisions along the ray, real and null ones.
    *
    * @param sample  uniform in [0, 1): the next distance
    * @param collide what happens at parameter t of the ray, whose point `work` has, given the rate
    *                of collisions per unit of t, for the three colours and the hero, and the length
    *                of that unit; false if the path turns there
    */
  private inline def track(ray: Ray, w: PathWeights, work: MediumWork)(
      inline sample: Float,
      inline collide: (Float, Float, Float, Float, Float, Float) => Boolean
  ): Unit =
    val walk = work.walk
    val unit = ray.direction.length
    if !w.isLost && enter(ray, walk) then
      var stepsLeft = VaryingMedium.MaxSteps
      var isStraight = true
      while isStraight && !w.isDead && !w.isLost && walk.next() do
        val rateR = extinction.r * walk.majorant * unit
        val rateG = extinction.g * walk.majorant * unit
        val rateB = extinction.b * walk.majorant * unit
        val heroRate = w.ofHero(rateR, rateG, rateB)
        var t = walk.start
        while t < walk.end do
          val remaining = walk.end - t
          val step = if heroRate > 0f then -log(1f - sample) / heroRate else Float.PositiveInfinity
          if !(step < remaining) then
            w.pass(rateR * remaining, rateG * remaining, rateB * remaining)
            t = walk.end
          else
            w.pass(rateR * step, rateG * step, rateB * step)
            t += step
            stepsLeft -= 1
            evaluate(walk, t, work.point)
            if collide(t, rateR, rateG, rateB, heroRate, unit) then
              if stepsLeft == 0 then w.discard()
              if w.isDead || w.isLost then t = walk.end
            else
              isStraight = false
              t = walk.end

  private def enter(ray: Ray, walk: MajorantWalk): Boolean =
    walk.enter(toUnit.point(ray.origin), toUnit.vector(ray.direction), ray.tMax, bounds)

  private def evaluate(walk: MajorantWalk, t: Float, point: MediumPoint): Unit =
    coefficients(walk.ox + t * walk.dx, walk.oy + t * walk.dy, walk.oz + t * walk.dz, point)

  private def scatter(w: PathWeights, p: MediumPoint): Unit =
    val inverse = 1f / w.ofHero(p.scatterR, p.scatterG, p.scatterB)
    val r = p.scatterR * inverse
    val g = p.scatterG * inverse
    val b = p.scatterB * inverse
    w.scale(r, g, b)
    w.scaleDensity(r, g, b)

  /** A null or absorbing collision: absorption is a weight.
    *
    * @param rateR,rateG,rateB of collisions, per unit of the ray's parameter
    * @param chance     the hero's probability of continuing; light sampling always continues
    */
  private def collideUnscattered(
      w: PathWeights,
      p: MediumPoint,
      rateR: Float,
      rateG: Float,
      rateB: Float,
      unit: Float,
      chance: Float
  ): Unit =
    val inverse = 1f / (w.ofHero(rateR, rateG, rateB) * chance)
    val kr = Math.max(0f, rateR - unit * p.scatterR) * inverse
    val kg = Math.max(0f, rateG - unit * p.scatterG) * inverse
    val kb = Math.max(0f, rateB - unit * p.scatterB) * inverse
    w.scale(
      Math.max(0f, kr - unit * p.absorbR * inverse),
      Math.max(0f, kg - unit * p.absorbG * inverse),
      Math.max(0f, kb - unit * p.absorbB * inverse)
    )
    w.scaleDensity(kr, kg, kb)
    w.scaleLight(rateR * inverse, rateG * inverse, rateB * inverse)

  /** Adds the emission at a collision of any kind, over the rate of such collisions. */
  private def addGlow(
      work: MediumWork,
      rateR: Float,
      rateG: Float,
      rateB: Float,
      unit: Float
  ): Unit =
    val w = work.weights
    val p = work.point
    val density = w.ur * rateR + w.ug * rateG + w.ub * rateB
    if density > 0f then
      val weight = 3f * unit / density
      work.glowR += w.r * p.glowR * weight
      work.glowG += w.g * p.glowG * weight
      work.glowB += w.b * p.glowB * weight

object VaryingMedium:
  /** Transmittance below which Russian roulette applies. */
  private val Faint = 0.02f

  /** Most collisions along a segment. No sound medium is a thousandth as dense where it does not
    * scatter; with densities of a damaged file, segments would have no end.
    */
  private val MaxSteps = 1 << 22
