package candela.scene

import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

final class CastersSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  private val weights = Gen.nonEmptyListOf(Gen.choose(0.0, 9.0)).map(_.toArray)
  private val unit = Gen.choose(0.0, 1.0)

  test("an aim's density over any part is the probability that a place of it is sampled"):
    forAll(weights, unit, unit): (weights, x, y) =>
      val aim = CasterAim(weights, even = 0.25)
      val (from, to) = (Math.min(x, y), Math.max(x, y))
      val count = 4000
      val within = (0 until count).count: i =>
        val place = aim.warp((i + 0.5) / count)
        place >= from && place < to
      // Of evenly spread numbers at most one is on the wrong side of each end
      assert(Math.abs(within.toDouble / count - aim.density(from, to) * (to - from)) <= 2.0 / count)

  test("every place can be sampled, whatever the weights"):
    forAll(weights, unit): (weights, x) =>
      assert(CasterAim(weights, even = 0.25).density(x, x + 1e-3) > 0.24)

  test("places are sampled evenly where nothing has weight"):
    val aim = CasterAim(Array(0.0, 0.0), even = 0.5)
    forAll(unit)(x => assert(aim.warp(x) == x))
