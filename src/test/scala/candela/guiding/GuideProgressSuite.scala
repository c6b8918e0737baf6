package candela.guiding

import candela.base.CheckedFile

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class GuideProgressSuite extends AnyFunSuite:
  private def verdict(
      guided: Double,
      unguided: Double,
      paths: Long = 20000L,
      cost: Double = 3.0
  ) = GuideVerdict(paths, guided * paths, unguided * paths, cost)

  private val start = GuideProgress(cost = 3.0)

  test("samples count as the inverse of their variance, to a power of two, where guiding paid"):
    def weight(noises: (Double, Double)*): Float =
      noises.foldLeft(start)((p, n) => p.after(verdict(n._1, n._2))).weight
    assert(weight() == 1f)
    // It does not pay
    assert(weight(0.9 -> 1.0) == 1f)
    assert(weight(0.72 -> 1.0) == 1f)
    assert(weight(0.68 -> 1.0) == 2f)
    assert(weight(0.5 -> 1.0) == 2f)
    assert(weight(3.0 -> 12.0) == 4f)
    // What the first pass that paid says of unguided paths holds: it is of the same light
    assert(weight(0.9 -> 7.0, 0.5 -> 1.0) == 16f)
    assert(weight(0.9 -> 1.0, 0.5 -> 1.0, 0.3 -> 5.0) == 4f)

  test("guiding pays by the variance that it leaves, and by what branches cost"):
    def pays(left: Double, effort: Double) = start.after(verdict(left, 1.0, cost = 3 * effort)).pays
    assert(!start.pays)
    assert(pays(0.68, 1.0) && !pays(0.72, 1.0) && !pays(0.72, 0.5))
    assert(pays(0.5, 2.1) && !pays(0.5, 2.3))
    // Doubts are forgotten when it pays
    val doubtful = start.after(verdict(0.9, 1.0)).after(verdict(0.9, 1.0))
    assert(doubtful.doubts == 2 && doubtful.after(verdict(0.3, 1.0)).doubts == 0)

  test("learning has settled where a pass brings less than two percent for the time"):
    def isSettled(noise: Double, cost: Double, before: Double = 0.4, paths: Long = 20000L) =
      start.after(verdict(before, 1.0, cost = 3.0)).isSettledBy(verdict(noise, 1.0, paths, cost))
    assert(!isSettled(0.38, cost = 3.0) && isSettled(0.395, cost = 3.0))
    // Fewer rays are as good as less noise
    assert(!isSettled(0.4, cost = 2.8 * 1.25, before = 0.5) && isSettled(0.38, cost = 3.3))
    // What does not pay may still come to
    assert(!isSettled(0.395, cost = 3.0, before = 0.9) && !isSettled(0.9, cost = 3.0))
    assert(!isSettled(0.395, cost = 3.0, paths = 100L))

  test("no sample counts without bounds, nor less than the first"):
    assert(start.after(verdict(0.0, 1.0)).weight == 32f)
    assert(start.after(verdict(0.5, 1.0)).after(verdict(9.0, 20.0)).weight == 1f)

  test("a pass of few paths says nothing"):
    assert(start.after(verdict(0.1, 1.0, paths = 100L)) == start)

  test("it is read as it was written"):
    val file = Files.createTempFile("candela-progress", "")
    for progress <- Vector(start, start.after(verdict(0.5, 1.0)), start.after(verdict(2.0, 1.0))) do
      CheckedFile.write(file, "progress")(progress.save)
      assert(CheckedFile.read(file, "progress")(GuideProgress.load) == progress)
    Files.delete(file)
