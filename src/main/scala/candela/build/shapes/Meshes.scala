package candela.build.shapes

import candela.base.{loop, SceneError}
import candela.build.recipe.*
import candela.scenefile.Dialect
import candela.shapes.{LoopSubdivision, MeshError}

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

object LoopSubdivRecipe extends ShapeRecipe("loopsubdiv", "Loop's subdivision surface"):
  private val levels = integer("levels", "times that each triangle is split into four", sinceV3)(3)
  private val nlevels =
    integer("nlevels", "times that each triangle is split into four", untilV3)(3)
  private val indices = integers("indices", "three vertices a triangle of the control mesh")
  private val points = numbers("P", "point3[]", "vertices of the control mesh")
  noMeaning("there is but one")(string("scheme", "kind of subdivision")("loop"))

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val depth = levels.given_().orElse(nlevels.given_()).getOrElse(3)
    if points().isEmpty || indices().isEmpty then
      site.error("a loopsubdiv needs `P` and `indices`")
      None
    else if depth < 0 || depth > 10 then
      site.error(s"`levels` of loopsubdiv lies in 0 to 10; found $depth")
      None
    else
      MeshArrays.checked(points(), Array.empty, Array.empty, indices()).flatMap: _ =>
        try
          val fine = LoopSubdivision.subdivide(depth, indices(), points())
          Some(ShapeGeometry.Triangles(fine.positions, fine.normals, Array.empty, fine.indices))
        catch
          case e: MeshError =>
            site.error(s"loopsubdiv: ${e.getMessage}")
            None

object HeightFieldRecipe
    extends ShapeRecipe("heightfield", "heights above a grid over the unit square", untilV3):
  private val nu = integer("nu", "grid points along x", shown = "none")(0)
  private val nv = integer("nv", "grid points along y", shown = "none")(0)
  private val heights = numbers("Pz", "float[]", "heights, row by row of constant y")

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val (columns, rows, z) = (nu(), nv(), heights())
    if z.isEmpty || nu.given_().isEmpty || nv.given_().isEmpty then
      site.error("a heightfield needs `nu`, `nv` and `Pz`")
      None
    else if columns < 2 || rows < 2 then
      site.warn(
        s"a heightfield needs two points or more both ways; this has $columns × $rows, and is " +
          "left out"
      )
      None
    else if z.length != columns.toLong * rows then
      site.error(s"`Pz` holds ${z.length} heights; nu × nv are ${columns.toLong * rows}")
      None
    else
      val uvs = new Array[Float](2 * z.length)
      val positions = new Array[Float](3 * z.length)
      loop(z.length): i =>
        uvs(2 * i) = (i % columns).toFloat / (columns - 1)
        uvs(2 * i + 1) = (i / columns).toFloat / (rows - 1)
        positions(3 * i) = uvs(2 * i)
        positions(3 * i + 1) = uvs(2 * i + 1)
        positions(3 * i + 2) = z(i)
      MeshArrays.checked(positions, Array.empty, uvs, MeshArrays.grid(columns, rows))
