package candela.guiding

import candela.io.CheckedFile
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

  /** After passes that leave these parts of the variance. */
  private def after(lefts: Double*): GuideProgress =
    lefts.foldLeft(start)((p, l) => p.after(verdict(l, 1.0)))

  test("guiding pays by the variance that it leaves, and by what branches cost"):
    def pays(left: Double, effort: Double) =
      start.after(verdict(left, 1.0, cost = 3 * effort)).isWorthwhile
    assert(!start.isWorthwhile)
    assert(pays(0.65, 1.0) && !pays(0.67, 1.0) && !pays(0.67, 0.5))
    assert(pays(0.5, 2.1) && !pays(0.5, 2.3))

  test("one pass decides if it is clear, else the mean of two"):
    def certain(lefts: Double*) = after(lefts*).isCertain
    assert(!certain() && !certain(0.61) && certain(0.58))
    assert(certain(0.61, 0.61) && certain(0.61, 0.68) && !certain(0.61, 0.8))
    // What branches cost counts, too
    assert(!start.after(verdict(0.5, 1.0, cost = 3 * 2.15)).isCertain)
    def givesUp(lefts: Double*) = after(lefts*).givesUp(isLast = false)
    assert(!givesUp() && !givesUp(0.8) && givesUp(1.01))
    assert(givesUp(0.8, 0.8) && givesUp(0.61, 0.8) && !givesUp(0.8, 0.5))
    // The last field guides all paths, or none
    assert(after(0.8).givesUp(isLast = true) && !after(0.61).givesUp(isLast = true))

  test("where it was certain, a single pass gives it up only if it did not bring much before"):
    assert(after(0.4, 0.8).isCertain && after(0.2, 0.2, 1.1).isCertain)
    val worse = after(0.4, 0.8, 0.8)
    assert(!worse.isWorthwhile && worse.givesUp(isLast = false))

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

  test("it is read as it was written"):
    val file = Files.createTempFile("candela-progress", "")
    val costly = after(0.3).after(verdict(0.8, 1.0, cost = 4.0))
    for progress <- Vector(start, after(0.5, 0.5), after(2.0).copy(gaveUp = true), costly) do
      CheckedFile.write(file, "progress")(progress.save)
      assert(CheckedFile.read(file, "progress")(GuideProgress.load) == progress)
    Files.delete(file)
