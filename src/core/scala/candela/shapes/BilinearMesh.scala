package candela.shapes

import candela.geometry.{Hit, Ray}
import candela.math.*

/** Bilinear patches in world space: p(u, v) interpolates the corners p00, p10, p01, p11 linearly in
  * u and in v. Edges are straight, so neighbours meet without a gap.
  *
  * @param positions x, y, z per vertex
  * @param indices   four vertices per patch, in the order p00, p10, p01, p11
  * @param normals   three Floats per vertex, any length; empty without normals
  * @param uvs       two Floats per vertex; empty to use the patch's own u and v
  * @param flipped   whether the geometric normal is −∂p/∂u × ∂p/∂v
  */
final class BilinearMesh(
    val positions: Array[Float],
    val indices: Array[Int],
    val normals: Array[Float],
    val uvs: Array[Float],
    val flipped: Boolean
):
  def count: Int = indices.length / 4

  def vertex(patch: Int, corner: Int): Vec3 =
    val i = 3 * indices(4 * patch + corner)
    Vec3(positions(i), positions(i + 1), positions(i + 2))

  /** Tests for a hit on the patch in (0, `ray.tMax`). If `write`, sets `ray.tMax` to its distance,
    * and `hit.u` and `hit.v` to its position on the patch.
    *
    * The lines of constant u that the ray hits have u that solve a quadratic equation (Reshetov,
    * "Cool Patches: A Geometric Approach to Ray/Bilinear Patch Intersections", Ray Tracing Gems,
    * 2019). In Double: rounding leaves gaps at edges of 1e-16 of the distance, which the margins
    * around u and v cover.
    */
  inline def test(patch: Int, ray: Ray, hit: Hit, inline write: Boolean): Boolean =
    val p = positions
    val i0 = 3 * indices(4 * patch)
    val i1 = 3 * indices(4 * patch + 1)
    val i2 = 3 * indices(4 * patch + 2)
    val i3 = 3 * indices(4 * patch + 3)
    val dx = ray.dx.toDouble
    val dy = ray.dy.toDouble
    val dz = ray.dz.toDouble
    // p(u, v) − origin = a + u·e + v·f + u·v·g
    val ax = p(i0).toDouble - ray.ox
    val ay = p(i0 + 1).toDouble - ray.oy
    val az = p(i0 + 2).toDouble - ray.oz
    val ex = p(i1).toDouble - p(i0)
    val ey = p(i1 + 1).toDouble - p(i0 + 1)
    val ez = p(i1 + 2).toDouble - p(i0 + 2)
    val fx = p(i2).toDouble - p(i0)
    val fy = p(i2 + 1).toDouble - p(i0 + 1)
    val fz = p(i2 + 2).toDouble - p(i0 + 2)
    val gx = p(i3).toDouble - p(i2) - ex
    val gy = p(i3 + 1).toDouble - p(i2 + 1) - ey
    val gz = p(i3 + 2).toDouble - p(i2 + 2) - ez
    // q = f × d, r = g × d
    val qx = fy * dz - fz * dy
    val qy = fz * dx - fx * dz
    val qz = fx * dy - fy * dx
    val rx = gy * dz - gz * dy
    val ry = gz * dx - gx * dz
    val rz = gx * dy - gy * dx
    val c2 = ex * rx + ey * ry + ez * rz
    val c1 = ex * qx + ey * qy + ez * qz + ax * rx + ay * ry + az * rz
    val c0 = ax * qx + ay * qy + az * qz
    val discriminant = c1 * c1 - 4 * c2 * c0
    if !(discriminant >= 0.0) then false
    else
      val root = Math.sqrt(discriminant)
      val s = if c1 < 0.0 then 0.5 * (root - c1) else -0.5 * (root + c1)
      val d2 = dx * dx + dy * dy + dz * dz
      // A ray that starts on the patch, with pError 0 as in a plane z = 0, hits it at distance 0 up
      // to the rounding of these coordinates
      val minDistance = BilinearMesh.Rounding * (Math.abs(ax) + Math.abs(ay) + Math.abs(az) +
        Math.abs(ex) + Math.abs(ey) + Math.abs(ez) + Math.abs(fx) + Math.abs(fy) + Math.abs(fz) +
        Math.abs(gx) + Math.abs(gy) + Math.abs(gz))
      var bestT = ray.tMax.toDouble
      var bestU = -1.0
      var bestV = 0.0
      var k = 0
      while k < 2 do
        val u = if k == 0 then s / c2 else c0 / s
        if u >= -BilinearMesh.Margin && u <= 1.0 + BilinearMesh.Margin then
          val nx = qx + u * rx
          val ny = qy + u * ry
          val nz = qz + u * rz
          val bx = ax + u * ex
          val by = ay + u * ey
          val bz = az + u * ez
          val n2 = nx * nx + ny * ny + nz * nz
          // (b × d) · n
          val across = (by * dz - bz * dy) * nx + (bz * dx - bx * dz) * ny +
            (bx * dy - by * dx) * nz
          val v = -across / n2
          if v >= -BilinearMesh.Margin && v <= 1.0 + BilinearMesh.Margin then
            val t =
              ((bx + v * (fx + u * gx)) * dx + (by + v * (fy + u * gy)) * dy +
                (bz + v * (fz + u * gz)) * dz) / d2
            if t < bestT && t * t * d2 > minDistance * minDistance && t > 0.0 then
              bestT = t
              bestU = u
              bestV = v
        k += 1
      val stored = bestT.toFloat
      val isHit = bestU > -0.5 && stored < ray.tMax
      if write then
        if isHit then
          ray.tMax = stored
          hit.u = BilinearMesh.unit(bestU)
          hit.v = BilinearMesh.unit(bestV)
      isHit

object BilinearMesh:
  /** Margin by which a patch extends past its edges, in u and v. */
  private[shapes] inline val Margin = 1e-6

  /** Rounding error of a distance, relative to the coordinates: a million times that of Double, and
    * far below that of Float.
    */
  private[shapes] inline val Rounding = 1e-10

  private[shapes] def unit(x: Double): Double = Math.max(0.0, Math.min(1.0, x))
