package candela.convert

import candela.math.{clamp, lerp, radians, Vec3}
import candela.scenefile.{Declaration, Param, ParamType}
import candela.shapes.Profile

/** Tessellates shapes that v4 lacks, by their parametric form. */
object Tessellation:

  /** The shape as a trianglemesh, if v4 lacks its type.
    *
    * @param isMirrored whether its transform mirrors it: v4 turns quadrics over then, but no mesh
    *   with normals
    */
  def of(d: Declaration, isMirrored: Boolean = false): Option[Declaration] = d.name match
    case "cone" | "paraboloid" | "hyperboloid" => profile(d).map(grid(d, _, isMirrored))
    case "heightfield" => heightfield(d)
    case _ => None

  /** Whether the normals are not those of the surface: see [[Profile]]. */
  def isLoose(d: Declaration): Boolean = profile(d).exists(_.loose)

  /** Points of a quadric by u and v in [0, 1], in its own space. */
  def surface(d: Declaration): Option[(Float, Float) => Vec3] = d.name match
    case "sphere" =>
      val radius = number(d, "radius", 1f)
      val (z0, z1) = zRange(d, -radius, radius)
      def angle(z: Float) = Math.acos(clamp(z / radius, -1f, 1f).toDouble)
      val (theta0, theta1) = (angle(z0), angle(z1))
      Some: (u, v) =>
        val theta = theta0 + v * (theta1 - theta0)
        cylindrical(radius * Math.sin(theta), radius * Math.cos(theta), u * phiMax(d))
    case "disk" =>
      val (radius, inner) = (number(d, "radius", 1f), number(d, "innerradius", 0f))
      val height = number(d, "height", 0f).toDouble
      Some((u, v) => cylindrical(radius - v.toDouble * (radius - inner), height, u * phiMax(d)))
    case _ => profile(d).map(p => point(p, phiMax(d), _, _))

  private def number(d: Declaration, name: String, default: Float) =
    d.param(name).flatMap(_.floats.headOption).getOrElse(default)

  private def zRange(d: Declaration, low: Float, high: Float) =
    val (a, b) = (number(d, "zmin", low), number(d, "zmax", high))
    (Math.min(a, b), Math.max(a, b))

  private def phiMax(d: Declaration) = radians(clamp(number(d, "phimax", 360f), 0f, 360f))

  private def profile(d: Declaration): Option[Profile] =
    def corner(name: String, default: Vec3) = d.param(name).map(_.floats) match
      case Some(Array(x, y, z)) => Vec3(x, y, z)
      case _ => default
    val radius = number(d, "radius", 1f)
    d.name match
      case "cylinder" =>
        val (z0, z1) = zRange(d, -1f, 1f)
        Some(Profile.cylinder(radius, z0, z1))
      case "cone" => Some(Profile.cone(radius, number(d, "height", 1f)))
      case "paraboloid" =>
        val (z0, z1) = zRange(d, 0f, 1f)
        Some(Profile.paraboloid(radius, z0, z1))
      case "hyperboloid" =>
        Profile.hyperboloid(corner("p1", Vec3.Zero), corner("p2", Vec3(1, 1, 1)))
      case _ => None

  private def cylindrical(radius: Double, z: Double, angle: Double) =
    Vec3((radius * Math.cos(angle)).toFloat, (radius * Math.sin(angle)).toFloat, z.toFloat)

  private def point(p: Profile, phiMax: Float, u: Float, v: Float): Vec3 =
    val z = p.vStart + v * p.vSpan
    cylindrical(Math.sqrt(Math.max(p.radius2(z), 0.0)), z, p.seam(z) + u * phiMax)

  private val StepsAround = 128
  private val StepsAlong = 32

  /** A surface over the unit square, with the normal ∂p/∂u × ∂p/∂v. */
  private def grid(d: Declaration, p: Profile, isMirrored: Boolean): Declaration =
    val phi = phiMax(d)
    val strips = ranges(p)
    def vertices(tip: Float) =
      for
        (v0, v1) <- strips
        j <- 0 to StepsAlong
        i <- 0 to StepsAround
        t = clamp(j.toFloat / StepsAlong, tip, 1 - tip)
      yield (i.toFloat / StepsAround, lerp(t, v0, v1))
    val sign = if isMirrored then -p.vSpan.sign else p.vSpan.sign
    def normal(u: Float, v: Float) =
      val at = point(p, phi, u, v)
      val (x, y, z) = (at.x.toDouble, at.y.toDouble, at.z.toDouble)
      Vec3(at.x, at.y, -p.leaning(x, y, z).toFloat).normalized * sign.toFloat
    val count = (StepsAround + 1) * (StepsAlong + 1)
    mesh(
      d,
      vertices(0f).map(point(p, phi, _, _)),
      vertices(Tip).map(normal(_, _)),
      vertices(0f),
      strips.indices.toArray
        .flatMap(i => squares(StepsAround + 1, StepsAlong + 1).map(_ + i * count))
    )

  /** Short of a tip, where there is no normal. */
  private val Tip = 1e-4f

  /** The ranges of v with a surface. */
  private def ranges(p: Profile): Vector[(Float, Float)] =
    val ends = (Vector(0.0, 1.0) ++ p.zeros.map(p.v(_)).filter(v => v > 0 && v < 1)).sorted
    ends.zip(ends.tail)
      .filter((a, b) => p.radius2(p.vStart + 0.5 * (a + b) * p.vSpan) > 0)
      .map((a, b) => (a.toFloat, b.toFloat))

  /** Two triangles per cell of a vertex grid. */
  private def squares(nx: Int, ny: Int): Array[Int] =
    (for
      y <- 0 until ny - 1
      x <- 0 until nx - 1
      a = y * nx + x
      i <- Seq(a, a + 1, a + nx + 1, a, a + nx + 1, a + nx)
    yield i).toArray

  private def heightfield(d: Declaration): Option[Declaration] =
    def size(name: String) = d.param(name).flatMap(_.ints.headOption).getOrElse(0)
    val (nx, ny) = (size("nu"), size("nv"))
    val z = d.param("Pz").fold(Array.emptyFloatArray)(_.floats)
    Option.when(nx > 1 && ny > 1 && z.length == nx * ny):
      val uvs =
        for y <- 0 until ny; x <- 0 until nx yield (x.toFloat / (nx - 1), y.toFloat / (ny - 1))
      val points = uvs.zip(z).map { case ((x, y), height) => Vec3(x, y, height) }
      mesh(d, points, Vector.empty, uvs, squares(nx, ny))

  private def mesh(
      d: Declaration,
      points: Seq[Vec3],
      normals: Seq[Vec3],
      uvs: Seq[(Float, Float)],
      indices: Array[Int]
  ): Declaration =
    def list(t: ParamType, name: String, values: Seq[Float]) =
      Option.when(values.nonEmpty)(Param(t, name, d.pos, d.pos, floats = values.toArray))
    def flattened(vs: Seq[Vec3]) = vs.flatMap(v => Seq(v.x, v.y, v.z))
    val meshParams = Vector(
      list(ParamType.Point3, "P", flattened(points)),
      list(ParamType.Normal, "N", flattened(normals)),
      list(ParamType.Point2, "uv", uvs.flatMap((u, v) => Seq(u, v)))
    ).flatten :+ Param(ParamType.Integer, "indices", d.pos, d.pos, ints = indices)
    d.copy(name = "trianglemesh", params = meshParams)
