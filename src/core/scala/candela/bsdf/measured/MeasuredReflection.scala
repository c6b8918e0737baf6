package candela.bsdf.measured

import candela.base.loop
import candela.bsdf.CosineSampled
import candela.color.Rgb
import candela.math.*

/** A BRDF from scattered measurements: a weighted average of nearby samples.
  *
  * Direction pairs map to points of the unit cube: (sin θi sin θo, the angle between the azimuths
  * over π, cos θi cos θo), which is invariant under exchange and rotation of the pair. Each
  * measurement has weight exp(−100 d²). The search radius grows until it contains three
  * measurements.
  *
  * @param points three coordinates of each measurement
  * @param values r, g, b of each, in sr⁻¹
  *
  * Source: PBRT 2nd ed., §8.6.1 (after Marschner et al., "Image-based BRDF measurement including
  * human skin", EGWR 1999).
  */
final class ScatteredReflection(points: Array[Float], values: Array[Float])
    extends CosineSampled:
  import ScatteredReflection.*
  private val count = points.length / 3

  // Uniform grid; cell c holds members(starts(c)) until members(starts(c + 1))
  private val starts = new Array[Int](Cells * Cells * Cells + 1)
  private val members = new Array[Int](count)

  loop(count)(i => starts(cellOf(i) + 1) += 1)
  loop(starts.length - 1)(c => starts(c + 1) += starts(c))
  private val filled = starts.clone
  loop(count): i =>
    val cell = cellOf(i)
    members(filled(cell)) = i
    filled(cell) += 1

  private def cellOf(i: Int): Int =
    (cell(points(3 * i + 2)) * Cells + cell(points(3 * i + 1))) * Cells + cell(points(3 * i))

  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val x = pair(wo, wi)
    var radius2 = FirstRadius2
    var isDone = false
    var result = Rgb.Black
    while !isDone do
      var r, g, b, weights = 0f
      var n = 0
      val radius = sqrt(radius2)
      var k = cell(x.z - radius)
      while k <= cell(x.z + radius) do
        var j = cell(x.y - radius)
        while j <= cell(x.y + radius) do
          val row = (k * Cells + j) * Cells
          var slot = starts(row + cell(x.x - radius))
          val end = starts(row + cell(x.x + radius) + 1)
          while slot < end do
            val i = members(slot)
            val d2 = square(points(3 * i) - x.x) + square(points(3 * i + 1) - x.y) +
              square(points(3 * i + 2) - x.z)
            if d2 < radius2 then
              val weight = exp(-100f * d2)
              r += weight * values(3 * i)
              g += weight * values(3 * i + 1)
              b += weight * values(3 * i + 2)
              weights += weight
              n += 1
            slot += 1
          j += 1
        k += 1
      if n > 2 || radius2 > LastRadius2 then
        isDone = true
        if weights > 0f then
          result = Rgb(Math.max(r, 0f), Math.max(g, 0f), Math.max(b, 0f)) * (1f / weights)
      radius2 *= 2f
    result

object ScatteredReflection:
  private inline val Cells = 24
  private inline val FirstRadius2 = 0.001f
  private inline val LastRadius2 = 1.5f

  private def cell(x: Float): Int = clamp(x * Cells, 0f, (Cells - 1).toFloat).toInt

  /** Maps a pair of directions to the unit cube. */
  def pair(wo: Vec3, wi: Vec3): Vec3 =
    val sinO = safeSqrt(1f - wo.z * wo.z)
    val sinI = safeSqrt(1f - wi.z * wi.z)
    val turn = Math.abs(Math.atan2(wi.y, wi.x) - Math.atan2(wo.y, wo.x)).toFloat
    val angle = if turn > Pi then TwoPi - turn else turn
    Vec3(sinI * sinO, angle / Pi, wi.z * wo.z)

/** A BRDF tabulated over the half vector's angle to the normal (90 rows, denser towards the
  * highlight) and the light's direction around the half vector (90 polar, 180 azimuthal angles).
  *
  * @param values r, g, b of each entry in sr⁻¹, the azimuth fastest
  *
  * Source: Matusik et al., "A Data-Driven Reflectance Model", SIGGRAPH 2003 (the MERL database).
  */
final class HalfAngleReflection(values: Array[Float]) extends CosineSampled:
  import HalfAngleReflection.*

  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val across = wo + wi
    val sum = if across.z < 0f then -across else across
    if sum.isZero then Rgb.Black
    else
      val light = if across.z < 0f then -wi else wi
      val h = sum.normalized
      val sine = safeSqrt(1f - h.z * h.z)
      val c = if sine > 0f then h.x / sine else 1f
      val s = if sine > 0f then h.y / sine else 0f
      // The light in a frame around the half vector
      val x = light.x * c * h.z + light.y * s * h.z - light.z * sine
      val y = light.y * c - light.x * s
      val z = light dot h
      val azimuth = Math.atan2(y, x).toFloat
      val folded = if azimuth < 0f then azimuth + Pi else azimuth
      val row = index(sqrt(acos(h.z) / (Pi / 2)), HalfAngles)
      val polar = index(acos(z) / (Pi / 2), Polar)
      val offset = 3 * (index(folded / Pi, Azimuths) + Azimuths * (polar + row * Polar))
      Rgb(values(offset), values(offset + 1), values(offset + 2))

object HalfAngleReflection:
  val HalfAngles = 90
  val Polar = 90
  val Azimuths = 180

  private def index(fraction: Float, count: Int): Int =
    clamp(fraction * count.toFloat, 0f, (count - 1).toFloat).toInt
  private def acos(x: Float): Float = Math.acos(clamp(x, -1f, 1f).toDouble).toFloat
