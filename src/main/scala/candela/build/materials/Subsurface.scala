package candela.build

import candela.color.Rgb

/** The skin of materials that light enters. */
abstract class SubsurfaceRecipe(
    name: String,
    meaning: String,
    dialects: Set[candela.scenefile.Dialect]
) extends MaterialRecipe(name, meaning, dialects)
    with GreyInstead:
  declare(
    rgbTexture("Kr", "factor of reflection", untilV3)(Rgb.White),
    rgbTexture("Kt", "factor of refraction", onlyV3)(Rgb.White),
    float("eta", "index of refraction", sinceV3)(1.33f),
    floatTexture("index", "index of refraction", onlyV2)(1.3f),
    floatTexture("roughness", "along u and v; 0: smooth", onlyV4)(0f),
    floatTexture("uroughness", "along u; 0: smooth", onlyV3)(0f),
    floatTexture("vroughness", "along v; 0: smooth", onlyV3)(0f),
    floatTexture("uroughness", "along u", onlyV4, shown = "roughness")(0f),
    floatTexture("vroughness", "along v", onlyV4, shown = "roughness")(0f),
    bool("remaproughness", "is roughness 0 to 1, or alpha?", sinceV3)(true),
    float("g", "asymmetry of scattering, -1 to 1", sinceV3)(0f)
  )

object Subsurface
    extends SubsurfaceRecipe("subsurface", "light scatters inside, by coefficients", every):
  declare(
    string("name", "of a measured material, instead of the coefficients", shown = "none")(""),
    rgbTexture("sigma_a", "absorption coefficient", unit = "1/mm")(Rgb(0.0011f, 0.0024f, 0.014f)),
    rgbTexture("sigma_prime_s", "reduced scattering coefficient", onlyV2, "1/mm")(
      Rgb(2.55f, 3.21f, 3.77f)
    ),
    rgbTexture("sigma_s", "scattering coefficient", sinceV3, "1/mm")(Rgb(2.55f, 3.21f, 3.77f)),
    float("scale", "factor of the coefficients")(1f),
    rgbTexture("reflectance", "instead of the coefficients", onlyV4, shown = "none")(Rgb.Black),
    rgbTexture("mfp", "mean free path, with `reflectance`", onlyV4, "mm")(Rgb.White)
  )

object KdSubsurface
    extends SubsurfaceRecipe("kdsubsurface", "light scatters inside, by the colour", untilV3):
  declare(
    rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f)),
    floatTexture("meanfreepath", "inside", onlyV2, "mm")(1f),
    rgbTexture("mfp", "mean free path", onlyV3, "mm")(Rgb.White),
    float("scale", "factor of the coefficients", onlyV3)(1f)
  )
