package candela.bench.report

import candela.report.{Machine, Numbers}
import org.scalatest.funsuite.AnyFunSuite

class RobustnessTextSuite extends AnyFunSuite:
  private val machine = Machine("a processor", 2, 1L << 30, "a system", "a JVM 17", None)
  private val programs =
    Vector(RobustProgram("own", "Candela", isOurs = true), RobustProgram("b", "Other", false))

  private def report(own: Robust, why: Option[String] = None): RobustnessReport =
    val counted = RobustRow("a ball", Map("own" -> own, "b" -> Robust.Counted(12, 100_000)), why)
    val mean = RobustRow("a floor", Map("b" -> Robust.Mean(0.25, 1e-3, 0.5, 0.01)))
    val groups = Vector(
      RobustGroup("leaks", "Leaks", 1e9, "Rays in balls.", Vector(counted)),
      RobustGroup("scenes", "Scenes", 0, "Floors.", Vector(mean))
    )
    RobustnessReport(
      "1.0",
      machine,
      "2026-01-01 10:00",
      60,
      100_000,
      "candela robustness",
      programs,
      groups,
      Vector("Embree" -> "not there")
    )

  private val none = Robust.Counted(0, 1_000_000)

  test("counts have three digits, and powers of ten none"):
    val texts = Vector(9999L, 99_999L, 100_000L, 25_000_000L, 99_856L, 2_083L).map(Numbers.count)
    assert(texts == Vector("9999", "10⁵", "10⁵", "2.5·10⁷", "9.99·10⁴", "2083"))

  test("a mean is faulty if it is off by more than is allowed and more than its noise"):
    assert(!Robust.Mean(0.504, 0, 0.5, 0.01).isFaulty)
    assert(Robust.Mean(0.506, 0, 0.5, 0.01).isFaulty)
    assert(!Robust.Mean(0.506, 1e-3, 0.5, 0.01).isFaulty)
    assert(Robust.Mean(Double.NaN, 1e-3, 0.5, 0.01).isFaulty)

  test("Markdown has a table for each kind of fault, with the faults in bold"):
    val lines = RobustnessText.markdown(report(none)).linesIterator.toVector
    assert(lines.contains("| Leaks, per 10⁹ | Candela | Other |"))
    assert(lines.contains("| a ball | 0 of 10⁶ (≤ 2996) | **12 of 10⁵ (≤ 1.9·10⁵)** |"))
    assert(lines.contains("| a floor | 0.5000 | **0.2500** |"))
    assert(lines.contains("- Embree: not there"))

  test("a fault of Candela breaks its promise, unless the row tells the reason"):
    assert(report(none).broken.isEmpty)
    val faulty = Robust.Counted(1, 1_000_000, Some("from here"))
    assert(report(faulty).broken.map(_._2.what) == Vector("a ball"))
    val known = report(faulty, Some("as others have it"))
    assert(known.broken.isEmpty)
    assert(RobustnessText.markdown(known).contains("a ball: as others have it"))
    val page = RobustnessPage.html(report(faulty))
    assert(page.contains("Candela is not as promised: Leaks: a ball"))

  test("JSON has each count with its rate and bound, and each mean with what is expected"):
    val all = ujson.read(RobustnessData.json(report(none)))
    val Seq(leaks, scenes) = all("groups").arr.toSeq: @unchecked
    val cell = leaks("rows")(0)("cells")("b")
    assert(cell("faults").num == 12 && cell("rate").num == 120000 && cell("faulty").bool)
    assert(scenes("rows")(0)("cells")("b")("expected").num == 0.5)
    assert(all("kept").bool && all("programs")(0)("ours").bool)
