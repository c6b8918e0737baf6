package candela.models

import candela.build.shapes.CornerVertices
import candela.diagnostics.SourcePos
import candela.scenefile.{Param, ParamType}

import java.lang.Float.{floatToRawIntBits, intBitsToFloat}

/** Triangles, and numbers of their vertices; those that are empty are not there.
  *
  * @param normals of vertices; none: flat
  * @param uvs     with v from the bottom of images
  * @param colors  linear red, green, blue and alpha
  * @param rests   what Floats lack of the positions
  */
private[models] final case class Mesh(
    positions: Array[Float],
    indices: Array[Int],
    normals: Array[Float] = Array.emptyFloatArray,
    uvs: Array[Float] = Array.emptyFloatArray,
    colors: Array[Float] = Array.emptyFloatArray,
    rests: Array[Float] = Array.emptyFloatArray,
    tangents: Array[Float] = Array.emptyFloatArray,
    secondUvs: Array[Float] = Array.emptyFloatArray
):
  /** Those of a `trianglemesh`. */
  def params(at: SourcePos): Vector[Param] =
    def numbers(kind: ParamType, name: String, values: Array[Float]) =
      Option.when(values.nonEmpty)(Param.floats(kind, name, at, values))
    Vector(
      Some(Param.floats(ParamType.Point3, "P", at, positions, rests)),
      Some(Param.ints("indices", at, indices)),
      numbers(ParamType.Normal, "N", normals),
      numbers(ParamType.Float, "tangents", tangents),
      numbers(ParamType.Point2, "uv", uvs),
      numbers(ParamType.Point2, "uv2", secondUvs),
      numbers(ParamType.Float, "colors", colors)
    ).flatten

  /** With vertices of their own for all triangles.
    *
    * @param colors four components of each triangle
    */
  def coloredByTriangle(colors: Array[Float]): Mesh =
    gathered(indices, Array.range(0, indices.length))
      .copy(colors = Array.tabulate(4 * indices.length)(i => colors(4 * (i / 12) + i % 4)))

  /** With u, v of each of the indices. */
  def withCornerUvs(cornerUvs: Array[Float]): Mesh =
    val vertices = CornerVertices()
    val corners = Array.tabulate(indices.length): i =>
      vertices(
        indices(i),
        floatToRawIntBits(cornerUvs(2 * i)),
        floatToRawIntBits(cornerUvs(2 * i + 1))
      )
    val uvs = Array.tabulate(2 * vertices.size): i =>
      intBitsToFloat(if i % 2 == 0 then vertices.second(i / 2) else vertices.third(i / 2))
    gathered(Array.tabulate(vertices.size)(vertices.first), corners).copy(uvs = uvs)

  /** With other vertices, by their numbers here, and indices of these. */
  private def gathered(vertices: Array[Int], indices: Array[Int]): Mesh =
    def spread(values: Array[Float], each: Int) =
      if values.isEmpty then values
      else Array.tabulate(each * vertices.length)(i => values(each * vertices(i / each) + i % each))
    Mesh(
      spread(positions, 3),
      indices,
      spread(normals, 3),
      spread(uvs, 2),
      spread(colors, 4),
      spread(rests, 3)
    )
