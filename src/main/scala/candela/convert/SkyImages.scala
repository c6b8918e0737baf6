package candela.convert

import candela.base.loop
import candela.diagnostics.Code
import candela.color.Rgb
import candela.io.InputFile
import candela.image.{Image, ImageError, ImageFiles}
import candela.lights.{EqualAreaMap, IesError, IesFile, LatLongMap, SphereMap}
import candela.scenefile.Param

/** Converts environment maps: equirectangular in v2 and v3, square equal-area in v4. pbrt-v2 and v3
  * interpolate between their pixels, v4 does not; so small ones are enlarged for v4.
  */
object SkyImages:

  /** Writes the environment map named by `p` for the target dialect; returns its name, or, after a
    * warning, that of the original if it can't be read.
    *
    * @param tint factor of its colours
    */
  def converted(p: Param, s: Statement, toSquare: Boolean, tint: Rgb): String =
    val name = p.strings.head
    try
      val file = RewrittenImages.file(s, p)
      val kind = if toSquare then "equalarea" else "latlong"
      s.run.files.reused((file.path, s.run.pass.from, s.name, tint)):
        val image = environment(file, name, s, toSquare)
        val tinted = if tint == Rgb.White then image else times(image, tint)
        s.run.files.add(kind, "exr", ImageFiles.exr(tinted))
    catch
      case e: (ImageError | IesError) =>
        val loss = if tint == Rgb.White then "" else ", without the colour of its light"
        s.warn(
          Code.UnconvertedImage,
          p.pos,
          s"can't convert the image, leaving it unchanged$loss: ${e.getMessage}"
        )
        name

  private def environment(file: InputFile, name: String, s: Statement, toSquare: Boolean): Image =
    val isPhotometry = IesFile.isNamed(name)
    val colors =
      if isPhotometry then IesFile.read(file).photometry.image
      else RewrittenImages.lightImage(ImageFiles.load(file).toImage, name, s)
    // v4's goniometric lights take the mean of the channels
    val source = if s.name == "goniometric" && !toSquare then averaged(colors) else colors
    if isPhotometry && !toSquare then
      val width = Math.max(source.width, 360)
      resampled(source, LatLongMap, width, source.height, LatLongMap, smooth = true)
    else if toSquare then
      val side = Math.min(Math.max(2 * source.height, RewrittenImages.SmoothSize), 4096)
      resampled(source, LatLongMap, side, side, EqualAreaMap, smooth = true)
    else if source.width == 2 * source.height then source
    else
      val height = Math.min(source.height, 4096)
      resampled(source, EqualAreaMap, 2 * height, height, LatLongMap, smooth = false)

  /** Each pixel averages the source over the pixel's directions.
    *
    * @param smooth whether to interpolate the source bilinearly instead of reading its nearest
    *   pixel
    */
  def resampled(
      source: Image,
      from: SphereMap,
      width: Int,
      height: Int,
      to: SphereMap,
      smooth: Boolean
  ): Image =
    val result = Image.rgb(width, height)
    val sum = new Array[Double](3)
    // Fewer where the source varies little within a pixel
    val across = Math.max(1, Math.min(SamplesAcross, 2 * SamplesAcross * source.height / height))
    loop(height): y =>
      loop(width): x =>
        java.util.Arrays.fill(sum, 0.0)
        loop(across): j =>
          loop(across): i =>
            val d =
              to.toDirection(
                (x + (i + 0.5f) / across) / width,
                (y + (j + 0.5f) / across) / height
              )
            val position = from.toImage(d)
            if smooth then bilinear(source, from, position.x, position.y, sum)
            else nearest(source, position.x, position.y, sum)
        loop(3)(c =>
          result.data((y * width + x) * 3 + c) = (sum(c) / (across * across)).toFloat
        )
    result

  /** Samples per pixel along each axis, at most. */
  private val SamplesAcross = 4

  private def nearest(image: Image, x: Float, y: Float, sum: Array[Double]): Unit =
    val px = Math.min((x * image.width).toInt, image.width - 1)
    val py = Math.min((y * image.height).toInt, image.height - 1)
    loop(3)(c => sum(c) += image(px, py, c))

  private def bilinear(image: Image, map: SphereMap, x: Float, y: Float, sum: Array[Double]): Unit =
    val (fx, fy) = (x * image.width - 0.5f, y * image.height - 0.5f)
    val (x0, y0) = (Math.floor(fx.toDouble).toInt, Math.floor(fy.toDouble).toInt)
    val (dx, dy) = (fx - x0, fy - y0)
    loop(4): k =>
      val (px, py) = (x0 + (k & 1), y0 + (k >> 1))
      val weight = (if (k & 1) == 1 then dx else 1 - dx) * (if k > 1 then dy else 1 - dy)
      val wx = map.wrapX(px, py, image.width, image.height)
      val wy = map.wrapY(px, py, image.width, image.height)
      loop(3)(c => sum(c) += weight * image(wx, wy, c))

  private def averaged(image: Image): Image =
    val data = image.data.clone
    loop(data.length / 3): i =>
      val mean = (data(3 * i) + data(3 * i + 1) + data(3 * i + 2)) / 3f
      java.util.Arrays.fill(data, 3 * i, 3 * i + 3, mean)
    Image(image.width, image.height, image.channelNames, data)

  private def times(image: Image, tint: Rgb): Image =
    val factors = Array(tint.r, tint.g, tint.b)
    val data = image.data.clone
    loop(data.length)(i => data(i) *= factors(i % 3))
    Image(image.width, image.height, image.channelNames, data)
