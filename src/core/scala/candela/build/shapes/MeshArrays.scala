package candela.build.shapes

import candela.base.indexWhere
import candela.diagnostics.Code
import candela.build.recipe.*
import candela.scenefile.ParamType
import candela.shapes.{BilinearMesh, BilinearPatch}

/** Checks that the arrays of a mesh are consistent. */
private[build] object MeshArrays:

  /** Two triangles for each cell of a grid of vertices, split from its first corner. */
  def grid(columns: Int, rows: Int): Array[Int] =
    val indices = Array.newBuilder[Int]
    for y <- 0 until rows - 1; x <- 0 until columns - 1 do
      val i = y * columns + x
      indices ++= Seq(i, i + 1, i + columns + 1, i, i + columns + 1, i + columns)
    indices.result()

  def checked(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )(using site: Site): Option[ShapeGeometry] =
    val faces = wholeFaces(indices, 3)
    val fits = isWhole(positions, faces)
    Option.when(fits)(triangles(positions, normals, uvs, faces))

  /** Drops the indices of an incomplete last face, with a warning, as pbrt does. */
  def wholeFaces(indices: Array[Int], corners: Int)(using site: Site): Array[Int] =
    val extra = indices.length % corners
    if extra > 0 && indices.length > corners then
      val ignored = if extra == 1 then "the last is" else s"the last $extra are"
      site.warn(
        Code.BrokenMesh,
        s"`indices` must have a multiple of $corners numbers, found ${indices.length}; $ignored " +
          "ignored, as pbrt does"
      )
      indices.dropRight(extra)
    else indices

  /** A mesh with checked positions and indices.
    *
    * @param content as in [[ShapeGeometry.Triangles]]
    */
  def triangles(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int],
      content: Option[String] = None
  )(using Site): ShapeGeometry =
    val vertices = positions.length / 3
    ShapeGeometry.Triangles(
      positions,
      matching("N", normals, vertices, 3),
      matching("uv", uvs, vertices, 2),
      indices,
      content
    )

  /** Bilinear patches; four indices each, in the order of [[BilinearMesh]]. */
  def patches(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )(using site: Site): ShapeGeometry =
    val vertices = positions.length / 3
    val n = matching("N", normals, vertices, 3)
    val t = matching("uv", uvs, vertices, 2)
    ShapeGeometry.Solids((toWorld, reversed) =>
      val mesh = BilinearMesh(
        SoupBuilder.points(positions, toWorld),
        indices,
        SoupBuilder.normals(n, toWorld, reversed),
        t,
        flipped = reversed != toWorld.swapsHandedness
      )
      Vector.tabulate(mesh.count)(BilinearPatch(mesh, _))
    )

  /** Checks that indices are in range and positions finite. Reports an error otherwise. */
  def isWhole(positions: Array[Float], indices: Array[Int], corners: Int = 3)(using
      site: Site
  ): Boolean =
    val vertices = positions.length / 3
    def problem(what: String): Option[String] = Some(what)
    val wrong =
      if positions.length % 3 != 0 then
        problem(s"`P` must have a multiple of 3 numbers, found ${positions.length}")
      else if indices.length % corners != 0 then
        val count = indices.length
        problem(s"`indices` must have a multiple of $corners numbers, found $count")
      else
        indexWhere(indices.length)(i => indices(i) < 0 || indices(i) >= vertices) match
          case -1 =>
            Option.unless(isFinite(positions))("`P` must not contain NaN or infinite numbers")
          case i =>
            val range = s"0 to ${vertices - 1}"
            problem(s"`indices` must be vertices of `P`, $range, found ${indices(i)}")
    wrong.foreach(site.unusable(Code.BrokenMesh, _))
    wrong.isEmpty

  /** Whether no number is infinite or NaN. */
  def isFinite(numbers: Array[Float]): Boolean =
    indexWhere(numbers.length)(i => !java.lang.Float.isFinite(numbers(i))) < 0

  /** Drops attributes that don't match the number of vertices, with a warning, as pbrt does. */
  private def matching(name: String, values: Array[Float], vertices: Int, each: Int)(using
      site: Site
  ): Array[Float] =
    if values.length == 0 || values.length == vertices * each then values
    else
      val kind = if site.declaration.param(name).exists(_.paramType == ParamType.Float) then
        "numbers"
      else "values"
      val needed = vertices * each
      site.warn(
        Code.BrokenMesh,
        s"`$name` must have $needed $kind for $vertices vertices, found ${values.length}; " +
          "it is ignored"
      )
      Array.empty
