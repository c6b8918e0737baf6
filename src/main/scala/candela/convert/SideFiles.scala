package candela.convert

import candela.base.loop
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{InputFile, SceneFolder, WholeFile}
import java.nio.file.{Files, Path}
import java.security.MessageDigest
import java.util.{Arrays, Locale}

import scala.collection.mutable
import scala.util.Try

import candela.color.{Encoding, Rgb}
import candela.image.{Image, ImageError, ImageFiles}
import candela.lights.{Picture, PictureLookup}
import candela.scenefile.{Declaration, Dialect, Param}

/** Files that accompany an output scene, named by a hash of their content: an existing file of that
  * name is either equal, or not ours to overwrite.
  *
  * @param check called with each file before it is written
  */
final class SideFiles(val folder: Path, check: Path => Unit = _ => ()):
  private var created = Vector.empty[Path]
  private val rewritten = mutable.HashMap.empty[Any, String]

  /** Writes the bytes to a file atomically; returns its name. */
  def add(kind: String, extension: String, bytes: Array[Byte]): String =
    val hash = MessageDigest.getInstance("SHA-256").digest(bytes)
    val name = s"$kind-${hash.take(8).map("%02x".formatLocal(Locale.ROOT, _)).mkString}.$extension"
    val path = folder.resolve(name)
    if !Files.exists(path) then
      check(path)
      WholeFile.write(path, bytes)
      created :+= path
    else if !Files.isRegularFile(path) || !Arrays.equals(Files.readAllBytes(path), bytes) then
      throw SceneError(Problem.general(Code.SideFile, s"`$path` exists with different content"))
    name

  /** The name of what `make` adds, which is made once for equal keys. */
  def reused(key: Any)(make: => String): String = rewritten.getOrElseUpdate(key, make)

  /** Deletes what has been created. */
  def undo(): Unit =
    for path <- created do
      val _ = Files.deleteIfExists(path)
    created = Vector.empty
    rewritten.clear()

  /** Deletes what has been created if `body` fails. */
  def completing[A](body: => A): A =
    var isDone = false
    try
      val result = body
      isDone = true
      result
    finally if !isDone then undo()

/** Rewrites images as linear EXR beside the scene, if the target dialect can't read the format or
  * express the processing of the stored values.
  */
object RewrittenImages:

  /** The slide of a projector, linear, times a colour. pbrt-v2 and v3 interpolate between its
    * pixels, v4 does not; so a small image is enlarged, as its own dialect shows it.
    */
  def slide(s: Statement, p: Param, lookup: PictureLookup, tint: Rgb = Rgb.White): String =
    written(s, p, (lookup, tint)): image =>
      val picture = Picture(lightImage(image, name(p), s), lookup)
      val times = Math.max(1, SmoothSize / Math.max(image.width, image.height))
      val enlarged = Image.rgb(image.width * times, image.height * times)
      loop(enlarged.width * enlarged.height): i =>
        val x = (i % enlarged.width + 0.5f) / enlarged.width
        val y = (i / enlarged.width + 0.5f) / enlarged.height
        val color = picture(x, y) * tint
        enlarged.data(3 * i) = color.r
        enlarged.data(3 * i + 1) = color.g
        enlarged.data(3 * i + 2) = color.b
      enlarged

  /** The image of a light as its dialect shows it: pbrt-v2 and v3 do not decode files of 8 bits,
    * and v2 reads the rows of TGA files from below.
    */
  def lightImage(image: Image, name: String, s: Statement): Image =
    if s.run.pass.from == Dialect.V4 then image.linear.toRgb
    else
      val stored = Image(image.width, image.height, image.channelNames, image.data).toRgb
      val isFromBelow =
        s.run.ends._1 == Dialect.V2 && name.toLowerCase(Locale.ROOT).endsWith(".tga")
      if isFromBelow then stored.upsideDown else stored

  private def name(p: Param): String = p.strings.head.replace('\\', '/')

  /** Pixels along the longer side: steps between them are hardly seen. */
  val SmoothSize = 1024

  /** An image of a single pixel. */
  def plain(s: Statement, color: Rgb): String =
    val image = Image(1, 1, Image.RgbNames, Array(color.r, color.g, color.b))
    s.run.files.add("image", "exr", ImageFiles.exr(image))

  /** Whether v3, which takes all colours for sRGB, would misread the image. */
  def hasOtherPrimaries(s: Statement, p: Param): Boolean =
    Try(!ImageFiles.load(file(s, p)).toImage.colorSpace.isSrgb).getOrElse(false)

  /** The file that a parameter names.
    *
    * @throws ImageError if there is none
    */
  def file(s: Statement, p: Param): InputFile = file(s.declaration.folder, p)

  def file(folder: SceneFolder, p: Param): InputFile =
    folder.locate(p.strings.head, Some(p.valuesAt)).getOrElse:
      if SceneFolder.isName(p.strings.head) then
        throw ImageError(Code.NoSuchFile, s"${folder.path.resolve(name(p))}: there is no such file")
      else throw ImageError(Code.UnconvertedImage, "the name is not valid")

  /** The image with `change` applied to its stored values (8 bits: 0 to 1) and their channel,
    * in sRGB.
    *
    * @param way what `change` depends on
    */
  def baked(s: Statement, p: Param, way: Any)(change: (Float, Int) => Float): String =
    written(s, p, way): stored =>
      val image = if stored.colorSpace.isSrgb then stored else stored.toReflectances
      val sources = image.colorChannels.toArray
      val result = Image.rgb(image.width, image.height)
      loop(image.width * image.height): i =>
        loop(3): c =>
          result.data(3 * i + c) = change(image.data(image.channels * i + sources(c)), c)
      result

  /** A float texture's image as numbers, if it has colours: v3 takes their luminance, v4 their
    * mean.
    *
    * @param way what `number`, of stored values, depends on
    */
  def numbers(s: Statement, p: Param, way: Any)(number: Rgb => Float): Option[String] =
    Option.when(isColored(s.declaration, p)):
      written(s, p, ("numbers", way)): image =>
        val colors = stored(image)
        val result = Image.rgb(image.width, image.height)
        loop(image.width * image.height): i =>
          val x = number(Rgb(colors(3 * i), colors(3 * i + 1), colors(3 * i + 2)))
          java.util.Arrays.fill(result.data, 3 * i, 3 * i + 3, x)
        result

  /** As numbers of linear values, or of the stored ones. */
  def luminances(d: Declaration, p: Param, isRaw: Boolean, files: SideFiles): String =
    val source = file(d.folder, p)
    files.reused((source.path, "luminances", isRaw)):
      val image = ImageFiles.load(source).toImage
      val colors = if isRaw then stored(image) else image.linear.toRgb.data
      val result = Image.rgb(image.width, image.height)
      loop(image.width * image.height): i =>
        val y = Rgb(colors(3 * i), colors(3 * i + 1), colors(3 * i + 2)).luminance
        java.util.Arrays.fill(result.data, 3 * i, 3 * i + 3, y)
      files.add("image", "exr", ImageFiles.exr(result))

  /** Whether some pixel is not grey; not if the image can't be read. */
  def isColored(d: Declaration, p: Param): Boolean =
    Try(stored(ImageFiles.load(file(d.folder, p)).toImage)).toOption.exists: colors =>
      colors.indices.by(3).exists(i => colors(i) != colors(i + 1) || colors(i) != colors(i + 2))

  private def stored(image: Image) =
    Image(image.width, image.height, image.channelNames, image.data).toRgb.data

  /** The stored values as linear ones, unless the file is PNG, for which scenes name the encoding,
    * or linear as it is: name of the file, or why it can't be read.
    */
  def raw(folder: SceneFolder, p: Param, files: SideFiles): Either[String, String] =
    val name = p.strings.head
    if name.toLowerCase(Locale.ROOT).endsWith(".png") then Right(name)
    else
      try
        val image = ImageFiles.load(file(folder, p)).toImage
        Right(
          if image.encoding == Encoding.Linear then name
          else files.add("image", "exr", ImageFiles.exr(plain(image)))
        )
      catch case e: ImageError => Left(e.getMessage)

  private def plain(i: Image): Image = Image(i.width, i.height, i.channelNames, i.data)

  /** Name of the new file; of the old one, after a warning, if it can't be read. */
  private def written(s: Statement, p: Param, way: Any)(change: Image => Image): String =
    val name = p.strings.head
    def failed(reason: String) =
      s.warn(Code.UnconvertedImage, p.pos, s"can't read the image, leaving it unchanged: $reason")
      name
    try
      val from = file(s, p)
      s.run.files.reused((from.path, s.run.pass.from, way)):
        val image = ImageFiles.load(from).toImage
        s.run.files.add("image", "exr", ImageFiles.exr(change(image)))
    catch case e: ImageError => failed(e.getMessage)
