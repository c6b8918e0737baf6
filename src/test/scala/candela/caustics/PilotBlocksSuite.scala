package candela.caustics

import candela.film.{BoxFilter, PixelBounds, Splats, View}
import candela.scenefile.Dialect
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Random

class PilotBlocksSuite extends AnyFunSuite:
  private val camera = SceneTexts.plan("Camera \"perspective\" WorldBegin", Dialect.V4).camera
  private val (width, height) = (30, 20)
  private val view = View(
    camera,
    Splats.Discarded,
    width,
    height,
    PixelBounds(0, 0, width, height),
    BoxFilter(0.5f, 0.5f),
    1,
    None,
    0f
  )

  /** What the paths from `from` to `until` find. */
  private def found(from: Int, until: Int): PilotBlocks =
    val blocks = PilotBlocks(view)
    for k <- from until until do
      val random = Random(k)
      val (x, y) = (random.nextInt(width), random.nextInt(height))
      blocks.addPair(x, y, random.nextFloat(), random.nextFloat())
      val light = random.nextDouble()
      blocks.addSplat(x.toFloat, y.toFloat, light, 3 * light, 1 + random.nextInt(1 << 20))
    blocks

  test("parts that are put together are the whole"):
    val whole = found(0, 3000)
    val parts = PilotBlocks(view)
    for i <- 0 until 3 do parts.add(found(1000 * i, 1000 * (i + 1)))
    def all(blocks: PilotBlocks) =
      val found = blocks.variances(3000, PilotBlocks.EndlessSamples)
      Vector(found.byPaths, found.excess, found.byLight)
    for (a, b) <- all(whole).zip(all(parts)) do
      assert(Math.abs(a - b) < 1e-9 * Math.abs(a), (a, b))

  test("twice as many light paths that find the same tell the same variance"):
    val once = found(0, 1000)
    val twice = PilotBlocks(view)
    for _ <- 0 until 2 do twice.add(found(0, 1000))
    val (of, ofTwice) = (
      once.variances(1000, PilotBlocks.UsualSamples),
      twice.variances(2000, PilotBlocks.UsualSamples)
    )
    assert(Math.abs(of.excess - ofTwice.excess) < 1e-9 * of.excess)
    assert(Math.abs(of.byLight - ofTwice.byLight) < 1e-9 * of.byLight)

  test("light that is seldom found counts no more than if it was missing"):
    /** Even light, and a hundredth of it that the camera's paths find once in `seldom` samples. */
    def more(seldom: Double, usual: Double = PilotBlocks.UsualSamples): Double =
      val blocks = PilotBlocks(view)
      for x <- 0 until width; y <- 0 until height do
        blocks.addPair(x, y, 1f, 1f)
        val light = 0.01
        blocks.addSplat(x.toFloat, y.toFloat, light, light, seldom)
      blocks.variances(width * height, usual).excess / (width * height)
    // Relative variance of a sample: the light times its brightness where it is found
    assert(Math.abs(more(1e3) - 0.01 * 0.01 * 1e3) < 0.01)
    assert(Math.abs(more(1e4) - 0.01 * 0.01 * 1e4) < 0.1)
    assert(Math.abs(more(1e7, PilotBlocks.EndlessSamples) - 0.01 * 0.01 * 1e7) < 100)
    for seldom <- Seq(1e6, 1e8) do
      assert(Math.abs(more(seldom) - PilotBlocks.UsualSamples * 0.01 * 0.01) < 0.1)
