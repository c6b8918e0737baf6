package candela.build.media

import candela.base.loop
import candela.diagnostics.SourcePos
import candela.geometry.{Bounds3, BoxTree}
import candela.math.{Transform, Vec3}
import candela.scenefile.Declaration

/** Triangle meshes that bound one medium together, in their space. */
private[media] final class FilledMesh(parts: Vector[Declaration]):
  private val corners = parts.map(d => (d.param("P").get.floats, d.param("indices").get.ints))
  private val starts = corners.scanLeft(0)((sum, part) => sum + part._2.length / 3).toArray

  val at: SourcePos = parts.head.pos

  val bounds: Bounds3 =
    var all = Bounds3.Empty
    for (p, _) <- corners do loop(p.length / 3)(i => all = all.union(FilledMesh.vertex(p, i)))
    all

  private def faces: Int = starts.last

  private def face(i: Int): Face =
    var part = 0
    while i >= starts(part + 1) do part += 1
    val (p, indices) = corners(part)
    val k = 3 * (i - starts(part))
    def vertex(j: Int) = FilledMesh.vertex(p, indices(k + j))
    Face(vertex(0), vertex(1), vertex(2))

  private lazy val tree = BoxTree(faces, i => face(i).bounds)

  /** How often the mesh surrounds a point: once inside, if it is closed. */
  private def winding(p: Vec3): Int =
    var sum = 0
    val ahead = Bounds3(p, Vec3(Float.PositiveInfinity, p.y, p.z))
    tree.forEach(ahead)(i => sum += face(i).crossing(p))
    sum

  def contains(p: Vec3): Boolean = bounds.union(p) == bounds && winding(p) > 0

  /** Where another mesh is.
    *
    * @param toThis  from its space to that of this mesh
    * @param margin  what is nearer touches
    */
  def placement(inner: FilledMesh, toThis: Transform, margin: Float): FilledMesh.Placement =
    var (isMet, inside, outside) = (false, false, false)
    var i = 0
    while i < inner.faces && !isMet && !(inside && outside) do
      val f = inner.face(i).map(toThis.point)
      val near = f.bounds.grown(margin)
      isMet = bounds.overlaps(near) && tree.exists(near)(j => f.overlaps(face(j), margin))
      if contains(f.a) then inside = true else outside = true
      i += 1
    if isMet || inside && outside then FilledMesh.Placement.Across
    else if inside then FilledMesh.Placement.Inside
    else FilledMesh.Placement.Outside

  /** The sum of its faces' normals, their area, and the volume that they enclose. */
  private lazy val (gap, area, volume) =
    var (sum, area, volume) = (Vec3.Zero, 0f, 0.0)
    val center = bounds.center
    loop(faces): i =>
      val f = face(i)
      val normal = (f.b - f.a) cross (f.c - f.a)
      sum = sum + normal
      area += normal.length
      volume += (f.a - center) dot normal
    (sum.length, area, volume)

  /** Whether its faces don't add up to nothing, as those of closed meshes do. */
  def isOpen: Boolean = gap > FilledMesh.MaxGap * area

  /** What is wrong with it as a border, if anything is. */
  def flaw: Option[String] =
    if isOpen then Some("this mesh is not closed: rays may enter its medium and never leave it")
    else if volume < 0 then
      Some("the faces of this mesh are wound inwards, so that its medium is outside")
    else None

private[media] object FilledMesh:
  enum Placement:
    case Inside, Outside, Across

  /** Part of the area of a mesh that may be missing. */
  private val MaxGap = 1e-3f

  private def vertex(p: Array[Float], i: Int) = Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2))

private final case class Face(a: Vec3, b: Vec3, c: Vec3):
  def bounds: Bounds3 = Bounds3(a, a).union(b).union(c)

  def map(f: Vec3 => Vec3): Face = Face(f(a), f(b), f(c))

  private def edges: Vector[(Vec3, Vec3)] = Vector((a, b), (b, c), (c, a))

  /** Whether they have points in common, or vertices of this one touch the other. */
  def overlaps(f: Face, margin: Float): Boolean =
    def touches(p: Vec3) =
      Face.Axes.exists(axis => f.isCrossed(p - axis * margin, p + axis * margin))
    edges.exists(f.isCrossed) || f.edges.exists(isCrossed) ||
    touches(a) || touches(b) || touches(c)

  /** Whether a line segment crosses or touches this face. */
  private def isCrossed(p: Vec3, q: Vec3): Boolean =
    def volume(u: Vec3, v: Vec3, w: Vec3, o: Vec3) = Face.volume(u - o, v - o, w - o)
    val (start, end) = (volume(a, b, c, p), volume(a, b, c, q))
    (start <= 0 && end >= 0 || start >= 0 && end <= 0) && {
      val (x, y, z) = (volume(a, b, q, p), volume(b, c, q, p), volume(c, a, q, p))
      x >= 0 && y >= 0 && z >= 0 || x <= 0 && y <= 0 && z <= 0
    } && (start != 0 || end != 0)

  /** What the face adds to the winding around a point: ±1 if it is ahead along x, else 0. Points on
    * edges count for one of the faces.
    */
  def crossing(p: Vec3): Int =
    def side(u: Vec3, v: Vec3): Int =
      if (u.z > p.z) == (v.z > p.z) then 0
      else
        val (low, high) = if u.z < v.z then (u, v) else (v, u)
        val y = low.y + (high.y - low.y).toDouble * (p.z - low.z) / (high.z - low.z)
        if y <= p.y then 0 else if v.z > u.z then 1 else -1
    val sum = side(a, b) + side(b, c) + side(c, a)
    if sum == 0 then 0
    else
      val height = Face.volume(b - a, c - a, p - a)
      if height * sum < 0 then sum else 0

private object Face:
  private val Axes = Vector(Vec3(1f, 0f, 0f), Vec3(0f, 1f, 0f), Vec3(0f, 0f, 1f))

  private def volume(u: Vec3, v: Vec3, w: Vec3): Double =
    val x = v.y.toDouble * w.z - v.z.toDouble * w.y
    val y = v.z.toDouble * w.x - v.x.toDouble * w.z
    val z = v.x.toDouble * w.y - v.y.toDouble * w.x
    u.x * x + u.y * y + u.z * z
