package candela.build.shapes

import candela.accel.{HoleMask, Mask, SolidMask, StochasticMask}
import candela.build.recipe.*
import candela.lights.{HiddenLight, Light, PerforatedLight, SurfaceLight}
import candela.scenefile.Dialect
import candela.shapes.SurfaceSampler
import candela.textures.{ConstantFloat, FloatTexture}

/** `alpha` and `shadowalpha` of shapes. */
private[build] object Alpha extends Fields:
  protected def register[T](field: Field[T]): Field[T] = field

  /** Which dialects have holes in the shape of this name; v4 has them in all. */
  def dialects(shape: String): Set[Dialect] = shape match
    case "trianglemesh" => every
    case "plymesh" => sinceV3
    case _ => onlyV4

  /** Those that have holes for shadow rays alone. */
  def shadowDialects(shape: String): Set[Dialect] = dialects(shape) & onlyV3

  private val alpha = floatTexture("alpha", "0 where there is a hole")(1f)
  private val shadowAlpha = floatTexture("shadowalpha", "0 where there is no shadow", onlyV3)(1f)

  /** What is left of the surface, where it is not all of it. */
  private def given_(field: Field[FloatTexture], dialects: Set[Dialect])(using
      site: Site
  ): Option[FloatTexture] =
    val isHoly = (a: Float) => if site.dialect == Dialect.V4 then a < 1f else a == 0f
    Option.when(dialects(site.dialect))(field()).filter(_.constant.forall(isHoly))

  def mask(using site: Site): Mask =
    val shape = site.declaration.name
    val holes = given_(alpha, dialects(shape))
    val shadowHoles = given_(shadowAlpha, shadowDialects(shape))
    if site.dialect == Dialect.V4 then holes.fold(SolidMask)(StochasticMask(_))
    else if holes.isEmpty && shadowHoles.isEmpty then SolidMask
    else HoleMask(holes.getOrElse(Whole), shadowHoles.getOrElse(Whole))

  /** How a surface with this mask emits. */
  def emission(using site: Site): Emission =
    if site.dialect != Dialect.V4 then Emission.Plain
    else
      given_(alpha, every).map(_.constant) match
        case None => Emission.Plain
        case Some(Some(a)) if a <= 0f => Emission.Hidden
        case Some(_) => Emission.Perforated(alpha())

  private val Whole = ConstantFloat(1f)

/** How light sampling takes an emitting surface: v2 and v3 forget its holes. */
private[build] enum Emission:
  case Plain, Hidden
  case Perforated(alpha: FloatTexture)

  def of(light: SurfaceLight, surface: SurfaceSampler): Light = this match
    case Plain => light
    case Hidden => HiddenLight(light)
    case Perforated(alpha) => PerforatedLight(light, surface, alpha)
