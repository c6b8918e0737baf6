package candela.job

import candela.aov.ImageLayer
import candela.image.{Image, ImageEdits}
import candela.io.FileName
import candela.render.RenderPlan

import java.nio.file.Path

/** Files of the strategies that bidirectional path tracing tells apart, beside the image: of
  * `x.exr`, `x_bdpt_d02_s01_t02.exr` and others. The image itself has none of them.
  */
final class StrategyFiles(plan: RenderPlan):
  /** All of an image. */
  def beside(image: Path): Vector[Path] = plan.strategies.map: strategy =>
    image.resolveSibling(s"${FileName.stem(image)}_${strategy.word}.exr")

  /** What a file holds of all that was rendered. */
  def contents(file: Path, all: Image): Image =
    val layers = plan.layers.toVector
    val named = plan.strategies.find(s => FileName.stem(file).endsWith(s"_${s.word}"))
    def channels(of: ImageLayer) = layers.flatMap(_.channels(of))
    named match
      case Some(strategy) =>
        ImageEdits.layerAsColors(ImageEdits.select(all, channels(strategy)))
      case None if plan.strategies.isEmpty => all
      case None =>
        ImageEdits.select(all, all.channelNames.diff(plan.strategies.flatMap(channels)))

object StrategyFiles:
  /** Names of files; those of strategies in one. */
  def listed(files: Vector[Path]): String =
    val (strategies, others) = files.partition(f => Name.matches(f.getFileName.toString))
    val pattern = strategies.headOption.map: file =>
      val name = Name.replaceFirstIn(file.toString, "$1_bdpt_d*_s*_t*.exr")
      if strategies.size == 1 then file.toString else s"$name (${strategies.size} files)"
    (others ++ pattern).mkString(", ")

  private val Name = raw"(.*)_bdpt_d\d\d_s\d\d_t\d\d\.exr".r
