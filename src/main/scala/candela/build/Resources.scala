package candela.build

import java.nio.file.{Files, Path}

import scala.collection.mutable

import candela.base.Suggest
import candela.bsdf.Coats
import candela.color.ColorBasis
import candela.image.{ImageError, ImageFiles, StoredImage}
import candela.scenefile.{Declaration, Param}
import candela.textures.{FloatTexture, RgbTexture}

/** What statements of a scene file can refer to by name: textures, and files.
  *
  * @param basis in which all colours of the scene are given to the runtime
  */
final class Resources(val basis: ColorBasis):
  /** Tables of coated materials, shared by all of them that are alike. */
  val coats = Coats()

  private val floats = mutable.Map.empty[String, FloatTexture]
  private val colors = mutable.Map.empty[String, RgbTexture]
  private val images = mutable.Map.empty[Path, Either[String, StoredImage]]

  def define(name: String, texture: FloatTexture): Unit = floats(name) = texture
  def define(name: String, texture: RgbTexture): Unit = colors(name) = texture

  def floatTexture(p: Param, problems: Findings): Option[FloatTexture] =
    lookUp(p, floats, colors.keySet, "float", "spectrum", problems)

  def rgbTexture(p: Param, problems: Findings): Option[RgbTexture] =
    lookUp(p, colors, floats.keySet, "spectrum", "float", problems)

  private def lookUp[T](
      p: Param,
      in: mutable.Map[String, T],
      others: collection.Set[String],
      kind: String,
      otherKind: String,
      problems: Findings
  ): Option[T] =
    val name = p.strings.headOption.getOrElse("")
    in.get(name).orElse {
      if others(name) then
        problems.error(
          p.valuesAt,
          s"texture `$name` is of type $otherKind; `${p.name}` takes $kind"
        )
      else
        problems.error(
          p.valuesAt,
          s"no $kind texture is named `$name`",
          Suggest.help(name, in.keys)
        )
      None
    }

  /** The file that a parameter names, relative to the scene's folder. An absent one is an error. */
  def file(p: Param, from: Declaration, problems: Findings): Option[Path] =
    val name = p.strings.headOption.getOrElse("")
    val path = from.folder.resolve(name.replace('\\', '/'))
    if name.nonEmpty && Files.isRegularFile(path) then Some(path)
    else
      val siblings = Option(path.getParent).filter(Files.isDirectory(_)).toVector.flatMap: folder =>
        val listing = Files.list(folder)
        try listing.toArray.toVector.map(_.asInstanceOf[Path].getFileName.toString)
        finally listing.close()
      val near = Suggest.nearest(path.getFileName.toString, siblings)
      problems.error(p.valuesAt, s"no file `$name`", near.map(n => s"did you mean `$n`?"))
      None

  /** The picture that a parameter names, read once however often it is used. */
  def image(p: Param, from: Declaration, problems: Findings): Option[StoredImage] =
    file(p, from, problems).flatMap: path =>
      val read = images.getOrElseUpdate(
        path.toAbsolutePath.normalize,
        try Right(ImageFiles.load(path))
        catch case e: ImageError => Left(e.getMessage)
      )
      read match
        case Right(image) => Some(image)
        case Left(message) =>
          problems.error(p.valuesAt, message)
          None
