package candela.bench.suite

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class ForecastSuite extends AnyFunSuite:
  private val renderers = Vector("a", "b").map: name =>
    Program(name, name, Vector.empty, Vector("f"), 1, Vector.empty, true, 0, isThin = false)
  private val scenes = Vector("s", "t").map: name =>
    val file = Path.of(name)
    SuiteScene(name, name, "", Map("f" -> file), Some(file), None, None, None, Vector.empty)
  private val suite = Suite("T", renderers, scenes, Work.Samples(Vector(1, 16)), seeds = 2, 10)
  private val entries = for s <- scenes; p <- renderers yield Entry(p, s, s.files("f"))
  private def forecast() = Forecast(entries.flatMap(Forecast.runs(_, suite)))
  private def job(entry: Entry, step: Int) = Job(entry, step, 1, 1)

  test("nothing is foretold before each step was seen"):
    val f = forecast()
    assert(f.secondsLeft.isEmpty && f.words == "[0 of 20]")
    f.ended(job(entries.head, -1), Some(1))
    f.ended(job(entries.head, 0), Some(1))
    assert(f.secondsLeft.isEmpty)
    f.ended(job(entries.head, 1), Some(5))
    // of the first: 1 and 5; of the three others 1 + 2 · 1 + 2 · 5
    assert(f.secondsLeft.contains(1 + 5 + 3 * (1 + 2 + 10)))
    assert(f.words == "[3 of 20, about 45 s left]")

  test("a program's own times count, on other scenes too, and at best on the same one"):
    val f = forecast()
    for step <- -1 to 1 do f.ended(job(entries(0), step), Some(1))
    for step <- -1 to 1 do f.ended(job(entries(1), step), Some(100))
    val (a, b) = (2 * 1 + 5 * 1, 2 * 100 + 5 * 100)
    assert(f.secondsLeft.contains(a + b) && f.words == "[6 of 20, about 12 min left]")
    f.ended(job(entries(2), 1), Some(10))
    assert(f.secondsLeft.contains(2 + 2 * 1 + 1 + 10 + b + 0.0))

  test("what can't be run takes no time"):
    val f = forecast()
    for step <- -1 to 1 do f.ended(job(entries(0), step), Some(1))
    for entry <- entries.tail do f.dropFrom(entry, 0, hasFirstImage = false)
    assert(f.words == "[3 of 5, about 2 s left]")
    f.ended(job(entries(0), 0), None)
    f.dropFrom(entries(0), 1, hasFirstImage = false)
    assert(f.words == "[4 of 4]")

  test("first images are foretold, unless a count is one"):
    def left(samples: Vector[Int], found: Option[Boolean]) =
      val one = suite.copy(scenes = scenes.take(1), work = Work.Samples(samples))
      val f = Forecast(Forecast.runs(entries.head, one))
      for has <- found do f.dropFrom(entries.head, samples.size, has)
      f.words
    assert(left(Vector(4, 16), None) == "[0 of 7]" && left(Vector(1, 16), None) == "[0 of 5]")
    // The warm-up is over when they are known
    assert(left(Vector(4, 16), Some(true)) == "[0 of 6]")
    assert(left(Vector(4, 16), Some(false)) == "[0 of 4]")
