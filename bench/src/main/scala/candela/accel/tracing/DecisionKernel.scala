package candela.accel.tracing

import jdk.incubator.vector.{DoubleVector, FloatVector, LongVector}

import candela.shapes.DoubtfulHit

/** Rays that pass inside triangles, and what [[candela.shapes.TriangleTest]] computes in Double to
  * decide about them, eight at a time, operation by operation.
  */
private[tracing] final class Decisions(most: Int):
  private val size = most + 8
  private def ints() = new Array[Int](size)
  private def doubles() = new Array[Double](size)

  /** Where the ray's record and the triangle's corners begin. */
  val ray, triangle: Array[Int] = ints()
  val b1, b2: Array[Double] = doubles()
  val t: Array[Float] = new Array[Float](size)

  /** Negative: the result is clear. */
  val clear: Array[Long] = new Array[Long](size)
  var count = 0

private[tracing] object DecisionKernel:
  import VertexKernel.{F, narrow, wide}

  private inline def corner(t: Array[Float], k: Int, which: Array[Int], i: Int): DoubleVector =
    wide(FloatVector.fromArray(F, t, k, which, i))

  private inline def sign(x: DoubleVector): LongVector = x.reinterpretAsLongs()

  def decide(d: Decisions, t: Array[Float], w: Int, rays: Array[Float]): Unit =
    var i = 0
    while i < d.count do
      val px = corner(t, 0, d.triangle, i)
      val py = corner(t, w, d.triangle, i)
      val pz = corner(t, 2 * w, d.triangle, i)
      val ax = corner(t, 3 * w, d.triangle, i).sub(px)
      val ay = corner(t, 4 * w, d.triangle, i).sub(py)
      val az = corner(t, 5 * w, d.triangle, i).sub(pz)
      val bx = corner(t, 6 * w, d.triangle, i).sub(px)
      val by = corner(t, 7 * w, d.triangle, i).sub(py)
      val bz = corner(t, 8 * w, d.triangle, i).sub(pz)
      val dx = corner(rays, StreamKernel.Direction, d.ray, i)
      val dy = corner(rays, StreamKernel.Direction + 1, d.ray, i)
      val dz = corner(rays, StreamKernel.Direction + 2, d.ray, i)
      val qx = dy.mul(bz).sub(dz.mul(by))
      val qy = dz.mul(bx).sub(dx.mul(bz))
      val qz = dx.mul(by).sub(dy.mul(bx))
      val volume = ax.mul(qx).add(ay.mul(qy)).add(az.mul(qz))
      val inverse = VertexKernel.all(1.0).div(volume)
      val sx = corner(rays, 0, d.ray, i).sub(px)
      val sy = corner(rays, 1, d.ray, i).sub(py)
      val sz = corner(rays, 2, d.ray, i).sub(pz)
      val rx = sy.mul(az).sub(sz.mul(ay))
      val ry = sz.mul(ax).sub(sx.mul(az))
      val rz = sx.mul(ay).sub(sy.mul(ax))
      val b1 = sx.mul(qx).add(sy.mul(qy)).add(sz.mul(qz)).mul(inverse)
      val b2 = dx.mul(rx).add(dy.mul(ry)).add(dz.mul(rz)).mul(inverse)
      val end = bx.mul(rx).add(by.mul(ry)).add(bz.mul(rz)).mul(inverse)
      val sides = ax.mul(ax).add(ay.mul(ay)).add(az.mul(az))
        .mul(bx.mul(bx).add(by.mul(by)).add(bz.mul(bz)))
        .mul(dx.mul(dx).add(dy.mul(dy)).add(dz.mul(dz)))
      val below = sides.mul(DoubtfulHit.Slim).sub(volume.mul(volume))
      val others = sign(b1.add(DoubtfulHit.Rounded))
        .or(sign(b2.add(DoubtfulHit.Rounded)))
        .or(sign(VertexKernel.all(1.0 + DoubtfulHit.Rounded).sub(b1.add(b2))))
      b1.intoArray(d.b1, i)
      b2.intoArray(d.b2, i)
      narrow(end).intoArray(d.t, i)
      sign(below).and(others.not()).intoArray(d.clear, i)
      i += 8
