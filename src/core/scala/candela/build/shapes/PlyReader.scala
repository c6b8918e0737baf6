package candela.build.shapes

import candela.base.{FloatBuffer, IntBuffer, RestBuffer, loop}
import candela.geometry.Polygons

/** Reads the elements of a PLY file.
  *
  * @param keepQuads whether to keep quads as they are
  * @param keepsAll  whether to keep all numbers of vertices and faces
  * @param isModel   whether the file is a model of its own, as in [[PlyFile]]
  * @param fail      reports a problem at a byte offset
  */
private[build] final class PlyReader(
    header: PlyHeader,
    in: PlyNumbers,
    keepQuads: Boolean = false,
    keepsAll: Boolean = false,
    isModel: Boolean = false,
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
  private val wedge = FloatBuffer()
  private val triangleCorners = IntBuffer()
  private val cornerUvs = FloatBuffer()
  private var ofVertices = Vector.empty[(String, Array[Float])]
  private var ofTriangles = Vector.empty[(String, FloatBuffer)]

  def read(): PlyMesh =
    val vertexCount = needed("vertex").count
    val surface = if isModel then this.surface else needed("face")
    header.elements.filter(_.properties.nonEmpty).foreach: element =>
      if !in.canHold(element) then
        fail(in.offset, s"the file is too short for its ${element.count} ${element.name} elements")
      element.name match
        case "vertex" => readVertices(element)
        case name if name == surface.name =>
          if name == "face" then readFaces(element, vertexCount)
          else readStrips(element, vertexCount)
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
      header.omitted(Map("vertex" -> Set.empty, surface.name -> listsOf(surface))),
      cornerUvs.drain(),
      header.images
    )

  /** Names of the lists that are read. */
  private def listsOf(surface: PlyElement): Set[String] =
    if isModel && surface.name == "face" then PlyReader.Corners + PlyReader.Wedge
    else PlyReader.Corners

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

  private def element(name: String): Option[PlyElement] =
    header.elements.find(e => e.name == name && e.count > 0)

  private def needed(name: String): PlyElement = element(name).getOrElse:
    fail(in.offset, s"the file must have $name elements, found $summary")

  /** Elements and their numbers. */
  private def summary: String =
    val listed = header.elements.map(e => s"${e.count} ${e.name}").mkString(", ")
    if listed.isEmpty then "none" else listed

  private def surface: PlyElement = element("face").orElse(element("tristrips")).getOrElse:
    fail(in.offset, s"the model has no faces, found $summary; points are not supported")

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
    val corners = cornersOf(element, "faces")
    val properties = element.properties.toArray
    val wedges = properties.indexWhere(p =>
      isModel && p.name == PlyReader.Wedge && p.countType.nonEmpty
    )
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
        triangleCorners.clear()
        var i = 0
        loop(properties.length): k =>
          if k == corners then readCorners(properties(k), vertexCount)
          else if k == wedges then readWedge(properties(k))
          else if retained(k) then
            val value = in.next(properties(k).valueType).toFloat
            faceValues(i) = if java.lang.Float.isFinite(value) then value else 0f
            i += 1
          else skip(properties(k))
        loop((indices.length - firstIndex) / 3)(_ =>
          loop(faceValues.length)(i => ofTriangles(i)._2 += faceValues(i))
        )
        if wedges >= 0 then loop(triangleCorners.length)(i => addCornerUv(triangleCorners(i)))

  /** Index of the list of vertices. */
  private def cornersOf(element: PlyElement, what: String): Int =
    val index =
      element.properties.indexWhere(p => PlyReader.Corners(p.name) && p.countType.nonEmpty)
    if index < 0 then
      val listed = element.properties.map(_.name).mkString("`", "`, `", "`")
      fail(in.offset, s"$what must have a list `vertex_indices`, found $listed")
    index

  /** The texture coordinates of a face's corners. */
  private def readWedge(p: PlyProperty): Unit =
    wedge.clear()
    loop(in.length(p.countType.get)): _ =>
      val value = in.next(p.valueType).toFloat
      wedge += (if java.lang.Float.isFinite(value) then value else 0f)

  /** Corners without coordinates have 0, 0. */
  private def addCornerUv(corner: Int): Unit =
    loop(2): k =>
      val i = 2 * corner + k
      cornerUvs += (if i < wedge.length then wedge(i) else 0f)

  /** Strips of triangles that turn alternately; an index of −1 begins a new one. */
  private def readStrips(element: PlyElement, vertexCount: Int): Unit =
    val corners = cornersOf(element, element.name)
    val properties = element.properties.toArray
    loop(element.count): _ =>
      loop(properties.length): k =>
        if k == corners then readStrip(properties(k), vertexCount) else skip(properties(k))

  private def readStrip(p: PlyProperty, vertexCount: Int): Unit =
    var (first, second, count) = (0, 0, 0)
    loop(in.length(p.countType.get)): _ =>
      val next = index(p.valueType, vertexCount, least = -1)
      if next < 0 then count = 0
      else
        if count >= 2 then
          if count % 2 == 0 then triangle(first, second, next) else triangle(second, first, next)
        first = second
        second = next
        count += 1

  private def readCorners(p: PlyProperty, vertexCount: Int): Unit =
    val length = in.length(p.countType.get)
    if length < 3 then
      loop(length)(_ =>
        val _ = index(p.valueType, vertexCount)
      )
    else
      if isModel then readPolygon(p, vertexCount, length)
      else
        val first = index(p.valueType, vertexCount)
        val second = index(p.valueType, vertexCount)
        val last = index(p.valueType, vertexCount)
        readFan(p, vertexCount, first, second, last, length)

  /** A face that may be concave. */
  private def readPolygon(p: PlyProperty, vertexCount: Int, length: Int): Unit =
    polygon.clear()
    loop(length)(_ => polygon += index(p.valueType, vertexCount))
    def emit(a: Int, b: Int, c: Int): Unit =
      triangle(polygon(a), polygon(b), polygon(c))
      triangleCorners += a
      triangleCorners += b
      triangleCorners += c
    if positions.isEmpty then loop(length - 2)(i => emit(0, i + 1, i + 2)) // vertices follow
    else polygons.triangulate(positions, length)(polygon(_))(emit)

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

  private def index(t: PlyType, vertexCount: Int, least: Int = 0): Int =
    val offset = in.offset
    val value = in.next(t)
    if !(value >= least && value < vertexCount && value == Math.rint(value)) then
      val range = s"between $least and ${vertexCount - 1}"
      fail(offset, s"the vertex index of a face must be $range, found ${PlyNumbers.plain(value)}")
    value.toInt

private[build] object PlyReader:
  private val Position = Seq("x", "y", "z")
  private val Normal = Seq("nx", "ny", "nz")
  private val Corners = Set("vertex_indices", "vertex_index")

  /** MeshLab's list of u, v of each corner. */
  private val Wedge = "texcoord"

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
