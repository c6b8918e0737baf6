package candela.cameras

import candela.base.loop
import candela.math.square

/** Exit pupil bounds: for each of several rings of film positions around the centre, the rectangle
  * on the rear lens surface through which light can reach them. They hold for positions on the
  * film's +x axis, and rotate with the others.
  *
  * @param bounds      x0, x1, y0, y1 for each ring, in metres; x0 > x1 if no light reaches it
  * @param halfDiagonal of the film
  * @param central      the innermost ring's area as pbrt-v3 has it, in square metres
  *
  * Source: Steinert et al., "General Spectral Camera Lens Simulation", Computer Graphics Forum
  * 30(6), 2011, for bounds tabulated over the film's radius; PBRT 4th ed., §5.4.5.
  */
final class ExitPupil private (
    bounds: Array[Double],
    halfDiagonal: Double,
    val central: () => Double
):
  private val rings = bounds.length / 4

  def ring(filmRadius: Double): Int =
    Math.min((filmRadius / halfDiagonal * rings).toInt, rings - 1)

  def isDark(ring: Int): Boolean = bounds(4 * ring) > bounds(4 * ring + 1)
  def x(ring: Int, u: Double): Double = lerp(u, bounds(4 * ring), bounds(4 * ring + 1))
  def y(ring: Int, v: Double): Double = lerp(v, bounds(4 * ring + 2), bounds(4 * ring + 3))

  /** In square metres; 0 if no light reaches the ring. */
  def area(ring: Int): Double =
    if isDark(ring) then 0.0
    else
      (bounds(4 * ring + 1) - bounds(4 * ring)) * (bounds(4 * ring + 3) - bounds(4 * ring + 2))

  private def lerp(t: Double, a: Double, b: Double) = (1 - t) * a + t * b

object ExitPupil:
  private val Rings = 64

  /** Cells of the search grid across and up; up covers half the height, by symmetry. */
  private val CellsAcross = 48
  private val CellsUp = 24

  /** If the pupil has fewer cells across, the search continues with a finer grid. */
  private val MinCells = 12
  private val MaxZooms = 8

  /** Computes the rectangles, which contain all light that a circular stop would admit.
    *
    * Traces rays from both borders and the middle of each ring to a grid on the rear surface: first
    * over all of it, then around the previous ring's pupil, which is never far away. Bisects the
    * edges between the outermost rays that pass and the next ones. Finally pads the rectangle by as
    * much as pbrt, which has to make up for its grid spacing.
    */
  def of(lens: LensSystem, diagonal: Double): ExitPupil =
    val round = lens.withRoundStop
    val reach = 1.5 * round.rearAperture
    val margin = 2 * Math.sqrt(2.0) * 2 * reach / 1024
    val halfDiagonal = diagonal / 2
    var area = Region(-reach, reach, reach)
    var isDark = false
    val bounds = new Array[Double](4 * Rings)
    for ring <- 0 until Rings do
      val radii = Vector(ring.toDouble, ring + 0.5, ring + 1.0).map(_ / Rings * halfDiagonal)
      val pupil = if isDark then None else search(round, radii, area)
      pupil match
        case Some(r) =>
          store(bounds, ring, r.x0 - margin, r.x1 + margin, r.top + margin)
          val padding = Math.max((r.x1 - r.x0) / 2, 2 * halfDiagonal / Rings)
          area = Region(
            Math.max(-reach, r.x0 - padding),
            Math.min(reach, r.x1 + padding),
            Math.min(reach, r.top + padding)
          )
        case None =>
          isDark = true // and so are all rings further out
          store(bounds, ring, 1.0, -1.0, 0.0)
    ExitPupil(
      bounds,
      halfDiagonal,
      () => sampled(round, halfDiagonal / Rings, bounds, reach, margin)
    )

  /** The area that pbrt-v3 finds for the innermost ring, by which it divides.
    *
    * It bounds those of 2²⁰ points on the rear surface that light passes, each for another position
    * on the film, and pads the bounds. They are smaller than the exact ones if the pupil is small,
    * since few points are within.
    */
  private def sampled(
      lens: LensSystem,
      width: Double,
      exact: Array[Double],
      reach: Double,
      margin: Double
  ): Double =
    val ray = new Array[Double](6)
    var x0, y0 = Double.PositiveInfinity
    var x1, y1 = Double.NegativeInfinity
    loop(SearchPoints): i =>
      val x = reach * (2 * (Integer.reverse(i) >>> 12) / SearchPoints.toDouble - 1)
      val y = reach * (2 * inverse3(i) - 1)
      // No light passes outside of the exact bounds
      val isNear = x >= exact(0) && x <= exact(1) && y >= exact(2) && y <= exact(3)
      if isNear && !(x >= x0 && x <= x1 && y >= y0 && y <= y1) then
        val radius = (i + 0.5) / SearchPoints * width
        if passes(lens, ray, radius, x, y) then
          x0 = Math.min(x0, x)
          x1 = Math.max(x1, x)
          y0 = Math.min(y0, y)
          y1 = Math.max(y1, y)
    if x0 > x1 then square(2 * reach) // without a point, pbrt takes all
    else (x1 - x0 + 2 * margin) * (y1 - y0 + 2 * margin)

  private inline val SearchPoints = 1 << 20

  /** The radical inverse in base 3. */
  private def inverse3(i: Int): Double =
    var remaining = i
    var digits = 0L
    var scale = 1L
    while remaining > 0 do
      digits = digits * 3 + remaining % 3
      scale *= 3
      remaining /= 3
    digits.toDouble / scale.toDouble

  private def store(to: Array[Double], ring: Int, x0: Double, x1: Double, top: Double): Unit =
    to(4 * ring) = x0
    to(4 * ring + 1) = x1
    to(4 * ring + 2) = -top
    to(4 * ring + 3) = top

  /** Does light pass from `radius` on the film through (x, y) on the rear surface?
    *
    * @param ray scratch
    */
  private def passes(
      lens: LensSystem,
      ray: Array[Double],
      radius: Double,
      x: Double,
      y: Double
  ): Boolean =
    ray(0) = radius
    ray(1) = 0
    ray(2) = 0
    ray(3) = x - radius
    ray(4) = y
    ray(5) = lens.rearZ
    lens.fromFilm(ray) > 0

  /** From x0 to x1, and up to ±top. */
  private final case class Region(x0: Double, x1: Double, top: Double)

  private def search(lens: LensSystem, radii: Vector[Double], area: Region): Option[Region] =
    var region = area
    var pupil = Option.empty[Region]
    var zooms = 0
    while zooms < MaxZooms do
      val cell = (region.x1 - region.x0) / CellsAcross
      val extents = radii.flatMap(scan(lens, _, region))
      pupil = Option.when(extents.nonEmpty):
        Region(extents.map(_.x0).min, extents.map(_.x1).max, extents.map(_.top).max)
      pupil match
        case Some(r)
            if r.x1 - r.x0 < MinCells * cell || r.top < MinCells / 2 * region.top / CellsUp =>
          region = Region(r.x0 - cell, r.x1 + cell, r.top + region.top / CellsUp)
          zooms += 1
        case _ => zooms = MaxZooms
    pupil

  /** Bounds of all rays from `radius` that pass. */
  private def scan(lens: LensSystem, radius: Double, region: Region): Option[Region] =
    val ray = new Array[Double](6)
    def passes(x: Double, y: Double): Boolean = this.passes(lens, ray, radius, x, y)
    val dx = (region.x1 - region.x0) / CellsAcross
    val dy = region.top / CellsUp
    def rim(inside: Double, outside: Double)(isIn: Double => Boolean): Double =
      var a = inside
      var b = outside
      for _ <- 1 to 12 do
        val middle = (a + b) / 2
        if isIn(middle) then a = middle else b = middle
      b
    var x0 = Double.PositiveInfinity
    var x1 = Double.NegativeInfinity
    var top = -1.0
    for row <- 0 to CellsUp do
      val y = row * dy
      val hits = (0 to CellsAcross).filter(i => passes(region.x0 + i * dx, y))
      if hits.nonEmpty then
        val left = region.x0 + hits.head * dx
        val right = region.x0 + hits.last * dx
        x0 = Math.min(x0, rim(left, left - dx)(passes(_, y)))
        x1 = Math.max(x1, rim(right, right + dx)(passes(_, y)))
        for i <- hits do
          val x = region.x0 + i * dx
          if y > top - dy then top = Math.max(top, rim(y, y + dy)(passes(x, _)))
    Option.when(x0 <= x1)(Region(x0, x1, top))
