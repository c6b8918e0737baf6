package candela.accel.tracing

import jdk.incubator.vector.{FloatVector, VectorOperators}

import candela.math.{square, Vec3}

/** A rectangular lamp: the numbers of [[candela.shapes.RectangleSampler]] and its light. */
private[candela] final class RectangleLamp(
    val corners: Array[Vec3],
    val width: Float,
    val height: Float,
    val axes: Array[Vec3],
    val center: Vec3,
    val normal: Vec3,
    val error: Vec3,
    val area: Float,
    val twoSided: Boolean
)

/** Arrays for samples of one lamp: points that are lit, and what [[LampKernel]] makes of them. */
private[candela] final class LampSamples(most: Int):
  private val size = most + 16
  private def floats() = new Array[Float](size)
  private def doubles() = new Array[Double](size)
  val vertex: Array[Int] = new Array[Int](size)
  val px, py, pz, u1, u2: Array[Float] = floats()
  val x0, y0, z, farR, farI, sine, cosine, angle: Array[Double] = doubles()
  val tx, ty, tz, wx, wy, wz, pdf, endX, endY, endZ, fraction: Array[Float] = floats()

/** The vector code of light sampling: the operations of [[candela.lights.FewLights]],
  * [[candela.shapes.RectangleSampler]] and [[candela.sampling.SphericalRectangle]], in their order
  * and precision. The arctangent is the JVM's.
  */
private[candela] object LampKernel:
  import VertexKernel.*

  /** Adds the importance of a flat lamp to the sums.
    *
    * @param data row of the lamp, from `at` on
    */
  def weigh(
      v: DiffuseVertices,
      data: Array[Float],
      at: Int,
      weights: Array[Float],
      sums: Array[Float],
      before: Array[Float],
      n: Int
  ): Unit =
    val cx = data(at)
    val cy = data(at + 1)
    val cz = data(at + 2)
    val ax = data(at + 3)
    val ay = data(at + 4)
    val az = data(at + 5)
    val radius = data(at + 6)
    val power = data(at + 7)
    val signed = data(at + 8)
    val sized = data(at + 9)
    val least = data(at + 10)
    var i = 0
    while i < n do
      val x = all(cx).sub(load(v.px, i))
      val y = all(cy).sub(load(v.py, i))
      val z = all(cz).sub(load(v.pz, i))
      val d2 = x.mul(x).add(y.mul(y)).add(z.mul(z))
      val along = x.mul(ax).add(y.mul(ay)).add(z.mul(az)).neg()
      val facing = x.mul(load(v.lx, i)).add(y.mul(load(v.ly, i))).add(z.mul(load(v.lz, i)))
        .add(radius)
      val received = facing.abs().mul(0.51f).add(facing.mul(0.49f))
      val inverse = all(1f).div(d2.add(least))
      val height = along.mul(signed).add(along.abs().mul(sized))
      val emitted = height.mul(height.add(4 * radius)).sqrt()
      val w = emitted.mul(inverse).mul(power).mul(received.mul(inverse))
      w.intoArray(weights, i)
      load(before, i).add(w).intoArray(sums, i)
      i += Lanes

  /** Solid angles: up to the arctangent. */
  def begin(s: LampSamples, l: RectangleLamp, n: Int): Unit =
    val a = l.corners(0)
    val (xs, ys, zs) = (l.axes(0), l.axes(1), l.axes(2))
    var i = 0
    while i < n do
      val dx = all(a.x.toDouble).sub(wide(load(s.px, i)))
      val dy = all(a.y.toDouble).sub(wide(load(s.py, i)))
      val dz = all(a.z.toDouble).sub(wide(load(s.pz, i)))
      val x0 = dx.mul(xs.x.toDouble).add(dy.mul(xs.y.toDouble)).add(dz.mul(xs.z.toDouble))
      val y0 = dx.mul(ys.x.toDouble).add(dy.mul(ys.y.toDouble)).add(dz.mul(ys.z.toDouble))
      val z = dx.mul(zs.x.toDouble).add(dy.mul(zs.y.toDouble)).add(dz.mul(zs.z.toDouble))
      val x1 = x0.add(l.width.toDouble)
      val y1 = y0.add(l.height.toDouble)
      val up = z.abs()
      val z2 = z.mul(z)
      val i0 = up.mul(x1.mul(x1).add(y0.mul(y0)).add(z2).sqrt())
      val i1 = up.mul(x1.mul(x1).add(y1.mul(y1)).add(z2).sqrt())
      val i2 = up.mul(x0.mul(x0).add(y1.mul(y1)).add(z2).sqrt())
      val i3 = up.mul(x0.mul(x0).add(y0.mul(y0)).add(z2).sqrt())
      val r0 = x1.mul(y0)
      val r1 = x1.neg().mul(y1)
      val r2 = x0.mul(y1)
      val r3 = x0.neg().mul(y0)
      val nearR = r0.mul(r1).sub(i0.mul(i1))
      val nearI = r0.mul(i1).add(i0.mul(r1))
      val farR = r2.mul(r3).sub(i2.mul(i3))
      val farI = r2.mul(i3).add(i2.mul(r3))
      x0.intoArray(s.x0, i)
      y0.intoArray(s.y0, i)
      z.intoArray(s.z, i)
      farR.intoArray(s.farR, i)
      farI.intoArray(s.farI, i)
      nearR.mul(farI).add(nearI.mul(farR)).intoArray(s.sine, i)
      nearR.mul(farR).sub(nearI.mul(farI)).intoArray(s.cosine, i)
      i += Lanes

  def measure(s: LampSamples, l: RectangleLamp, n: Int): Unit =
    var i = 0
    while i < n do
      val from = Vec3(s.px(i), s.py(i), s.pz(i))
      val isLarge = l.area > 0.1f * (l.center - from).lengthSquared
      val angle = if isLarge then Math.atan2(s.sine(i), s.cosine(i)) else 0.0
      s.angle(i) = if angle < 0 then angle + 2 * Math.PI else angle
      i += 1

  /** Points on the lamp, with their density. */
  def sample(s: LampSamples, l: RectangleLamp, n: Int): Unit =
    val a = l.corners(0)
    val b = l.corners(1)
    val c = l.corners(2)
    val d = l.corners(3)
    val perArea = 1f / l.area
    var i = 0
    while i < n do
      val x0 = load(s.x0, i)
      val y0 = load(s.y0, i)
      val z = load(s.z, i)
      val farR = load(s.farR, i)
      val farI = load(s.farI, i)
      val angle = load(s.angle, i)
      val u1 = wide(load(s.u1, i))
      val u2 = wide(load(s.u2, i))
      val x1 = x0.add(l.width.toDouble)
      val y1 = y0.add(l.height.toDouble)
      val z2 = z.mul(z)
      val toLower = all(1.0).div(z2.add(y0.mul(y0)))
      val lower = y0.neg().mul(toLower.sqrt())
      val level = z2.mul(toLower)
      val upper = y1.div(z2.add(y1.mul(y1)).sqrt())
      val scale = all(1.0).div(farR.mul(farR).add(farI.mul(farI)).sqrt())
      val cosRest = farR.mul(scale)
      val sinRest = farI.neg().mul(scale)
      sinCos(u1.mul(angle)): (sine, cosine) =>
        val rise = cosine.mul(cosRest).sub(sine.mul(sinRest)).mul(lower).sub(upper)
        val run = sine.mul(cosRest).add(cosine.mul(sinRest))
        val squared = rise.mul(rise).sub(level.mul(run).mul(run))
        val isSmall = squared.compare(VectorOperators.GT, 1e-300).not()
        val across = squared.blend(1e-300, isSmall).sqrt()
        val signed = run.blend(run.neg(), rise.compare(VectorOperators.LT, 0.0))
        val x2 = signed.mul(z.abs()).div(across)
        val x = x2.blend(x1, x2.compare(VectorOperators.GT, x1))
          .blend(x0, x2.compare(VectorOperators.LT, x0))
        val d2 = x.mul(x).add(z2)
        val h0 = y0.div(d2.add(y0.mul(y0)).sqrt())
        val h1 = y1.div(d2.add(y1.mul(y1)).sqrt())
        val h = h0.add(u2.mul(h1.sub(h0)))
        val rest = all(1e-30).max(all(1.0).sub(h.mul(h)))
        val y2 = h.mul(d2.div(rest).sqrt())
        val y = y2.blend(y1, y2.compare(VectorOperators.GT, y1))
          .blend(y0, y2.compare(VectorOperators.LT, y0))
        val byAngle = angle.compare(VectorOperators.GT, 3e-4)
          .and(angle.compare(VectorOperators.LT, 6.22))
        val across1 = u1.blend(x.sub(x0).div(l.width.toDouble), byAngle)
        val along1 = u2.blend(y.sub(y0).div(l.height.toDouble), byAngle)
        val restS = all(1.0).sub(across1)
        val restT = all(1.0).sub(along1)
        val wa = restS.mul(restT)
        val wb = across1.mul(restT)
        val wc = across1.mul(along1)
        val wd = restS.mul(along1)
        narrow(
          wa.mul(a.x.toDouble).add(wb.mul(b.x.toDouble)).add(wc.mul(c.x.toDouble))
            .add(wd.mul(d.x.toDouble))
        ).intoArray(s.tx, i)
        narrow(
          wa.mul(a.y.toDouble).add(wb.mul(b.y.toDouble)).add(wc.mul(c.y.toDouble))
            .add(wd.mul(d.y.toDouble))
        ).intoArray(s.ty, i)
        narrow(
          wa.mul(a.z.toDouble).add(wb.mul(b.z.toDouble)).add(wc.mul(c.z.toDouble))
            .add(wd.mul(d.z.toDouble))
        ).intoArray(s.tz, i)
        val px = load(s.px, i)
        val py = load(s.py, i)
        val pz = load(s.pz, i)
        val dx = load(s.tx, i).sub(px)
        val dy = load(s.ty, i).sub(py)
        val dz = load(s.tz, i).sub(pz)
        val distance2 = dx.mul(dx).add(dy.mul(dy)).add(dz.mul(dz))
        val slant = dx.mul(l.normal.x).add(dy.mul(l.normal.y)).add(dz.mul(l.normal.z)).abs()
          .div(distance2.sqrt())
        val byArea = distance2.mul(perArea).div(slant)
          .blend(0f, slant.compare(VectorOperators.GT, 0f).not())
        val pdf = byArea.blend(narrow(all(1.0).div(angle)), byAngle.cast(F))
        val inverse = all(1f).div(distance2.sqrt())
        val wx = dx.mul(inverse)
        val wy = dy.mul(inverse)
        val wz = dz.mul(inverse)
        val facing = wx.mul(l.normal.x).add(wy.mul(l.normal.y)).add(wz.mul(l.normal.z))
        val isLit = distance2.compare(VectorOperators.GT, 0f)
        val lit =
          if l.twoSided then isLit else isLit.and(facing.compare(VectorOperators.LT, 0f))
        all(0f).blend(pdf, lit).intoArray(s.pdf, i)
        wx.intoArray(s.wx, i)
        wy.intoArray(s.wy, i)
        wz.intoArray(s.wz, i)
      i += Lanes

  /** Ends of shadow rays. */
  def end(s: LampSamples, l: RectangleLamp, n: Int): Unit =
    val m = l.normal
    val d = Math.abs(m.x) * l.error.x + Math.abs(m.y) * l.error.y + Math.abs(m.z) * l.error.z
    val most = 1f - 0.9999f
    var i = 0
    while i < n do
      val wx = load(s.wx, i)
      val wy = load(s.wy, i)
      val wz = load(s.wz, i)
      val back = wx.neg().mul(m.x).add(wy.neg().mul(m.y)).add(wz.neg().mul(m.z))
      val side = all(d).blend(-d, back.compare(VectorOperators.LT, 0f))
      away(load(s.tx, i), side.mul(m.x)).intoArray(s.endX, i)
      away(load(s.ty, i), side.mul(m.y)).intoArray(s.endY, i)
      away(load(s.tz, i), side.mul(m.z)).intoArray(s.endZ, i)
      val slant = wx.mul(m.x).add(wy.mul(m.y)).add(wz.mul(m.z)).abs()
      all(1f).sub(all(most).min(all(5e-6f).div(slant))).intoArray(s.fraction, i)
      i += Lanes
