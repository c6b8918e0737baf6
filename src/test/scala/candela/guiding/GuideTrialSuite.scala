package candela.guiding

import org.scalatest.funsuite.AnyFunSuite

class GuideTrialSuite extends AnyFunSuite:
  import GuideTrialSuite.*

  private def guide(learnsOn: Boolean = false, settings: GuideSettings = Usual) =
    val guide = Guide(settings.copy(learnsOn = learnsOn), planned = 64, pixels = Pixels)
    val _ = pass(guide, until = 1, left = 1.0)
    guide

  test("guiding is given up after one pass that leaves all of the variance"):
    val trial = guide()
    val _ = pass(trial, until = 2, left = 1.1)
    assert(trial.outcome.gaveUp && !trial.pass.field.guides)

  test("guiding is given up after two passes that leave most of it"):
    val trial = guide()
    val _ = pass(trial, until = 2, left = 0.8)
    assert(!trial.outcome.gaveUp && trial.pass.fraction < 1f)
    val _ = pass(trial, until = 4, left = 0.8)
    assert(trial.outcome.gaveUp && trial.pass.fraction == 0f)

  test("all paths are guided after one pass that leaves little, or two that leave enough less"):
    val clear = guide()
    val _ = pass(clear, until = 2, left = 0.4)
    assert(clear.pass.fraction == 1f)
    val close = guide()
    val _ = pass(close, until = 2, left = 0.61)
    assert(!close.outcome.gaveUp && close.pass.fraction < 1f)
    val _ = pass(close, until = 4, left = 0.61)
    assert(close.pass.fraction == 1f)

  test("regions are judged before they are fitted as after"):
    def growth() =
      val records = GuideRecords(1f, GuideFieldSuite.learnt.regions)
      record(records.newPart(), left = 0.7)
      GuideFieldSuite.growth(GuideFieldSuite.learnt, records.sorted(), Usual)
    val (before, after) = (growth(), growth())
    val judged = before.judged()
    for made <- Vector(before, after) do assert(GuideLearning(made).help(() => (), () => false))
    assert(judged == after.verdict && judged == before.verdict && judged.paths > 10000)
    assert(before.result().lobes sameElements after.result().lobes)
    assert(before.result().bsdfProbabilities sameElements after.result().bsdfProbabilities)

  test("until it is certain that guiding pays, mixtures are fitted to fewer events"):
    // Regions of many events
    val settings = Usual.copy(perRegion = 8.0)
    def check(left: Double, isRough: Boolean): Unit =
      val trial = guide(settings = settings)
      val before = trial.pass
      val paths = (Pixels * before.fraction).toInt
      val _ = pass(trial, until = 2, left)
      for fitsRoughly <- Vector(false, true) do
        val records = GuideRecords(1f, before.field.regions)
        record(records.newPart(), left, paths)
        val made = GuideFieldSuite.growth(before.field, records.sorted(), settings)
        if fitsRoughly then made.fitRoughly()
        assert(GuideLearning(made).help(() => (), () => false))
        val isSame = made.result().lobes.sameElements(trial.pass.field.lobes)
        assert(isSame == (fitsRoughly == isRough), s"$left of the variance, $fitsRoughly")
    check(left = 0.8, isRough = true)
    check(left = 0.4, isRough = false)

  test("nothing is fitted where guiding is given up"):
    def fitted(left: Double) =
      val trial = guide()
      val regions = pass(trial, until = 2, left)
      (regions, trial.outcome.gaveUp)
    assert(fitted(left = 1.1) == (0, true))
    val (regions, gaveUp) = fitted(left = 0.8)
    assert(regions > 0 && !gaveUp)

  test("guiding is given up after it was certain, too"):
    val trial = guide(learnsOn = true)
    val _ = pass(trial, until = 2, left = 0.5)
    val _ = pass(trial, until = 4, left = 0.82)
    assert(trial.pass.fraction == 1f && !trial.outcome.gaveUp)
    val _ = pass(trial, until = 8, left = 0.82)
    assert(trial.outcome.gaveUp && trial.pass.fraction == 0f)

private object GuideTrialSuite:
  val Pixels = 300000
  val Usual: GuideSettings = GuideSettings(adapts = true)

  /** Light of each second path. */
  private val Bright = 5f

  /** Records a pass that ends before this sample.
    *
    * @param left part of the variance that guiding leaves
    * @return regions that are fitted then
    */
  def pass(guide: Guide, until: Int, left: Double): Int =
    val now = guide.pass
    val paths = (Pixels * (until - now.begun) * now.fraction).toInt
    val part = now.newPart()
    assert(part != null)
    record(part.nn, left, paths)
    var fitted = 0
    assert(guide.beginSample(until, moves = () => fitted += 1))
    fitted

  /** Paths of one event, with the light 1 or [[Bright]], in places that do not depend on it. */
  def record(part: GuideRecords.Part, left: Double, paths: Int = 40000): Unit =
    val mean = (1f + Bright) / 2
    val variance = (1f + Bright * Bright) / 2 - mean * mean
    for i <- 0 until paths do
      val event = GuideFieldSuite.event(i)
      val light = if i % 4 < 2 then 1f else Bright
      // The field would have been better in each region
      event(GuideRecords.GuidePdf) = 2f
      event(GuideRecords.Total) = light
      event(GuideRecords.Unguided) = light * light + (variance * (1 / left - 1)).toFloat
      part.countPath(3)
      part.add(event)
