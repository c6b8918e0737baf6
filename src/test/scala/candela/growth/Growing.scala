package candela.growth

import candela.scenefile.Dialect

import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_8}
import java.nio.file.{Files, Path}

/** A scene of any number of one thing.
  *
  * @param name    of the thing
  * @param size    the number from which on growth is measured
  * @param isFaulty whether the scene has errors, whose messages may take time, too
  * @param defines values of `$NAME`, for so many
  * @param suffix  of a model's file, whose characters are bytes
  * @param text    the scene with so many; its files are written to the folder
  */
final case class Growing(
    name: String,
    dialect: Dialect,
    size: Int = 250,
    isFaulty: Boolean = false,
    defines: Int => Map[String, String] = _ => Map.empty,
    suffix: Option[String] = None
)(text: (Path, Int) => String):

  /** Writes the scene to the folder. */
  def write(folder: Path, count: Int): Path =
    val usual = if dialect == Dialect.Mitsuba then "xml" else "pbrt"
    val encoding = if suffix.isEmpty then UTF_8 else ISO_8859_1
    val file = folder.resolve(s"scene.${suffix.getOrElse(usual)}")
    Files.writeString(file, text(folder, count), encoding)

object Growing:
  val rows: Vector[Growing] =
    GrowingRecipes.rows ++ GrowingPbrt.rows ++ GrowingLanguage.rows ++ GrowingMitsuba.rows ++
      GrowingModels.rows

  /** Different for each of 0 until `count`, below 1. */
  def share(i: Int, count: Int): Double = (i + 1.0) / (count + 1)

  /** A point of a square. */
  def spot(i: Int, count: Int): String =
    val side = Math.ceil(Math.sqrt(count)).toInt
    s"${4.0 * (i % side) / side - 2} ${4.0 * (i / side) / side - 2} ${0.1 * share(i, count)}"
