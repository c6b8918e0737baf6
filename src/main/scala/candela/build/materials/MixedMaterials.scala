package candela.build.materials

import candela.bsdf.{InterfaceMaterial, Material}
import candela.bsdf.composite.MixedMaterial
import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect
import candela.textures.{GrayTexture, RgbTexture}

object MixRecipe
    extends MaterialRecipe("mix", "a blend of two named materials", every, bumps = false):
  private val first = string("namedmaterial1", "where `amount` is 1", untilV3, "none")("")
  private val second = string("namedmaterial2", "where `amount` is 0", untilV3, "none")("")
  private val part = rgbTexture("amount", "of the first", untilV3)(Rgb.gray(0.5f))
  private val both =
    strings("materials", "string[2]", "where `amount` is 0, and where it is 1", onlyV4)
  private val partOfSecond = floatTexture("amount", "of the second", onlyV4)(0.5f)

  protected def make()(using site: Site): Material =
    if site.dialect == Dialect.V4 then
      both() match
        case Vector(a, b) =>
          mixed(named(b, "materials"), named(a, "materials"), GrayTexture(partOfSecond()))
        case names =>
          site.error(s"`materials` of \"mix\" takes two names of materials; found ${names.length}")
          Materials.default
    else
      mixed(named(first(), "namedmaterial1"), named(second(), "namedmaterial2"), part())

  private def mixed(a: Material, b: Material, amount: RgbTexture)(using site: Site): Material =
    if a.isSubsurface || b.isSubsurface then
      site.warn("light does not travel beneath a mixed surface: it goes straight on inside")
    MixedMaterial(a, b, amount)

  private def named(name: String, parameter: String)(using site: Site): Material =
    val at = site.declaration.param(parameter).fold(site.declaration.at)(_.valuesAt)
    val found = site.resources.materials(name, at, site.resources, site.problems)
    if site.dialect == Dialect.V4 && (found eq InterfaceMaterial) then
      site.problems.error(at, s"`$name` is an interface, which can't be a part of \"mix\"")
    found

/** The edge of a medium. */
final class InterfaceRecipe(name: String, dialects: Set[Dialect])
    extends MaterialRecipe(name, "no surface: light passes straight on", dialects, bumps = false):
  protected def make()(using Site): Material = InterfaceMaterial
