package candela.convert

import candela.base.loop
import java.nio.{ByteBuffer, ByteOrder}

import candela.scenefile.{Declaration, Param, ParamType, SceneDescription, ShapeDescription}

/** Moves large meshes to binary PLY files: little-endian, 32-bit floats, doubles for vertices with
  * more digits.
  */
object PlyWriter:

  /** The scene with every mesh of at least `minTriangles` triangles moved to its own file. */
  def extract(scene: SceneDescription, minTriangles: Int, files: SideFiles): SceneDescription =
    def shape(s: ShapeDescription) =
      val d = s.shape
      val count = d.param("indices").fold(0)(_.ints.length / 3)
      if count >= minTriangles && Meshes.fitsPly(d) then s.copy(shape = moved(d, files)) else s
    scene.copy(
      shapes = scene.shapes.map(shape),
      objects = scene.objects.map((name, shapes) => name -> shapes.map(shape))
    )

  private def moved(d: Declaration, files: SideFiles): Declaration =
    val name = files.add("mesh", "ply", bytes(d))
    val position = d.param("P").get.pos
    val filename = Param(ParamType.String, "filename", position, position, strings = Vector(name))
    val remaining = d.params.filterNot(p => InFile(p.name))
    d.copy(name = "plymesh", params = filename +: remaining)

  private val InFile = Set("P", "N", "uv", "st", "indices", "discarddegenerateUVs")

  /** The file of a `trianglemesh`. */
  def bytes(d: Declaration): Array[Byte] =
    def floats(name: String) = d.param(name).fold(Array.emptyFloatArray)(_.floats)
    val (p, n) = (floats("P"), floats("N"))
    val uv = if floats("uv").nonEmpty then floats("uv") else floats("st")
    val indices = d.param("indices").get.ints
    val (vertices, faces) = (p.length / 3, indices.length / 3)
    val names = Vector("x", "y", "z") ++ (if n.nonEmpty then Vector("nx", "ny", "nz") else Nil) ++
      (if uv.nonEmpty then Vector("u", "v") else Nil)
    val rests = d.param("P").get.rests
    val isFine = rests.nonEmpty
    def kind(name: String) =
      if isFine && Set("x", "y", "z")(name) then "double" else "float"
    val header = (Vector("ply", "format binary_little_endian 1.0", s"element vertex $vertices") ++
      names.map(name => s"property ${kind(name)} $name") ++
      Vector(s"element face $faces", "property list uchar int vertex_indices", "end_header"))
      .map(_ + "\n").mkString.getBytes("US-ASCII")
    val buffer =
      ByteBuffer.allocate(header.length + vertices * (4 * names.size + (if isFine then 12
                                                                        else 0)) + faces * 13)
    buffer.order(ByteOrder.LITTLE_ENDIAN).put(header)
    def number(x: Float): Unit =
      val _ = buffer.putFloat(x)
    def index(i: Int): Unit =
      val _ = buffer.putInt(i)
    loop(vertices): i =>
      if isFine then loop(3)(k => buffer.putDouble(d.param("P").get.number(3 * i + k)): Unit)
      else loop(3)(k => number(p(3 * i + k)))
      if n.nonEmpty then loop(3)(k => number(n(3 * i + k)))
      if uv.nonEmpty then loop(2)(k => number(uv(2 * i + k)))
    loop(faces): i =>
      val _ = buffer.put(3.toByte)
      loop(3)(k => index(indices(3 * i + k)))
    buffer.array
