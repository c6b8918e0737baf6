package candela.guiding

import candela.math.*
import candela.sampling.{IndependentSampler, SampleHash}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class GuideFieldSuite extends AnyFunSuite:
  import GuideFieldSuite.*

  test("space is divided, and every point is in one region of its side"):
    assert(learnt.regions > 8)
    val up = (0 until 64).map(i => region(place(i), Up)).distinct
    assert(up.size > 4)
    assert(!up.contains(region(place(0), Vec3(1f, 0f, 0f))))
    assert(region(Vec3(-100f, -100f, 0f), Up) == region(Vec3(-1f, -1f, 0f), Up))

  test("the density of directions is that of its samples, and all of it is one"):
    val mixture = GuideMixture()
    val p = place(0)
    mixture.locate(learnt, region(p, Up), p)
    MixtureDensity.check(mixture.pdf, mixture.sample)

  test("from all places of a region, a near light is seen where it is"):
    val mixture = GuideMixture()
    val densities =
      for i <- 0 until 64 yield
        val p = place(i)
        mixture.locate(learnt, region(p, Up), p)
        mixture.pdf((Light - p).normalized)
    // A uniform density is 0.08
    assert(densities.min > 5f, densities)

  test("what is given up while it is learnt is learnt later"):
    def guide(): Guide =
      val made = Guide(GuideSettings(adapts = false, perRegion = 5.0), 64, 10000)
      val part = made.pass.newPart().nn
      for i <- 0 until 10000 do part.add(event(i))
      made
    val (halted, whole) = (guide(), guide())
    assert(whole.beginSample(1) && whole.pass.field.regions > 8)
    // Before the first region, and after the third
    for most <- Vector(0, 3) do
      var regions = 0
      assert(!halted.beginSample(1, () => regions += 1, () => regions >= most))
      assert(halted.pass.begun == 0 && regions == most)
    assert(halted.beginSample(1) && halted.pass.field.regions == whole.pass.field.regions)
    assert(halted.pass.field.lobes.sameElements(whole.pass.field.lobes))

  test("exponentials are exact to five digits"):
    for i <- 0 to 2000 do
      val x = -0.02f * i
      // The series of `Lobe.exp` is right to five digits
      assert(Math.abs(Lobe.exp(x) / Math.exp(x) - 1.0) < 5e-6, x)

  test("what is recorded is the same in any order, by any number of workers"):
    def sorted(order: Seq[Int], workers: Int) =
      val records = GuideRecords(rate = 1f, regions = GuideField.Start.regions)
      val parts = Vector.fill(workers)(records.newPart())
      for (i, j) <- order.zipWithIndex do parts(j % workers).add(event(i))
      val events = records.sorted()
      events.numbers.toVector.take(events.count * GuideRecords.Size)
    val one = sorted(0 until 10000, 1)
    assert(one.length / GuideRecords.Size == 10000)
    assert(one.grouped(GuideRecords.Size).toSet == (0 until 10000).map(event(_).toVector).toSet)
    assert(sorted((0 until 10000).reverse, 3) == one)

  test("no event is lost or doubled, however often events are sorted", Slow):
    val memory = GuideMemory()
    val expected = (0 until 3000).map(event(_).toVector).toSet
    for round <- 0 until 400 do
      val records = GuideRecords(1f, GuideField.Start.regions, memory)
      val parts = Vector.fill(2)(records.newPart())
      for i <- 0 until 3000 do parts((i * (round + 1) >> 4) % 2).add(event(i))
      val events = records.sorted()
      records.release()
      val found = events.numbers.iterator.take(3000 * GuideRecords.Size).grouped(GuideRecords.Size)
      assert(found.map(_.toVector).toSet == expected, s"in round $round")

  test("passes use the same memory one after the other"):
    val memory = GuideMemory()
    def pass(count: Int, memory: GuideMemory, workers: Int) =
      val records = GuideRecords(1f, GuideField.Start.regions, memory)
      val parts = Vector.fill(workers)(records.newPart())
      for i <- 0 until count do parts(i % workers).add(event(i))
      val events = records.sorted()
      records.release()
      events
    def numbers(events: GuideEvents) =
      events.numbers.toVector.take(events.count * GuideRecords.Size)
    val first = pass(5000, memory, workers = 3)
    val second = pass(2000, memory, workers = 2)
    assert(second.numbers eq first.numbers)
    assert(numbers(second) == numbers(pass(2000, GuideMemory(), workers = 1)))
    assert(pass(8000, memory, workers = 3).count == 8000)

  test("a part of the paths is guided, and a part of these records, with any camera"):
    def chosen(origin: Int => Vec3, direction: Int => Vec3) =
      val records = GuideRecords(rate = 0.25f, regions = GuideField.Start.regions)
      val pass = Guide.Pass(GuideField.Start, begun = 1, fraction = 0.4f, records)
      val guided = (0 until 10000).filter(i => pass.includes(origin(i), direction(i)))
      val learning = guided.filter(i => pass.learnsFrom(origin(i), direction(i)))
      // Deviations of 49 and 30
      assert(Math.abs(guided.length - 4000) < 250)
      assert(Math.abs(learning.length - 1000) < 150)
    def number(i: Int) = SampleHash.toUnit(SampleHash.mix(i))
    def vector(i: Int) = Vec3(number(3 * i), number(3 * i + 1), number(3 * i + 2))
    chosen(_ => Vec3.Zero, vector)
    chosen(vector, _ => Vec3.Z)

  test("a region knows the mean light of all its events, and of the paths that begin there"):
    val settings = GuideSettings(adapts = false, perRegion = 1e6)
    val records = GuideRecords(1f, GuideField.Start.regions)
    val (one, other) = (records.newPart(), records.newPart())
    for i <- 0 until 10000 do
      val found = event(i)
      // Each second one is the first of its path, which had found 3 before
      if i % 2 == 0 then
        found(GuideRecords.Total) = found(GuideRecords.Light) + 3f
        found(GuideRecords.EarlierLight) = 3f
      (if i % 3 == 0 then one else other).add(found)
    for i <- 0 until 40000 do (if i % 3 == 0 then one else other).countEvent(GuideField.side(Up))
    val counts = records.counts
    assert(counts(GuideField.side(Up)) == 40000 && counts.sum == 40000)
    val growth = grown(GuideField.Start, records.sorted(), settings, everything = 40000f)
    val field = growth.result()
    val region = GuideMixture().region(field, Vec3.Zero, GuideField.side(Up))
    assert(Math.abs(field.measurements(region) - (1.05f / 4 + 3f)) < 0.01f)
    // The second moment of numbers between 1 and 1.1, where one of four is not 0
    val moment = (1.331 - 1.0) / 0.3 / 4
    val factor = Math.sqrt(moment / EventCost / (growth.verdict.noise / PathCost))
    assert(Math.abs(field.splittingFactors(region) / factor - 1) < 0.005)

private object GuideFieldSuite:
  val EventCost = 3f
  val PathCost = 7.0
  val Up: Vec3 = Vec3(0f, 0f, 1f)

  /** Above the middle of a square floor. */
  val Light: Vec3 = Vec3(0.1f, 0f, 0.7f)

  private def random(i: Int, pass: Int = 0): (Float, Float) =
    // Suites run at the same time
    val sampler = IndependentSampler(1 << 20, 7)
    sampler.start(pass, 0, i)
    sampler.next2D()
    (sampler.x, sampler.y)

  def place(i: Int): Vec3 =
    val (x, y) = random(i)
    Vec3(2f * x - 1f, 2f * y - 1f, 0f)

  /** Half of the light comes from around [[Light]], half from anywhere above. */
  def event(i: Int): Array[Float] =
    val p = place(i)
    val (u, v) = random(i, pass = 1)
    val near = Light + Vec3(0.05f * u, 0.05f * v, 0f) - p
    val wide = Vec3(u - 0.5f, v - 0.5f, 0.5f)
    val wi = (if i % 2 == 0 then near else wide).normalized
    Array(
      p.x,
      p.y,
      p.z,
      GuideField.side(Up).toFloat,
      wi.x,
      wi.y,
      wi.z,
      1f + 0.1f * u,
      1f,
      1f,
      0f,
      0f,
      0f,
      0f
    )

  val learnt: GuideField =
    val settings = GuideSettings(adapts = false, perRegion = 5.0)
    (1 to 4).foldLeft(GuideField.Start): (field, pass) =>
      val records = GuideRecords(1f, field.regions)
      val part = records.newPart()
      for i <- 0 until 10000 * pass do part.add(event(i))
      grown(field, records.sorted(), settings).result()

  /** @param everything events of each region, also those without light; at least those with it */
  def grown(
      old: GuideField,
      events: GuideEvents,
      settings: GuideSettings,
      everything: Float = 1f
  ): GuideGrowth =
    val learning = GuideLearning(growth(old, events, settings, everything))
    assert(learning.help(() => (), () => false))
    learning.growth

  /** Likewise, before anything has grown. */
  def growth(
      old: GuideField,
      events: GuideEvents,
      settings: GuideSettings,
      everything: Float = 1f
  ): GuideGrowth =
    val all = Array.fill(old.regions)(everything)
    val costs = Array.fill(old.regions)(EventCost)
    GuideGrowth(old, events, settings, lit = 1.0, all, costs, PathCost)

  def region(p: Vec3, n: Vec3): Int = GuideMixture().region(learnt, p, GuideField.side(n))
