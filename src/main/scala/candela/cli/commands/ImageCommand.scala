package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError, Severity}
import java.nio.file.Path

import candela.cli.files.{InputImages, OutputFiles}
import candela.cli.options.{MapShape, Options}
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.convert.SkyImages
import candela.image.*
import candela.job.ImageFile
import candela.lights.{EqualAreaMap, LatLongMap}

/** `candela image`: converts an image to other formats, sizes, ranges and primaries. */
final class ImageCommand(options: Options, terminal: Terminal, report: Report):
  private val imageOptions = options.image

  def run(): ExitCode = report.guarded:
    val outputs = OutputFiles.ofImages(options.outfiles)
    outputs.check(options.files, "image")
    val path = OutputFiles.path(options.files.head)
    val source = InputImages.read(path, report).premultiplied
    val result =
      try edited(source)
      catch
        case e: ImageError => throw ImageError(e.code, message(path, e))
    // As imgtool: a crop knows its place
    val isPlaced =
      imageOptions.size.isEmpty && imageOptions.environment.isEmpty && !imageOptions.flips
    val (sourceWindow, texts) = ImageFiles.about(path)
    val window = Option.when(isPlaced):
      imageOptions.crop.fold(sourceWindow): c =>
        Some(ImageWindow(c.x0, c.y0, source.width, source.height))
    .flatten
    val writeOptions =
      WriteOptions(isHalf = imageOptions.isHalf, display = options.display, window = window)
    val name = OutputFiles.sources(Vector(path))
    val about = name +: texts.filter(_._1 != name._1)
    OutputFiles.writeAll(outputs.paths): out =>
      val hasColors = OutputFormat.of(out).exists(_.contents != Contents.Channels)
      val written =
        if hasColors then ImageFiles.colored(path, ImageEdits.layerAsColors(result)) else result
      ImageFile.encoded(out, written, about, writeOptions).save()
      if !options.quiet then terminal.out.println(s"wrote $out  ${result.width}x${result.height}")
    terminal.out.flush()
    ExitCode.Done

  private def message(path: Path, e: ImageError) =
    if e.getMessage.startsWith(s"$path") then e.getMessage else s"$path: ${e.getMessage}"

  private def edited(image: Image): Image =
    val selected = imageOptions.channels.fold(image)(ImageEdits.select(image, _))
    val cropped = imageOptions.crop.fold(selected)(_.of(selected))
    val shaped = imageOptions.environment match
      case Some(shape) => environment(cropped, shape)
      case None =>
        imageOptions.size.fold(cropped): size =>
          val (w, h) = size.of(cropped.width, cropped.height)
          Resample(cropped, w, h)
    val scaled =
      if imageOptions.scale == 1f then shaped else ImageEdits.scaled(shaped, imageOptions.scale)
    val clamped = imageOptions.clamp.fold(scaled)(ImageEdits.clamped(scaled, _))
    val placed = imageOptions.colorSpace.fold(clamped)(ImageEdits.inColorSpace(clamped, _))
    if imageOptions.flips then ImageEdits.flipped(placed) else placed

  private def environment(image: Image, shape: MapShape): Image =
    val source = image.toRgb
    def fail(why: String) = throw SceneError(Problem.general(Code.ImageEdit, why))
    shape match
      case MapShape.EqualArea =>
        if source.width != 2 * source.height then
          val message =
            s"${source.width}x${source.height} pixels: a latlong map is twice as wide as high"
          report.warnings(
            Vector(Problem(Code.ImageEdit, Severity.Warning, None, message)),
            all = true
          )
        val side = imageOptions.size.fold(source.width)(_.of(1, 1)._1)
        SkyImages.resampled(source, LatLongMap, side, side, EqualAreaMap, smooth = true)
      case MapShape.LatLong =>
        if source.width != source.height then
          fail(s"an equalarea map is square, found ${source.width}x${source.height} pixels")
        val (w, h) =
          imageOptions.size.fold((2 * source.height, source.height))(_.of(2, 1))
        SkyImages.resampled(source, EqualAreaMap, w, h, LatLongMap, smooth = true)
