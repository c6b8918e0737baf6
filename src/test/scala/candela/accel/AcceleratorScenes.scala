package candela.accel

import candela.accel.tracing.{Bvh, Grid}
import candela.math.*
import candela.shapes.{Mesh, Shape, TriangleSoup}
import candela.testing.{Draws, Soups}
import candela.textures.ConstantFloat

import scala.util.Random

/** Sets of primitives that are hard for one accelerator or another. */
object AcceleratorScenes:

  private def mixed(triangles: Seq[Soups.Triangle], shapes: Seq[Shape] = Nil): Primitives =
    val soup = if triangles.isEmpty then Soups.Empty else Soups.of(triangles)
    Primitives(soup, shapes.toArray)

  /** Instances of three objects (triangles, shapes, both), turned, stretched and mirrored. */
  def instances(draws: Draws, count: Int, size: Float)(centre: => Vec3): Instances =
    def near = draws.vec(-1, 1)
    val objects = Array[Accelerator](
      Bvh(mixed(Soups.randomTriangles(draws, 60, 0.3f)(near))),
      BruteForce(mixed(Nil, Soups.shapes(draws, 5, 1)(near))),
      Grid(mixed(Soups.randomTriangles(draws, 20, 0.5f)(near), Soups.shapes(draws, 5, 0.5f)(near)))
    )
    val places =
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
    Instances.of(objects, places.view)

  def all: Seq[(String, Primitives)] =
    val draws = Draws(1)
    def anywhere = draws.vec(-1, 1)
    val far = Vec3(10000f, -5000f, 20000f)
    Seq(
      "nothing" -> mixed(Nil),
      "one triangle" -> mixed(Soups.randomTriangles(draws, 1, 1)(Vec3.Zero)),
      "a few" -> mixed(Soups.randomTriangles(draws, 5, 0.7f)(anywhere)),
      "uniform" -> mixed(Soups.randomTriangles(draws, 300, 0.3f)(anywhere)),
      "clustered" -> mixed:
        Seq.fill(6)(anywhere).flatMap(c =>
          Soups.randomTriangles(draws, 50, 0.01f)(c + draws.direction() * 0.02f)
        ) ++ Soups.randomTriangles(draws, 3, 1)(anywhere)
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
        val triangle = Soups.randomTriangles(draws, 1, 1)(Vec3.Zero).head
        Seq.fill(40)(triangle)
      ,
      "spheres and disks, each several times" -> mixed(
        Nil,
        Random(3).shuffle(Seq.fill(4)(Soups.shapes(Draws(5), 30, 0.5f)(Vec3.Zero)).flatten)
      ),
      "spheres and disks" -> mixed(Nil, Soups.shapes(draws, 60, 0.5f)(anywhere)),
      "triangles, spheres and disks" -> mixed(
        Soups.randomTriangles(draws, 200, 0.3f)(anywhere),
        Soups.shapes(draws, 40, 0.3f)(anywhere)
      ),
      "instances" ->
        Primitives(Soups.Empty, Array.empty, instances(draws, 60, 0.1f)(anywhere)),
      "triangles, spheres, disks and instances" -> Primitives(
        Soups.of(Soups.randomTriangles(draws, 100, 0.3f)(anywhere)),
        Soups.shapes(draws, 20, 0.3f)(anywhere).toArray,
        instances(draws, 20, 0.2f)(anywhere)
      ),
      "instances far from the origin" -> Primitives(
        Soups.Empty,
        Array.empty,
        instances(draws, 40, 0.1f)(far + anywhere)
      ),
      "far from the origin" -> mixed(
        Soups.randomTriangles(draws, 200, 0.3f)(far + anywhere),
        Soups.shapes(draws, 20, 0.3f)(far + anywhere)
      ),
      "at voxel faces, far from the origin" -> mixed:
        Soups.latticeQuads(draws, 108, 18)(draws.below(3)).map: (a, b, c) =>
          (a + far, b + far, c + far)
      ,
      // The grid has 64 voxels a side, each some 16 Floats wide
      "many small ones, far from the origin" -> mixed:
        Soups.randomTriangles(draws, 10000, 0.03f)(far + anywhere)
    )

  private def flatten(t: Soups.Triangle): Soups.Triangle =
    def down(p: Vec3) = Vec3(p.x, p.y, 0.25f)
    (down(t._1), down(t._2), down(t._3))

  /** In three parts: solid, open behind, open at random. */
  private def masked(triangles: Seq[Soups.Triangle]): Primitives =
    val all = Soups.of(triangles)
    val third = all.count / 3
    val meshes =
      Array(0, 1, 2).map(i => Mesh(0, i * third, third, Array.empty, Array.empty, false, 0, -1))
    val soup = new TriangleSoup(all.positions, all.indices, meshes, tangents = true)
    val masks =
      Array(SolidMask, FrontMask(SolidMask), StochasticMask(ConstantFloat(0.5f), separate = true))
    Primitives(soup, Array.empty, Instances.Empty, Masks(masks, Array.empty))

  /** Sets of triangles alone: each hard in its own way. */
  def triangles: Seq[(String, Primitives)] =
    val draws = Draws(11)
    def anywhere = draws.vec(-1, 1)
    def of(triangles: Seq[Soups.Triangle]) = Primitives(Soups.of(triangles), Array.empty)
    def sliver(length: Float, width: Float) =
      val (a, d) = (anywhere, draws.direction() * length)
      (a, a + d, a + d * draws.unit() + draws.direction() * width)
    val far = Vec3(3e4f, -5e3f, 1e4f)
    val flat = Soups.latticeQuads(draws, 200, 6)(draws.below(3))
    Seq(
      "slivers" -> of(Seq.fill(300)(sliver(2f, draws.magnitude(1e-7, 1e-2)))),
      "needles in one direction" -> of(Seq.fill(200):
        val a = anywhere
        (a, a + Vec3(3f, 0f, 0f), a + Vec3(1.5f, 1e-6f, draws.between(-1e-7f, 1e-7f)))),
      "parallel to the axes" -> of(flat),
      "parallel to the axes, far away" -> of(flat.map((a, b, c) => (a + far, b + far, c + far))),
      "parallel to the axes, edges' products overflow" ->
        of(flat.map((a, b, c) => (a * 1e12f, b * 1e12f, c * 1e12f))),
      "the same ones again and again" -> of(Seq.fill(4)(flat.take(60)).flatten),
      "edges and corners in common" -> Primitives(
        Soups.icosphere(3, Transform.translate(0.3f, 7f, -2f)),
        Array.empty
      ),
      "points and lines" -> of(Seq.fill(100):
        val (a, b) = (anywhere, anywhere)
        if draws.coin() then (a, a, a) else (a, b, a * 0.5f + b * 0.5f)),
      "of all sizes" -> of(Seq.fill(300):
        val size = draws.magnitude(1e-6, 1e4)
        val c = anywhere * draws.magnitude(1e-3, 1e3)
        (c + draws.vec(-size, size), c + draws.vec(-size, size), c + draws.vec(-size, size))),
      "beyond the squares of Floats" -> of(Soups.randomTriangles(
        draws,
        50,
        3e24f
      )(anywhere * 1e25f)),
      "open behind, and half open" -> masked(Soups.randomTriangles(draws, 300, 0.7f)(anywhere)),
      "tiny" -> of(Soups.randomTriangles(draws, 50, 3e-18f)(anywhere * 1e-17f)),
      "one" -> of(Soups.randomTriangles(draws, 1, 1f)(Vec3.Zero))
    ) ++ all.filter(s => s._2.shapes.isEmpty && s._2.instances.count == 0)

  /** A torus with bumps: 2·`sides`² triangles in the order of a mesh. */
  def torus(sides: Int): Primitives =
    val positions = (for v <- 0 until sides; u <- 0 until sides yield
      val (a, b) = (2 * Math.PI * u / sides, 2 * Math.PI * v / sides)
      val r = 0.4 + 0.05 * Math.sin(9 * a) * Math.sin(13 * b)
      val out = 1 + r * Math.cos(b)
      Seq(out * Math.cos(a), out * Math.sin(a), r * Math.sin(b)).map(_.toFloat)
    ).flatten.toArray
    val indices = (for v <- 0 until sides; u <- 0 until sides yield
      def at(i: Int, j: Int) = (v + j) % sides * sides + (u + i) % sides
      Seq(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1))
    ).flatten.toArray
    Primitives(Soups.indexed(positions, indices), Array.empty)
