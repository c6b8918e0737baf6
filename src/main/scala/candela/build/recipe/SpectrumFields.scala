package candela.build.recipe

import candela.color.ColorBasis
import candela.scenefile.{Dialect, ParamType}
import candela.textures.{ConstantRgb, RgbTexture}

/** A parameter that is a spectrum, the same everywhere, or a texture of colours. */
enum SpectrumSource:
  case Uniform(value: SpectralValue)

  /** In the basis of the scene. */
  case Varying(texture: RgbTexture)

object SpectrumSource:
  /** As a texture, with what `color` makes of a uniform value in the basis. */
  def textured(source: SpectrumSource)(color: SpectralValue => candela.color.Rgb): RgbTexture =
    source match
      case Uniform(value) => ConstantRgb(color(value))
      case Varying(texture) => texture

/** Parameters of recipes whose wavelengths count as long as no texture gives them. */
trait SpectrumFields extends Fields:

  protected final def spectrumTexture(
      name: String,
      doc: String,
      in: Set[Dialect] = every,
      shown: String
  )(default: Dialect ?=> SpectralValue): Field[SpectrumSource] =
    val field = Field[SpectrumSource](
      name,
      "spectrum texture",
      doc,
      in,
      "",
      d => SpectrumSource.Uniform(default(using d)),
      _ => shown,
      (p, site) =>
        if p.paramType == ParamType.Texture then
          site.resources.rgbTexture(p, site.problems).map: texture =>
            texture.constant match
              case Some(c) => SpectrumSource.Uniform(uniform(c, site.resources.basis))
              case None => SpectrumSource.Varying(texture)
        else Spectra.value(p, site).map(SpectrumSource.Uniform(_))
    )
    register(field)

  private def uniform(color: candela.color.Rgb, basis: ColorBasis) =
    SpectralValue.Color(basis.toSrgb(color))
