package candela.build.materials

import candela.diagnostics.Code
import candela.io.InputFile
import candela.bsdf.{Bsdf, ConstantMaterial, Material}
import candela.bsdf.measured.FourierBsdf
import candela.build.recipe.*
import candela.color.{Rgb, Spectrum}
import candela.scenefile.Dialect

/** A BSDF read from a file: of spectra, made for each colour basis, or of red, green and blue. */
private[build] enum MeasuredBsdf:
  case OfSpectra(make: (Spectrum => Rgb) => Bsdf)
  case OfColors(bsdf: Bsdf)

/** Base of materials with a measured BSDF from a file. */
abstract class MeasuredRecipe(
    meaning: String,
    ending: String,
    dialects: Set[Dialect],
    name: String = "measured",
    parameter: String = "filename"
) extends MaterialRecipe(name, meaning, dialects):
  private val file = string(parameter, s"$ending file", shown = "none")("")

  private val measured = Once[Either[String, MeasuredBsdf]]()

  /** Returns the BSDF, or an error message. */
  protected def read(file: InputFile): Either[String, MeasuredBsdf]

  /** Whether the BSDF is isotropic. */
  protected def isIsotropic: Boolean

  protected def create()(using site: Site): Material =
    site.declaration.param(parameter).filter(_ => file().nonEmpty) match
      case None =>
        site.error(Code.MissingParameter, s"\"$name\" needs a `$parameter`")
        Materials.default
      case Some(p) =>
        val basis = site.resources.basis
        val material =
          for
            there <-
              site.resources.file(p, site.declaration, site.problems, StandIns.MagentaSurface)
            bsdf <- measured(read(there)) match
              case Right(MeasuredBsdf.OfSpectra(make)) =>
                Some(
                  make: s =>
                    Spectra.inBasis(SpectralValue.Wavelengths(s), SpectrumRole.Reflectance, site)
                )
              case Right(MeasuredBsdf.OfColors(b)) =>
                val name = file()
                for census <- site.resources.counting do
                  census.ifSpectral: () =>
                    site.problems.warn(
                      Code.Unsupported,
                      p.valuesAt,
                      s"`$name` gives red, green and blue only; they are taken as values at " +
                        "the wavelengths of a path, which desaturates its colours",
                      Some("render with --color rgb")
                    )
                Some(b)
              case Left(why) =>
                val message = s"can't read `${file()}`: $why"
                site.problems.missing(
                  Code.MeasuredFile,
                  p.valuesAt,
                  message,
                  StandIns.MagentaSurface
                )
                None
          yield ConstantMaterial(bsdf, isAnisotropic = !isIsotropic)
        material.getOrElse(StandIns.material(basis))

/** pbrt-v2's measured BRDF. */
object MeasuredTableRecipe
    extends MeasuredRecipe("measured BRDF from a table", ".brdf or .merl", onlyV2):
  protected def isIsotropic: Boolean = true
  protected def read(file: InputFile): Either[String, MeasuredBsdf] = BrdfFile.read(file)

/** pbrt-v4's measured BRDF. */
object MeasuredBsdfRecipe
    extends MeasuredRecipe("measured BRDF of Dupuy and Jakob", ".bsdf", onlyV4):
  protected def isIsotropic: Boolean = false
  protected def read(file: InputFile): Either[String, MeasuredBsdf] = AdaptiveFile.read(file)

object FourierRecipe
    extends MeasuredRecipe(
      "measured or computed BSDF as Fourier series",
      ".bsdf",
      onlyV3,
      name = "fourier",
      parameter = "bsdffile"
    ):
  protected def isIsotropic: Boolean = true
  protected def read(file: InputFile): Either[String, MeasuredBsdf] =
    BsdfFile.read(file).map(table => MeasuredBsdf.OfColors(FourierBsdf(table)))
