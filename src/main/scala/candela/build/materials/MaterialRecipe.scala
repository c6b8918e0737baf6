package candela.build

import candela.bsdf.{Edition, Material, Roughness, RoughnessModel}
import candela.scenefile.Dialect

/** What all materials have.
  *
  * @param bumps whether bumps can be put on the surface
  */
abstract class MaterialRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect],
    bumps: Boolean = true
) extends Recipe[Material](name, meaning, dialects):
  if bumps then
    notYet("the surface is smooth")(
      floatTexture("bumpmap", "height of bumps", untilV3, "scene units", "none")(0f),
      floatTexture("displacement", "height of bumps", onlyV4, "scene units", "none")(0f),
      string("normalmap", "image of normals", onlyV4, "none")("")
    )

/** Of materials that are not rendered yet. */
trait GreyInstead extends Recipe[Material]:
  override def pending: Option[String] = Some(Materials.instead)
  protected def make()(using Site): Material = Materials.default

/** The parameters of roughness that many materials share.
  *
  * @param across the dialects in which u and v can have roughnesses of their own
  */
abstract class RoughRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect],
    default: Float,
    across: Set[Dialect] = sinceV3
) extends MaterialRecipe(name, meaning, dialects):
  private val both = floatTexture("roughness", "of the surface; 0: smooth")(default)
  private val u = alongAxis("u")
  private val v = alongAxis("v")
  private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", sinceV3)(true)

  private def alongAxis(axis: String) = Option.when(across.exists(dialects)):
    floatTexture(s"${axis}roughness", s"along $axis", across, shown = "roughness")(default)

  protected def roughness(smoothAtZero: Boolean = false)(using site: Site): Roughness =
    val model = site.dialect match
      case Dialect.V2 => RoughnessModel.BlinnExponent
      case Dialect.V3 =>
        if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
      case Dialect.V4 =>
        if remap() then RoughnessModel.SquareRootAlpha else RoughnessModel.PlainAlpha
    val along = u.flatMap(_.given_()).getOrElse(both())
    val sideways = v.flatMap(_.given_()).getOrElse(both())
    Roughness(along, sideways, model, smoothAtZero)

/** pbrt-v2 has other formulas than v3 for some materials of the same name. */
private[build] def edition(dialect: Dialect): Edition =
  if dialect == Dialect.V2 then Edition.Second else Edition.Third
