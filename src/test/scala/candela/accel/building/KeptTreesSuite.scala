package candela.accel.building

import candela.base.loop
import candela.concurrency.Parallel
import candela.io.Keep
import org.scalatest.funsuite.AnyFunSuite

import candela.accel.{AcceleratorScenes, Primitives, WideTree}
import candela.accel.tracing.{Bvh, Hierarchies}
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.render.ThreadPool
import candela.shapes.{Mesh, Shape, TriangleSoup}
import candela.testing.{Draws, Soups}

class KeptTreesSuite extends AnyFunSuite:

  /** Two tori, the second of fewer triangles, and spheres, all of which may be elsewhere. */
  private def scene(
      first: Float = 0f,
      second: Float = 0f,
      spheres: Float = 0f,
      sides: Int = 40,
      content: Option[String] = None
  ): Primitives =
    val (a, b) = (AcceleratorScenes.torus(60).soup, AcceleratorScenes.torus(sides).soup)
    def at(soup: TriangleSoup, by: Float) = soup.positions.map(_ + by)
    def all(soup: TriangleSoup) = soup.indices.slice(0, soup.indices.length)
    val vertices = a.positions.length / 3
    def mesh(vertex: Int, triangle: Int, count: Int) =
      val none = Array.empty[Float]
      Mesh(
        vertex,
        triangle,
        count,
        none,
        none,
        false,
        0,
        -1,
        content = content.filter(_ => vertex > 0)
      )
    val soup = TriangleSoup(
      at(a, first) ++ at(b, second),
      all(a) ++ all(b).map(_ + vertices),
      Array(mesh(0, 0, a.count), mesh(vertices, a.count, b.count)),
      false
    )
    val draws = Draws(3)
    val shapes = Array.fill[Shape](20):
      val p = draws.vec(-1, 1)
      Soups.sphere(Transform.translate(p.x + spheres, p.y, p.z), 0.1f)
    Primitives(soup, shapes)

  private def tree(keep: Keep, primitives: Primitives, parallel: Parallel = Parallel.Alone) =
    keep.startScene()
    KeptTrees(keep, 4, 4, 4, parallel).of(primitives)

  private def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  /** Fails unless each primitive is in one leaf. */
  private def assertWhole(tree: WideTree, primitives: Primitives): Unit =
    def below(code: Int): Vector[Int] =
      if code == WideTree.NoChild then Vector.empty
      else if code >= 0 then
        Vector.tabulate(tree.width)(k => bits(tree.nodes(code + 6 * tree.width + k))).flatMap(below)
      else if WideTree.isBlock(code) then
        val at = WideTree.leafStart(code) * WideTree.blockFloats(tree.lanes) + 9 * tree.lanes
        Vector.tabulate(WideTree.size(code))(i => bits(tree.blocks(at + i)))
      else Vector.fill(WideTree.size(code))(-1)
    val all = below(tree.root)
    assert(all.size == primitives.count && tree.count == primitives.count)
    val inBlocks = all.filter(_ >= 0)
    assert(inBlocks.distinct.size == inBlocks.size && inBlocks.size > primitives.count / 2): Unit

  private def assertSameHits(keep: Keep, primitives: Primitives): Unit =
    val draws = Draws(7)
    val found = Hierarchies.scalar(primitives, keep = keep)
    val reference = Bvh(primitives)
    val (ray, hit) = (Ray(), Hit())
    loop(2000): _ =>
      val (from, to) = (draws.vec(-3, 3), draws.vec(-1, 1))
      ray.set(from, to - from, Float.PositiveInfinity)
      val isHit = reference.closest(ray, hit)
      val (primitive, t) = (hit.primitive, ray.tMax)
      ray.set(from, to - from, Float.PositiveInfinity)
      assert(found.closest(ray, hit) == isHit && hit.primitive == primitive && ray.tMax == t)
      ray.set(from, to - from, 0.9f * t)
      assert(!found.isOccluded(ray, hit)): Unit

  test("the tree of equal primitives is built once, and is that of one scene alone"):
    val keep = Keep()
    val first = tree(keep, scene())
    val again = tree(keep, scene())
    assert(again.nodes eq first.nodes)
    assert(again.blocks eq first.blocks)
    val alone = WideBuilder.of(scene(), 4, 4, 4, Parallel.Alone)
    assert(alone.nodes.map(bits).sameElements(again.nodes.map(bits)))
    assert(alone.root == again.root)

  test("trees of other primitives, widths and lanes are others"):
    val keep = Keep()
    val first = tree(keep, scene())
    val others = Seq(scene(first = 1f), scene(second = 1f), scene(spheres = 1f), scene(sides = 41))
    for other <- others do assert(tree(keep, other).nodes ne first.nodes)
    assert(KeptTrees(keep, 4, 8, 4, Parallel.Alone).of(scene()).lanes == 8)
    assert(KeptTrees(keep, 8, 4, 4, Parallel.Alone).of(scene()).width == 8)

  test("a mesh whose content is known is told from others by that"):
    val keep = Keep()
    val first = tree(keep, scene(content = Some("a")))
    assert(tree(keep, scene(content = Some("a"))).nodes eq first.nodes)
    for other <- Seq(scene(content = Some("b")), scene(first = 1f, content = Some("a"))) do
      assert(tree(keep, other).nodes ne first.nodes)

  test("if a part has moved, the tree of the rest is kept from the second scene on"):
    val keep = Keep()
    val _ = tree(keep, scene())
    for (moved, i) <- Seq(scene(second = 0.1f), scene(second = 0.2f)).zipWithIndex do
      val made = tree(keep, moved)
      assertWhole(made, moved)
      assert(made.root == 0)
      assertSameHits(keep, moved)
      val alone = WideBuilder.of(moved, 4, 4, 4, Parallel.Alone)
      assert(made.bounds == alone.bounds, i)

  test("what rests is not built again, whatever moves"):
    val keep = Keep()
    val moves = Seq(scene(), scene(second = 0.1f), scene(second = 0.2f), scene(second = 0.3f))
    val made = moves.map(tree(keep, _))
    // The part at rest comes first in the joined tree
    val rest = WideBuilder.layout(
      moves.head,
      BoxRecord.ofSome(moves.head, (0 until 7200).toArray ++ (10400 until 10420), Parallel.Alone),
      4,
      4,
      4,
      Parallel.Alone
    )
    for tree <- made.tail do
      val here = tree.blocks.take(rest.blocks.length)
      assert(here.map(bits).sameElements(rest.blocks.map(bits)))

  test("a part that moves later joins those that move"):
    val keep = Keep()
    val _ = tree(keep, scene())
    for
      moved <- Seq(
        scene(second = 0.1f),
        scene(second = 0.1f, spheres = 0.1f),
        scene(second = 0.2f, spheres = 0.1f),
        scene(spheres = 0.2f)
      )
    do
      assertWhole(tree(keep, moved), moved)
      assertSameHits(keep, moved)

  test("if most of a scene has moved, its tree is that of the scene alone"):
    val keep = Keep()
    val _ = tree(keep, scene())
    val moved = scene(first = 0.1f)
    val alone = WideBuilder.of(moved, 4, 4, 4, Parallel.Alone)
    assert(tree(keep, moved).nodes.map(bits).sameElements(alone.nodes.map(bits)))

  test("kept trees are the same for any number of threads"):
    def all(parallel: Parallel) =
      val keep = Keep()
      Seq(scene(), scene(second = 0.1f), scene(second = 0.2f)).map(tree(keep, _, parallel))
    for (a, b) <- all(Parallel.Alone).zip(all(ThreadPool(3))) do
      assert(a.nodes.map(bits).sameElements(b.nodes.map(bits)))
      assert(a.blocks.map(bits).sameElements(b.blocks.map(bits)))
