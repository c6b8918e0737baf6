package candela.models

import candela.diagnostics.SourcePos
import candela.scenefile.{Param, ParamType}

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
    def spread(values: Array[Float], each: Int) =
      if values.isEmpty then values
      else Array.tabulate(each * indices.length)(i => values(each * indices(i / each) + i % each))
    Mesh(
      spread(positions, 3),
      Array.range(0, indices.length),
      spread(normals, 3),
      spread(uvs, 2),
      Array.tabulate(4 * indices.length)(i => colors(4 * (i / 12) + i % 4)),
      spread(rests, 3)
    )
