package candela.build.shapes

import candela.base.loop
import candela.color.Rgb
import candela.concurrency.Parallel
import candela.diagnostics.{Code, Limit, SceneError}
import candela.io.{Keep, Sha256}
import candela.io.Sha256.Numbers
import candela.build.recipe.*
import candela.geometry.ShadingPoint
import candela.image.Image
import candela.math.{Position, Transform, Vec3}
import candela.scenefile.Dialect
import candela.shapes.{DisplacedMesh, LoopSubdivision, MeshError, SubdividedMesh, VertexAttributes}

object TriangleMeshRecipe extends MeshRecipe("trianglemesh", "indexed triangle mesh"):
  private val indices =
    integers("indices", "three vertex indices per triangle; optional for 3 points")
  private val points = numbers("P", "point3[]", "vertex positions")
  private val normals = numbers("N", "normal[]", "shading normals, one per vertex")
  private val uv = numbers("uv", "point2[]", "texture coordinates, one pair per vertex")
  private val st = numbers("st", "point2[]", "alias of `uv`", untilV3)
  private val secondUv =
    numbers("uv2", "point2[]", "second set of texture coordinates", onlyGltf)
  private val colors =
    numbers("colors", "float[]", "red, green, blue and alpha of each vertex", onlyGltf)
  private val tangents =
    numbers("tangents", "float[]", "tangent of each vertex, and the sign of the other", onlyGltf)
  private val culls =
    bool("cullbackfaces", "rays from behind pass", onlyOthers)(false)
  unsupported("tangents follow uv; only anisotropic materials show the difference")(
    numbers("S", "vector3[]", "tangents, one per vertex")
  )
  noMeaning("degenerate uv are harmless")(
    bool("discarddegenerateUVs", "discard all uv if some are degenerate", onlyV2)(false)
  )
  noMeaning("only Ptex textures use them")(
    integers("faceIndices", "face indices, one per triangle", sinceV3)
  )

  override protected def isOpenBehind()(using Site): Boolean = culls()

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val p = points()
    val uvs = if uv().nonEmpty then uv() else st()
    val given_ = indices()
    val index = if given_.isEmpty && p.length == 9 then Array(0, 1, 2) else given_
    val isEmpty = (points.given_(), indices.given_()) match
      case (Some(ps), Some(is)) => ps.isEmpty || is.isEmpty
      case _ => false
    if isEmpty then
      site.warn(Code.NoSurface, "a mesh without triangles is ignored")
      None
    else if p.isEmpty || index.isEmpty then
      site.unusable(Code.MissingParameter, "a \"trianglemesh\" needs `P` and `indices`")
      None
    else
      MeshArrays.checked(p, normals(), uvs, index).map:
        case mesh: ShapeGeometry.Triangles =>
          def perVertex(values: Array[Float], each: Int) =
            if values.length == p.length / 3 * each then values else Array.emptyFloatArray
          val extras =
            VertexAttributes(
              perVertex(secondUv(), 2),
              perVertex(colors(), 4),
              perVertex(tangents(), 4)
            )
          if extras.isEmpty then mesh else mesh.copy(attributes = extras)
        case other => other

object PlyMeshRecipe extends MeshRecipe("plymesh", "triangle mesh from a PLY file", sinceV3):
  private val Meshes = Keep.Shelf(Some(PlyMeshForm))
  private val filename = string("filename", ".ply or .ply.gz file", shown = "none")("")
  private val displacement =
    floatTexture("displacement", "height along the normal", onlyV4, "object space", "none")(0f)
  private val edge =
    float(
      "edgelength",
      "maximum edge length of the displaced mesh",
      onlyV4,
      "scene units",
      range = Range.above(0f)
    )(1f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    site.declaration.param("filename") match
      case Some(p) if filename().nonEmpty =>
        val standIn = StandIns.LeftOut
        site.resources.file(p, site.declaration, site.problems, standIn).flatMap: file =>
          try
            val keepQuads = site.dialect == Dialect.V4
            val (read, digest) = site.resources.cache.ofFile(Meshes, file, s"$keepQuads"):
              PlyFile.read(file, keepQuads = keepQuads)
            val recentred = read.recentred(site.toWorld)
            val (mesh, origin) = recentred.getOrElse((read, Position.Origin))
            val toWorld =
              if recentred.isEmpty then site.toWorld else site.toWorld * origin.fromOrigin
            val content = digest.filter(_ => recentred.isEmpty).map(d => s"$d $keepQuads")
            val shape =
              if displacement.given_().isEmpty then Some(ofFile(mesh, content))
              else displaced(mesh, toWorld)
            if recentred.isEmpty then shape else shape.map(ShapeGeometry.Around(origin, _))
          catch
            case e: SceneError =>
              for x <- e.problems do
                site.problems.missing(x.code, p.valuesAt, x.message, standIn, x.help)
              None
      case _ =>
        site.unusable(Code.MissingParameter, "a \"plymesh\" needs `filename`")
        None

  /** As triangles. */
  private def displaced(mesh: PlyMesh, toWorld: Transform)(using
      site: Site
  ): Option[ShapeGeometry] =
    val longest = edge() * site.resources.settings.edgeScale.getOrElse(1f)
    if mesh.uvs.isEmpty then
      site.error(Code.MissingParameter, "a displaced mesh needs texture coordinates, as in pbrt")
      None
    else
      val heights = displacement()
      val point = ShadingPoint()
      val halves = mesh.quads.grouped(4).flatMap(q => Seq(q(0), q(1), q(3), q(0), q(3), q(2)))
      try
        val displacedMesh = DisplacedMesh.of(
          mesh.positions,
          mesh.normals,
          mesh.uvs,
          mesh.indices ++ halves,
          toWorld,
          longest,
          site.allowance.capped(Limit.Triangles, DisplacedMesh.MaxVertices)
        ): (p, u, v) =>
          point.p = p
          point.u = u
          point.v = v
          heights(point)
        Some(ShapeGeometry.Triangles(
          displacedMesh.positions,
          displacedMesh.normals,
          displacedMesh.uvs,
          displacedMesh.indices
        ))
      catch
        case e: MeshError =>
          site.error(Code.DamagedMesh, s"\"plymesh\": ${e.getMessage}")
          None

  /** Quads are bilinear patches in pbrt-v4, which are curved if the corners are not coplanar. */
  private def ofFile(mesh: PlyMesh, content: Option[String])(using Site): ShapeGeometry =
    val faces = Vector(
      Option.when(mesh.indices.nonEmpty)(
        MeshArrays.triangles(mesh.positions, mesh.normals, mesh.uvs, mesh.indices, content)
      ),
      Option.when(mesh.quads.nonEmpty)(
        MeshArrays.patches(mesh.positions, mesh.normals, mesh.uvs, mesh.quads)
      )
    ).flatten
    if faces.size == 1 then faces.head else ShapeGeometry.Several(faces)

object BilinearMeshRecipe
    extends ShapeRecipe("bilinearmesh", "mesh of bilinear patches", onlyV4):
  private val indices = integers(
    "indices",
    "four vertex indices per patch, in the order (0,0), (1,0), (0,1), (1,1) of u and v; optional " +
      "for 4 points"
  )
  private val points = numbers("P", "point3[]", "vertex positions")
  private val normals = numbers("N", "normal[]", "shading normals, one per vertex")
  private val uv = numbers("uv", "point2[]", "texture coordinates, one pair per vertex")
  noMeaning("pbrt uses it for importance sampling of emission; the image is the same")(
    string("emissionfilename", "emission image", shown = "none")("")
  )
  noMeaning("only Ptex textures use them")(
    integers("faceIndices", "face indices, one per patch")
  )

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val p = points()
    val given_ = indices()
    val quadIndices = if given_.isEmpty && p.length == 12 then Array(0, 1, 2, 3) else given_
    if p.isEmpty || quadIndices.length < 4 then
      site.error(Code.MissingParameter, "a \"bilinearmesh\" needs `P` and `indices`")
      None
    else
      val faces = MeshArrays.wholeFaces(quadIndices, 4)
      Option.when(MeshArrays.isWhole(p, faces, 4))(
        MeshArrays.patches(p, normals(), uv(), faces)
      )

object LoopSubdivRecipe extends ShapeRecipe("loopsubdiv", "Loop subdivision surface"):
  private val Fine = Keep.Shelf[SubdividedMesh]()
  private val Levels = Range(0f, 10f)
  private val levels = integer("levels", "number of subdivision levels", sinceV3, range = Levels)(3)
  private val nlevels =
    integer("nlevels", "number of subdivision levels", untilV3, range = Levels)(3)
  private val indices = integers("indices", "three vertex indices per triangle of the control mesh")
  private val points = numbers("P", "point3[]", "vertices of the control mesh")
  noMeaning("only Loop subdivision exists")(string("scheme", "subdivision scheme")("loop"))

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val depth = levels.given_().orElse(nlevels.given_()).getOrElse(3)
    if points().isEmpty || indices().isEmpty then
      site.unusable(Code.MissingParameter, "a \"loopsubdiv\" needs `P` and `indices`")
      None
    else
      val faces = MeshArrays.wholeFaces(indices(), 3)
      MeshArrays.checked(points(), Array.empty, Array.empty, faces).flatMap: _ =>
        try
          val count = (faces.length.toLong / 3) << (2 * depth)
          site.allowance.check(Limit.Triangles, count, Some(site.declaration.pos)):
            s"\"loopsubdiv\" makes $count triangles"
          def key = Sha256.hex(Sha256.ofNumbers(
            Seq(Numbers(Array(depth)), Numbers(faces), Numbers(points())),
            Parallel.Alone
          ))
          val fine = site.resources.cache(Fine, key):
            LoopSubdivision.subdivide(depth, faces, points())
          for edge <- fine.crowded do
            site.warn(Code.BrokenMesh, s"\"loopsubdiv\": $edge, as in pbrt")
          Some(ShapeGeometry.Triangles(fine.positions, fine.normals, Array.empty, fine.indices))
        catch
          case e: MeshError =>
            site.error(Code.BrokenMesh, s"\"loopsubdiv\": ${e.getMessage}")
            None

object HeightFieldRecipe
    extends ShapeRecipe("heightfield", "height field over the unit square", untilV3):
  private val nu = integer(
    "nu",
    "grid points along x",
    shown = "none",
    range = Range.atLeast(2f).deferred
  )(0)
  private val nv = integer(
    "nv",
    "grid points along y",
    shown = "none",
    range = Range.atLeast(2f).deferred
  )(0)
  private val heights = numbers("Pz", "float[]", "heights, in rows of constant y")

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val (columns, rows, z) = (nu(), nv(), heights())
    if z.isEmpty || nu.given_().isEmpty || nv.given_().isEmpty then
      site.error(Code.MissingParameter, "a \"heightfield\" needs `nu`, `nv` and `Pz`")
      None
    else if columns < 2 || rows < 2 then
      site.warn(
        Code.BrokenMesh,
        s"`nu` and `nv` of a \"heightfield\" must be at least 2, found $columns and $rows; " +
          "it is ignored"
      )
      None
    else if z.length != columns.toLong * rows then
      site.error(
        Code.ParameterCount,
        s"`Pz` must have nu × nv = ${columns.toLong * rows} heights, found ${z.length}"
      )
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

/** Heights of an image, whose first row is at y = -1. */
object HeightMapRecipe
    extends MeshRecipe(
      "heightmap",
      "height field over the square of ±1, from an image",
      onlyMitsuba
    ):
  private val filename =
    string("filename", "image; colours count as luminances", shown = "none")("")
  private val scale = float("scale", "height of 1")(1f)
  private val smooth = bool("smooth", "interpolate the normals of the image's cells")(true)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    if filename().isEmpty then
      site.error(Code.MissingParameter, "a \"heightmap\" needs `filename`")
      None
    else
      val p = site.declaration.param("filename").get
      for
        stored <- site.resources.image(p, site.declaration, site.problems, "it is flat")
        field <- heights(stored.toImage.linear)
        mesh <- field.mesh(smooth())
      yield mesh

  private def heights(image: Image)(using site: Site): Option[HeightField] =
    val rgb = image.toRgb
    if rgb.width < 2 || rgb.height < 2 then
      site.warn(Code.NoSurface, "an image of heights must have 2 × 2 pixels; it is ignored")
      None
    else
      site.allowance.check(
        Limit.Triangles,
        2L * rgb.width * rgb.height,
        Some(site.declaration.pos)
      )(s"a height field of ${rgb.width} × ${rgb.height} pixels")
      val z = Array.tabulate(rgb.width * rgb.height): i =>
        scale() * Rgb(rgb.data(3 * i), rgb.data(3 * i + 1), rgb.data(3 * i + 2)).luminance
      Some(HeightField(rgb.width, rgb.height, z))

private final class HeightField(columns: Int, rows: Int, z: Array[Float]):

  def mesh(smooth: Boolean)(using Site): Option[ShapeGeometry] =
    val uvs = new Array[Float](2 * z.length)
    val positions = new Array[Float](3 * z.length)
    loop(z.length): i =>
      val (u, v) = ((i % columns).toFloat / (columns - 1), (i / columns).toFloat / (rows - 1))
      uvs(2 * i) = u
      uvs(2 * i + 1) = 1 - v
      positions(3 * i) = 2 * u - 1
      positions(3 * i + 1) = 2 * v - 1
      positions(3 * i + 2) = z(i)
    val normals = if smooth then smoothNormals else Array.emptyFloatArray
    MeshArrays.checked(positions, normals, uvs, MeshArrays.grid(columns, rows))

  /** Sums of the unit normals of a pixel's cells. */
  private def smoothNormals: Array[Float] =
    val sums = new Array[Float](3 * z.length)
    def add(i: Int, dx: Float, dy: Float): Unit =
      val n = Vec3(-dx * (columns - 1) / 2, -dy * (rows - 1) / 2, 1f).normalized
      sums(3 * i) += n.x
      sums(3 * i + 1) += n.y
      sums(3 * i + 2) += n.z
    loop(rows - 1): y =>
      loop(columns - 1): x =>
        val i = y * columns + x
        val (z00, z10, z01, z11) = (z(i), z(i + 1), z(i + columns), z(i + columns + 1))
        add(i, z10 - z00, z01 - z00)
        add(i + 1, z10 - z00, z11 - z10)
        add(i + columns, z11 - z01, z01 - z00)
        add(i + columns + 1, z11 - z01, z11 - z10)
    sums
