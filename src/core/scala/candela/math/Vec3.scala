package candela.math

/** A point, vector or normal: three Floats. The name of a value tells which; [[Transform]] has one
  * method for each.
  *
  * Read-only, and immutable unless created as a [[MutableVec3]]: reused records such as
  * [[candela.geometry.ShadingPoint]] hold those, and the types of their members say so, which
  * `ArchitectureSuite` checks. A method may read any `Vec3`; code that keeps a possibly mutable one
  * must keep its [[toVec3]]. What the methods here return is immutable.
  */
sealed class Vec3(startX: Float, startY: Float, startZ: Float):
  private[math] var ownX = startX
  private[math] var ownY = startY
  private[math] var ownZ = startZ

  final def x: Float = ownX
  final def y: Float = ownY
  final def z: Float = ownZ

  def +(b: Vec3): Vec3 = Vec3(x + b.x, y + b.y, z + b.z)
  def -(b: Vec3): Vec3 = Vec3(x - b.x, y - b.y, z - b.z)
  def *(s: Float): Vec3 = Vec3(x * s, y * s, z * s)
  def unary_- : Vec3 = Vec3(-x, -y, -z)

  infix def dot(b: Vec3): Float = x * b.x + y * b.y + z * b.z
  infix def absDot(b: Vec3): Float = Math.abs(dot(b))

  /** Cross product, exact to 1.5 ulp per component also for nearly parallel vectors. */
  infix def cross(b: Vec3): Vec3 = Vec3(
    differenceOfProducts(y, b.z, z, b.y),
    differenceOfProducts(z, b.x, x, b.z),
    differenceOfProducts(x, b.y, y, b.x)
  )

  def lengthSquared: Float = x * x + y * y + z * z
  def length: Float = sqrt(lengthSquared)

  /** Unit vector; NaN for the zero vector. Computed in Double: lengths of 1e±30 neither over- nor
    * underflow.
    */
  def normalized: Vec3 =
    val dx = x.toDouble
    val dy = y.toDouble
    val dz = z.toDouble
    val s = 1.0 / Math.sqrt(dx * dx + dy * dy + dz * dz)
    Vec3((dx * s).toFloat, (dy * s).toFloat, (dz * s).toFloat)

  def isZero: Boolean = x == 0f && y == 0f && z == 0f
  def isFinite: Boolean =
    java.lang.Float.isFinite(x) && java.lang.Float.isFinite(y) && java.lang.Float.isFinite(z)

  /** This vector, negated if necessary to be in the hemisphere of `n`. */
  def facing(n: Vec3): Vec3 =
    val sign = if dot(n) < 0f then -1f else 1f
    Vec3(x * sign, y * sign, z * sign)

  /** The current value: this vector itself, if it is immutable. */
  def toVec3: Vec3 = this

  def apply(axis: Int): Float = if axis == 0 then x else if axis == 1 then y else z

  override def equals(other: Any): Boolean = other match
    case b: Vec3 => x == b.x && y == b.y && z == b.z
    case _ => false
  override def hashCode: Int = (x, y, z).hashCode
  override def toString: String = s"($x, $y, $z)"

/** A vector in a record that a worker reuses: overwriting it does not allocate. */
final class MutableVec3(x0: Float, y0: Float, z0: Float) extends Vec3(x0, y0, z0):
  def this() = this(0f, 0f, 0f)

  def set(v: Vec3): Unit =
    ownX = v.x
    ownY = v.y
    ownZ = v.z

  def set(x: Float, y: Float, z: Float): Unit =
    ownX = x
    ownY = y
    ownZ = z

  override def toVec3: Vec3 = Vec3(x, y, z)

object Vec3:
  val Zero: Vec3 = Vec3(0f, 0f, 0f)
  val X: Vec3 = Vec3(1f, 0f, 0f)
  val Y: Vec3 = Vec3(0f, 1f, 0f)
  val Z: Vec3 = Vec3(0f, 0f, 1f)
