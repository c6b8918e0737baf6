package candela.accel

import candela.math.*
import candela.shapes.{Shape, TriangleSoup}
import candela.testing.{Draws, Soups}

/** Sets of primitives that are hard for one accelerator or another. */
object AcceleratorScenes:

  private def mixed(triangles: Seq[Soups.Triangle], shapes: Seq[Shape] = Nil): Primitives =
    val soup = if triangles.isEmpty then TriangleSoup.Empty else Soups.of(triangles)
    Primitives(soup, shapes.toArray)

  /** Instances of three objects (triangles, shapes, both), turned, stretched and mirrored. */
  def instances(draws: Draws, count: Int, size: Float)(centre: => Vec3): Instances =
    def near = draws.vec(-1, 1)
    val objects = Array[Accelerator](
      Bvh(mixed(Soups.around(draws, 60, 0.3f)(near))),
      BruteForce(mixed(Nil, Soups.shapes(draws, 5, 1)(near))),
      Grid(mixed(Soups.around(draws, 20, 0.5f)(near), Soups.shapes(draws, 5, 0.5f)(near)))
    )
    Instances.of(
      objects,
      Vector.tabulate(count): i =>
        val c = centre
        val scale = Transform.scale(size, size, size).get
        def turned = draws.rotation() * draws.stretch() * scale
        val there = Transform.translate(c.x, c.y, c.z) * turned
        val isMoving = i % 4 == 3
        val away = draws.translation(size)
        val place =
          if isMoving then Interpolation(there, away * there, 0f, 1f, shortest = true)
          else Still(there)
        (i % 3, place)
    )

  def all: Seq[(String, Primitives)] =
    val draws = Draws(1)
    def anywhere = draws.vec(-1, 1)
    val far = Vec3(10000f, -5000f, 20000f)
    Seq(
      "nothing" -> mixed(Nil),
      "one triangle" -> mixed(Soups.around(draws, 1, 1)(Vec3.Zero)),
      "a few" -> mixed(Soups.around(draws, 5, 0.7f)(anywhere)),
      "uniform" -> mixed(Soups.around(draws, 300, 0.3f)(anywhere)),
      "clustered" -> mixed:
        Seq.fill(6)(anywhere).flatMap(c =>
          Soups.around(draws, 50, 0.01f)(c + draws.direction() * 0.02f)
        ) ++ Soups.around(draws, 3, 1)(anywhere)
      ,
      "long and thin" -> mixed:
        Seq.fill(200):
          val (a, along) = (anywhere, draws.direction())
          (a, a + along * 2f, a + along + draws.direction() * 2e-3f)
      ,
      // 216 triangles: the grid has 3·∛216 = 18 voxels a side, so all quads stand at their faces
      "at voxel faces" -> mixed:
        Soups.latticeQuads(draws, 108, 18)(draws.below(3))
      ,
      "in one plane" -> mixed(Soups.latticeQuads(draws, 150, 8)(2).map(flatten)),
      "one on the other" -> mixed:
        val triangle = Soups.around(draws, 1, 1)(Vec3.Zero).head
        Seq.fill(40)(triangle)
      ,
      "spheres and disks" -> mixed(Nil, Soups.shapes(draws, 60, 0.5f)(anywhere)),
      "triangles, spheres and disks" -> mixed(
        Soups.around(draws, 200, 0.3f)(anywhere),
        Soups.shapes(draws, 40, 0.3f)(anywhere)
      ),
      "instances" ->
        Primitives(TriangleSoup.Empty, Array.empty, instances(draws, 60, 0.1f)(anywhere)),
      "triangles, spheres, disks and instances" -> Primitives(
        Soups.of(Soups.around(draws, 100, 0.3f)(anywhere)),
        Soups.shapes(draws, 20, 0.3f)(anywhere).toArray,
        instances(draws, 20, 0.2f)(anywhere)
      ),
      "instances far from the origin" -> Primitives(
        TriangleSoup.Empty,
        Array.empty,
        instances(draws, 40, 0.1f)(far + anywhere)
      ),
      "far from the origin" -> mixed(
        Soups.around(draws, 200, 0.3f)(far + anywhere),
        Soups.shapes(draws, 20, 0.3f)(far + anywhere)
      ),
      "at voxel faces, far from the origin" -> mixed:
        Soups.latticeQuads(draws, 108, 18)(draws.below(3)).map: (a, b, c) =>
          (a + far, b + far, c + far)
      ,
      // The grid has 64 voxels a side, each some 16 Floats wide
      "many small ones, far from the origin" -> mixed:
        Soups.around(draws, 10000, 0.03f)(far + anywhere)
    )

  private def flatten(t: Soups.Triangle): Soups.Triangle =
    def down(p: Vec3) = Vec3(p.x, p.y, 0.25f)
    (down(t._1), down(t._2), down(t._3))
