package candela.convert

import candela.math.{clamp, radians, Vec3}
import candela.scenefile.{Declaration, Param, ParamType}

/** Tessellates shapes that v4 lacks, by their parametric form. */
object Tessellation:

  /** The shape as a trianglemesh, if v4 lacks its type. */
  def of(d: Declaration): Option[Declaration] = d.name match
    case "cone" | "paraboloid" | "hyperboloid" => surface(d).map(grid(d))
    case "heightfield" => heightfield(d)
    case _ => None

  /** Points of a quadric by u and v in [0, 1], in its own space. */
  def surface(d: Declaration): Option[(Float, Float) => Vec3] =
    def number(name: String, default: Float) =
      d.param(name).flatMap(_.floats.headOption).getOrElse(default)
    def point(name: String, default: Vec3) = d.param(name).map(_.floats) match
      case Some(Array(x, y, z)) => Vec3(x, y, z)
      case _ => default
    val phimax = radians(clamp(number("phimax", 360f), 0f, 360f))
    def turned(x: Float, y: Float, z: Float, u: Float) =
      val (sin, cos) = (Math.sin(u * phimax.toDouble), Math.cos(u * phimax.toDouble))
      Vec3((x * cos - y * sin).toFloat, (x * sin + y * cos).toFloat, z)
    val radius = number("radius", 1f)
    def zRange(low: Float, high: Float) =
      val (a, b) = (number("zmin", low), number("zmax", high))
      (Math.min(a, b), Math.max(a, b))
    d.name match
      case "sphere" =>
        val (z0, z1) = zRange(-radius, radius)
        def angle(z: Float) = Math.acos(clamp(z / radius, -1f, 1f).toDouble)
        val (theta0, theta1) = (angle(z0), angle(z1))
        Some: (u, v) =>
          val theta = theta0 + v * (theta1 - theta0)
          turned((radius * Math.sin(theta)).toFloat, 0f, (radius * Math.cos(theta)).toFloat, u)
      case "cylinder" =>
        val (z0, z1) = zRange(-1f, 1f)
        Some((u, v) => turned(radius, 0f, z0 + v * (z1 - z0), u))
      case "disk" =>
        val (height, inner) = (number("height", 0f), number("innerradius", 0f))
        Some((u, v) => turned(radius - v * (radius - inner), 0f, height, u))
      case "cone" =>
        val height = number("height", 1f)
        Some((u, v) => turned(radius * (1 - v), 0f, v * height, u))
      case "paraboloid" =>
        val (z0, z1) = zRange(0f, 1f)
        Some: (u, v) =>
          val z = z0 + v * (z1 - z0)
          turned(radius * Math.sqrt(Math.max(z / z1, 0f).toDouble).toFloat, 0f, z, u)
      case "hyperboloid" =>
        val (p1, p2) = (point("p1", Vec3.Zero), point("p2", Vec3(1, 1, 1)))
        Some: (u, v) =>
          val p = p1 * (1 - v) + p2 * v
          turned(p.x, p.y, p.z, u)
      case _ => None

  private val StepsAround = 128
  private val StepsAlong = 32

  /** A surface over the unit square, with the normal ∂p/∂u × ∂p/∂v. */
  private def grid(d: Declaration)(p: (Float, Float) => Vec3): Declaration =
    val vertices =
      for j <- 0 to StepsAlong; i <- 0 to StepsAround
      yield (i.toFloat / StepsAround, j.toFloat / StepsAlong)
    def normal(u: Float, v: Float) =
      // Offset into the surface, because ∂p/∂u vanishes at a tip.
      val (u0, u1) = (Math.max(u - Step, 0f), Math.min(u + Step, 1f))
      val (v0, v1) = (Math.max(v - Step, 0f), Math.min(v + Step, 1f))
      val inner = clamp(v, Step, 1 - Step)
      ((p(u1, inner) - p(u0, inner)) cross (p(u, v1) - p(u, v0))).normalized
    mesh(
      d,
      vertices.map(p(_, _)),
      vertices.map(normal(_, _)),
      vertices,
      squares(StepsAround + 1, StepsAlong + 1)
    )

  private val Step = 1e-3f

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
    d.copy(name = "trianglemesh", params = meshParams ++ d.param("alpha"))
