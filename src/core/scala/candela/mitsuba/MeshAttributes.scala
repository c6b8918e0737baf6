package candela.mitsuba

import candela.base.loop
import candela.build.shapes.PlyMesh
import candela.color.Encoding

/** Numbers of a mesh, at its vertices or of its faces, by Mitsuba's names. Each triangle has 2 × 2
  * cells of a grid over u and v, in which they are interpolated: bilinearly between three corners
  * and a fourth that continues the plane is linearly.
  *
  * @param isSrgb whether Mitsuba 0.6 decodes the colours
  */
final class MeshAttributes(ply: PlyMesh, isSrgb: Boolean = true):
  private val triangles = ply.indices.length / 3
  private val across = Math.max(1, Math.ceil(Math.sqrt(triangles.toDouble)).toInt)

  /** Cells of the grid. */
  val width: Int = 2 * across
  val height: Int = 2 * ((triangles + across - 1) / across)

  private val groups: Map[String, Vector[Array[Float]]] =
    (MeshAttributes.grouped("vertex", ply.ofVertices) ++
      MeshAttributes.grouped("face", ply.ofTriangles)).toMap

  def names: Iterable[String] = groups.keys

  /** The grid of an attribute, channels of a cell adjacent, with their number; None: unknown. */
  def grid(name: String): Option[(Int, Array[Float])] =
    groups.get(name).map(grid(name, _))

  /** The colours of vertices in linear light, as of Mitsuba 0.6. */
  def vertexColors: Option[(Int, Array[Float])] =
    for channels <- groups.get("vertex_color").map(_.take(3)) if channels.size == 3 yield
      val areBytes = channels.exists(_.exists(_ > 1f))
      def linear(x: Float) =
        val value = if areBytes then x / 255f else x
        if isSrgb then Encoding.Srgb.decode(value) else value
      grid("vertex_color", channels.map(_.map(linear)))

  private def grid(name: String, channels: Vector[Array[Float]]): (Int, Array[Float]) =
    val count = channels.size
    val texels = new Array[Float](width * height * count)
    loop(triangles): t =>
      loop(count): c =>
        val values = channels(c)
        def corner(k: Int) =
          if name.startsWith("face") then values(t) else values(ply.indices(3 * t + k))
        val (p, q, r) = (corner(0), corner(1), corner(2))
        val base = cell(t)
        texels(base * count + c) = p
        texels((base + 1) * count + c) = q
        texels((base + width) * count + c) = r
        texels((base + width + 1) * count + c) = q + r - p
    (count, texels)

  private def cell(triangle: Int): Int =
    triangle / across * 2 * width + triangle % across * 2

  /** The mesh with u and v of the grid. */
  def laidOut(mesh: Mesh): Mesh =
    val corners = mesh.indices.length
    def spread(values: Array[Float], count: Int) =
      if values.isEmpty then values
      else Array.tabulate(count * corners)(i => values(count * mesh.indices(i / count) + i % count))
    val uvs = new Array[Float](2 * corners)
    loop(corners): i =>
      val base = cell(i / 3)
      val (x, y) = (base % width + (if i % 3 == 1 then 1 else 0), base / width + i % 3 / 2)
      uvs(2 * i) = (x + 0.5f) / width
      uvs(2 * i + 1) = (y + 0.5f) / height
    Mesh(
      spread(mesh.positions, 3),
      spread(mesh.normals, 3),
      uvs,
      Array.range(0, corners),
      spread(mesh.rests, 3)
    )

object MeshAttributes:
  /** Types of textures that show them. */
  val Types: Set[String] = Set("mesh_attribute", "vertexcolors")

  private val Colors = Vector(Vector("r", "g", "b", "a"), Vector("red", "green", "blue", "alpha"))
  private val Numbered =
    Vector("x y z w", "r g b a", "0 1 2 3", "1 2 3 4").map(_.split(" ").toVector)

  /** Properties with a common prefix are one attribute; those of a colour need none, and
    * have `color` at the end of the name.
    */
  private[mitsuba] def grouped(
      kind: String,
      properties: Vector[(String, Array[Float])]
  ): Vector[(String, Vector[Array[Float]])] =
    val byName = properties.toMap
    val colors = Colors.find(c => byName.contains(c.head)).toVector.map: c =>
      s"${kind}_color" -> c.takeWhile(byName.contains).map(byName)
    val prefixes = properties.map(_._1).filter(_.contains("_"))
      .map(name => name.take(name.lastIndexOf('_'))).distinct
    val prefixed = prefixes.flatMap: prefix =>
      Numbered.map(_.map(s => s"${prefix}_$s").takeWhile(byName.contains)).find(_.nonEmpty)
        .map: components =>
          val suffix = if components.head.endsWith("_r") then "_color" else ""
          s"${kind}_$prefix$suffix" -> components.map(byName)
    colors ++ prefixed
