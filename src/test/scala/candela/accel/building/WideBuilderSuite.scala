package candela.accel.building

import candela.base.loop
import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.accel.{AcceleratorScenes, Primitives, WideTree}
import candela.accel.tracing.{Bvh, Hierarchies}
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.render.ThreadPool
import candela.testing.{Draws, Soups}

class WideBuilderSuite extends AnyFunSuite:

  private def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  test("the wide tree is the same for any number of threads", Slow):
    val draws = Draws(10)
    val spheres = Soups.shapes(draws, 12_000, 1e-3f)(draws.vec(-1, 1)).toArray
    val mixed = Primitives(AcceleratorScenes.torus(115).soup, spheres)
    for (primitives, width, lanes) <- Seq((AcceleratorScenes.torus(150), 4, 4), (mixed, 16, 8)) do
      def build(parallel: Parallel) = WideBuilder.of(primitives, width, lanes, 4, parallel)
      val alone = build(Parallel.Alone)
      assert(alone.count > 32768)
      for parallel <- Seq(ThreadPool(3), Backwards) do
        val other = build(parallel)
        assert(other.root == alone.root)
        assert(other.nodes.map(bits).sameElements(alone.nodes.map(bits)))
        assert(other.blocks.map(bits).sameElements(alone.blocks.map(bits)))
      val wide = Hierarchies.scalar(primitives, width, ThreadPool(3))
      val (ray, hit) = (Ray(), Hit())
      val reference = Bvh(primitives)
      loop(1000): _ =>
        val (from, to) = (draws.vec(-2, 2), draws.vec(-1, 1))
        ray.set(from, to - from, Float.PositiveInfinity)
        val found = reference.closest(ray, hit)
        val (primitive, t) = (hit.primitive, ray.tMax)
        ray.set(from, to - from, Float.PositiveInfinity)
        assert(wide.closest(ray, hit) == found && hit.primitive == primitive && ray.tMax == t): Unit

  /** The most entries that a walk's stack can have in the subtree of `code`, if `waiting` are on it
    * already.
    */
  private def stackNeed(tree: WideTree, code: Int, waiting: Int): Int =
    if code < 0 then waiting
    else
      val children = Vector.tabulate(tree.width)(k => bits(tree.nodes(code + 6 * tree.width + k)))
        .filter(_ != WideTree.NoChild)
      val here = waiting + children.size
      children.map(stackNeed(tree, _, here - 1)).foldLeft(here)(Math.max)

  test("a tree tells the stack that a walk needs, and each triangle is in one block"):
    for
      (scene, primitives) <- AcceleratorScenes.triangles
      (width, lanes) <- Seq((4, 4), (8, 8), (16, 8), (16, 16))
    do
      val tree = WideBuilder.of(primitives, width, lanes, 4, Parallel.Alone)
      val need = stackNeed(tree, tree.root, 0)
      assert(need <= tree.stackSize && tree.stackSize <= 91 * (width - 1) + 1, scene)
      val owners =
        for
          block <- 0 until tree.blockCount
          lane <- 0 until lanes
        yield bits(tree.blocks(block * WideTree.blockFloats(lanes) + 9 * lanes + lane))
      assert(owners.filter(_ >= 0).sorted == (0 until primitives.count), scene)

  /** The numbers of primitives in the leaves below `code`, blocks or not. */
  private def leaves(tree: WideTree, code: Int, blocks: Boolean): Vector[Int] =
    if code == WideTree.NoChild then Vector.empty
    else if code < 0 then
      if WideTree.isBlock(code) == blocks then Vector(WideTree.size(code)) else Vector.empty
    else
      Vector.tabulate(tree.width)(k => bits(tree.nodes(code + 6 * tree.width + k)))
        .flatMap(leaves(tree, _, blocks))

  test("other primitives that are not to be split are in larger leaves, triangles in the same"):
    val draws = Draws(11)
    val spheres = Soups.shapes(draws, 3000, 1e-2f)(draws.vec(-1, 1)).toArray
    val mesh = Soups.icosphere(3, Transform.translate(3f, 0f, 0f))
    for soup <- Seq(Soups.Empty, mesh) do
      val primitives = Primitives(soup, spheres)
      def tree(unsplit: Int) = WideBuilder.of(primitives, 4, 4, 4, Parallel.Alone, unsplit)
      val (fine, coarse) = (tree(1), tree(8))
      val (few, many) =
        (leaves(coarse, coarse.root, blocks = false), leaves(fine, fine.root, blocks = false))
      assert(few.sum == spheres.length && many.sum == spheres.length)
      assert(few.max == 8 && few.size * 3 < many.size && many.max <= 4)
      assert(leaves(coarse, coarse.root, blocks = true).sum == soup.count)
      assert(coarse.blockCount == fine.blockCount)

  test("blocks of a mesh's triangles are nearly full"):
    val mesh = Primitives(Soups.icosphere(4, Transform.translate(0f, 0f, 0f)), Array.empty)
    for lanes <- Seq(4, 8) do
      val tree = WideBuilder.of(mesh, 16, lanes, 4, Parallel.Alone)
      val full = mesh.count.toDouble / (tree.blockCount * lanes)
      assert(full > 0.75 && full <= 1.0, s"$lanes lanes")
