package candela.bidirectional

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
      blocks.addSaving(x, y, random.nextDouble())
      val light = random.nextDouble()
      blocks.addSplat(x.toFloat, y.toFloat, light, 3 * light, light, light * light)
    blocks

  test("parts that are put together are the whole"):
    val whole = found(0, 3000)
    val parts = PilotBlocks(view)
    for i <- 0 until 3 do parts.add(found(1000 * i, 1000 * (i + 1)))
    val pairs =
      whole.variances(3000).toList.zip(parts.variances(3000).toList) ++
        whole.savings().toList.zip(parts.savings().toList)
    for case (a: Double, b: Double) <- pairs do assert(Math.abs(a - b) < 1e-9 * Math.abs(a), (a, b))

  test("twice as many light paths that find the same tell the same variance"):
    val once = found(0, 1000)
    val twice = PilotBlocks(view)
    for _ <- 0 until 2 do twice.add(found(0, 1000))
    val (_, more, byLight) = once.variances(1000)
    val (_, moreOfTwice, byLightOfTwice) = twice.variances(2000)
    assert(Math.abs(more - moreOfTwice) < 1e-9 * more)
    assert(Math.abs(byLight - byLightOfTwice) < 1e-9 * byLight)
