package candela.geometry

import candela.math.*

/** A ray with a maximum distance, and precomputed values for intersection tests.
  *
  * Mutable, one per worker and purpose: kernels read its fields, so tracing a ray allocates
  * nothing. `tMax` shrinks to the closest hit found so far.
  */
final class Ray:
  var ox, oy, oz = 0f
  var dx, dy, dz = 0f
  var tMax = 0f

  /** 1/direction; infinite where a component is zero. */
  var invX, invY, invZ = 0f

  /** The axis of the largest direction component, and the other two in an order that preserves
    * handedness; with the shear that aligns the ray with +z. Source: Woop, Benthin, Wald,
    * "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
    */
  var kx, ky, kz = 0
  var shearX, shearY, shearZ = 0f

  /** The origin along kx, ky and kz, and the direction along kz. */
  var oAlongX, oAlongY, oAlongZ, dAlongZ = 0f

  private var entries = Array.emptyLongArray

  /** Traversal stack, with room for so many entries at least. A rendering in wavelengths has
    * thousands of rays, so none has more than trees need.
    */
  def stack(size: Int): Array[Long] =
    if entries.length < size then entries = new Array[Long](size)
    entries

  /** Scratch memory of a traversal: results for the children of a node. */
  val lanes: Array[Int] = new Array[Int](16)

  /** Set only if textures need it. */
  val differential: RayDifferential = RayDifferential()

  /** Origin along an axis. */
  inline def along(axis: Int): Float = if axis == 0 then ox else if axis == 1 then oy else oz

  def origin: Vec3 = Vec3(ox, oy, oz)
  def direction: Vec3 = Vec3(dx, dy, dz)
  def at(t: Float): Vec3 = Vec3(ox + t * dx, oy + t * dy, oz + t * dz)

  /** Time of the ray, in the scene's unit of time; [[set]] leaves it unchanged. Used only with
    * motion.
    */
  var time = 0f

  /** Is this a camera's ray, whose origin is not offset from any surface? A camera may stand in the
    * plane of a surface. [[set]] makes it false.
    */
  var isPrimary = false

  /** Does the ray see no sky? [[set]] makes it false. */
  var hidesSky = false

  /** Weight of a camera ray; set only by cameras that weight their rays. */
  var weight = 1f

  private var nestedRay: Option[Ray] = None
  private var matrices: Array[Double] = Array.empty

  /** A ray for traversing an instance, in its object space; created on first use. */
  def nested: Ray =
    if nestedRay.isEmpty then nestedRay = Some(Ray())
    nestedRay.get

  /** Scratch memory for a transform at the ray's time; created on first use. */
  def space: Array[Double] =
    if matrices.length == 0 then matrices = new Array[Double](Motion.Work)
    matrices

  def set(origin: Vec3, direction: Vec3, end: Float): Unit =
    set(origin.x, origin.y, origin.z, direction.x, direction.y, direction.z, end)

  def set(ox: Float, oy: Float, oz: Float, dx: Float, dy: Float, dz: Float, end: Float): Unit =
    this.ox = ox
    this.oy = oy
    this.oz = oz
    this.dx = dx
    this.dy = dy
    this.dz = dz
    tMax = end
    isPrimary = false
    hidesSky = false
    invX = 1f / dx
    invY = 1f / dy
    invZ = 1f / dz
    val ax = Math.abs(dx)
    val ay = Math.abs(dy)
    val az = Math.abs(dz)
    // One branch of three, and one of two: neither can be predicted
    if ax > ay && ax > az then align(0, 1, 2, ox, oy, oz, dx, dy, dz, invX)
    else if ax <= ay && ay > az then align(1, 2, 0, oy, oz, ox, dy, dz, dx, invY)
    else align(2, 0, 1, oz, ox, oy, dz, dx, dy, invZ)

  /** Makes z the axis of the largest direction component, x and y the two that follow. */
  private inline def align(
      z: Int,
      x: Int,
      y: Int,
      oz: Float,
      ox: Float,
      oy: Float,
      dz: Float,
      dx: Float,
      dy: Float,
      inverse: Float
  ): Unit =
    kz = z
    oAlongZ = oz
    dAlongZ = dz
    shearZ = inverse
    if dz < 0f then alignAcross(y, x, oy, ox, dy, dx, dz) else alignAcross(x, y, ox, oy, dx, dy, dz)

  private inline def alignAcross(
      x: Int,
      y: Int,
      ox: Float,
      oy: Float,
      dx: Float,
      dy: Float,
      dz: Float
  ): Unit =
    kx = x
    ky = y
    oAlongX = ox
    oAlongY = oy
    shearX = -dx / dz
    shearY = -dy / dz
