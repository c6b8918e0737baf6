package candela.moving

import candela.math.{Position, Transform}

/** Where a camera is and looks, as `LookAt` says it. Immutable.
  *
  * @param target what it turns around; in the middle of the picture
  * @param up     a direction, upwards in the picture
  * @param axis   that upright things of the scene have: horizontal turns are about it
  * @param inside from the space of `LookAt` to that of the camera: a mirroring, a scale
  */
final case class CameraPose(
    eye: Position,
    target: Position,
    up: Position,
    axis: Position,
    inside: Transform
):
  import CameraPose.*

  def distance: Double = eye.distance(target)
  def forward: Position = unit(target - eye)

  /** Rightwards in the space of `LookAt`, with `above` upwards. */
  def right: Position = unit(cross(up, forward))
  def above: Position = cross(forward, right)

  /** Whether the picture is mirrored. */
  def isMirrored: Boolean = inside.swapsHandedness

  /** Turns around a point, as if the scene were turned.
    *
    * @param around degrees about the axis; the front goes to the right of the picture
    * @param rise   degrees by which the eye rises
    * @param pivot  the point
    */
  def orbited(around: Double, rise: Double, pivot: Position): CameraPose =
    val side = if isMirrored then -1 else 1
    val tilt = Math.toDegrees(Math.acos(clamp(dot(forward, axis), -1, 1)))
    // Beyond the poles, up would be down
    val lifted =
      if rise == 0 then 0 else clamp(tilt + rise, NearestPole, 180 - NearestPole) - tilt
    val turn = rotation(side * around, axis) * rotation(lifted, right)
    def turned(v: Position) = turn.position(v)
    copy(
      eye = pivot + turned(eye - pivot),
      target = pivot + turned(target - pivot),
      up = turned(up)
    )

  /** Moved along a vector. */
  def moved(by: Position): CameraPose = copy(eye = eye + by, target = target + by)

  /** With the target, at the end of the line of sight, at another distance. */
  def lookingAt(distance: Double): CameraPose = copy(target = eye + forward * distance)

  /** The distance to the target divided by a factor. */
  def nearer(factor: Double): CameraPose = copy(eye = target - (target - eye) * (1 / factor))

  /** The numbers of `LookAt`: those that don't matter in a picture are rounded off. */
  def numbers: Vector[Double] =
    val decimals = Digits - Math.floor(Math.log10(distance)).toInt
    val isUpright = Math.abs(dot(right, axis)) < 1e-6 && dot(above, axis) > 0
    val upwards = if isUpright then axis else above
    Vector(eye, target).flatMap(coordinates).map(rounded(_, decimals)) ++
      coordinates(upwards).map(rounded(_, Digits))

object CameraPose:

  /** The pose of a camera.
    *
    * @param distance to its target
    */
  def of(toCamera: Transform, distance: Double): CameraPose =
    val toWorld = toCamera.inverse
    val eye = toWorld.position(Position.Origin)
    def direction(x: Double, y: Double, z: Double) = unit(toWorld.position(Position(x, y, z)) - eye)
    val (forward, up) = (direction(0, 0, 1), direction(0, 1, 0))
    val target = eye + forward * distance
    val view = lookAt(eye, target, up)
    CameraPose(eye, target, up, nearestAxis(up), snapped(toCamera * view.inverse))

  private def lookAt(eye: Position, target: Position, up: Position): Transform =
    Transform.lookAt(coordinates(eye), coordinates(target), coordinates(up))
      .getOrElse(Transform.Identity)

  /** That of the coordinates' axes that points most into a direction. */
  private def nearestAxis(v: Position): Position =
    val axes = for s <- Vector(1.0, -1.0); i <- 0 to 2 yield axis(i, s)
    axes.maxBy(dot(_, v))

  private def axis(i: Int, length: Double): Position =
    def at(k: Int) = if i == k then length else 0.0
    Position(at(0), at(1), at(2))

  /** Without the rounding of the inverse. */
  private def snapped(t: Transform): Transform =
    val scale = Vector(0, 1, 2, 4, 5, 6, 8, 9, 10).map(i => Math.abs(t.m(i))).max
    val largest = if Math.abs(scale - 1) < 1e-9 then 1.0 else scale
    val rows = Vector.tabulate(16): i =>
      val x = t.m(i)
      val multiple = Math.rint(x / largest) * largest
      val isLinear = i < 12 && i % 4 != 3
      if !isLinear then (if i == 15 then 1.0 else 0.0)
      else if Math.abs(x - multiple) < 1e-9 * largest then multiple + 0.0
      else significant(x)
    Transform.fromRows(rows).getOrElse(t)

  /** Significant digits of positions, in relation to the distance of the target, and of directions.
    */
  private val Digits = 6

  /** From a pole, in degrees. */
  private val NearestPole = 0.5

  private def significant(x: Double): Double =
    java.math.BigDecimal(x).round(java.math.MathContext(2 * Digits)).doubleValue

  private[moving] def rounded(x: Double, decimals: Int): Double =
    val scaled = java.math.BigDecimal(x).setScale(decimals, java.math.RoundingMode.HALF_EVEN)
    scaled.doubleValue + 0.0

  private def rotation(degrees: Double, about: Position): Transform =
    Transform.rotate(degrees, about.x, about.y, about.z).getOrElse(Transform.Identity)

  private def clamp(x: Double, least: Double, most: Double) = Math.max(least, Math.min(most, x))

  def coordinates(p: Position): Vector[Double] = Vector(p.x, p.y, p.z)
  def dot(a: Position, b: Position): Double = a.x * b.x + a.y * b.y + a.z * b.z
  def cross(a: Position, b: Position): Position =
    Position(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
  def unit(v: Position): Position = v * (1 / Math.sqrt(dot(v, v)))

  extension (a: Position)
    def +(b: Position): Position = Position(a.x + b.x, a.y + b.y, a.z + b.z)
    def -(b: Position): Position = Position(a.x - b.x, a.y - b.y, a.z - b.z)
    def *(s: Double): Position = Position(a.x * s, a.y * s, a.z * s)
