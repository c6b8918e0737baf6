package candela.noise

import candela.build.SceneBuilder
import candela.render.RenderPlan
import candela.scenefile.{Declaration, Param, Parser, SceneDescription}
import candela.settings.RenderSettings

import java.nio.file.Path

/** A scene whose image is reduced to `width` pixels. */
final class SmallScene(description: SceneDescription):
  def plan(options: RenderSettings): RenderPlan =
    SceneBuilder.build(description, options)._1.piloted

object SmallScene:
  def apply(file: String, width: Int): SmallScene =
    val scene = Parser.readable(Path.of(file), None, false)
    new SmallScene(scene.copy(film = scene.film.map(reduced(_, width))))

  private def reduced(film: Declaration, width: Int): Declaration =
    val wide = film.param("xresolution").flatMap(_.ints.headOption).getOrElse(width)
    def scaled(p: Param) =
      val sizes = p.ints.map(n => Math.max(1, Math.round(n.toDouble * width / wide).toInt))
      Param(p.paramType, p.name, p.pos, p.valuesAt, ints = sizes)
    val names = Set("xresolution", "yresolution")
    film.copy(params = film.params.map(p => if names(p.name) then scaled(p) else p))
