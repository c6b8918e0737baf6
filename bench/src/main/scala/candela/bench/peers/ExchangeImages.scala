package candela.bench.peers

import candela.convert.{SideFiles, SkyImages}
import candela.image.{Image, ImageError, ImageFiles}
import candela.lights.{EqualAreaMap, PolarLatLongMap}
import candela.math.clamp
import candela.scenefile.{Declaration, Param}

/** Images as linear EXR, beside each the same as PFM, which scripts read without a library. */
private[peers] object ExchangeImages:

  /** The reflectances of an image texture. */
  def texture(d: Declaration, files: SideFiles, values: ExchangeValues): String =
    val scale = values.number(d, "scale", 1f)
    val inverts = d.param("invert").exists(_.bools.contains(true))
    val encoding = d.param("encoding").flatMap(_.strings.headOption).getOrElse("sRGB")
    written(d, d.param("filename"), files, values): stored =>
      val linear = encoding.split(' ').toVector match
        case Vector("sRGB") => stored.linear.toRgb
        case Vector("linear") =>
          Image(stored.width, stored.height, stored.channelNames, stored.data).toRgb
        case _ =>
          values.reject(s"image encoding `$encoding`")
          stored.linear.toRgb
      val data = linear.data.map: x =>
        val scaled = x * scale
        clamp(if inverts then 1f - scaled else scaled, 0f, 1f)
      Image(linear.width, linear.height, linear.channelNames, data)

  /** A map by latitude and longitude, in Mitsuba's rows, of pbrt-v4's equal-area one. */
  def sky(d: Declaration, p: Param, files: SideFiles, values: ExchangeValues): String =
    written(d, Some(p), files, values): stored =>
      val source = stored.linear.toRgb
      val height = Math.min(source.height, MaxRows)
      val to = PolarLatLongMap(height)
      SkyImages.resampled(source, EqualAreaMap, 2 * height, height, to, smooth = false)

  private val MaxRows = 2048

  private def written(
      d: Declaration,
      name: Option[Param],
      files: SideFiles,
      values: ExchangeValues
  )(change: Image => Image): String =
    val imageFile =
      name.flatMap(p => p.strings.headOption.flatMap(d.folder.locate(_, Some(p.valuesAt))))
    imageFile match
      case None =>
        values.reject(s"image of ${values.statement(d)}")
        ""
      case Some(file) =>
        try
          val image = change(ImageFiles.load(file).toImage)
          val exr = files.add("image", "exr", ImageFiles.exr(image))
          ImageFiles.write(files.folder.resolve(exr.stripSuffix("exr") + "pfm"), image)
          exr
        catch
          case e: ImageError =>
            values.reject(e.getMessage)
            ""
