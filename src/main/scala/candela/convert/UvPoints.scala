package candela.convert

import candela.base.loop
import candela.math.Vec3
import candela.scenefile.Declaration

/** The points of a shape, by its surface parameters u and v.
  *
  * @param window the parameters that it has
  * @param point  point at s and t in [0, 1] of the window, in the shape's space
  */
final class UvPoints(val window: Window, val point: (Float, Float) => Vec3)

object UvPoints:
  /** None if several points have the same u and v, or if the shape is in a file.
    *
    * @param size points along each axis for meshes
    */
  def of(shape: Declaration, size: Int): Option[UvPoints] =
    Tessellation.surface(shape) match
      case Some(point) => Some(UvPoints(Window(1f, 1f, 0f, 0f), point))
      case None => Tessellation.of(shape).orElse(Some(shape)).flatMap(ofMesh(_, size))

  private def ofMesh(mesh: Declaration, size: Int): Option[UvPoints] =
    val p = mesh.param("P").fold(Array.emptyFloatArray)(_.floats)
    val uv = mesh.param("uv").orElse(mesh.param("st")).fold(Array.emptyFloatArray)(_.floats)
    val indices = mesh.param("indices").fold(Array.emptyIntArray)(_.ints)
    val isWhole = p.length > 0 && uv.length * 3 == p.length * 2 &&
      indices.length > 0 && indices.length % 3 == 0 &&
      indices.forall(i => i >= 0 && 3 * i < p.length)
    Option.when(mesh.name == "trianglemesh" && isWhole)(Raster(p, uv, indices, size))
      .flatMap(_.points)

  /** Points of a mesh on a grid over the bounds of its u and v. */
  private final class Raster(p: Array[Float], uv: Array[Float], indices: Array[Int], size: Int):
    private def ends(axis: Int) =
      val values = indices.map(i => uv(2 * i + axis))
      (values.min, values.max)
    private val ((u0, u1), (v0, v1)) = (ends(0), ends(1))
    private val (perU, perV) = (1f / (u1 - u0), 1f / (v1 - v0))
    private val grid = new Array[Vec3 | Null](size * size)
    // How far apart two points are that are not the same
    private val tolerance =
      1e-3f * (0 to 2).map(c => p.indices.filter(_ % 3 == c).map(p(_)))
        .map(values => values.max - values.min).max
    private var overlaps = false

    def points: Option[UvPoints] =
      if !(u1 > u0 && v1 > v0) then None
      else
        loop(indices.length / 3)(paint)
        spread()
        Option.when(!overlaps):
          def cell(x: Float) = Math.min(Math.max((x * size).toInt, 0), size - 1)
          val window = Window(perU, perV, -u0 * perU, -v0 * perV)
          UvPoints(
            window,
            (s, t) =>
              val point = grid(cell(t) * size + cell(s))
              if point == null then Vec3.Zero else point
          )

    private def paint(triangle: Int): Unit =
      val corners = Array.tabulate(3)(k => indices(3 * triangle + k))
      val x = corners.map(i => (uv(2 * i) - u0) * perU * size - 0.5f)
      val y = corners.map(i => (uv(2 * i + 1) - v0) * perV * size - 0.5f)
      val q = corners.map(i => Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2)))
      val area = (x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0))
      if area != 0f then
        for
          j <- Math.max(Math.ceil(y.min).toInt, 0) to Math.min(y.max.toInt, size - 1)
          i <- Math.max(Math.ceil(x.min).toInt, 0) to Math.min(x.max.toInt, size - 1)
        do
          val b = ((i - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (j - y(0))) / area
          val c = ((x(1) - x(0)) * (j - y(0)) - (i - x(0)) * (y(1) - y(0))) / area
          if b >= 0f && c >= 0f && b + c <= 1f then
            val point = q(0) * (1f - b - c) + q(1) * b + q(2) * c
            val existing = grid(j * size + i)
            if existing == null then grid(j * size + i) = point
            else if (existing - point).length > tolerance then overlaps = true

    /** Gives pixels at the rim the point beside them, for the filter. */
    private def spread(): Unit =
      loop(UvPoints.Rim): _ =>
        val previous = grid.clone
        loop(size * size): k =>
          if previous(k) == null then
            val (i, j) = (k % size, k / size)
            val neighbours = Iterator(
              (i - 1, j),
              (i + 1, j),
              (i, j - 1),
              (i, j + 1)
            ).filter((x, y) => x >= 0 && x < size && y >= 0 && y < size)
            grid(k) = neighbours.map((x, y) => previous(y * size + x)).find(_ != null).orNull

  /** Width of the rim, in pixels. */
  private val Rim = 4
