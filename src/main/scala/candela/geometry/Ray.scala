package candela.geometry

import candela.math.*

/** A half-line with an end, and what every intersection test wants to know of its direction.
  *
  * Mutable, one per worker and purpose: the kernels read its fields, so that tracing a ray
  * allocates nothing. `tMax` shrinks to the closest hit found so far.
  */
final class Ray:
  var ox, oy, oz = 0f
  var dx, dy, dz = 0f
  var tMax = 0f

  /** 1/direction; an infinity where a component is zero. */
  var invX, invY, invZ = 0f

  /** The axis along which the direction is longest, and the other two in an order that keeps the
    * handedness; with the shear that turns the ray into +z. Source: Woop, Benthin, Wald,
    * "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
    */
  var kx, ky, kz = 0
  var shearX, shearY, shearZ = 0f

  /** The origin along kx, ky and kz. */
  var oAlongX, oAlongY, oAlongZ = 0f

  /** Work space of an accelerator's walk: what is still to be visited. Deep enough for any tree
    * that the builder makes, of two children a node or of sixteen.
    */
  val stack: Array[Long] = new Array[Long](Ray.StackSize)

  /** Work space too: what a walk finds out about the children of a node, all at once. */
  val lanes: Array[Int] = new Array[Int](16)

  /** How often an accelerator has walked with it, as far as it counts. */
  var walks = 0

  /** Filled in only where textures ask for it. */
  val differential: RayDifferential = RayDifferential()

  /** Of the origin, by the number of the axis. */
  inline def along(axis: Int): Float = if axis == 0 then ox else if axis == 1 then oy else oz

  def origin: Vec3 = Vec3(ox, oy, oz)
  def direction: Vec3 = Vec3(dx, dy, dz)
  def at(t: Float): Vec3 = Vec3(ox + t * dx, oy + t * dy, oz + t * dz)

  /** When the ray is under way, in the scene's unit of time; [[set]] leaves it as it is. Only plans
    * with motion look at it.
    */
  var time = 0f

  /** Of the light along a camera ray; only cameras that weigh their rays set it. */
  var weight = 1f

  private var within: Option[Ray] = None
  private var matrices: Array[Double] = Array.empty

  /** A ray of its own for the way through something inside, in that thing's space; made when it is
    * first asked for.
    */
  def nested: Ray =
    if within.isEmpty then within = Some(Ray())
    within.get

  /** Work space for a map that holds at the ray's time; made when it is first asked for. */
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
    invX = 1f / dx
    invY = 1f / dy
    invZ = 1f / dz
    val ax = Math.abs(dx)
    val ay = Math.abs(dy)
    val az = Math.abs(dz)
    kz = if ax > ay then (if ax > az then 0 else 2) else if ay > az then 1 else 2
    kx = if kz == 2 then 0 else kz + 1
    ky = if kx == 2 then 0 else kx + 1
    val along = component(kz)
    oAlongZ = this.along(kz)
    if along < 0f then
      val swap = kx
      kx = ky
      ky = swap
    oAlongX = this.along(kx)
    oAlongY = this.along(ky)
    shearX = -component(kx) / along
    shearY = -component(ky) / along
    shearZ = 1f / along

  private def component(axis: Int): Float = if axis == 0 then dx else if axis == 1 then dy else dz

object Ray:
  /** 91 levels at most, each with 15 children that wait. */
  inline val StackSize = 1400
