package candela.build

import candela.io.InputFile
import candela.build.recipe.TextureStore
import candela.build.shapes.PlySize
import candela.image.ImageSize
import candela.render.{Cost, CostKind}
import candela.scenefile.{Declaration, Dialect, MaterialRef, SceneDescription, ShapeDescription}

/** Estimates the memory of a scene before it is built, from its statements and the headers of its
  * files. Displaced triangles, for example, are known only after building and not included.
  *
  * @param textures how images are kept
  */
private[build] final class SceneSize(
    description: SceneDescription,
    uses: ObjectUses,
    textures: TextureStore
):
  import SceneSize.*

  private val worlds =
    (uses.world +: uses.shared.map(_.shapes)).map(SurfaceCount.of(_, description.dialect.base))
  private val surfaces = worlds.foldLeft(SurfaceCount())(_ + _)
  private val instances = uses.shared.map(_.places.size.toLong).sum

  def costs: Vector[Cost] =
    val corners = if surfaces.triangles > 0 then OtherCorners else 0L
    val hierarchies = surfaces.triangles * TriangleNode +
      (surfaces.nonTriangles + instances) * (OtherNode + corners)
    Vector(
      Cost(CostKind.Statements, statements),
      Cost(CostKind.Triangles, worlds.map(_.meshBytes).sum),
      Cost(CostKind.Shapes, shapes),
      Cost(CostKind.Instances, instances * Instance),
      Cost(CostKind.Hierarchies, hierarchies),
      Cost(CostKind.Textures, textures.bytes, isMost = textures.tiles.nonEmpty),
      Cost(CostKind.Materials, materials * Material),
      Cost(CostKind.Lights, lights),
      Cost(CostKind.Media, media)
    ).filter(_.bytes > 0)

  /** Bytes that building the largest hierarchy takes beside, at least. */
  def building: Long =
    worlds.map(w => w.triangles + w.nonTriangles).maxOption.getOrElse(0L) * Building

  private def shapes: Long =
    val otherSolids = surfaces.solids - surfaces.spheres
    surfaces.spheres * Sphere + otherSolids * Solid + surfaces.segments * Segment +
      surfaces.patches * Patch

  /** Bytes of the shapes' statements, and the number of those that emit. */
  private val (listed, emitting) =
    var listed, emitting = 0L
    for shapes <- description.shapes +: description.objects.values.toVector; s <- shapes do
      listed += Statement + arrays(s.shape)
      if s.areaLight.isDefined then emitting += 1
    (listed, emitting)

  private def statements: Long =
    listed + description.media.iterator.map(m => arrays(m.medium)).sum +
      description.instances.size * Placed + unshared * Rows +
      (emitting + description.lights.size) * LightStatement

  /** Instances whose matrix is copied, or is not that of a row. */
  private def unshared: Long =
    description.instances.size - uses.shared.map(_.plain.toLong).sum

  private def materials: Long =
    // Shapes of one statement share it, most of them one after another
    val distinctMaterials = java.util.IdentityHashMap[MaterialRef, Unit]()
    var last: MaterialRef | Null = null
    for s <- description.shapes if s.material ne last do
      last = s.material
      distinctMaterials.put(s.material, ())
    description.namedMaterials.size + distinctMaterials.size

  private def lights: Long =
    val shapes =
      if emitting == 0 then Vector.empty else uses.world.filter(_.areaLight.isDefined)
    val areaLights = SurfaceCount.of(shapes, description.dialect.base)
    areaLights.triangles * TriangleLight + (areaLights.solids + description.lights.size) * Light +
      description.lights.map(l => image(l.light)).sum

  /** Bytes of the image of a light. What portals make of theirs is in memory. */
  private def image(light: Declaration): Long =
    val isTiled = textures.lightTiles.nonEmpty && light.param("portal").isEmpty &&
      TextureStore.mayBeTiled(light, light.dialect.getOrElse(description.dialect.base))
    val pixel = if isTiled then TablePixel else LightPixel
    TextureStore.ImageNames.flatMap(file(light, _)).flatMap(ImageSize.guess(_))
      .map(s => s.width.toLong * s.height * pixel).sum

  private def media: Long =
    description.media.iterator.map: m =>
      val floats = m.medium.params.iterator.map(_.floats.length.toLong).sum
      4 * floats + file(m.medium, "filename").fold(0L)(_.size)
    .sum

private[build] object SceneSize:
  // Bytes in memory of one of each, as objects of Java lie there on 64 bits
  private val Statement = 330L
  private val LightStatement = 280L

  /** Of an instance: without its matrix, which may be that of [[Instance]]. */
  private val Placed = 13L
  private val Rows = 96L
  private val Sphere = 80L
  private val Solid = 500L
  private val Segment = 74L
  private val Patch = 172L
  private val Instance = 104L
  private val Material = 1000L
  private val Light = 450L
  private val TriangleLight = 550L

  // Blocks of triangles that are not quite full, and nodes
  private val TriangleNode = 54L
  private val OtherNode = 58L

  /** Of each other primitive, where there are triangles, too. */
  private val OtherCorners = 36L

  /** Boxes and orders of primitives, while a hierarchy is built. */
  private val Building = 56L

  /** Pixels of environment maps, with their table of directions. */
  private val LightPixel = 20L

  /** Of the table alone. */
  private val TablePixel = 5L

  /** A file to look at in passing. */
  private[build] def file(d: Declaration, name: String): Option[InputFile] =
    for
      p <- d.param(name)
      word <- p.strings.headOption if word.nonEmpty
      file <- d.folder.glance(word) if file.isRegular
    yield file

  private def arrays(d: Declaration): Long =
    var numbers = 0L
    for p <- d.params do numbers += p.floats.length + p.ints.length + p.rests.length
    4 * numbers

/** Numbers of surfaces.
  *
  * @param meshBytes of vertices and indices
  * @param segments  of curves
  * @param patches   bilinear ones
  * @param spheres   of the solids
  */
private[build] final case class SurfaceCount(
    triangles: Long = 0,
    meshBytes: Long = 0,
    solids: Long = 0,
    segments: Long = 0,
    patches: Long = 0,
    spheres: Long = 0
):
  /** Primitives other than triangles. */
  def nonTriangles: Long = solids + segments + patches

  def +(more: SurfaceCount): SurfaceCount =
    SurfaceCount(
      triangles + more.triangles,
      meshBytes + more.meshBytes,
      solids + more.solids,
      segments + more.segments,
      patches + more.patches,
      spheres + more.spheres
    )

private[build] object SurfaceCount:
  /** Of all these shapes: there may be millions of spheres and curves. */
  def of(shapes: Vector[ShapeDescription], dialect: Dialect): SurfaceCount =
    var spheres = 0L
    var segments = 0L
    var sum = SurfaceCount()
    for s <- shapes do
      s.shape.name match
        case "sphere" => spheres += 1
        case "curve" => segments += segmentsOf(s.shape)
        case _ => sum += of(s, dialect)
    sum + SurfaceCount(solids = spheres, spheres = spheres, segments = segments)

  private def of(shape: ShapeDescription, dialect: Dialect): SurfaceCount =
    val d = shape.shape
    d.name match
      case "trianglemesh" => mesh(d)
      case "loopsubdiv" =>
        val levels = Vector("levels", "nlevels").flatMap(d.param(_)).flatMap(_.ints.headOption)
        val growth = 1L << (2 * Math.max(0, Math.min(levels.headOption.getOrElse(3), 12)))
        val triangles = count(d, "indices") / 3 * growth
        SurfaceCount(triangles, triangles * (Corners + LoopVertex / 2))
      case "bilinearmesh" => SurfaceCount(patches = count(d, "indices") / 4)
      case "plymesh" =>
        val size = SceneSize.file(d, "filename").flatMap(PlySize.guess)
        size.fold(SurfaceCount())(ofFile(_, keepsQuads = dialect == Dialect.V4))
      case _ => SurfaceCount(solids = 1)

  private def segmentsOf(curve: Declaration): Long =
    val degree = number(curve, "degree", 3)
    val points = count(curve, "P") / 3
    val isSpline = curve.param("basis").exists(_.strings.contains("bspline"))
    val curves = if isSpline then points - degree else (points - 1) / Math.max(1, degree)
    val halvings = Math.max(0, Math.min(number(curve, "splitdepth", 3), 16))
    Math.max(1, curves) << halvings

  private def mesh(d: Declaration): SurfaceCount =
    val corners = if d.param("indices").isEmpty then 3L else count(d, "indices")
    val numbers = Vector("P", "N", "uv", "st").map(count(d, _)).sum
    SurfaceCount(corners / 3, corners / 3 * Corners + numbers * 4)

  private def ofFile(size: PlySize, keepsQuads: Boolean): SurfaceCount =
    val numbers = size.vertices * size.numbers * 4
    if keepsQuads && size.corners > 3.5 && size.corners < 4.5 then
      SurfaceCount(0, numbers, patches = size.faces)
    else
      val triangles = (size.faces * (size.corners - 2)).toLong
      SurfaceCount(triangles, triangles * Corners + numbers)

  private def count(d: Declaration, name: String): Long =
    d.param(name).fold(0L)(p => Math.max(p.floats.length, p.ints.length))

  private def number(d: Declaration, name: String, usual: Int): Int =
    d.param(name).fold(usual): p =>
      p.ints.headOption.orElse(p.floats.headOption.map(_.toInt)).getOrElse(usual)

  /** Bytes of a triangle's indices where those of a mesh are near each other. */
  private val Corners = 7L

  /** Bytes of a subdivided vertex, its point and normal; there are half as many as triangles. */
  private val LoopVertex = 24L
