package candela.accel.tracing

import jdk.incubator.vector.{
  DoubleVector, FloatVector, IntVector, VectorMask, VectorOperators, VectorSpecies
}

import candela.math.{gamma, InvPi}

/** The vector code of diffuse vertices: the operations of [[candela.shapes.TriangleSoup]],
  * [[candela.geometry.Frame]], [[candela.bsdf.Lambert]] and [[candela.sampling.Warp]], one by one and
  * in their order and precision, for eight vertices at a time.
  */
private[candela] object VertexKernel:
  val F: VectorSpecies[java.lang.Float] = FloatVector.SPECIES_256
  val I: VectorSpecies[Integer] = IntVector.SPECIES_256
  val D: VectorSpecies[java.lang.Double] = DoubleVector.SPECIES_512
  inline val Lanes = 8

  inline def wide(v: FloatVector): DoubleVector =
    v.convertShape(VectorOperators.F2D, D, 0).asInstanceOf[DoubleVector]
  inline def narrow(v: DoubleVector): FloatVector =
    v.convertShape(VectorOperators.D2F, F, 0).asInstanceOf[FloatVector]
  inline def load(a: Array[Float], i: Int): FloatVector = FloatVector.fromArray(F, a, i)
  inline def load(a: Array[Double], i: Int): DoubleVector = DoubleVector.fromArray(D, a, i)
  inline def all(x: Float): FloatVector = FloatVector.broadcast(F, x)
  inline def all(x: Double): DoubleVector = DoubleVector.broadcast(D, x)
  inline def bits(v: FloatVector): IntVector = v.reinterpretAsInts()
  inline def floats(v: IntVector): FloatVector = v.reinterpretAsFloats()

  private inline def mean(
      b0: DoubleVector,
      b1: DoubleVector,
      b2: DoubleVector,
      p0: FloatVector,
      p1: FloatVector,
      p2: FloatVector
  ): FloatVector = narrow(b0.mul(wide(p0)).add(b1.mul(wide(p1))).add(b2.mul(wide(p2))))

  private inline def mean(
      b0: FloatVector,
      b1: FloatVector,
      b2: FloatVector,
      n0: FloatVector,
      n1: FloatVector,
      n2: FloatVector
  ): FloatVector = b0.mul(n0).add(b1.mul(n1)).add(b2.mul(n2))

  private inline def error(x: FloatVector, a: FloatVector, b: FloatVector, c: FloatVector) =
    x.abs().mul(gamma(2)).add(a.abs().max(b.abs().max(c.abs())).mul(2e-15f))

  /** Points, their errors and geometric normals. */
  def place(v: DiffuseVertices, n: Int): Unit =
    var i = 0
    while i < n do
      val b1 = load(v.u, i)
      val b2 = load(v.v, i)
      val b0 = all(1.0).sub(b1).sub(b2)
      val ax = load(v.corner(0), i)
      val bx = load(v.corner(3), i)
      val cx = load(v.corner(6), i)
      val ay = load(v.corner(1), i)
      val by = load(v.corner(4), i)
      val cy = load(v.corner(7), i)
      val az = load(v.corner(2), i)
      val bz = load(v.corner(5), i)
      val cz = load(v.corner(8), i)
      val x = mean(b0, b1, b2, ax, bx, cx)
      val y = mean(b0, b1, b2, ay, by, cy)
      val z = mean(b0, b1, b2, az, bz, cz)
      x.intoArray(v.px, i)
      y.intoArray(v.py, i)
      z.intoArray(v.pz, i)
      error(x, ax, bx, cx).intoArray(v.ex, i)
      error(y, ay, by, cy).intoArray(v.ey, i)
      error(z, az, bz, cz).intoArray(v.ez, i)
      i += Lanes
    facet(v, n)

  private def facet(v: DiffuseVertices, n: Int): Unit =
    var i = 0
    while i < n do
      val px = wide(load(v.corner(0), i))
      val py = wide(load(v.corner(1), i))
      val pz = wide(load(v.corner(2), i))
      val ax = wide(load(v.corner(3), i)).sub(px)
      val ay = wide(load(v.corner(4), i)).sub(py)
      val az = wide(load(v.corner(5), i)).sub(pz)
      val bx = wide(load(v.corner(6), i)).sub(px)
      val by = wide(load(v.corner(7), i)).sub(py)
      val bz = wide(load(v.corner(8), i)).sub(pz)
      val x = ay.mul(bz).sub(az.mul(by))
      val y = az.mul(bx).sub(ax.mul(bz))
      val z = ax.mul(by).sub(ay.mul(bx))
      val length = x.mul(x).add(y.mul(y)).add(z.mul(z)).sqrt()
      val s = load(v.side, i).div(length)
      length.intoArray(v.length, i)
      narrow(x.mul(s)).intoArray(v.gx, i)
      narrow(y.mul(s)).intoArray(v.gy, i)
      narrow(z.mul(s)).intoArray(v.gz, i)
      i += Lanes

  /** Shading normals, which may turn the geometric ones; frames; which side the path comes from; the
    * normal for the choice of a light.
    */
  def shade(v: DiffuseVertices, n: Int): Unit =
    var i = 0
    while i < n do
      val b1 = narrow(load(v.u, i))
      val b2 = narrow(load(v.v, i))
      val b0 = all(1f).sub(b1).sub(b2)
      val x = mean(b0, b1, b2, load(v.normal(0), i), load(v.normal(3), i), load(v.normal(6), i))
      val y = mean(b0, b1, b2, load(v.normal(1), i), load(v.normal(4), i), load(v.normal(7), i))
      val z = mean(b0, b1, b2, load(v.normal(2), i), load(v.normal(5), i), load(v.normal(8), i))
      val length2 = x.mul(x).add(y.mul(y)).add(z.mul(z))
      val isSmooth = length2.compare(VectorOperators.GT, 0f)
        .and(length2.compare(VectorOperators.LT, Float.PositiveInfinity))
      val inverse = all(1f).div(length2.sqrt())
      val gx = load(v.gx, i)
      val gy = load(v.gy, i)
      val gz = load(v.gz, i)
      val nx = gx.blend(x.mul(inverse), isSmooth)
      val ny = gy.blend(y.mul(inverse), isSmooth)
      val nz = gz.blend(z.mul(inverse), isSmooth)
      val turns = gx.mul(nx).add(gy.mul(ny)).add(gz.mul(nz)).compare(VectorOperators.LT, 0f)
      gx.blend(gx.neg(), turns).intoArray(v.gx, i)
      gy.blend(gy.neg(), turns).intoArray(v.gy, i)
      gz.blend(gz.neg(), turns).intoArray(v.gz, i)
      nx.intoArray(v.nx, i)
      ny.intoArray(v.ny, i)
      nz.intoArray(v.nz, i)
      val sign = floats(bits(nz).and(Int.MinValue).or(One))
      val a = all(-1f).div(sign.add(nz))
      val b = nx.mul(ny).mul(a)
      all(1f).add(sign.mul(nx).mul(nx).mul(a)).intoArray(v.sx, i)
      sign.mul(b).intoArray(v.sy, i)
      sign.neg().mul(nx).intoArray(v.sz, i)
      b.intoArray(v.tx, i)
      sign.add(ny.mul(ny).mul(a)).intoArray(v.ty, i)
      ny.neg().intoArray(v.tz, i)
      val wo = load(v.dx, i).neg().mul(nx)
        .add(load(v.dy, i).neg().mul(ny))
        .add(load(v.dz, i).neg().mul(nz))
      wo.intoArray(v.woZ, i)
      val isBack = wo.compare(VectorOperators.GT, 0f).not()
      nx.blend(nx.neg(), isBack).intoArray(v.lx, i)
      ny.blend(ny.neg(), isBack).intoArray(v.ly, i)
      nz.blend(nz.neg(), isBack).intoArray(v.lz, i)
      i += Lanes

  private val One = java.lang.Float.floatToRawIntBits(1f)

  /** Sine or cosine of an eighth, as candela.math. */
  private inline def sinOfEighth(x: DoubleVector): DoubleVector =
    val q = x.mul(x)
    x.mul(
      q.mul(2.717345361627713e-6).sub(1.9839202172159784e-4).mul(q).add(8.33332878229936e-3)
        .mul(q).sub(0.16666666631589003).mul(q).add(0.9999999999956726)
    )

  private inline def cosOfEighth(x: DoubleVector): DoubleVector =
    val q = x.mul(x)
    q.mul(2.4379830963894595e-5).sub(1.3886617996113834e-3).mul(q).add(4.166661669239419e-2)
      .mul(q).sub(0.4999999961485576).mul(q).add(0.9999999999524889)

  /** Sines and cosines of angles from 0 to 2π. */
  inline def sinCos(x: DoubleVector)(inline use: (DoubleVector, DoubleVector) => Unit): Unit =
    val eighth = x.mul(0.125)
    val s1 = sinOfEighth(eighth)
    val c1 = cosOfEighth(eighth)
    val s2 = s1.mul(2.0).mul(c1)
    val c2 = all(1.0).sub(s1.mul(2.0).mul(s1))
    val s4 = s2.mul(2.0).mul(c2)
    val c4 = all(1.0).sub(s2.mul(2.0).mul(s2))
    use(s4.mul(2.0).mul(c4), all(1.0).sub(s4.mul(2.0).mul(s4)))

  /** Cosine-weighted directions on the path's side: into the world, with their local z. */
  def scatter(v: DiffuseVertices, n: Int): Unit =
    var i = 0
    while i < n do
      val a = load(v.u1, i).mul(2f).sub(1f)
      val b = load(v.u2, i).mul(2f).sub(1f)
      val isWide = a.abs().compare(VectorOperators.GT, b.abs())
      val r = b.blend(a, isWide)
      val other = a.blend(b, isWide)
      val quotient = wide(other.div(r))
      val phi = quotient.mul(0.25 * Math.PI)
      val zero = r.compare(VectorOperators.EQ, 0f)
      val angle = phi.blend(0.0, zero.cast(D))
      val along = r.mul(narrow(cosOfEighth(angle)))
      val across = r.mul(narrow(sinOfEighth(angle)))
      val x = across.blend(along, isWide)
      val y = along.blend(across, isWide)
      val up2 = all(1f).sub(x.mul(x)).sub(y.mul(y))
      val up = up2.sqrt().blend(0f, up2.compare(VectorOperators.GT, 0f).not())
      val z = up.blend(up.neg(), load(v.woZ, i).compare(VectorOperators.LT, 0f))
      z.intoArray(v.wiZ, i)
      world(load(v.sx, i), load(v.tx, i), load(v.nx, i), x, y, z).intoArray(v.wx, i)
      world(load(v.sy, i), load(v.ty, i), load(v.ny, i), x, y, z).intoArray(v.wy, i)
      world(load(v.sz, i), load(v.tz, i), load(v.nz, i), x, y, z).intoArray(v.wz, i)
      i += Lanes

  private inline def world(
      s: FloatVector,
      t: FloatVector,
      n: FloatVector,
      x: FloatVector,
      y: FloatVector,
      z: FloatVector
  ): FloatVector = s.mul(x).add(t.mul(y)).add(n.mul(z))

  /** Origins of rays to (`wx`, `wy`, `wz`), as [[candela.geometry.ShadingPoint.offset]]. */
  def offset(
      v: DiffuseVertices,
      wx: Array[Float],
      wy: Array[Float],
      wz: Array[Float],
      toX: Array[Float],
      toY: Array[Float],
      toZ: Array[Float],
      n: Int
  ): Unit =
    var i = 0
    while i < n do
      val nx = load(v.gx, i)
      val ny = load(v.gy, i)
      val nz = load(v.gz, i)
      val d = nx.abs().mul(load(v.ex, i))
        .add(ny.abs().mul(load(v.ey, i)))
        .add(nz.abs().mul(load(v.ez, i)))
      val behind = load(wx, i).mul(nx).add(load(wy, i).mul(ny)).add(load(wz, i).mul(nz))
        .compare(VectorOperators.LT, 0f)
      val side = d.blend(d.neg(), behind)
      away(load(v.px, i), nx.mul(side)).intoArray(toX, i)
      away(load(v.py, i), ny.mul(side)).intoArray(toY, i)
      away(load(v.pz, i), nz.mul(side)).intoArray(toZ, i)
      i += Lanes

  /** `x` + `by`, and one Float further. */
  inline def away(x: FloatVector, by: FloatVector): FloatVector =
    val moved = x.add(by)
    val step = bits(by).lanewise(VectorOperators.XOR, bits(moved))
      .lanewise(VectorOperators.ASHR, 31)
      .or(1)
    val next = floats(bits(moved).add(step))
    // From zero to the least Float of either sign
    val least = floats(bits(by).and(Int.MinValue).or(1))
    val isZero = moved.compare(VectorOperators.EQ, 0f)
    val stays = by.compare(VectorOperators.EQ, 0f)
    next.blend(least, isZero).blend(moved, stays)

  /** Light of the samples that are met at a diffuse vertex, but for visibility, as
    * [[candela.integrators.WaveWalk.connect]]: the factor of f · L; 0 where none arrives.
    */
  def connect(v: DiffuseVertices, n: Int): Unit =
    var i = 0
    while i < n do
      val z = load(v.lightX, i).mul(load(v.nx, i))
        .add(load(v.lightY, i).mul(load(v.ny, i)))
        .add(load(v.lightZ, i).mul(load(v.nz, i)))
      val isSame = load(v.woZ, i).mul(z).compare(VectorOperators.GT, 1e-10f * 1e-10f)
      val pdf = load(v.lightPdf, i)
      val r = z.abs().mul(InvPi).div(pdf)
      val weight = all(1f).div(all(1f).add(r.mul(r)))
      val factor = z.abs().mul(weight).div(pdf)
      val arrives = isSame.and(pdf.compare(VectorOperators.GT, 0f))
      all(0f).blend(factor, arrives).intoArray(v.factor, i)
      all(0f).blend(1f, arrives).intoArray(v.arrives, i)
      i += Lanes
