package candela.gallery

import candela.aov.Layer
import candela.build.SceneBuilder
import candela.image.{ContactSheet, DisplayTransform, Image, ImageFiles}
import candela.color.ToneCurve
import candela.scenefile.Parser
import candela.settings.{LightGrouping, RenderRegion, RenderSettings}

import java.nio.file.{Files, Path}

/** Renders the picture of docs/LAYERS.md: an image and the layers of light that add up to it. */
object LightPicture:
  private val File = Path.of("docs", "layers", "light.jpg")

  def main(args: Array[String]): Unit =
    val layers = Vector(Layer.Emission, Layer.Background, Layer.Direct, Layer.Indirect)
    val lamps = Vector("lamp" -> Vector("diffuse_17"), "candle" -> Vector("diffuse_93"))
    val options = RenderSettings(
      samples = Some(64),
      region = RenderRegion.Window(0.25f, 0.75f, 0.1f, 0.9f),
      layers = layers.filterNot(_ == Layer.Background) :+ Layer.Lights,
      lightGroups = Some(LightGrouping.Named(lamps :+ "sky" -> Vector("infinite")))
    )
    val scene = Parser.parse(Path.of("scenes", "showcase.pbrt"))
    val image = Gallery.render(SceneBuilder.build(scene, options)._1)
    val names = image.channelNames.collect { case s"$layer.R" => layer }
    val shown = DisplayTransform(curve = ToneCurve.Agx)
    val cells = ("image" -> shown(image.toRgb)) +: names.map: name =>
      val channels = image.indicesOf(Image.RgbNames.map(c => s"$name.$c"))
      name -> shown(image.selected(channels.get))
    val _ = Files.createDirectories(File.getParent)
    ImageFiles.write(File, ContactSheet(Some(4), cellSize = 240).of(cells))
    println(s"wrote $File")
