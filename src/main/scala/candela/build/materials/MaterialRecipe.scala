package candela.build

import candela.bsdf.{Edition, Material, Roughness, RoughnessModel}
import candela.scenefile.Dialect

/** What all materials have. */
abstract class MaterialRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[Material](name, meaning, dialects):
  notYet("the surface is smooth")(
    floatTexture("bumpmap", "height of bumps", untilV3, unit = "scene units", shown = "none")(0f),
    floatTexture("displacement", "height of bumps", onlyV4, "scene units", "none")(0f),
    string("normalmap", "image of normals", onlyV4, "none")("")
  )

/** The parameters of roughness that many materials share. */
abstract class RoughRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect],
    default: Float
) extends MaterialRecipe(name, meaning, dialects):
  private val both = floatTexture("roughness", "of the surface; 0: smooth")(default)
  private val u = floatTexture("uroughness", "along u; default: `roughness`", sinceV3)(default)
  private val v = floatTexture("vroughness", "along v; default: `roughness`", sinceV3)(default)
  private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", sinceV3)(true)

  protected def roughness(smoothAtZero: Boolean = false)(using site: Site): Roughness =
    val model = site.dialect match
      case Dialect.V2 => RoughnessModel.BlinnExponent
      case Dialect.V3 =>
        if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
      case Dialect.V4 =>
        if remap() then RoughnessModel.SquareRootAlpha else RoughnessModel.PlainAlpha
    val (along, across) = (u.given_().getOrElse(both()), v.given_().getOrElse(both()))
    Roughness(along, across, model, smoothAtZero)

/** pbrt-v2 has other formulas than v3 for some materials of the same name. */
private[build] def edition(dialect: Dialect): Edition =
  if dialect == Dialect.V2 then Edition.Second else Edition.Third
