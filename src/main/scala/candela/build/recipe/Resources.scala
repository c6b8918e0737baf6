package candela.build.recipe

import java.nio.file.{Files, Path}

import scala.collection.mutable
import scala.util.Try

import candela.base.{Parallel, SourcePos, Suggest}
import candela.bsdf.Material
import candela.bsdf.layered.Coats
import candela.bsdf.subsurface.ProfileTables
import candela.color.ColorBasis
import candela.image.{ImageError, ImageFiles, StoredImage}
import candela.scenefile.{Declaration, NameKind, Param}
import candela.textures.{FloatTexture, RgbTexture}

/** Resources that statements of a scene file refer to: textures, materials and files.
  *
  * @param basis colour basis of the runtime scene
  * @param crew  executes divisible work
  * @param seed  random seed, except of samplers
  */
final class Resources(
    val basis: ColorBasis,
    val crew: Parallel = Parallel.Alone,
    val seed: Int = 0
):
  val materials = NamedMaterials()

  /** Tables of coated materials, shared by materials with equal parameters. */
  val coats = Coats()

  /** BSSRDF profile tables, shared by materials with equal parameters. */
  val profiles = ProfileTables()

  private var footprints = Vector.empty[String]

  /** Features that need ray differentials, for messages; initially empty. */
  def footprintUses: Vector[String] = footprints

  def footprintsInWords: String =
    if footprints.isEmpty then "none: no texture needs them"
    else footprints.mkString("for ", ", ", "")

  /** Requests ray differentials or partial derivatives for a feature. */
  def askForFootprints(what: String): Unit =
    if !footprints.contains(what) then footprints :+= what

  private val floats = mutable.Map.empty[String, FloatTexture]
  private val colors = mutable.Map.empty[String, RgbTexture]
  private val images = mutable.Map.empty[Path, Either[String, StoredImage]]

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

  /** Resolves the file that a parameter names, relative to the scene's folder. Reports a missing
    * file and returns None.
    *
    * @param standIn replacement if the user chose to keep going
    */
  def file(p: Param, from: Declaration, problems: Findings, standIn: String): Option[Path] =
    val name = p.strings.headOption.getOrElse("")
    def path = from.folder.resolve(name.replace('\\', '/'))
    // some names are not valid paths, e.g. with a zero byte
    val found = Try(path).toOption.filter(name.nonEmpty && Files.isRegularFile(_))
    if found.isEmpty then
      problems.missing(p.valuesAt, s"no file `$name`", standIn, Suggest.file(path))
    found

  /** Loads the image that a parameter names; images are cached. */
  def image(
      p: Param,
      from: Declaration,
      problems: Findings,
      standIn: String = StandIns.Magentas
  ): Option[StoredImage] =
    file(p, from, problems, standIn).flatMap: path =>
      val read = images.getOrElseUpdate(
        path.toAbsolutePath.normalize,
        try Right(ImageFiles.load(path))
        catch case e: ImageError => Left(e.getMessage)
      )
      read match
        case Right(image) => Some(image)
        case Left(message) =>
          problems.missing(p.valuesAt, message, standIn)
          None

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
