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
  declare(floatTexture("g", "asymmetry of scattering in the coat, -1 to 1")(0f))
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

object CoatedConductor
    extends MaterialRecipe("coatedconductor", "a metal under a dielectric coat", onlyV4)
    with GreyInstead:
  for layer <- Seq("interface", "conductor") do
    declare(
      floatTexture(s"$layer.roughness", "of this side; 0: smooth")(0f),
      floatTexture(s"$layer.uroughness", "along u", shown = s"$layer.roughness")(0f),
      floatTexture(s"$layer.vroughness", "along v", shown = s"$layer.roughness")(0f)
    )
  declare(
    bool("remaproughness", "is roughness 0 to 1, or alpha?")(true),
    floatTexture("thickness", "of the coat, mean free paths")(0.01f),
    spectrum("interface.eta", "index of refraction of the coat")(Indices.glass),
    spectrum("conductor.eta", "of the metal", shown = "of copper", typeName = "spectrum texture")(
      copper("eta")
    ),
    spectrum("conductor.k", "of the metal", shown = "of copper", typeName = "spectrum texture")(
      copper("k")
    ),
    rgbTexture("reflectance", "of the metal, instead of eta and k", shown = "none")(Rgb.White),
    rgbTexture("albedo", "of the medium in the coat")(Rgb.Black),
    floatTexture("g", "asymmetry of scattering in the coat, -1 to 1")(0f),
    integer("maxdepth", "most interactions within the layers")(10)
  )
  noMeaning("nothing is sampled at random here")(
    integer("nsamples", "random walks that are averaged")(1)
  )
