package candela.accel.tracing

import candela.base.loop
import candela.accel.{Accelerator, Primitives}
import candela.geometry.{Bounds3, Hit, Ray}
import candela.math.*

/** A uniform grid, traversed voxel by voxel.
  *
  * Source: Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics
  * 1987; the resolution, 3·∛n voxels along the longest side, as in PBRT's `grid`. PBRT limits a
  * side to 64 voxels; here the limit is four voxels per primitive, if that is more.
  *
  * All positions are relative to the lower corner, so that a grid far from the origin loses no
  * precision. A primitive is listed in every voxel that its box overlaps, padded by a hundredth of
  * a voxel against Float rounding; the traversal itself is in Double (stability suite: rays from
  * afar).
  */
final class Grid(primitives: Primitives) extends Accelerator:
  val bounds: Bounds3 = Accelerator.union(primitives.bounds)
  private val packed = primitives.packed(Array.range(0, primitives.count))

  private val resolution: Array[Int] =
    val extent = bounds.extent
    val longest = Math.max(extent.x, Math.max(extent.y, extent.z))
    val perUnit =
      if longest > 0f then (3.0 * Math.cbrt(primitives.count.toDouble) / longest).toFloat else 0f
    val maxResolution = Math.max(64, Math.cbrt(Grid.VoxelsPerPrimitive * primitives.count).toInt)
    Array.tabulate(3)(k => clamp(Math.round(extent(k) * perUnit), 1, maxResolution))

  private val width: Array[Float] = Array.tabulate(3)(k => bounds.extent(k) / resolution(k))
  private val voxels = resolution.product

  /** cells(starts(i)) until cells(starts(i + 1)): the primitives in voxel i, x fastest. */
  private val starts = new Array[Int](voxels + 1)
  private val cells: Array[Int] =
    if primitives.count == 0 then Array.empty else fill(primitives.bounds)

  def describe: String =
    val voxels = resolution.mkString("×")
    s"grid: ${primitives.count} primitives in $voxels voxels, ${cells.length} entries"

  private def fill(boxes: Array[Float]): Array[Int] =
    loop(primitives.count)(i => overlapped(boxes, i)(v => starts(v + 1) += 1))
    loop(voxels): v =>
      if starts(v + 1) > Int.MaxValue - starts(v) then
        throw IllegalStateException("the grid's primitive lists exceed the maximum array length")
      starts(v + 1) += starts(v)
    val offsets = starts.clone()
    val entries = new Array[Int](starts(voxels))
    loop(primitives.count): i =>
      overlapped(boxes, i): v =>
        entries(offsets(v)) = i
        offsets(v) += 1
    entries

  private inline def overlapped(boxes: Array[Float], i: Int)(inline body: Int => Unit): Unit =
    val x0 = voxelOf(boxes, i, 0, -0.01f)
    val y0 = voxelOf(boxes, i, 1, -0.01f)
    val z0 = voxelOf(boxes, i, 2, -0.01f)
    val x1 = voxelOf(boxes, i, 3, 0.01f)
    val y1 = voxelOf(boxes, i, 4, 0.01f)
    val z1 = voxelOf(boxes, i, 5, 0.01f)
    var z = z0
    while z <= z1 do
      var y = y0
      while y <= y1 do
        var x = x0
        while x <= x1 do
          body((z * resolution(1) + y) * resolution(0) + x)
          x += 1
        y += 1
      z += 1

  /** Voxel index, along its axis, of the box side `side` (0–2 lower, 3–5 upper), offset by `pad`
    * voxels.
    */
  private def voxelOf(boxes: Array[Float], i: Int, side: Int, pad: Float): Int =
    val axis = side % 3
    if width(axis) > 0f then
      val position = (boxes(6 * i + side) - bounds.min(axis)) / width(axis) + pad
      clamp(Math.floor(position).toInt, 0, resolution(axis) - 1)
    else 0

  def closest(ray: Ray, hit: Hit): Boolean =
    hit.primitive = -1
    traverse(ray, hit, anyHit = false)

  def isOccluded(ray: Ray, hit: Hit): Boolean = traverse(ray, hit, anyHit = true)

  private inline def traverse(ray: Ray, hit: Hit, inline anyHit: Boolean): Boolean =
    var hasHit = false
    val entry = enter(ray)
    if entry >= 0.0 then
      // Relative to the grid's corner; in Double, as rays may start a million grid sizes away
      val ox = ray.ox.toDouble - bounds.min.x
      val oy = ray.oy.toDouble - bounds.min.y
      val oz = ray.oz.toDouble - bounds.min.z
      var x = start(ox + entry * ray.dx, 0)
      var y = start(oy + entry * ray.dy, 1)
      var z = start(oz + entry * ray.dz, 2)
      val stepX = if ray.dx < 0f then -1 else 1
      val stepY = if ray.dy < 0f then -1 else 1
      val stepZ = if ray.dz < 0f then -1 else 1
      // Distance to the next voxel boundary on each axis, and between two boundaries
      var nextX = wall(x, stepX, 0, ox, ray.dx)
      var nextY = wall(y, stepY, 1, oy, ray.dy)
      var nextZ = wall(z, stepZ, 2, oz, ray.dz)
      val deltaX = Math.abs(width(0) / ray.dx.toDouble)
      val deltaY = Math.abs(width(1) / ray.dy.toDouble)
      val deltaZ = Math.abs(width(2) / ray.dz.toDouble)
      var going = true
      while going do
        val voxel = (z * resolution(1) + y) * resolution(0) + x
        var slot = starts(voxel)
        val end = starts(voxel + 1)
        while slot < end && going do
          val primitive = cells(slot)
          inline if anyHit then
            if packed.isHit(primitive, primitive + 1, ray, hit) then
              hasHit = true
              going = false
          else if packed.intersect(primitive, primitive + 1, ray, hit) then hasHit = true
          slot += 1
        if going then
          // `tMax` is the closest hit: voxels past the next boundary hold none closer
          if nextX <= nextY && nextX <= nextZ then
            x += stepX
            going = nextX <= ray.tMax && x >= 0 && x < resolution(0)
            nextX += deltaX
          else if nextY <= nextZ then
            y += stepY
            going = nextY <= ray.tMax && y >= 0 && y < resolution(1)
            nextY += deltaY
          else
            z += stepZ
            going = nextZ <= ray.tMax && z >= 0 && z < resolution(2)
            nextZ += deltaZ
    hasHit

  /** Distance at which the ray enters the grid, 0 if it starts inside; −1 if it misses. */
  private def enter(ray: Ray): Double =
    var tNear = 0.0
    var tFar = ray.tMax.toDouble
    loop(3): k =>
      val o = if k == 0 then ray.ox else if k == 1 then ray.oy else ray.oz
      val d = if k == 0 then ray.dx else if k == 1 then ray.dy else ray.dz
      val i = 1.0 / d
      val a = (bounds.min(k).toDouble - o) * i
      val b = (bounds.max(k).toDouble - o) * i
      val (t0, t1) = if i < 0.0 then (b, a) else (a, b)
      if t0 > tNear then tNear = t0
      if t1 * Slack < tFar then tFar = t1 * Slack
    if tNear <= tFar && primitives.count > 0 then tNear else -1.0

  /** Enlarges the box slightly, for rays at grazing incidence. */
  private inline val Slack = 1.0000004

  private def start(p: Double, axis: Int): Int =
    if width(axis) > 0f then
      clamp(Math.floor(p / width(axis)).toInt, 0, resolution(axis) - 1)
    else 0

  private def wall(i: Int, step: Int, axis: Int, o: Double, d: Float): Double =
    if d == 0f || width(axis) <= 0f then Double.PositiveInfinity
    else ((if step > 0 then i + 1 else i) * width(axis).toDouble - o) / d

object Grid:
  /** Limit for large sets. */
  private val VoxelsPerPrimitive = 4.0
