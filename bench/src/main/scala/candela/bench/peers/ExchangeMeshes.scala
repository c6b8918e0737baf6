package candela.bench.peers

import candela.diagnostics.SourcePos
import candela.build.shapes.PlyFile
import candela.convert.{PlyWriter, SideFiles, Tessellation}
import candela.math.{Transform, Vec3}
import candela.scenefile.{Declaration, Param, ParamType}

/** Geometry of a shape in its own space; normals and texture coordinates may be empty. */
private final case class ObjectMesh(
    points: Array[Float],
    normals: Array[Float],
    uvs: Array[Float],
    indices: Array[Int]
)

/** Shapes as files of triangles in world space, whose corners turn counterclockwise seen from
  * outside, and whole spheres.
  */
private[peers] final class ExchangeMeshes(files: SideFiles, values: ExchangeValues):
  private var low = Vec3(Float.MaxValue, Float.MaxValue, Float.MaxValue)
  private var high = -low

  /** No surface is farther away from there. */
  def reach(from: Vec3): Float =
    def farther(low: Float, high: Float, from: Float) = Math.max(from - low, high - from)
    val far = Vec3(
      farther(low.x, high.x, from.x),
      farther(low.y, high.y, from.y),
      farther(low.z, high.z, from.z)
    )
    Math.max(far.length, 1e-3f)

  /** @param mapping of the texture, if there is one
    * @param inner   elements of material and emitter
    */
  def element(
      d: Declaration,
      toWorld: Transform,
      isReversed: Boolean,
      mapping: Option[UvMapping],
      inner: String
  ): String =
    val isFullSphere = d.name == "sphere" && mapping.isEmpty &&
      !d.params.exists(p => Seq("zmin", "zmax", "phimax").contains(p.name))
    toWorld.uniformScale match
      case Some(scale) if isFullSphere => sphere(d, toWorld, scale, isReversed, inner)
      case _ =>
        mesh(d) match
          case None =>
            values.reject(s"shape \"${d.name}\"")
            ""
          case Some(objectMesh) =>
            val bytes = placed(objectMesh, toWorld, isReversed, mapping)
            val name = files.add("mesh", "ply", bytes)
            val isFlat = if objectMesh.normals.isEmpty then "true" else "false"
            s"""  <shape type="ply"><string name="filename" value="$name"/>""" +
              s"""<boolean name="face_normals" value="$isFlat"/>$inner</shape>"""

  private def sphere(
      d: Declaration,
      toWorld: Transform,
      scale: Double,
      isReversed: Boolean,
      inner: String
  ): String =
    val c = toWorld.point(Vec3.Zero)
    val r = values.number(d, "radius", 1f) * scale.toFloat
    extend(c - Vec3(r, r, r))
    extend(c + Vec3(r, r, r))
    s"""  <shape type="sphere"><point name="center" x="${c.x}" y="${c.y}" z="${c.z}"/>""" +
      s"""<float name="radius" value="$r"/><boolean name="flip_normals" value="$isReversed"/>""" +
      s"$inner</shape>"

  private def mesh(d: Declaration): Option[ObjectMesh] =
    def floats(name: String) = d.param(name).fold(Array.emptyFloatArray)(_.floats)
    d.name match
      case "trianglemesh" =>
        values.rejectOthers(d, "P", "N", "uv", "st", "S", "indices", "alpha")
        val indices = d.param("indices").fold(Array(0, 1, 2))(_.ints)
        val uvs = if floats("uv").nonEmpty then floats("uv") else floats("st")
        Option.when(indices.length % 3 == 0 && indices.forall(i =>
          0 <= i && 3 * i < floats("P").length
        )):
          ObjectMesh(floats("P"), floats("N"), uvs, indices)
      case "plymesh" =>
        values.rejectOthers(d, "filename", "alpha")
        for
          p <- d.param("filename")
          file <- d.folder.locate(p.strings.head, Some(p.valuesAt))
        yield
          val ply = PlyFile.read(file, Some(p.pos))
          ObjectMesh(ply.positions, ply.normals, ply.uvs, ply.indices)
      case "bilinearmesh" => patches(d, floats)
      case "sphere" | "cylinder" | "disk" => Tessellation.surface(d).map(grid(d.name, _))
      case _ => None

  /** Flat patches, as two triangles each. */
  private def patches(d: Declaration, floats: String => Array[Float]): Option[ObjectMesh] =
    values.rejectOthers(d, "P", "N", "uv", "indices", "alpha")
    val p = floats("P")
    val corners = d.param("indices").fold(Array(0, 1, 2, 3))(_.ints)
    def at(i: Int) = Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2))
    val isFlat = corners.grouped(4).forall:
      case Array(a, b, c, e) => (at(b) - at(a) + at(c) - at(e)).length <=
          1e-4f * (at(e) - at(a)).length
      case _ => false
    if !isFlat then values.reject("bilinear patches, unless parallelograms")
    Option.when(isFlat):
      val indices = corners.grouped(4).flatMap(q => Seq(q(0), q(1), q(3), q(0), q(3), q(2))).toArray
      ObjectMesh(p, floats("N"), floats("uv"), indices)

  private def grid(name: String, p: (Float, Float) => Vec3): ObjectMesh =
    val (nu, nv) = if name == "sphere" then (256, 128) else (512, 1)
    val uvs = for j <- 0 to nv; i <- 0 to nu yield (i.toFloat / nu, j.toFloat / nv)
    val isFlat = name == "disk"
    def normal(u: Float, v: Float): Vec3 =
      val inner = Math.min(Math.max(v, Step), 1 - Step)
      val along = p(u, Math.min(inner + Step, 1f)) - p(u, Math.max(inner - Step, 0f))
      ((p(Math.min(u + Step, 1f), inner) - p(Math.max(u - Step, 0f), inner)) cross along).normalized
    def all(vs: Seq[Vec3]) = vs.flatMap(v => Seq(v.x, v.y, v.z)).toArray
    val normals = if isFlat then Array.emptyFloatArray else all(uvs.map(normal(_, _)))
    val indices =
      for j <- 0 until nv; i <- 0 until nu; a = j * (nu + 1) + i
      yield Seq(a, a + 1, a + nu + 2, a, a + nu + 2, a + nu + 1)
    ObjectMesh(
      all(uvs.map(p(_, _))),
      normals,
      uvs.flatMap((u, v) => Seq(u, v)).toArray,
      indices.flatten.toArray
    )

  private val Step = 1e-3f

  private def extend(p: Vec3): Unit =
    low = Vec3(Math.min(low.x, p.x), Math.min(low.y, p.y), Math.min(low.z, p.z))
    high = Vec3(Math.max(high.x, p.x), Math.max(high.y, p.y), Math.max(high.z, p.z))

  private def placed(
      m: ObjectMesh,
      toWorld: Transform,
      isReversed: Boolean,
      mapping: Option[UvMapping]
  ): Array[Byte] =
    // Corners without coordinates have those of each triangle, so that none is shared
    val geometry = if mapping.isDefined && m.uvs.isEmpty then apart(m) else m
    val count = geometry.points.length / 3
    def vec(of: Array[Float], i: Int) = Vec3(of(3 * i), of(3 * i + 1), of(3 * i + 2))
    val points = Array.tabulate(count)(i => toWorld.point(vec(geometry.points, i)))
    points.foreach(extend)
    val side = if isReversed then -1f else 1f
    val normals =
      if geometry.normals.length != 3 * count then Array.empty[Vec3]
      else Array.tabulate(count)(i => toWorld.normal(vec(geometry.normals, i)).normalized * side)
    val turns = isReversed != toWorld.swapsHandedness
    val indices = geometry.indices.grouped(3).flatMap: t =>
      val facet = (points(t(1)) - points(t(0))) cross (points(t(2)) - points(t(0)))
      val isTurned =
        if normals.isEmpty then turns
        else (facet dot (normals(t(0)) + normals(t(1)) + normals(t(2)))) < 0f
      if isTurned then Seq(t(0), t(2), t(1)) else t.toSeq
    .toArray
    val uvs = mapping.fold(Array.emptyFloatArray): by =>
      Array.tabulate(2 * count): k =>
        val x = geometry.uvs(k)
        // v begins at the top of Mitsuba's images, at the bottom of pbrt's
        if k % 2 == 0 then by.scaleU * x + by.du else 1f - (by.scaleV * x + by.dv)
    def all(vs: Array[Vec3]) = vs.flatMap(v => Array(v.x, v.y, v.z))
    def list(kind: ParamType, name: String, numbers: Array[Float]) =
      Option.when(numbers.nonEmpty)(Param.floats(kind, name, SourcePos.Nowhere, numbers))
    val params = Vector(
      list(ParamType.Point3, "P", all(points)),
      list(ParamType.Normal, "N", all(normals)),
      list(ParamType.Point2, "uv", uvs)
    ).flatten :+ Param.int("indices", SourcePos.Nowhere, indices*)
    PlyWriter.bytes(ExchangeScene.plain("Shape", "trianglemesh").copy(params = params))

  private def apart(m: ObjectMesh): ObjectMesh =
    def spread(of: Array[Float]) =
      if of.isEmpty then of else m.indices.flatMap(i => of.slice(3 * i, 3 * i + 3))
    val corners = Array(0f, 0f, 1f, 0f, 1f, 1f)
    val uvs = Array.fill(m.indices.length / 3)(corners).flatten
    ObjectMesh(spread(m.points), spread(m.normals), uvs, m.indices.indices.toArray)
