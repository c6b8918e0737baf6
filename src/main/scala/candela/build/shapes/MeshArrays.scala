package candela.build.shapes

import candela.build.recipe.*
import candela.scenefile.ParamType
import candela.shapes.{BilinearMesh, BilinearPatch}

/** Checks that the arrays of a mesh fit together. */
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
    val fits = isWhole(positions, indices)
    Option.when(fits)(triangles(positions, normals, uvs, indices))

  /** A mesh whose positions and indices are known to fit. */
  def triangles(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )(using Site): ShapeGeometry =
    val vertices = positions.length / 3
    ShapeGeometry.Triangles(
      positions,
      matching("N", normals, vertices, 3),
      matching("uv", uvs, vertices, 2),
      indices
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
    ShapeGeometry.Solids(
      (toWorld, reversed) =>
        val mesh = BilinearMesh(
          SoupBuilder.points(positions, toWorld),
          indices,
          SoupBuilder.normals(n, toWorld, reversed),
          t,
          flipped = reversed != toWorld.swapsHandedness
        )
        Vector.tabulate(mesh.count)(BilinearPatch(mesh, _))
      ,
      emits = true
    )

  /** Do indices name vertices, and are these finite? If not, that is reported. */
  def isWhole(positions: Array[Float], indices: Array[Int], corners: Int = 3)(using
      site: Site
  ): Boolean =
    val vertices = positions.length / 3
    def problem(what: String): Option[String] = Some(what)
    val wrong =
      if positions.length % 3 != 0 then
        problem(s"`P` holds ${positions.length} numbers, not triples")
      else if indices.length % corners != 0 then
        val groups = if corners == 3 then "triples" else s"groups of $corners"
        problem(s"`indices` holds ${indices.length} numbers, not $groups")
      else
        indices.find(i => i < 0 || i >= vertices) match
          case Some(i) =>
            problem(s"`indices` names vertex $i, but `P` has $vertices (0 to ${vertices - 1})")
          case None =>
            if positions.exists(x => !java.lang.Float.isFinite(x)) then
              problem("`P` holds a number that is not finite")
            else None
    wrong.foreach(site.error(_))
    wrong.isEmpty

  /** Attributes that don't match the number of vertices are dropped with a warning, as pbrt
    * does.
    */
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
        s"`$name` holds ${values.length} $kind; $vertices vertices need $needed; it is ignored"
      )
      Array.empty
