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

/** What statements of a scene file can refer to by name: textures, materials, and files.
  *
  * @param basis in which all colours of the scene are given to the runtime
  * @param crew  does what can be divided
  * @param seed  of random numbers that are not the sampler's
  */
final class Resources(
    val basis: ColorBasis,
    val crew: Parallel = Parallel.Alone,
    val seed: Int = 0
):
  val materials = NamedMaterials()

  /** Tables of coated materials, shared by all of them that are alike. */
  val coats = Coats()

  /** Likewise of media beneath surfaces. */
  val profiles = ProfileTables()

  private var footprints = Vector.empty[String]

  /** What asks for the footprint of a sample on a surface, in words; at first nothing. */
  def footprintUses: Vector[String] = footprints

  def footprintsInWords: String =
    if footprints.isEmpty then "none: no texture asks for them"
    else footprints.mkString("for ", ", ", "")

  /** Something of this kind asks for it, or for partial derivatives. */
  def askForFootprints(what: String): Unit =
    if !footprints.contains(what) then footprints :+= what

  private val floats = mutable.Map.empty[String, FloatTexture]
  private val colors = mutable.Map.empty[String, RgbTexture]
  private val images = mutable.Map.empty[Path, Either[String, StoredImage]]

  def define(name: String, texture: FloatTexture): Unit = floats(name) = texture
  def define(name: String, texture: RgbTexture): Unit = colors(name) = texture

  /** The texture that a parameter names; a stand-in after a problem was reported. */
  def floatTexture(p: Param, problems: Findings): Option[FloatTexture] =
    val found = lookUp(p, floats, colors.keySet, "float", "spectrum", StandIns.Ones, problems)
    Some(found.getOrElse(StandIns.number))

  /** Likewise. */
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
          (s"texture `$name` is of type $otherKind; `${p.name}` takes $kind", None)
        else (s"no $kind texture is named `$name`", Suggest.help(name, in.keys))
      problems.unnamed(NameKind.Texture, p.valuesAt, message, standIn, help)
      None
    }

  /** The file that a parameter names, relative to the scene's folder. None if it is not there,
    * which was reported.
    *
    * @param standIn what takes its place if the user asked to keep going
    */
  def file(p: Param, from: Declaration, problems: Findings, standIn: String): Option[Path] =
    val name = p.strings.headOption.getOrElse("")
    def path = from.folder.resolve(name.replace('\\', '/'))
    // some names, such as those with a zero byte, are no path's
    val found = Try(path).toOption.filter(name.nonEmpty && Files.isRegularFile(_))
    if found.isEmpty then
      problems.missing(p.valuesAt, s"no file `$name`", standIn, Suggest.file(path))
    found

  /** The picture that a parameter names, read once however often it is used. */
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

/** Materials by the names that `MakeNamedMaterial` gave them, each made when it is first asked
  * for.
  */
final class NamedMaterials:
  private val recipes = mutable.LinkedHashMap.empty[String, () => Material]
  private val made = mutable.HashMap.empty[String, Material]
  private val open = mutable.HashSet.empty[String]

  def define(name: String, make: () => Material): Unit = recipes(name) = make

  /** The material of that name. An unknown one is missing; one that is made of itself is an
    * error.
    */
  def apply(name: String, at: SourcePos, resources: Resources, problems: Findings): Material =
    if open(name) then
      problems.error(at, s"material `$name` is made of itself")
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
              s"no material is named `$name`",
              StandIns.MagentaSurface,
              Suggest.help(name, recipes.keys)
            )
            StandIns.material(resources.basis)
      )
