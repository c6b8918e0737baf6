package candela.build

import candela.scenefile.ParamType

/** Checks that the arrays of a mesh fit together. */
private[build] object MeshArrays:
  def checked(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )(using site: Site): Option[ShapeGeometry] =
    val vertices = positions.length / 3
    def problem(what: String): Option[String] = Some(what)
    val wrong =
      if positions.length % 3 != 0 then
        problem(s"`P` holds ${positions.length} numbers, not triples")
      else if indices.length % 3 != 0 then
        problem(s"`indices` holds ${indices.length} numbers, not triples")
      else
        indices.find(i => i < 0 || i >= vertices) match
          case Some(i) =>
            problem(s"`indices` names vertex $i, but `P` has $vertices (0 to ${vertices - 1})")
          case None =>
            if positions.exists(x => !java.lang.Float.isFinite(x)) then
              problem("`P` holds a number that is not finite")
            else None
    wrong match
      case Some(message) =>
        site.error(message)
        None
      case None =>
        Some(
          ShapeGeometry.Triangles(
            positions,
            matching("N", normals, vertices, 3),
            matching("uv", uvs, vertices, 2),
            indices
          )
        )

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
