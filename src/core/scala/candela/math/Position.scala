package candela.math

/** A point in Double. Far from the origin, Floats are too coarse. */
final case class Position(x: Double, y: Double, z: Double):
  def isOrigin: Boolean = x == 0 && y == 0 && z == 0

  /** The largest coordinate's magnitude. */
  def reach: Double = Math.max(Math.abs(x), Math.max(Math.abs(y), Math.abs(z)))

  def distance(p: Position): Double =
    Math.sqrt((p.x - x) * (p.x - x) + (p.y - y) * (p.y - y) + (p.z - z) * (p.z - z))

  def *(s: Float): Position =
    if this eq Position.Origin then this else Position(x * s, y * s, z * s)

  /** The translation that moves the origin here. */
  def fromOrigin: Transform = Transform.translate(x, y, z)

  /** The translation that moves this point to the origin. */
  def toOrigin: Transform = Transform.translate(-x, -y, -z)

object Position:
  val Origin: Position = Position(0, 0, 0)
