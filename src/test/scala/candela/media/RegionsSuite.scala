package candela.media

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.geometry.{Bounds3, Ray}
import candela.math.*
import candela.sampling.HenyeyGreenstein

final class RegionsSuite extends AnyFunSuite:
  private val phase = HenyeyGreenstein(0f)
  private val box = Bounds3(Vec3.Zero, Vec3(1f, 2f, 1f))
  private val moved = Transform.translate(3, 0, 0)

  private def uniform(s: Float, g: Float = 0f) =
    UniformRegion(moved, box, Filling(Rgb.Black, Rgb.gray(s), Rgb.White, HenyeyGreenstein(g)))

  private def depth(regions: Regions, from: Vec3, to: Vec3, step: Float): Float =
    val work = regions.newWork()
    val ray = Ray()
    val unit = (to - from).length
    ray.set(from, to - from, 1f)
    // All offsets of the samples alike
    val n = 200
    for i <- 0 until n do regions.addDepth(ray, 0f, 1f, unit, step, (i + 0.5f) / n, work)
    work.depthG / n

  test("the depth of a uniform box is exact, whatever the step"):
    val found = depth(Regions(Array(uniform(2f))), Vec3(0f, 1f, 0.5f), Vec3(9f, 1f, 0.5f), 5f)
    // 200 Floats are added: 200 · 6e-8 of the sum
    assert(Math.abs(found - 2f) < 1e-4f)

  test("depths of boxes that overlap add up"):
    val both = Regions(Array(uniform(2f), uniform(0.5f)))
    val found = depth(both, Vec3(3.5f, 1f, 0.5f), Vec3(9f, 1f, 0.5f), 1f)
    // As above, 400 Floats
    assert(Math.abs(found - 0.5f * 2.5f) < 1e-4f)

  test("the exponential medium's depth is the integral of its density"):
    val filling = Filling(Rgb.Black, Rgb.White, Rgb.Black, phase)
    val region = ExponentialRegion(moved, box, filling, Vec3.Y, ground = 3f, fall = 1.5f)
    // Straight up through the box, in steps whose offsets are all taken: unbiased
    val found = depth(Regions(Array(region)), Vec3(3.5f, -1f, 0.5f), Vec3(3.5f, 5f, 0.5f), 0.1f)
    val expected = 3.0 / 1.5 * (1 - Math.exp(-3))
    assert(Math.abs(found - expected) < 2e-3, s"$found, expected $expected")

  test("a grid of v2 goes on as it ends"):
    val grid = SampledGrid(2, 1, 1, Array(1f, 3f), GridEdge.Clamped)
    val region = GridRegion(moved, box, Filling(Rgb.White, Rgb.Black, Rgb.Black, phase), grid)
    def at(x: Float) = region.densityAt(Vec3(3f + x, 1f, 0.5f))
    assert(at(0.01f) == 1f && at(0.25f) == 1f && Math.abs(at(0.5f) - 2f) < 1e-5f)
    assert(at(0.9f) == 3f && at(1.1f) == 0f)

  test("where media overlap, phase functions count by what they scatter"):
    val regions = Regions(Array(uniform(3f, g = 0.5f), uniform(1f, g = -0.5f)))
    val work = regions.newWork()
    regions.evaluate(Vec3(3.5f, 1f, 0.5f), work)
    val expected = 0.75f * HenyeyGreenstein.value(1f, 0.5f) +
      0.25f * HenyeyGreenstein.value(1f, -0.5f)
    assert(Math.abs(regions.phase(Vec3.Z, Vec3.Z, work) - expected) < 1e-6f)
    assert(Math.abs(work.scatterG - 4f) < 1e-5f && work.glowG == 2f)

  test("a way that misses all boxes is no way through them"):
    val regions = Regions(Array(uniform(1f)))
    val ray = Ray()
    ray.set(Vec3(0f, 5f, 0.5f), Vec3.X, Float.PositiveInfinity)
    assert(!regions.clip(ray, regions.newWork()))
