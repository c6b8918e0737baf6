package candela.math

/** Storage for a [[Vec3]] in a record that a worker reuses: overwriting it allocates nothing. */
final class MutableVec3(var x: Float, var y: Float, var z: Float):
  def this() = this(0f, 0f, 0f)

  def set(v: Vec3): Unit =
    x = v.x
    y = v.y
    z = v.z

  infix def dot(v: Vec3): Float = x * v.x + y * v.y + z * v.z

  /** The present value. The JIT compiler keeps it in registers wherever it does not escape. */
  def toVec3: Vec3 = Vec3(x, y, z)
