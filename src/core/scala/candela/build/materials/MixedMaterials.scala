package candela.build.materials

import candela.diagnostics.Code
import candela.bsdf.{FramedMaterial, InterfaceMaterial, Material, TwoSidedMaterial}
import candela.bsdf.composite.MixedMaterial
import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect
import candela.textures.{GrayTexture, RgbTexture}

object MixRecipe
    extends MaterialRecipe("mix", "blend of two named materials", every, bumps = false):
  private val first =
    string("namedmaterial1", "material where `amount` is 1", untilV3, shown = "none")("")
  private val second =
    string("namedmaterial2", "material where `amount` is 0", untilV3, shown = "none")("")
  private val fraction =
    rgbTexture("amount", "fraction of the first material", untilV3)(Rgb.gray(0.5f))
  private val materialNames =
    strings("materials", "string[2]", "materials where `amount` is 0 and where it is 1", onlyV4)
  private val fractionOfSecond =
    floatTexture("amount", "fraction of the second material", onlyV4)(0.5f)

  protected def create()(using site: Site): Material =
    if site.dialect == Dialect.V4 then
      materialNames() match
        case Vector(a, b) =>
          val (one, other) = pair(b, "materials", a, "materials")
          mixed(one, other, GrayTexture(fractionOfSecond()))
        case names =>
          site.error(
            Code.ParameterCount,
            s"`materials` of \"mix\" must be two material names, found ${names.length}"
          )
          Materials.default
    else
      val (one, other) = pair(first(), "namedmaterial1", second(), "namedmaterial2")
      mixed(one, other, fraction())

  private def mixed(a: Material, b: Material, amount: RgbTexture)(using site: Site): Material =
    if a.isSubsurface || b.isSubsurface then
      site.warn(
        Code.Unsupported,
        "\"mix\" does not support subsurface scattering; light passes through the inside " +
          "unscattered"
      )
    MixedMaterial(a, b, amount, gains = site.dialect != Dialect.V4)

object TwoSidedRecipe
    extends MaterialRecipe(
      "twosided",
      "materials of the front and the back",
      onlyMitsuba
    ):
  private val materialNames =
    strings("materials", "string[2]", "materials of the front and the back")

  protected def create()(using site: Site): Material = materialNames() match
    case Vector(front, back) =>
      val (one, other) = pair(front, "materials", back, "materials")
      TwoSidedMaterial(one, other)
    case names =>
      site.error(
        Code.ParameterCount,
        s"`materials` of \"twosided\" must be two material names, found ${names.length}"
      )
      Materials.default

/** Two named materials, which are one object if they have one name. */
private def pair(a: String, parameter: String, b: String, other: String)(using
    Site
): (Material, Material) =
  val material = named(a, parameter)
  (material, if b == a then material else named(b, other))

private[materials] def named(name: String, parameter: String)(using site: Site): Material =
  val pos = site.declaration.param(parameter).fold(site.declaration.pos)(_.valuesAt)
  val material = site.resources.materials(name, pos, site.resources, site.problems)
  if site.dialect == Dialect.V4 && material.isInterface then
    val outer = site.declaration.name
    site.problems.error(
      Code.ParameterValue,
      pos,
      s"`$parameter` of \"$outer\" must not name an interface, found `$name`"
    )
  FramedMaterial.of(material)

object NestedRecipe
    extends MaterialRecipe("nested", "material within another one", onlyMitsuba):
  private val innerName = string("material", "name of the material")("")
  private val onesided = bool("onesided", "whether it is black from behind")(false)

  protected def create()(using site: Site): Material =
    val inner = named(innerName(), "material")
    if onesided() then inner.oneSided else inner

/** A medium interface without a surface. */
final class InterfaceRecipe(name: String, dialects: Set[Dialect])
    extends MaterialRecipe(name, "medium interface without a surface", dialects, bumps = false):
  /** pbrt-v2 and v3 render unknown materials as their default. */
  override def isUnknownElsewhere: Boolean = true
  protected def create()(using Site): Material = InterfaceMaterial
