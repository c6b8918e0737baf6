package candela.build.recipe

import candela.build.SceneBuilder
import candela.color.ColorBasis
import candela.concurrency.Parallel
import candela.diagnostics.{SceneError, Severity, SourcePos}
import candela.io.SceneFolder
import candela.render.Renderer
import candela.scenefile.{Declaration, Dialect, Param, ParamType, Parser}
import candela.settings.RenderSettings
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.nio.file.Path

final class RangeSuite extends AnyFunSuite:
  private val place = SourcePos("ranges.pbrt", 1, 1)

  private def site(p: Param, dialect: Dialect, category: String = "Shape", name: String = "x") =
    Site(
      Declaration(category, name, Vector(p), place, SceneFolder.Nowhere),
      dialect.base,
      Resources(ColorBasis.Srgb, rules = Some(Rules.of(dialect))),
      Findings()
    )

  /** The numbers that are used, and what is said. */
  private def held(range: Range, values: Float*): (Option[Seq[Float]], Vector[String]) =
    val p = Param.float("x", place, values*)
    val here = site(p, Dialect.V4)
    val numbers = range.held(p, "", here).map(_.floats.toSeq)
    (numbers, here.problems.result.map(p => s"${p.severity}: ${p.message}"))

  test("numbers within a range are used without a word"):
    for range <- Seq(Range(0f, 1f), Range(0f, 1f).limited, Range(2f, 3f).including(0f), Range.Any)
    do
      assert(held(range, range.also.getOrElse(1f)) == (
        Some(Seq(range.also.getOrElse(1f))),
        Vector()
      ))
    assert(held(Range.Unlimited, Float.PositiveInfinity)._2.isEmpty)

  test("others are an error, or limited or used with a warning, or left to the recipe"):
    val range = Range(0f, 1f)
    val error = "Error: `x` must be from 0 to 1, found 2"
    val warning = "Warning: `x` must be from 0 to 1, found 2; using "
    assert(held(range, 2f) == (None, Vector(error)))
    assert(held(range.limited, 2f) == (Some(Seq(1f)), Vector(warning + "1")))
    assert(held(range.limited, .5f, 2f) == (
      Some(Seq(.5f, 1f)),
      Vector(warning + "the nearest that is")
    ))
    val unclamped = "Warning: `x` should be from 0 to 1, found 2, which is not clamped"
    assert(held(range.unclamped, 2f) == (Some(Seq(2f)), Vector(unclamped)))
    assert(held(range.deferred, 2f) == (Some(Seq(2f)), Vector()))

  test("what is larger than 1e30 is limited, and infinity is an error, wherever numbers are used"):
    for range <- Seq(Range.Any, Range(0f, 1f).unclamped, Range(0f, 1f).deferred) do
      val message = "`x` must be within ±1e30, found "
      val warning = s"Warning: ${message}1e35; using 1e30"
      assert(held(range, 1e35f) == (Some(Seq(1e30f)), Vector(warning)))
      assert(held(range, Float.PositiveInfinity) == (None, Vector(s"Error: ${message}infinite")))
      assert(held(range, 2e30f, Float.NaN) == (Some(Seq(0f, 0f)), Vector(s"Error: ${message}NaN")))

  test("the ends of an open range are outside"):
    assert(held(Range.above(0f), 0f)._2 == Vector("Error: `x` must be above 0, found 0"))
    assert(held(Range.exclusive(0f, 180f), 180f)._1.isEmpty)
    assert(held(Range.above(0f), Float.MinPositiveValue)._1.nonEmpty)

  test("a range is written in words"):
    val texts = Vector(
      Range.Any -> "",
      Range.atLeast(1f) -> "at least 1",
      Range.endless -> "above 0",
      Range(0f, 1f) -> "from 0 to 1",
      Range.exclusive(0f, 180f) -> "between 0 and 180",
      Range.atLeast(1000f).including(0f) -> "0 or at least 1000"
    )
    for (range, text) <- texts do assert(range.text == text)

  test("NaN is an error for each number of each recipe"):
    for
      (category, recipe, field, _) <- RangeScenes.parameters
      dialect <- recipe.dialectsOf(field)
    do
      val kind = RangeScenes.kindOf(field, dialect)
      if kind != ParamType.Integer then
        val count = if kind == ParamType.Float then 1 else 3
        val p = Param.floats(kind, field.name, place, Array.fill(count)(Float.NaN))
        val here = site(p, dialect, category.name, recipe.name)
        val _ = field.given_()(using here)
        assert(
          here.problems.result.exists(_.severity == Severity.Error),
          s"$recipe ${field.name}"
        ): Unit

  private val Floats = Vector("0", "-1", "1e-38", "-1e-38", "1e10", "-1e10", "1e38", "1e400")
  private val Integers = Vector("0", "-1", "1000000", "2147483647", "-2147483648")

  /** What is wrong with a scene, if anything is. */
  private def fault(scene: RangeScene, renders: Boolean): Option[String] =
    try
      val parsed = Parser.parseText("test.pbrt", scene.text, Path.of(""), Some(scene.dialect))
      val (plan, problems) = SceneBuilder.build(parsed, RenderSettings(), pool = Parallel.Alone)
      val isLong = scene.field.typeName.startsWith("integer") && scene.value.length > 6
      if !renders || isLong then None
      else
        val made = plan.piloted
        val data = Renderer.render(made, threads = 1).image(made.development).data
        val isSilent = (parsed.warnings ++ problems).isEmpty
        Option.when(isSilent && !data.forall(java.lang.Float.isFinite))("NaN without a word")
    catch
      // The scene itself is whole
      case e: SceneError =>
        e.problems.map(_.message).find(m => m.contains("needs") || m.contains("no file"))
      case e: Exception => Some(e.toString)

  private def assertFaultless(
      floats: Vector[String],
      integers: Vector[String],
      renders: Boolean
  ): Unit =
    val faults =
      for
        (category, recipe, field, dialect) <- RangeScenes.parameters
        value <- if field.typeName.startsWith("integer") then integers else floats
        scene = RangeScene(category, recipe, field, dialect, value)
        fault <- fault(scene, renders)
      yield s"${scene.name}: $fault"
    assert(faults.isEmpty, faults.mkString("\n", "\n", "")): Unit

  test("scenes with an extreme number are built, or refused by an error"):
    assertFaultless(Vector("-1e10"), Vector("-2147483648"), renders = false)

  test("scenes with an extreme number are rendered, and no image is NaN without a word", Slow):
    assertFaultless(Floats, Integers, renders = true)
