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
    assert(weight(0.67 -> 1.0) == 1f)
    assert(weight(0.65 -> 1.0) == 2f)
    assert(weight(0.5 -> 1.0) == 2f)
    assert(weight(3.0 -> 12.0) == 4f)
    // What the first pass that paid says of unguided paths holds: it is of the same light
    assert(weight(0.9 -> 7.0, 0.5 -> 1.0) == 16f)
    assert(weight(0.9 -> 1.0, 0.5 -> 1.0, 0.3 -> 5.0) == 4f)

  test("guiding pays by the variance that it leaves, and by what branches cost"):
    def pays(left: Double, effort: Double) = start.after(verdict(left, 1.0, cost = 3 * effort)).pays
    assert(!start.pays)
    assert(pays(0.65, 1.0) && !pays(0.67, 1.0) && !pays(0.67, 0.5))
    assert(pays(0.5, 2.1) && !pays(0.5, 2.3))
    // Doubts are forgotten when it clearly pays, or twice
    val doubtful = start.after(verdict(0.9, 1.0)).after(verdict(0.9, 1.0))
    assert(doubtful.doubts == 2 && doubtful.after(verdict(0.3, 1.0)).doubts == 0)
    val unclear = doubtful.after(verdict(0.61, 1.0))
    assert(unclear.doubts == 2 && unclear.after(verdict(0.61, 1.0)).doubts == 0)
    // What leaves all of the variance says as much as two passes
    assert(start.after(verdict(1.01, 1.0)).doubts == 2)
    // … and what does not pay on average with what paid before, but not clearly
    assert(start.after(verdict(0.61, 1.0)).after(verdict(0.8, 1.0)).doubts == 2)
    assert(start.after(verdict(0.61, 1.0)).after(verdict(0.68, 1.0)).isCertain)
    assert(start.after(verdict(0.4, 1.0)).after(verdict(0.8, 1.0)).doubts == 1)
    // … which is of what branches cost, too
    def afterCostly(left: Double, effort: Double) =
      start.after(verdict(0.3, 1.0, cost = 3 * 3.5)).after(verdict(left, 1.0, cost = 3 * effort))
    assert(!afterCostly(0.9, 1.2).pays && afterCostly(0.3, 3.4).isCertain)
    // After it was certain, no single pass says it for good
    val certain = start.after(verdict(0.4, 1.0)).after(verdict(0.4, 1.0))
    assert(certain.after(verdict(1.1, 1.0)).doubts == 1)

  test("all paths are guided when guiding has clearly paid once, or twice one after the other"):
    def certain(lefts: Double*) =
      lefts.foldLeft(start)((p, l) => p.after(verdict(l, 1.0))).isCertain
    assert(!certain() && !certain(0.61) && certain(0.58))
    assert(certain(0.61, 0.61) && !certain(0.61, 0.8, 0.61) && !certain(0.4, 0.8))
    // What branches cost counts, too
    assert(!start.after(verdict(0.5, 1.0, cost = 3 * 2.15)).isCertain)
    // A pass of few paths is no second one
    assert(!start.after(verdict(0.61, 1.0)).after(verdict(0.61, 1.0, paths = 100L)).isCertain)

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
    val few = verdict(0.1, 1.0, paths = 100L)
    assert(start.after(few).after(few) == start)
    val certain = start.after(verdict(0.4, 1.0))
    assert(certain.after(few).after(few) == certain)

  test("two passes of few paths are a doubt where it was certain, but is no more"):
    val few = verdict(0.1, 1.0, paths = 100L)
    val doubtful = start.after(verdict(0.4, 1.0)).after(verdict(0.8, 1.0))
    assert(doubtful.after(few).doubts == 1 && doubtful.after(few).after(few).doubts == 2)
    // In a row
    val between = doubtful.after(few).after(verdict(0.61, 1.0)).after(few)
    assert(between.doubts == 1 && between.pays)
    assert(between.after(few).doubts == 2 && !between.after(few).pays)

  test("it is read as it was written"):
    val file = Files.createTempFile("candela-progress", "")
    val twice = start.after(verdict(0.5, 1.0)).after(verdict(0.5, 1.0))
    val silent = start.after(verdict(0.3, 1.0)).after(verdict(0.8, 1.0, cost = 4.0))
      .after(verdict(0.1, 1.0, paths = 100L))
    assert(silent.sure && silent.silent == 1)
    for progress <- Vector(start, twice, start.after(verdict(2.0, 1.0)), silent) do
      CheckedFile.write(file, "progress")(progress.save)
      assert(CheckedFile.read(file, "progress")(GuideProgress.load) == progress)
    Files.delete(file)
