package candela.convert

import java.nio.file.{Files, InvalidPathException, Path}
import java.security.MessageDigest

import candela.base.{loop, Problem, SceneError, WholeFile}
import candela.color.Rgb
import candela.image.{Image, ImageError, ImageFiles}
import candela.scenefile.Param

/** Files that lie beside a written scene. They are named by what is in them: what is there already
  * under such a name is the same, or not ours to touch.
  */
final class SideFiles(val folder: Path):

  /** Puts the bytes into a file, whole or not at all; its name. */
  def add(kind: String, extension: String, bytes: Array[Byte]): String =
    val hash = MessageDigest.getInstance("SHA-256").digest(bytes)
    val name = s"$kind-${hash.take(8).map(b => f"$b%02x").mkString}.$extension"
    val path = folder.resolve(name)
    if !Files.exists(path) then WholeFile.write(path, bytes)
    else if !java.util.Arrays.equals(Files.readAllBytes(path), bytes) then
      throw SceneError(Problem.general(s"`$path` exists and holds something else"))
    name

/** Pictures written anew as EXR, with linear values, beside the scene: where the other dialect does
  * not read the format, or can't say what is to become of the numbers in the file.
  */
object Pictures:

  /** A picture with the values that its file means by itself, times a colour. */
  def asExr(s: Statement, p: Param, tint: Rgb = Rgb.White): String =
    val factors = Array(tint.r, tint.g, tint.b)
    written(s, p): image =>
      val made = image.linear.toRgb
      loop(made.data.length)(i => made.data(i) *= factors(i % 3))
      made

  /** A single pixel. */
  def plain(s: Statement, color: Rgb): String =
    val image = Image(1, 1, Image.RgbNames, Array(color.r, color.g, color.b))
    s.run.files.add("image", "exr", ImageFiles.exr(image))

  /** A picture with `change` applied to the numbers of its file (8 bits: 0 to 1), given a channel.
    */
  def baked(s: Statement, p: Param)(change: (Float, Int) => Float): String =
    written(s, p): image =>
      val sources = image.colorChannels.toArray
      val made = Image.rgb(image.width, image.height)
      loop(image.width * image.height): i =>
        loop(3): c =>
          made.data(3 * i + c) = change(image.data(image.channels * i + sources(c)), c)
      made

  /** The new file's name, or the old one after a warning. */
  private def written(s: Statement, p: Param)(change: Image => Image): String =
    val name = p.strings.head
    def failed(why: String) =
      s.warn(p.at, s"the image stays as it is, for it can't be read: $why")
      name
    try
      val image = ImageFiles.read(s.declaration.folder.resolve(name.replace('\\', '/')))
      s.run.files.add("image", "exr", ImageFiles.exr(change(image)))
    catch
      case e: ImageError => failed(e.getMessage)
      case e: InvalidPathException => failed(e.getReason)
