package candela.build

import candela.bsdf.{Material, MaterialFactory as Make}
import candela.color.{Colorimetry, Rgb, Upsampling}

object CoatedDiffuse
    extends RoughRecipe("coateddiffuse", "diffuse under a dielectric coat", onlyV4, 0f):
  private val reflectance = rgbTexture("reflectance", "of the base, 0 to 1")(Rgb.gray(0.5f))
  private val thickness = floatTexture("thickness", "of the coat, mean free paths")(0.01f)
  private val albedo = rgbTexture("albedo", "of the medium in the coat")(Rgb.Black)
  private val eta = spectrum("eta", "index of refraction of the coat")(Indices.glass)
  private val depth = integer("maxdepth", "most interactions within the layers")(10)
  noMeaning("only media that scatter have it, which are not supported yet")(
    float("g", "asymmetry of scattering in the coat")(0f)
  )
  noMeaning("nothing is sampled at random here")(
    integer("nsamples", "random walks that are averaged")(1)
  )
  protected def make()(using site: Site): Material =
    val coats = site.resources.coats
    val basis = site.resources.basis
    // A colour that is the same everywhere can be scattered by wavelength, once and for all
    val bySpectrum = reflectance().constant.map: color =>
      val base = Upsampling.spectrum(basis.toSrgb(color))
      (f: Float => Float) =>
        basis.fromSrgb(Colorimetry.rgb(nm => f(base(nm)), Colorimetry.White.D65))
    Make
      .coatedDiffuse(
        reflectance(), roughness(), thickness(), albedo(), Indices.one(eta()), depth(), coats,
        bySpectrum
      )
      .getOrElse {
        site.warn(
          s"a coat that scatters or varies in thickness is not supported yet: ${Materials.instead}"
        )
        Make.diffuse(reflectance())
      }
