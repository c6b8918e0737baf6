package candela.testing

import candela.concurrency.Parallel
import candela.diagnostics.{Problem, SceneError}
import java.nio.file.Path

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.render.{Renderer, RenderPlan}
import candela.scenefile.{Dialect, Parser, SceneDescription}
import candela.settings.RenderSettings

/** Scenes written in a test: to plans, problems and pictures. */
object SceneTexts:

  def parse(text: String, dialect: Dialect, folder: Path = Path.of("")): SceneDescription =
    Parser.parseText("test.pbrt", text, folder, Some(dialect))

  def plan(
      text: String,
      dialect: Dialect = Dialect.V3,
      options: RenderSettings = RenderSettings(),
      pool: Parallel = Parallel.Alone
  ): RenderPlan = plan(parse(text, dialect), options, pool)

  private def plan(scene: SceneDescription, options: RenderSettings, pool: Parallel): RenderPlan =
    SceneBuilder.build(scene, options, pool = pool)._1.piloted

  /** All that building has to say, warnings or errors. */
  def problems(
      text: String,
      dialect: Dialect = Dialect.V3,
      folder: Path = Path.of(""),
      options: RenderSettings = RenderSettings()
  ): Vector[Problem] =
    try SceneBuilder.build(parse(text, dialect, folder), options)._2
    catch case e: SceneError => e.problems

  /** The mean of all pixels, in linear sRGB. */
  def mean(text: String, dialect: Dialect = Dialect.V3): Rgb = mean(parse(text, dialect))

  def mean(scene: SceneDescription): Rgb =
    val made = plan(scene, RenderSettings(), Parallel.Alone)
    val data = Renderer.render(made, threads = 1).image(made.development).data
    def channel(c: Int) =
      (data.indices.by(3).map(i => data(i + c).toDouble).sum * 3 / data.length).toFloat
    Rgb(channel(0), channel(1), channel(2))
