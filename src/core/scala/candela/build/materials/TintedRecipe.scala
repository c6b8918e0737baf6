package candela.build.materials

import candela.bsdf.Material
import candela.build.recipe.{Field, Site}
import candela.scenefile.{Declaration, ParamType}
import candela.textures.RgbTexture

/** A material of a colour, without which all else of it is made: of thousands that differ in this
  * colour alone, one is read.
  */
private[build] trait TintedRecipe extends MaterialRecipe:

  /** The colour. */
  protected def tint: Field[RgbTexture]

  /** Makes materials by the colour, on whose value no message depends if it is within [0, 1], and
    * the site of each.
    */
  protected def tinted()(using Site): (RgbTexture, Site) => Material

  protected def create()(using site: Site): Material =
    val color = tint() // what is wrong with it is said first
    tinted()(color, site)

  /** As [[build]], of statements that are [[isAlike]]: `apply` makes each by its site. */
  final def family(first: Site): Site => Material =
    val colored = tinted()(using first)
    site => colored(tint.again()(using site).getOrElse(tint()(using site)), site).folded

  /** Whether two statements of this material differ in nothing but the numbers of its colour. */
  final def isAlike(a: Declaration, b: Declaration): Boolean =
    a.isAlikeBut(tint.name, b) && isColor(a) && isColor(b)

  /** Equal for statements that are [[isAlike]]. */
  final def kindOf(d: Declaration): Int = d.hashBut(tint.name)

  private def isColor(d: Declaration): Boolean =
    d.param(tint.name).exists: p =>
      p.paramType == ParamType.Rgb && p.floats.length == 3 && isShare(p.floats)

  /** Without boxes: there may be very many. */
  private def isShare(c: Array[Float]): Boolean =
    c(0) >= 0f && c(0) <= 1f && c(1) >= 0f && c(1) <= 1f && c(2) >= 0f && c(2) <= 1f
