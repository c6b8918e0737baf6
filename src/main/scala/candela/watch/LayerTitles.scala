package candela.watch

import candela.aov.Layer
import candela.report.LiveLayer

/** What the images of a snapshot are called, for readers who don't know names of channels. */
private[watch] object LayerTitles:

  /** @param names as in [[Snapshot.layers]] */
  def titled(names: Vector[String]): Vector[LiveLayer] = names.map:
    case "color" => LiveLayer("color", "colour", "the image")
    case "noise" => LiveLayer("noise", "noise", "expected standard deviation of the colour")
    case group @ s"Combined_$light" =>
      LiveLayer(group, s"light group $light", "light of these lights only")
    case band @ s"S0.$nanometres" =>
      LiveLayer(band, nanometres.replace(',', '.').replace("nm", " nm"), "spectral radiance")
    case name =>
      Layer.values.find(_.channels.exists(belongs(_, name))) match
        case None => LiveLayer(name, name, "")
        case Some(layer) =>
          val title = titles.getOrElse(layer, layer.word)
          // One of several images of the layer
          val isPart = !layer.channels.forall(belongs(_, name))
          LiveLayer(name, if isPart then s"$title: $name" else title, layer.meaning)

  private def belongs(channel: String, name: String): Boolean =
    channel == name || (channel.startsWith(s"$name.") && channel.length == name.length + 2)

  /** Of layers whose word on the command line is short. */
  private val titles: Map[Layer, String] = Map(
    Layer.Normal -> "normals",
    Layer.ShadingNormal -> "shading normals",
    Layer.Uv -> "surface parameters",
    Layer.RelativeVariance -> "relative variance",
    Layer.Gradient -> "depth gradient",
    Layer.Lights -> "light groups",
    Layer.DenoisingAlbedo -> "albedo for denoising",
    Layer.DenoisingNormal -> "normals for denoising",
    Layer.CryptoObject -> "object mattes",
    Layer.CryptoMaterial -> "material mattes"
  )
