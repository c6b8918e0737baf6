package candela.cli.terminal

import candela.cli.Captured
import candela.job.Render
import candela.settings.{BuildControl, BuildStages, RenderGoal, RenderSettings}
import candela.scenefile.Dialect
import candela.testing.{Eventually, SceneTexts}

import org.scalatest.funsuite.AnyFunSuite

class StageLineSuite extends AnyFunSuite:

  test("a terminal shows the stage and its seconds, and clears them"):
    val captured = Captured(isInteractive = true)
    @volatile var now = 0.0
    val line = new StageLine(captured.terminal.err, isInteractive = true, () => now)
    val result = line.during("pilot"):
      now = 2.6
      Eventually.eventually("a line")(Option.when(captured.err.contains("\rpilot  2.6 s"))(7))
    assert(result == 7 && captured.err.endsWith("\r"))

  test("a log has a line every ten seconds; short stages are not told"):
    val captured = Captured()
    @volatile var now = 0.0
    val line = new StageLine(captured.terminal.err, isInteractive = false, () => now)
    line.during("pilot")(())
    assert(captured.err.isEmpty)
    line.during("pilot"):
      now = 11
      Eventually.eventually("a line")(Option.when(captured.err.nonEmpty)(()))
    assert(captured.err == "pilot  11.0 s\n")

  test("pilots are such a stage"):
    var told = Vector.empty[String]
    val stages = new BuildStages:
      def during[A](stage: String)(body: => A): A =
        told :+= stage
        body
    val scene = SceneTexts.parse(
      "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin " +
        "LightSource \"infinite\" Translate 0 0 5 Material \"dielectric\" Shape \"sphere\"",
      Dialect.V4
    )
    val settings = RenderSettings(goal = RenderGoal(error = Some(0.1)))
    Render.build(scene, settings, BuildControl(stages = stages)).close()
    assert(told == Vector("pilot"))
