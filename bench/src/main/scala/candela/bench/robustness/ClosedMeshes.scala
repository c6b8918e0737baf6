package candela.bench.robustness

import candela.accel.{Accelerator, Instances, Primitives}
import candela.accel.tracing.Hierarchies
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.shapes.TriangleSoup

/** A closed mesh, as its vertices have it or as an instance of a ball.
  *
  * @param toWorld from the ball of radius 1 to the world
  * @param isSlow  whether a ray meets the boxes of most triangles
  */
final case class ClosedMesh(
    name: String,
    toWorld: Transform,
    isInstance: Boolean = false,
    isSlow: Boolean = false
):
  /** In the world. */
  def soup: TriangleSoup = Solids.icosphere(ClosedMesh.Levels, toWorld)

  /** @param make the accelerator of triangles */
  def accelerator(make: Primitives => Accelerator): Accelerator =
    if !isInstance then make(Primitives(soup, Array.empty))
    else
      val unit = Solids.icosphere(ClosedMesh.Levels, Transform.Identity)
      val ball = make(Primitives(unit, Array.empty))
      val placed = Instances.of(Array(ball), Vector((0, Still(toWorld))).view, 0f, 1f)
      Hierarchies.scalar(Primitives(Solids.Empty, Array.empty, placed))

object ClosedMesh:
  /** Of subdivision: 2,048 triangles. */
  final val Levels = 4

  private def uniform(s: Double) = Transform.scale(s, s, s).get

  val all: Vector[ClosedMesh] =
    val draws = Draws(1)
    val baked = Vector(
      ClosedMesh("around the origin", Transform.Identity),
      ClosedMesh("of size 1e-6", uniform(1e-6) * draws.rotation()),
      ClosedMesh("of size 1e6", uniform(1e6) * draws.rotation()),
      ClosedMesh("far away", Transform.translate(3e4, -1e4, 2e4) * draws.rotation()),
      ClosedMesh(
        "flat as a needle",
        draws.rotation() * Transform.scale(1, 1e-4, 1e-3).get,
        isSlow = true
      )
    )
    val sheared = draws.rotation() * Transform.scale(1, 8, 0.125).get * draws.rotation()
    val uneven = Transform.translate(10, -20, 30) * draws.rotation() *
      Transform.scale(1e3, 1, 1e-3).get
    baked ++ Vector(
      ClosedMesh("sheared, an instance", sheared, isInstance = true),
      ClosedMesh("unevenly scaled, an instance", uneven, isInstance = true)
    )

/** No ray leaves a closed mesh, whatever edge or corner it is aimed at: what belongs to two
  * triangles is decided for both by the same products, so that one of them owns it.
  */
object LeakingRays:

  /** Rays from within the mesh to points of its edges, half of them of unit length. */
  final class Aim(mesh: ClosedMesh, trials: Trials):
    private val soup = mesh.soup
    private val draws = trials.draws(2)
    private var i = 0L

    def next(ray: Ray): Unit =
      val o = mesh.toWorld.point(if i % 50 == 0 then Vec3.Zero else draws.direction() * 0.6f)
      val triangle = draws.below(soup.count)
      val (p, q) = (soup.vertex(triangle, draws.below(3)), soup.vertex(triangle, draws.below(3)))
      val t = if i % 3 == 0 then 0f else draws.unit()
      val goal = p * (1f - t) + q * t
      ray.set(o, if i % 2 == 0 then goal - o else (goal - o).normalized, Float.PositiveInfinity)
      i += 1

  def tally(a: Accelerator, mesh: ClosedMesh, trials: Trials): Tally =
    val (ray, hit, aim) = (Ray(), Hit(), Aim(mesh, trials))
    Tally.of(trials.count): _ =>
      aim.next(ray)
      if a.closest(ray, hit) then Tally.Sound
      else s"from ${ray.ox} ${ray.oy} ${ray.oz} along ${ray.dx} ${ray.dy} ${ray.dz}"
