package candela.mitsuba

import candela.base.{RestBuffer, loop}
import candela.build.shapes.VertexNormals
import candela.math.{Position, Transform, Vec3}

/** Triangles of a mesh file. Normals and coordinates may be empty.
  *
  * @param uvs   with v as in Mitsuba
  * @param rests what Floats lack of `positions`, as in [[candela.scenefile.Param]]
  */
final class Mesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val indices: Array[Int],
    val rests: Array[Float] = Array.emptyFloatArray
):

  /** In world space, as Mitsuba keeps meshes: reflections turn triangles over. */
  def placed(toWorld: Transform): Mesh =
    if toWorld.isIdentity then this
    else
      def inWorld(i: Int) = toWorld.position(point(i))
      val worldPositions = new Array[Float](positions.length)
      val missing = RestBuffer()
      def store(i: Int, x: Double): Unit =
        worldPositions(i) = x.toFloat
        if RestBuffer.isCoarse(worldPositions(i)) then missing.note(i, x, worldPositions(i))
      loop(positions.length / 3): i =>
        val p = inWorld(i)
        store(3 * i, p.x)
        store(3 * i + 1, p.y)
        store(3 * i + 2, p.z)
      Mesh(
        worldPositions,
        mapped(normals)(toWorld.normal),
        uvs,
        indices,
        missing.drain(worldPositions.length)
      )

  /** A vertex, with all its digits. */
  private def point(i: Int): Position =
    def exact(k: Int) =
      if rests.isEmpty then positions(k).toDouble else positions(k).toDouble + rests(k)
    Position(exact(3 * i), exact(3 * i + 1), exact(3 * i + 2))

  private def mapped(values: Array[Float])(f: Vec3 => Vec3): Array[Float] =
    val result = new Array[Float](values.length)
    loop(values.length / 3): i =>
      val v = f(Vec3(values(3 * i), values(3 * i + 1), values(3 * i + 2)))
      result(3 * i) = v.x
      result(3 * i + 1) = v.y
      result(3 * i + 2) = v.z
    result

  /** With coordinates where it has none, Mitsuba's: the weights of each triangle's second and third
    * corner.
    */
  def onTriangles: Mesh =
    if uvs.nonEmpty then this
    else
      val corners = Array(0f, 0f, 1f, 0f, 0f, 1f)
      Mesh(
        atCorners(positions, 3),
        atCorners(normals, 3),
        Array.tabulate(2 * indices.length)(i => corners(i % 6)),
        Array.range(0, indices.length),
        atCorners(rests, 3)
      )

  /** Without vertex normals. */
  def faceted: Mesh = Mesh(positions, Array.emptyFloatArray, uvs, indices, rests)

  /** Whether the mesh is so far out that Floats are too coarse for the angles of its triangles. */
  private def isFar: Boolean =
    rests.nonEmpty && (0 until 3).exists: k =>
      val along = Iterator.range(k, positions.length, 3).map(positions(_))
      val (low, high) = along.foldLeft((Float.MaxValue, -Float.MaxValue)): (box, x) =>
        (Math.min(box._1, x), Math.max(box._2, x))
      Math.max(Math.abs(low), Math.abs(high)) > Mesh.Far * (high - low)

  /** Its vertices around the first of them. */
  private def centred: Array[Float] =
    val anchor = point(0)
    val result = new Array[Float](positions.length)
    loop(positions.length / 3): i =>
      val p = point(i)
      result(3 * i) = (p.x - anchor.x).toFloat
      result(3 * i + 1) = (p.y - anchor.y).toFloat
      result(3 * i + 2) = (p.z - anchor.z).toFloat
    result

  /** With vertex normals, if it has none: those of the triangles, weighted by their angles at the
    * vertex.
    */
  def smooth: Mesh =
    if normals.nonEmpty then this
    else
      val sums = VertexNormals.ofVertices(centredIfFar, indices)
      Mesh(positions, sums, uvs, indices, rests).unit

  private def centredIfFar: Array[Float] = if isFar then centred else positions

  /** With vertex normals of its triangles, which are smooth across edges of at most an angle. */
  def smoothBelow(degrees: Double): Mesh =
    val weightedNormals = VertexNormals.ofCorners(centredIfFar, indices)
    def normalAt(c: Int) =
      Vec3(weightedNormals(3 * c), weightedNormals(3 * c + 1), weightedNormals(3 * c + 2))
    def unitOf(v: Vec3) = if v.lengthSquared > 0f then v.normalized else v
    val units = Array.tabulate(indices.length)(c => unitOf(normalAt(c)))
    val neighbours = indices.indices.groupBy: c =>
      val i = indices(c)
      (positions(3 * i), positions(3 * i + 1), positions(3 * i + 2))
    val minCosine = Math.cos(Math.toRadians(Math.max(0.0, Math.min(180.0, degrees)))) - 1e-5
    val sums = new Array[Float](3 * indices.length)
    for
      corners <- neighbours.values
      c <- corners
      other <- corners
      if units(c).dot(units(other)) >= minCosine
      k <- 0 until 3
    do sums(3 * c + k) += weightedNormals(3 * other + k)
    Mesh(
      atCorners(positions, 3),
      sums,
      atCorners(uvs, 2),
      Array.range(0, indices.length),
      atCorners(rests, 3)
    ).unit

  /** Values of vertices, at each corner. */
  private def atCorners(values: Array[Float], width: Int): Array[Float] =
    if values.isEmpty then values
    else Array.tabulate(width * indices.length)(i => values(width * indices(i / width) + i % width))

  private def unit: Mesh =
    Mesh(
      positions,
      mapped(normals)(n => if n.lengthSquared > 0f then n.normalized else Vec3.Z),
      uvs,
      indices,
      rests
    )

object Mesh:
  /** Sizes from the origin at which digits of a mesh's vertices are missing. */
  private val Far = 1024f

  /** The square of ±1 in the xy-plane, facing +z. */
  val rectangle: Mesh = Mesh(
    Array(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0),
    Array.emptyFloatArray,
    Array(0, 0, 1, 0, 1, 1, 0, 1),
    Array(0, 1, 2, 0, 2, 3)
  )

  /** The cube of ±1, with the coordinates of Mitsuba's on each side. */
  val cube: Mesh =
    val sides = Vector(
      "+-- +-+ --+ ---", "++- -+- -++ +++", "+-- ++- +++ +-+",
      "+-+ +++ -++ --+", "--+ -++ -+- ---", "++- +-- --- -+-"
    )
    val corners = sides.flatMap(_.split(' '))
    val positions = corners.flatMap(_.map(c => if c == '+' then 1f else -1f))
    val normals = Vector((0, -1, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1), (-1, 0, 0), (0, 0, -1))
      .flatMap((x, y, z) => Vector.fill(4)(Vector(x, y, z))).flatten.map(_.toFloat)
    val uvs = Vector.fill(6)(Vector(0f, 1f, 1f, 1f, 1f, 0f, 0f, 0f)).flatten
    val indices = (0 until 24 by 4).flatMap(i => Vector(i, i + 1, i + 2, i + 3, i, i + 2))
    Mesh(positions.toArray, normals.toArray, uvs.toArray, indices.toArray)
