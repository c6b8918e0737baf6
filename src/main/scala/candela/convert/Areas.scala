package candela.convert

import candela.base.loop
import candela.math.{clamp, radians, Transform, Vec3}
import candela.scenefile.ShapeDescription

/** Areas of shapes in world space, where they are easily told. */
object Areas:

  def of(s: ShapeDescription): Option[Float] =
    val t = s.objectToWorld.start
    def number(name: String, default: Float) =
      s.shape.param(name).flatMap(_.floats.headOption).getOrElse(default)
    val radius = number("radius", 1f)
    val phi = radians(clamp(number("phimax", 360f), 0f, 360f))
    s.shape.name match
      case "trianglemesh" => Some(mesh(s, t))
      case "sphere" =>
        val (z0, z1) = (number("zmin", -radius), number("zmax", radius))
        val height = Math.abs(clamp(z1, -radius, radius) - clamp(z0, -radius, radius))
        uniform(t).map(_ * phi * radius * height)
      case "disk" =>
        val inner = number("innerradius", 0f)
        uniform(t).map(_ * phi * 0.5f * (radius * radius - inner * inner))
      case "cylinder" =>
        uniform(t).map(_ * phi * radius * Math.abs(number("zmax", 1f) - number("zmin", -1f)))
      case _ => None

  /** The factor of areas, if the transform is a rotation, a shift and one scale. */
  private def uniform(t: Transform): Option[Float] =
    val axes = Seq(Vec3.X, Vec3.Y, Vec3.Z).map(t.vector)
    val lengths = axes.map(_.length)
    val isEven = lengths.forall(l => Math.abs(l / lengths.head - 1f) < 1e-4f)
    val isSquare = Seq((0, 1), (0, 2), (1, 2)).forall: (i, j) =>
      Math.abs(axes(i) dot axes(j)) < 1e-4f * lengths.head * lengths.head
    Option.when(isEven && isSquare)(lengths.head * lengths.head)

  private def mesh(s: ShapeDescription, t: Transform): Float =
    val p = s.shape.param("P").fold(Array.emptyFloatArray)(_.floats)
    val indices = s.shape.param("indices").fold(Array(0, 1, 2))(_.ints)
    def vertex(i: Int) = t.point(Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2)))
    var sum = 0.0
    loop(indices.length / 3): i =>
      val corners = indices.slice(3 * i, 3 * i + 3)
      if corners.forall(k => k >= 0 && 3 * k + 2 < p.length) then
        val a = vertex(corners(0))
        sum += 0.5 * ((vertex(corners(1)) - a) cross (vertex(corners(2)) - a)).length
    sum.toFloat
