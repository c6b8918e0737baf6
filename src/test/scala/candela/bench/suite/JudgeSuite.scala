package candela.bench.suite

import candela.bench.report.Growth
import candela.image.{Image, ImageError}
import candela.measure.ErrorLayer

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class JudgeSuite extends AnyFunSuite:
  private val folder = Files.createTempDirectory("candela-judge")
  private val entry =
    val words = Vector("cp")
    val program =
      Program("a", "A", words, words, 1, Vector.empty, isSeeded = true, 0, isThin = false)
    val scene =
      SuiteScene("s", "S", "", Map.empty, None, None, None, None, Vector.empty)
    Entry(program, scene, folder)
  private val suite =
    Suite("T", Vector(entry.program), Vector(entry.scene), Work.Samples(Vector(1)), 3, 1)

  private def gray(value: Float, width: Int = 4): Image =
    val image = Image.rgb(width, 3)
    java.util.Arrays.fill(image.data, value)
    image

  private def take(judge: Judge, step: Int, seed: Int, image: Image): Unit =
    judge.take(Job(entry, step, 1, seed), 1.0, None, image): Unit

  test("there are no results before a point of the curve has enough seeds"):
    val judge = SeedJudge(suite, folder)
    for seed <- 1 to 3 do take(judge, Job.FirstImage, seed, gray(seed.toFloat))
    for seed <- 1 to 2 do take(judge, 0, seed, gray(seed.toFloat))
    assert(judge.results.isEmpty)
    take(judge, 0, 3, gray(3f))
    assert(judge.results.size == 6)

  test("errors of scenes that grow are not taken apart"):
    val grows = entry.copy(scene = entry.scene.copy(growth = Some(Growth("things", 3))))
    for
      e <- Vector(entry, grows); judge <- Vector(SeedJudge(suite, folder), ReferenceJudge(gray(1)))
    do
      for seed <- 1 to 3 do
        judge.take(Job(e, 0, 1, seed), 1.0, None, gray(seed.toFloat)): Unit
      assert(judge.results.size == 3)
      assert(judge.results.forall(_.measurement.parts.isDefined == (e == entry)))

  test("a reference's own error is subtracted"):
    val own = gray(0.01f)
    val judge = ReferenceJudge(ErrorLayer.append(gray(1f), own))
    take(judge, 0, 1, gray(1.5f))
    take(judge, 0, 2, gray(1.05f))
    val found = judge.results.map(_.measurement.errors)
    assert(Math.abs(found(0).mse - 0.24) < 1e-6 && !found(0).isUnresolved)
    assert(found(1).mse == 0 && found(1).isUnresolved)
    assert(judge.reference.channelNames == Image.RgbNames)

  test("an image of another size than the first is an error, and not counted"):
    val judge = SeedJudge(suite, folder)
    take(judge, Job.WarmUp, 1, gray(1f))
    for seed <- 1 to 3 do take(judge, 0, seed, gray(seed.toFloat))
    val error = intercept[ImageError](take(judge, 0, 4, gray(1f, width = 5)))
    assert(error.getMessage.contains("5×3 and 4×3"))
    assert(judge.results.size == 3)

  test("variants of a program make the reference no more theirs: each family counts once"):
    def other(name: String, family: String) =
      entry.copy(program = entry.program.copy(name = name, title = name, ownFamily = Some(family)))
    val entries = Vector(other("a", "one"), other("a-2", "one"), other("b", "two"))
    val judge = SeedJudge(suite.copy(programs = entries.map(_.program)), folder)
    for (e, value) <- entries.zip(Vector(1f, 1f, 4f)); seed <- 1 to 3 do
      judge.take(Job(e, 0, 1, seed), 1.0, None, gray(value)): Unit
    // The mean of all three would be 2
    assert(judge.reference(0, 0, 0) == 2.5f)
    assert(judge.voters.map(_.name) == Vector("a", "b"))
