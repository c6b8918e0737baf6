package candela.stability

import candela.accel.*
import candela.accel.tracing.{Bvh, Grid, Hierarchies}
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.shapes.TriangleSoup
import candela.testing.{Draws, Soups}
import Checks.assert

/** No ray leaves a closed mesh, whatever edge or corner it is aimed at: what belongs to two
  * triangles is decided for both by the same products, so that one of them owns it.
  */
private object ClosedMeshes:
  private def uniform(s: Double) = Transform.scale(s, s, s).get

  private def placements: Seq[(String, Transform)] =
    val draws = Draws(1)
    Seq(
      "around the origin" -> Transform.Identity,
      "of size 1e-6" -> uniform(1e-6) * draws.rotation(),
      "of size 1e6" -> uniform(1e6) * draws.rotation(),
      "far away" -> Transform.translate(3e4, -1e4, 2e4) * draws.rotation(),
      "flat as a needle" -> draws.rotation() * Transform.scale(1, 1e-4, 1e-3).get
    )

  val cases: Seq[Case] =
    for (name, toWorld) <- placements; (by, long, make) <- accelerators yield
      val quick = if name.startsWith("flat") then 1500 else 10000
      val words = s"no ray leaks from a closed mesh $name ($by)"
      Case.sliced(words, quick, long, words): trials =>
        val soup = Soups.icosphere(4, toWorld)
        leaks(make(Primitives(soup, Array.empty)), soup, toWorld, trials)

  /** The hierarchy that renderings use, of enough triangles to be walked by vectors (where those
    * are) from the 250,000th ray on; the grid; and the hierarchy of two children a node, which is
    * for more triangles than fit into the other one.
    */
  private def accelerators: Seq[(String, Long, Primitives => Accelerator)] = Seq(
    ("bvh", 100_000_000L, Hierarchies.of(_)),
    ("grid", 100_000_000L, Grid(_)),
    ("binary bvh", 10_000_000L, Bvh(_))
  )

  private def leaks(a: Accelerator, soup: TriangleSoup, toWorld: Transform, trials: Trials): Unit =
    val count = trials.count
    val draws = trials.draws(2)
    val (ray, hit) = (Ray(), Hit())
    var i = 0L
    while i < count do
      val o = toWorld.point(if i % 50 == 0 then Vec3.Zero else draws.direction() * 0.6f)
      val triangle = draws.below(soup.count)
      val (p, q) = (soup.vertex(triangle, draws.below(3)), soup.vertex(triangle, draws.below(3)))
      val t = if i % 3 == 0 then 0f else draws.unit()
      val goal = p * (1f - t) + q * t
      ray.set(o, if i % 2 == 0 then goal - o else (goal - o).normalized, Float.PositiveInfinity)
      assert(a.closest(ray, hit), s"from $o to $goal"): Unit
      i += 1
