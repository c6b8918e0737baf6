package candela.build

import candela.base.SceneError
import candela.math.*
import candela.scenefile.{Dialect, ParamType}
import candela.shapes.{Disk, LoopSubdivision, MeshError, Shape, Sphere}

/** What a shape statement describes, before it is placed in the world. */
enum ShapeGeometry:
  /** Triangles in object space: x y z a vertex, three vertices a triangle; normals (x y z) and uvs
    * may be empty.
    */
  case Triangles(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )

  /** A single surface, given where it stands and whether its orientation is reversed. */
  case Solid(make: (Transform, Boolean) => Shape)

/** Recipes of shapes. */
object Shapes:
  val all: Recipes[Option[ShapeGeometry]] =
    Recipes(
      "shape",
      Vector(SphereRecipe, DiskRecipe, TriangleMeshRecipe, PlyMeshRecipe, LoopSubdivRecipe),
      Vector("cylinder", "cone", "paraboloid", "hyperboloid", "heightfield", "nurbs", "curve",
        "bilinearmesh")
        .map(_ -> "it is left out")
        .toMap
    )

  abstract class ShapeRecipe(name: String, dialects: Set[Dialect] = Dialect.values.toSet)
      extends Recipe[Option[ShapeGeometry]](name, dialects):
    notYet("alpha", "the shape is opaque")
    notYet("shadowalpha", "the shape casts full shadows")

  object SphereRecipe extends ShapeRecipe("sphere"):
    private val radius = float("radius", "radius")(1f)
    private val zmin =
      float("zmin", "z of the lower clip plane; below -radius: none")(Float.NegativeInfinity)
    private val zmax =
      float("zmax", "z of the upper clip plane; above radius: none")(Float.PositiveInfinity)
    private val phimax = float("phimax", "sweep about z, degrees")(360f)

    protected def make()(using site: Site): Option[ShapeGeometry] =
      val r = radius()
      val (z0, z1) = (clamp(zmin(), -r, r), clamp(zmax(), -r, r))
      if !(r > 0f) then
        site.error(s"a sphere's radius must be above 0; found $r")
        None
      else
        val phi = radians(clamp(phimax(), 0f, 360f))
        Some(
          ShapeGeometry.Solid((toWorld, reversed) =>
            Sphere(toWorld, r, Math.min(z0, z1), Math.max(z0, z1), phi, reversed)
          )
        )

  object DiskRecipe extends ShapeRecipe("disk"):
    private val height = float("height", "its place along z")(0f)
    private val radius = float("radius", "outer radius")(1f)
    private val inner = float("innerradius", "radius of the hole")(0f)
    private val phimax = float("phimax", "sweep about z, degrees")(360f)

    protected def make()(using site: Site): Option[ShapeGeometry] =
      val (r, i) = (radius(), inner())
      if !(r > 0f) || !(i >= 0f && i < r) then
        site.error(s"a disk needs 0 ≤ innerradius < radius; found innerradius $i, radius $r")
        None
      else
        val (h, phi) = (height(), radians(clamp(phimax(), 0f, 360f)))
        Some(ShapeGeometry.Solid((toWorld, reversed) => Disk(toWorld, h, r, i, phi, reversed)))

  object TriangleMeshRecipe extends ShapeRecipe("trianglemesh"):
    private val indices =
      integers("indices", "three vertices a triangle; may be absent for 3 points")
    private val points = numbers("P", "point3[]", "vertex positions")
    private val normals = numbers("N", "normal[]", "shading normals, one a vertex")
    private val uv = numbers("uv", "point2[]", "texture coordinates, one pair a vertex")
    private val st = numbers("st", "point2[]", "another name of `uv`")
    irrelevant("S", "discarddegenerateUVs", "faceIndices")

    protected def make()(using site: Site): Option[ShapeGeometry] =
      val p = points()
      val uvs = if uv().nonEmpty then uv() else st()
      val given_ = indices()
      val index = if given_.isEmpty && p.length == 9 then Array(0, 1, 2) else given_
      if p.isEmpty || index.isEmpty then
        site.error("a trianglemesh needs `P` and `indices`")
        None
      else Meshes.checked(p, normals(), uvs, index)

  object PlyMeshRecipe extends ShapeRecipe("plymesh"):
    private val filename = string("filename", "a .ply file (or .ply.gz)")("")
    notYet("displacement", "the mesh is not displaced")

    protected def make()(using site: Site): Option[ShapeGeometry] =
      site.declaration.param("filename") match
        case Some(p) if filename().nonEmpty =>
          site.resources.file(p, site.declaration, site.problems).flatMap: path =>
            try
              val mesh = PlyFile.read(path)
              Meshes.checked(mesh.positions, mesh.normals, mesh.uvs, mesh.indices)
            catch
              case e: SceneError =>
                e.problems.foreach(x => site.problems.error(p.valuesAt, x.message, x.help))
                None
        case _ =>
          site.error("a plymesh needs a `filename`")
          None

  object LoopSubdivRecipe extends ShapeRecipe("loopsubdiv"):
    private val levels = integer("levels", "times that each triangle is split into four")(3)
    private val nlevels = integer("nlevels", "another name of `levels`")(3)
    private val indices = integers("indices", "three vertices a triangle of the control mesh")
    private val points = numbers("P", "point3[]", "vertices of the control mesh")
    irrelevant("scheme")

    protected def make()(using site: Site): Option[ShapeGeometry] =
      val depth = levels.given_().orElse(nlevels.given_()).getOrElse(3)
      if points().isEmpty || indices().isEmpty then
        site.error("a loopsubdiv needs `P` and `indices`")
        None
      else if depth < 0 || depth > 10 then
        site.error(s"`levels` of loopsubdiv lies in 0 to 10; found $depth")
        None
      else
        Meshes.checked(points(), Array.empty, Array.empty, indices()).flatMap: _ =>
          try
            val fine = LoopSubdivision.subdivide(depth, indices(), points())
            Some(ShapeGeometry.Triangles(fine.positions, fine.normals, Array.empty, fine.indices))
          catch
            case e: MeshError =>
              site.error(s"loopsubdiv: ${e.getMessage}")
              None

  /** Checks that the arrays of a mesh fit together. */
  private object Meshes:
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
