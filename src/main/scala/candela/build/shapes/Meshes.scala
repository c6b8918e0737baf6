package candela.build.shapes

import candela.base.SceneError
import candela.build.recipe.*
import candela.scenefile.Dialect

object TriangleMeshRecipe extends MeshRecipe("trianglemesh", "triangles that share vertices"):
  private val indices =
    integers("indices", "three vertices a triangle; may be absent for 3 points")
  private val points = numbers("P", "point3[]", "vertex positions")
  private val normals = numbers("N", "normal[]", "shading normals, one a vertex")
  private val uv = numbers("uv", "point2[]", "texture coordinates, one pair a vertex")
  private val st = numbers("st", "point2[]", "another name of `uv`", untilV3)
  notYet("tangents come from uv")(numbers("S", "vector3[]", "tangents, one a vertex"))
  noMeaning("uv that don't span the surface do no harm")(
    bool("discarddegenerateUVs", "drop all uv if some don't span the surface", onlyV2)(false)
  )
  noMeaning("only Ptex textures ask for them")(
    integers("faceIndices", "numbers of faces, one a triangle", sinceV3)
  )

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val p = points()
    val uvs = if uv().nonEmpty then uv() else st()
    val given_ = indices()
    val index = if given_.isEmpty && p.length == 9 then Array(0, 1, 2) else given_
    val isEmpty = (points.given_(), indices.given_()) match
      case (Some(ps), Some(is)) => ps.isEmpty || is.isEmpty
      case _ => false
    if isEmpty then
      site.warn("a mesh without triangles is left out")
      None
    else if p.isEmpty || index.isEmpty then
      site.error("a trianglemesh needs `P` and `indices`")
      None
    else MeshArrays.checked(p, normals(), uvs, index)

object PlyMeshRecipe extends MeshRecipe("plymesh", "a mesh from a PLY file", sinceV3):
  private val filename = string("filename", "a .ply file (or .ply.gz)", shown = "none")("")
  notYet("the mesh is not displaced")(
    floatTexture("displacement", "along the normal", onlyV4, "scene units", "none")(0f),
    float("edgelength", "longest edge of the displaced mesh", onlyV4, "scene units")(1f)
  )

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    site.declaration.param("filename") match
      case Some(p) if filename().nonEmpty =>
        val standIn = StandIns.LeftOut
        site.resources.file(p, site.declaration, site.problems, standIn).flatMap: path =>
          try
            val mesh = PlyFile.read(path, keepQuads = site.dialect == Dialect.V4)
            Some(ofFile(mesh))
          catch
            case e: SceneError =>
              for x <- e.problems do site.problems.missing(p.valuesAt, x.message, standIn, x.help)
              None
      case _ =>
        site.error("a plymesh needs a `filename`")
        None

  /** Faces of four corners are bilinear patches in pbrt-v4, which bend where these don't lie in a
    * plane.
    */
  private def ofFile(mesh: PlyMesh)(using Site): ShapeGeometry =
    val faces = Vector(
      Option.when(mesh.indices.nonEmpty)(
        MeshArrays.triangles(mesh.positions, mesh.normals, mesh.uvs, mesh.indices)
      ),
      Option.when(mesh.quads.nonEmpty)(
        MeshArrays.patches(mesh.positions, mesh.normals, mesh.uvs, mesh.quads)
      )
    ).flatten
    if faces.size == 1 then faces.head else ShapeGeometry.Several(faces)

object BilinearMeshRecipe
    extends ShapeRecipe("bilinearmesh", "patches between four corners each", onlyV4):
  private val indices = integers(
    "indices",
    "four vertices a patch, in the order (0,0), (1,0), (0,1), (1,1) of u and v; may be absent " +
      "for 4 points"
  )
  private val points = numbers("P", "point3[]", "vertex positions")
  private val normals = numbers("N", "normal[]", "shading normals, one a vertex")
  private val uv = numbers("uv", "point2[]", "texture coordinates, one pair a vertex")
  noMeaning("it is where pbrt looks for light first; the picture is the same")(
    string("emissionfilename", "image of the emission", shown = "none")("")
  )
  noMeaning("only Ptex textures ask for them")(
    integers("faceIndices", "numbers of faces, one a patch")
  )

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val p = points()
    val given_ = indices()
    val all = if given_.isEmpty && p.length == 12 then Array(0, 1, 2, 3) else given_
    val extra = all.length % 4
    if p.isEmpty || all.length < 4 then
      site.error("a bilinearmesh needs `P` and `indices`")
      None
    else
      if extra > 0 then
        site.warn(s"`indices` holds ${all.length} numbers, not groups of 4; the last are left out")
      val whole = all.dropRight(extra)
      Option.when(MeshArrays.isWhole(p, whole, 4))(
        MeshArrays.patches(p, normals(), uv(), whole)
      )
