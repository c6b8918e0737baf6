package candela.build.shapes

import candela.base.{FloatBuffer, IntBuffer, RestBuffer, loop}
import candela.diagnostics.{Code, Problem, SceneError, Severity, SourcePos}
import candela.geometry.Polygons
import candela.io.{InputFile, IoReason}
import java.io.IOException

import candela.math.{Position, Transform}
import candela.scenefile.Source

/** Mesh of a PLY file.
  *
  * @param positions x, y, z of each vertex; all finite
  * @param rests     what `positions` lack of the numbers in the file, as in [[Param.rests]]
  * @param normals   x, y, z of each vertex, not normalised; empty if the file has none. Components
  *                  that are not finite are 0, which means no normal.
  * @param uvs       u, v of each vertex; empty if the file has none
  * @param indices   three vertex indices per triangle, all in range
  * @param quads     four vertex indices per quad that was kept, in the order 0 1 3 2 of its corners
  * @param ofVertices other numbers of each vertex, by property, in their order; if asked for
  * @param ofTriangles likewise, of the faces that triangles are parts of
  * @param wholes    what stands for 1 in those numbers that are unsigned bytes or words
  * @param omitted   properties and elements that are not read
  */
final class PlyMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val indices: Array[Int],
    val quads: Array[Int],
    val ofVertices: Vector[(String, Array[Float])] = Vector.empty,
    val ofTriangles: Vector[(String, Array[Float])] = Vector.empty,
    val rests: Array[Float] = Array.emptyFloatArray,
    val wholes: Map[String, Float] = Map.empty,
    val omitted: Vector[String] = Vector.empty
):
  /** Around another point, if digits of the vertices would be missing in the world. */
  def recentred(toWorld: Transform): Option[(PlyMesh, Position)] =
    FarPoints.middle(positions, rests, toWorld).map: origin =>
      val points = FarPoints.relative(positions, rests, origin)
      (PlyMesh(points, normals, uvs, indices, quads, ofVertices, ofTriangles), origin)

/** Reads meshes in the polygon file format: ASCII, binary of both byte orders, and either gzipped.
  *
  * Quads become the triangles 0 1 2 and 3 0 2, as in pbrt-v3; larger faces a fan. Faces of fewer
  * than three corners are skipped, as are elements other than vertices and faces.
  */
object PlyFile:

  /** @param at        position of the reference in the scene, for error messages
    * @param keepQuads whether to keep quads as they are
    * @param keepsAll  whether to keep all numbers of vertices and faces
    * @param cutsEars  whether faces may be concave, so that fans won't do
    */
  def read(
      file: InputFile,
      at: Option[SourcePos] = None,
      keepQuads: Boolean = false,
      keepsAll: Boolean = false,
      cutsEars: Boolean = false
  ): PlyMesh =
    Source.read(file) match
      case Right(source) => mesh(source, at, keepQuads, keepsAll, cutsEars)
      case Left(why) => throw problem(at, s"can't read the mesh `$file`: $why")

  /** Positions of the first vertices, at most `limit`. */
  def firstPositions(file: InputFile, limit: Int): Array[Double] =
    def fail(at: Long, message: String) = throw problem(None, message)
    Source.read(file) match
      case Left(why) => fail(0, why)
      case Right(source) =>
        try
          val header = PlyHeader.read(source, fail)
          PlyReader(
            header,
            PlyNumbers.of(source, header, fail),
            fail = fail
          ).firstPositions(limit)
        finally source.close()

  private def problem(at: Option[SourcePos], message: String): SceneError =
    SceneError(Problem(Code.DamagedMesh, Severity.Error, at, message))

  private[build] def mesh(
      source: Source,
      at: Option[SourcePos],
      keepQuads: Boolean = false,
      keepsAll: Boolean = false,
      cutsEars: Boolean = false
  ): PlyMesh =
    var isAscii = true
    def fail(offset: Long, message: String): Nothing =
      val location = if isAscii then s"line ${lineOf(offset, source)}" else s"byte $offset"
      throw problem(at, s"mesh `${source.name}`, $location: $message")
    try
      val header = PlyHeader.read(source, fail)
      isAscii = header.format == PlyFormat.Ascii
      val numbers = PlyNumbers.of(source, header, fail)
      PlyReader(header, numbers, keepQuads, keepsAll, cutsEars, fail).read()
    catch
      case e: IOException =>
        throw problem(at, s"can't read the mesh `${source.name}`: ${IoReason(e)}")
    finally source.close()

  /** Finds the line of an offset by reading the file again. */
  private def lineOf(offset: Long, source: Source): Long =
    var line = 1L
    for again <- source.again do
      try
        while again.offset(again.limit) < offset && !again.isLast do
          line += count(again, again.limit)
          again.slide(again.limit)
        line += count(again, (offset - again.offset(0)).min(again.limit).toInt)
      finally again.close()
    line

  private def count(source: Source, until: Int): Int =
    var lines = 0
    loop(until)(i => if source.bytes(i) == '\n' then lines += 1)
    lines

/** Reads the elements of a PLY file.
  *
  * @param keepQuads whether to keep quads as they are
  * @param keepsAll  whether to keep all numbers of vertices and faces
  * @param cutsEars  whether faces may be concave
  * @param fail      reports a problem at a byte offset
  */
private[build] final class PlyReader(
    header: PlyHeader,
    in: PlyNumbers,
    keepQuads: Boolean = false,
    keepsAll: Boolean = false,
    cutsEars: Boolean = false,
    fail: (Long, String) => Nothing
):
  private val rests = RestBuffer()
  private var positions = Array.emptyFloatArray
  private var normals = Array.emptyFloatArray
  private var uvs = Array.emptyFloatArray
  private val indices = IntBuffer()
  private val quads = IntBuffer()
  private val polygon = IntBuffer()
  private val polygons = Polygons()
  private var ofVertices = Vector.empty[(String, Array[Float])]
  private var ofTriangles = Vector.empty[(String, FloatBuffer)]

  def read(): PlyMesh =
    val vertexCount = needed("vertex").count
    val _ = needed("face")
    header.elements.filter(_.properties.nonEmpty).foreach: element =>
      if !in.canHold(element) then
        fail(in.offset, s"the file is too short for its ${element.count} ${element.name} elements")
      element.name match
        case "vertex" => readVertices(element)
        case "face" => readFaces(element, vertexCount)
        case _ => loop(element.count)(_ => element.properties.foreach(skip))
    val triangles = indices.drain()
    val patches = quads.drain()
    if triangles.isEmpty && patches.isEmpty then fail(in.offset, "no face has three corners")
    val triangleValues = ofTriangles.map((name, values) => name -> values.drain())
    val missing = rests.drain(positions.length)
    PlyMesh(
      positions,
      normals,
      uvs,
      triangles,
      patches,
      ofVertices,
      triangleValues,
      missing,
      header.wholes,
      header.omitted(PlyReader.Corners)
    )

  /** Positions of the first vertices, if the file begins with them. */
  def firstPositions(limit: Int): Array[Double] =
    val element = header.elements.head
    val columns = PlyReader.Position.map(name => element.properties.indexWhere(_.name == name))
    if element.name != "vertex" || columns.exists(_ < 0) ||
      element.properties.exists(_.countType.nonEmpty)
    then Array.emptyDoubleArray
    else
      Array.fill(Math.min(limit, element.count)):
        val row = element.properties.map(p => in.next(p.valueType))
        columns.map(row(_))
      .flatten

  private def needed(name: String): PlyElement =
    header.elements.find(_.name == name).filter(_.count > 0).getOrElse:
      val listed = header.elements.map(e => s"${e.count} ${e.name}").mkString(", ")
      val summary = if listed.isEmpty then "none" else listed
      fail(in.offset, s"the file must have $name elements, found $summary")

  private def readVertices(element: PlyElement): Unit =
    val names = element.properties.filter(_.countType.isEmpty).map(_.name)
    def hasAll(wanted: Seq[String]) = wanted.forall(names.contains)
    def room(wanted: Seq[String]) =
      new Array[Float](if hasAll(wanted) then element.count * wanted.size else 0)
    if !hasAll(PlyReader.Position) then
      val listed = element.properties.map(_.name).mkString("`", "`, `", "`")
      fail(in.offset, s"vertices must have `x`, `y` and `z`, found $listed")
    val uvNames = PlyReader.TextureCoordinates.find(hasAll).getOrElse(PlyReader.NoCoordinates)
    positions = room(PlyReader.Position)
    normals = room(PlyReader.Normal)
    uvs = room(uvNames)
    // for each property the target array (or null), its numbers per vertex, and the index among
    // these
    val roles = element.properties.map: p =>
      val arrays = List(positions, normals, uvs)
      val groups = List(PlyReader.Position, PlyReader.Normal, uvNames)
        .zip(arrays)
        .filter((g, array) => g.contains(p.name) && array.nonEmpty)
      val group = groups.headOption.filter(_ => p.countType.isEmpty)
      group.map((g, array) => (array, g.size, g.indexOf(p.name))).orElse:
        Option.when(keepsAll && p.countType.isEmpty):
          val values = new Array[Float](element.count)
          ofVertices :+= p.name -> values
          (values, 1, 0)
    val targets = roles.map(_.fold(null)(_._1)).toArray
    val strides = roles.map(_.fold(0)(_._2)).toArray
    val offsets = roles.map(_.fold(0)(_._3)).toArray
    val properties = element.properties.toArray
    val row = new Array[Float](properties.length)
    val isRow = properties.forall(p => p.countType.isEmpty && p.valueType == PlyType.Float32)
    loop(element.count): i =>
      if isRow && in.finiteRow(row) then
        loop(row.length): k =>
          val target = targets(k)
          if target != null then target(i * strides(k) + offsets(k)) = row(k)
      else
        loop(properties.length): k =>
          val target = targets(k)
          if target == null then skip(properties(k))
          else
            val index = i * strides(k) + offsets(k)
            target(index) = number(properties(k), target eq positions, i, index)

  /** The property's value; 0 if it is not finite, except in positions, where that is an error. */
  private def number(p: PlyProperty, isPosition: Boolean, vertex: Int, i: Int): Float =
    val offset = in.offset
    val exact = in.next(p.valueType)
    val value = exact.toFloat
    if java.lang.Float.isFinite(value) then
      if isPosition && RestBuffer.isCoarse(value) then rests.note(i, exact, value)
      value
    else if isPosition then
      fail(offset, s"`${p.name}` of vertex $vertex must be finite, found $value")
    else 0f

  private def skip(p: PlyProperty): Unit =
    val length = p.countType.fold(1)(in.length)
    loop(length)(_ =>
      val _ = in.next(p.valueType)
    )

  private def readFaces(element: PlyElement, vertexCount: Int): Unit =
    val corners =
      element.properties.indexWhere(p => PlyReader.Corners(p.name) && p.countType.nonEmpty)
    if corners < 0 then
      val listed = element.properties.map(_.name).mkString("`", "`, `", "`")
      fail(in.offset, s"faces must have a list `vertex_indices`, found $listed")
    val properties = element.properties.toArray
    val isPlain = properties.length == 1 && PlyReader.isUsualList(properties(0))
    val retained = properties.map(p => keepsAll && p.countType.isEmpty)
    ofTriangles =
      properties.toVector.zip(retained).collect { case (p, true) => p.name -> FloatBuffer() }
    val faceValues = new Array[Float](ofTriangles.size)
    val three = new Array[Int](3)
    loop(element.count): _ =>
      if isPlain && in.triangle(three, vertexCount) then triangle(three(0), three(1), three(2))
      else
        val firstIndex = indices.length
        var i = 0
        loop(properties.length): k =>
          if k == corners then readCorners(properties(k), vertexCount)
          else if retained(k) then
            val value = in.next(properties(k).valueType).toFloat
            faceValues(i) = if java.lang.Float.isFinite(value) then value else 0f
            i += 1
          else skip(properties(k))
        loop((indices.length - firstIndex) / 3)(_ =>
          loop(faceValues.length)(i => ofTriangles(i)._2 += faceValues(i))
        )

  private def readCorners(p: PlyProperty, vertexCount: Int): Unit =
    val length = in.length(p.countType.get)
    if length < 3 then
      loop(length)(_ =>
        val _ = index(p.valueType, vertexCount)
      )
    else
      val first = index(p.valueType, vertexCount)
      val second = index(p.valueType, vertexCount)
      val last = index(p.valueType, vertexCount)
      if length > 3 && cutsEars && positions.nonEmpty then
        readPolygon(p, vertexCount, Array(first, second, last), length)
      else readFan(p, vertexCount, first, second, last, length)

  /** The rest of a face that may be concave. */
  private def readPolygon(p: PlyProperty, vertexCount: Int, three: Array[Int], length: Int): Unit =
    polygon.clear()
    three.foreach(polygon += _)
    loop(length - 3)(_ => polygon += index(p.valueType, vertexCount))
    polygons.triangulate(positions, length)(polygon(_)): (a, b, c) =>
      triangle(polygon(a), polygon(b), polygon(c))

  private def readFan(
      p: PlyProperty,
      vertexCount: Int,
      first: Int,
      second: Int,
      third: Int,
      length: Int
  ): Unit =
    var last = third
    val isQuad = length == 4 && keepQuads
    if !isQuad then triangle(first, second, last)
    loop(length - 3): _ =>
      val next = index(p.valueType, vertexCount)
      // 3 0 2 for the second half of a quad; larger faces use the order of the fan
      if isQuad then
        quads += first
        quads += second
        quads += next
        quads += last
      else if length == 4 then triangle(next, first, last)
      else triangle(first, last, next)
      last = next

  private def triangle(a: Int, b: Int, c: Int): Unit =
    indices += a
    indices += b
    indices += c

  private def index(t: PlyType, vertexCount: Int): Int =
    val offset = in.offset
    val value = in.next(t)
    if !(value >= 0 && value < vertexCount && value == Math.rint(value)) then
      val range = s"between 0 and ${vertexCount - 1}"
      fail(offset, s"the vertex index of a face must be $range, found ${PlyNumbers.plain(value)}")
    value.toInt

private[build] object PlyReader:
  private val Position = Seq("x", "y", "z")
  private val Normal = Seq("nx", "ny", "nz")
  val Corners = Set("vertex_indices", "vertex_index")

  /** Whether [[PlyNumbers.triangle]] can read it. */
  private def isUsualList(p: PlyProperty): Boolean =
    p.countType.exists(_.bytes == 1) && (p.valueType match
      case PlyType.Int32 | PlyType.UInt32 => true
      case _ => false)

  private val NoCoordinates = Seq.empty[String]

  /** Common names of texture coordinates. */
  private val TextureCoordinates = List(
    Seq("u", "v"),
    Seq("s", "t"),
    Seq("texture_u", "texture_v"),
    Seq("texture_s", "texture_t")
  )
