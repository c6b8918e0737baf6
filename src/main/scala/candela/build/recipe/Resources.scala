package candela.build.recipe

import scala.collection.mutable

import candela.base.{Parallel, SourcePos, Suggest}
import candela.bsdf.Material
import candela.color.ColorBasis
import candela.scenefile.{Declaration, NameKind, Param}
import candela.textures.{FloatTexture, RgbTexture}

/** Resources that statements of a scene file refer to: textures, materials and files.
  *
  * @param basis colour basis of the runtime scene
  * @param pool  executes divisible work
  * @param seed  random seed, except of samplers
  * @param plainBasis the three numbers of the scene, from which what all bases share is made
  */
final class Resources private (
    val basis: ColorBasis,
    val pool: Parallel,
    val seed: Int,
    shared: SharedResources,
    val plainBasis: ColorBasis
):
  def this(
      basis: ColorBasis,
      pool: Parallel = Parallel.Alone,
      seed: Int = 0,
      mayBeSpectral: Boolean = false,
      switches: Switches = Switches()
  ) = this(basis, pool, seed, SharedResources(basis, mayBeSpectral, switches), basis)

  /** The same files and tables, for another basis; names are yet to be defined. */
  def in(other: ColorBasis): Resources = new Resources(other, pool, seed, shared, plainBasis)

  export shared.*

  /** Where spectra are noted, if they decide how the scene is rendered. */
  def counting: Option[ColorCensus] = Option.when(mayBeSpectral && !basis.isSpectral)(census)

  val materials = NamedMaterials()

  private val floats = mutable.Map.empty[String, FloatTexture]
  private val colors = mutable.Map.empty[String, RgbTexture]

  def define(name: String, texture: FloatTexture): Unit = floats(name) = texture
  def define(name: String, texture: RgbTexture): Unit = colors(name) = texture

  /** Returns the texture that a parameter names, or a fallback after reporting a problem. */
  def floatTexture(p: Param, problems: Findings): Option[FloatTexture] =
    val found = lookUp(p, floats, colors.keySet, "float", "spectrum", StandIns.Ones, problems)
    Some(found.getOrElse(StandIns.number))

  /** As above. */
  def rgbTexture(p: Param, problems: Findings): Option[RgbTexture] =
    val found = lookUp(p, colors, floats.keySet, "spectrum", "float", StandIns.Magentas, problems)
    Some(found.getOrElse(StandIns.color(basis)))

  private def lookUp[T](
      p: Param,
      in: mutable.Map[String, T],
      others: collection.Set[String],
      kind: String,
      otherKind: String,
      standIn: String,
      problems: Findings
  ): Option[T] =
    val name = p.strings.headOption.getOrElse("")
    in.get(name).orElse {
      val (message, help) =
        if others(name) then
          (s"`${p.name}` must be a $kind texture, but `$name` is a $otherKind texture", None)
        else (s"$kind texture `$name` is not defined", Suggest.help(name, in.keys))
      problems.unnamed(NameKind.Texture, p.valuesAt, message, standIn, help)
      None
    }

/** Materials by the names that `MakeNamedMaterial` gave them, each built on first use. */
final class NamedMaterials:
  private val recipes = mutable.LinkedHashMap.empty[String, () => Material]
  private val made = mutable.HashMap.empty[String, Material]
  private val open = mutable.HashSet.empty[String]

  def define(name: String, make: () => Material): Unit = recipes(name) = make

  /** Returns the named material. An undefined one is reported as missing; one that refers to itself
    * is an error.
    */
  def apply(name: String, at: SourcePos, resources: Resources, problems: Findings): Material =
    if open(name) then
      problems.error(at, s"material `$name` refers to itself")
      StandIns.material(resources.basis)
    else
      made.getOrElseUpdate(
        name,
        recipes.get(name) match
          case Some(make) =>
            open += name
            try make()
            finally open -= name
          case None =>
            problems.unnamed(
              NameKind.Material,
              at,
              s"material `$name` is not defined",
              StandIns.MagentaSurface,
              Suggest.help(name, recipes.keys)
            )
            StandIns.material(resources.basis)
      )
