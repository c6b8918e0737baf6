package candela.suite

import candela.image.{Image, ImageError}

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

  private def gray(value: Float, width: Int = 4): Image =
    val image = Image.rgb(width, 3)
    java.util.Arrays.fill(image.data, value)
    image

  private def take(judge: Judge, step: Int, seed: Int, image: Image): Unit =
    judge.take(Job(entry, step, 1, seed), 1.0, None, image): Unit

  test("there are no results before a point of the curve has enough seeds"):
    val judge = SeedJudge(folder)
    for seed <- 1 to 3 do take(judge, Job.FirstImage, seed, gray(seed.toFloat))
    for seed <- 1 to 2 do take(judge, 0, seed, gray(seed.toFloat))
    assert(judge.results.isEmpty)
    take(judge, 0, 3, gray(3f))
    assert(judge.results.size == 6)

  test("an image of another size than the first is an error, and not counted"):
    val judge = SeedJudge(folder)
    take(judge, Job.WarmUp, 1, gray(1f))
    for seed <- 1 to 3 do take(judge, 0, seed, gray(seed.toFloat))
    val error = intercept[ImageError](take(judge, 0, 4, gray(1f, width = 5)))
    assert(error.getMessage.contains("5×3 and 4×3"))
    assert(judge.results.size == 3)
