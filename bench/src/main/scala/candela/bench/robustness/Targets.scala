package candela.bench.robustness

import candela.accel.{Accelerator, BruteForce, Instances, Primitives}
import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*
import candela.scene.{Instanced, ShapeTable, Surfaces}
import candela.shapes.*

/** Something that rays land on and leave: a surface alone in the world. */
final class Target(surfaces: Surfaces, motion: Motion):
  private val primitives = surfaces.primitives()
  private val isPlain = !motion.moves && motion.transform(0f).isIdentity
  private val instances =
    if isPlain then Instances.Empty
    else Instances.of(Array(BruteForce(primitives)), Vector((0, motion)).view, 0f, 1f)
  private val instanced = Instanced(Array(surfaces), instances)
  private val accelerator: Accelerator =
    if isPlain then BruteForce(primitives)
    else BruteForce(Primitives(Solids.Empty, Array.empty, instances))

  def bounds: Bounds3 = accelerator.bounds
  def isHit(ray: Ray, hit: Hit): Boolean = accelerator.isOccluded(ray, hit)
  def closest(ray: Ray, hit: Hit): Boolean = accelerator.closest(ray, hit)

  def fill(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    if isPlain then surfaces.fill(hit.primitive, ray, hit, at)
    else instanced.fill(hit.primitive, ray, hit, at)

object Target:
  private val AtRest = Still(Transform.Identity)

  def apply(shapes: Seq[Shape], motion: Motion = AtRest): Target =
    new Target(Surfaces(Solids.Empty, ShapeTable.of(shapes.toArray)), motion)

  def mesh(soup: TriangleSoup, motion: Motion = AtRest): Target =
    new Target(Surfaces(soup, ShapeTable.Empty), motion)

/** Where rays that leave a surface go: to any side, to the outside, or to the outside and not along
  * the surface, which bends up to them.
  */
enum Leaving:
  case Anywhere, Outwards, Steeply

/** One kind of shape.
  *
  * @param create a shape of about the given size, placed; moved about by `motion` if there is one
  */
final case class Kind(name: String, leaving: Leaving, quick: Int = 2500)(
    val create: (Draws, Transform, Float, Option[Motion]) => Target
)

object Kind:
  private def motionOrRest(motion: Option[Motion]) = motion.getOrElse(Still(Transform.Identity))

  private def of(name: String, leaving: Leaving, quick: Int = 2500)(
      shapes: (Draws, Transform, Float) => Seq[Shape]
  ): Kind = Kind(name, leaving, quick)((draws, toWorld, size, motion) =>
    Target(shapes(draws, toWorld, size), motionOrRest(motion))
  )

  private def quadric(name: String, kind: Int, leaving: Leaving) =
    of(name, leaving)((draws, toWorld, size) => Seq(swept(draws, kind, size, toWorld)))

  /** A quadric of about `size`, whole or in part. */
  private def swept(draws: Draws, kind: Int, size: Float, toWorld: Transform): Quadric =
    def part() = size * draws.between(0.2f, 1)
    val phi = if draws.coin() then TwoPi else draws.between(0.5f, 6)
    val profile = kind match
      case 0 => Profile.cylinder(part(), -part(), part())
      case 1 => Profile.cone(part(), part())
      case 2 =>
        val top = part()
        val bottom = if draws.coin() then 0f else top * draws.between(0, 0.8f)
        Profile.paraboloid(part(), bottom, top)
      case _ =>
        val (waist, tilt) = (part(), draws.between(-1.5f, 1.5f))
        def at(z: Float) = Vec3(waist, tilt * z, z)
        Profile.hyperboloid(at(-part()), at(part())).get
    Quadric(toWorld, profile, phi, false)

  private def curves(name: String, kind: CurveKind) =
    of(name, Leaving.Steeply, quick = 300): (draws, toWorld, size) =>
      val p = Seq.tabulate(4)(i => Vec3(i - 1.5f, 0f, 0f) + draws.vec(-0.4f, 0.4f)).map(_ * size)
      val points = p.flatMap(q => Seq(q.x.toDouble, q.y.toDouble, q.z.toDouble)).toArray
      val normals = Option.when(kind == CurveKind.Ribbon)((draws.direction(), draws.direction()))
      val width = size * draws.magnitude(1e-2, 0.2)
      val curve = BezierCurve(points, width, width * draws.between(0.3f, 1f), normals)
      val segments = CurveBuilder.segments(Seq(curve), CurveForm(kind, 2, 1f), toWorld, false)
      Seq.tabulate(segments.count)(CurveSegment(segments, _))

  private def triangles(draws: Draws, toWorld: Transform, size: Float) =
    Solids.of(Solids.randomTriangles(draws, 1, size)(Vec3.Zero).map: (a, b, c) =>
      (toWorld.point(a), toWorld.point(b), toWorld.point(c)))

  val all: Seq[Kind] = Seq(
    Kind("triangle", Leaving.Anywhere)((draws, toWorld, size, motion) =>
      Target.mesh(triangles(draws, toWorld, size), motionOrRest(motion))
    ),
    of("disk", Leaving.Anywhere)((draws, toWorld, size) =>
      Seq(Disk(toWorld, size * draws.between(-1, 1), size, 0f, TwoPi, draws.coin()))
    ),
    of("sphere", Leaving.Outwards)((_, toWorld, size) => Seq(Solids.sphere(toWorld, size))),
    of("part of a sphere", Leaving.Outwards)((draws, toWorld, size) =>
      Seq(Sphere(toWorld, size, -0.5f * size, 0.7f * size, draws.between(1, 6), false))
    ),
    quadric("cylinder", 0, Leaving.Outwards),
    quadric("cone", 1, Leaving.Outwards),
    quadric("paraboloid", 2, Leaving.Outwards),
    quadric("hyperboloid", 3, Leaving.Steeply),
    of("bilinear patch", Leaving.Steeply): (draws, toWorld, size) =>
      val corners =
        for v <- Seq(0f, 1f); u <- Seq(0f, 1f)
        yield toWorld.point((Vec3(u, v, 0f) + draws.vec(-0.33f, 0.33f) - Half) * size)
      val order = Array(0, 1, 2, 3)
      val mesh = BilinearMesh(Solids.flat(corners), order, Array.empty, Array.empty, false)
      Seq(BilinearPatch(mesh, 0))
    ,
    curves("flat curve", CurveKind.Flat),
    curves("round curve", CurveKind.Cylinder),
    curves("ribbon", CurveKind.Ribbon)
  )

  private val Half = Vec3(0.5f, 0.5f, 0f)
