package candela.stability

import java.math.{BigDecimal as Big, MathContext}

import candela.math.Vec3

/** Arithmetic with 60 digits on what Floats say exactly. */
object Exact:
  private val Digits = MathContext(60)

  def of(x: Float): Big = Big(x.toDouble)
  def of(x: Double): Big = Big(x)

  extension (a: Big)
    def +~(b: Big): Big = a.add(b, Digits)
    def -~(b: Big): Big = a.subtract(b, Digits)
    def *~(b: Big): Big = a.multiply(b, Digits)
    def /~(b: Big): Big = a.divide(b, Digits)
    def root: Big = a.sqrt(Digits)

  final case class Vector3(x: Big, y: Big, z: Big):
    def +(b: Vector3): Vector3 = Vector3(x +~ b.x, y +~ b.y, z +~ b.z)
    def -(b: Vector3): Vector3 = Vector3(x -~ b.x, y -~ b.y, z -~ b.z)
    def *(s: Big): Vector3 = Vector3(x *~ s, y *~ s, z *~ s)
    infix def dot(b: Vector3): Big = (x *~ b.x) +~ (y *~ b.y) +~ (z *~ b.z)
    infix def cross(b: Vector3): Vector3 = Vector3(
      (y *~ b.z) -~ (z *~ b.y),
      (z *~ b.x) -~ (x *~ b.z),
      (x *~ b.y) -~ (y *~ b.x)
    )
    def length: Double = (this dot this).root.doubleValue

  def of(v: Vec3): Vector3 = Vector3(of(v.x), of(v.y), of(v.z))

  /** Distances along the ray, which need not be of unit length, to both sides of a sphere; None if
    * it misses.
    */
  def sphere(o: Vector3, d: Vector3, center: Vector3, radius: Big): Option[(Big, Big)] =
    val way = o - center
    val a = d dot d
    val b = way dot d
    val c = (way dot way) -~ (radius *~ radius)
    val discriminant = (b *~ b) -~ (a *~ c)
    Option.when(discriminant.signum >= 0):
      val root = discriminant.root
      ((b.negate -~ root) /~ a, (b.negate +~ root) /~ a)

  /** Distance along the ray to the plane through three points. */
  def plane(o: Vector3, d: Vector3, p0: Vector3, p1: Vector3, p2: Vector3): Big =
    val n = (p1 - p0) cross (p2 - p0)
    ((p0 - o) dot n) /~ (d dot n)
