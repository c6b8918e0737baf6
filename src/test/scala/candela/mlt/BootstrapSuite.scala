package candela.mlt

import java.util.concurrent.atomic.LongAdder

import org.scalatest.funsuite.AnyFunSuite

import candela.render.ThreadPool
import candela.sampling.SampleHash

final class BootstrapSuite extends AnyFunSuite:

  private def uniform(path: Int): Float = SampleHash.toUnit(SampleHash.mix64(path).toInt)

  /** One path in fifty brings all the light: σ/μ is 7. */
  private def rare(path: Int): Float = if uniform(path) < 0.02f then 50f else 0f

  private def run(asked: Int, mutations: Long, helpers: Int = 1)(
      strength: Int => Float
  ): (Bootstrap.Start, Long) =
    val bootstrap = Bootstrap(asked, mutations)
    val count = LongAdder()
    ThreadPool(helpers).forEach(helpers): _ =>
      bootstrap.help(() => false): path =>
        count.increment()
        strength(path)
    (bootstrap.start.get, count.sum)

  test("paths are drawn until the brightness has a standard error of 0.3 %"):
    val (start, count) = run(asked = 1000, mutations = 100_000_000)(rare)
    // 49 / 0.003² = 5.4 million; rounds double up to a million each
    assert(count > 5_000_000 && count < 8_000_000)
    assert(Math.abs(start.mean - 1) < 4.5 * 0.003)

  test("where all paths are alike, those that were asked for suffice"):
    assert(run(asked = 1000, mutations = 100_000_000)(_ => 2f)._2 == 1000)

  test("a few that are alike by chance are not trusted"):
    assert(run(asked = 2, mutations = 100_000)(path => if path < 40 then 1f else 2f)._2 > 1000)

  test("they are as many as all mutations at most, but as many as asked for"):
    assert(run(asked = 1000, mutations = 10_000)(rare)._2 == 10_000)
    assert(run(asked = 1000, mutations = 400)(rare)._2 == 1000)
    val (dark, count) = run(asked = 1000, mutations = 10_000)(_ => 0f)
    assert(count == 10_000 && dark.mean == 0f)

  test("chains start where light is, be it found late"):
    for strength <- Seq(rare, (path: Int) => if path < 5000 then 0f else rare(path)) do
      val (start, _) = run(asked = 1000, mutations = 10_000)(strength)
      for u <- Seq(0f, 0.3f, 0.6f, 0.999f) do assert(strength(start.path(u)) > 0f)

  test("the result does not depend on how many help"):
    def found(helpers: Int) =
      val (start, count) = run(asked = 1000, mutations = 400_000, helpers)(rare)
      (start.mean, start.path(0.5f), count)
    assert(found(1) == found(4))

  test("who is told to stop does so, and a failure is everyone's"):
    val stopped = Bootstrap(1000, 10_000)
    stopped.help(() => true)(rare)
    assert(stopped.start.isEmpty)
    val broken = Bootstrap(1000, 10_000)
    val bug = ArithmeticException("planted")
    assert(intercept[ArithmeticException](broken.help(() => false)(_ => throw bug)) eq bug)
    assert(intercept[ArithmeticException](broken.help(() => false)(rare)) eq bug)
