package candela.cli

import candela.build.recipe.Switches
import candela.guiding.GuidingMode

import scopt.{OParser, Read}

/** Part of the image to render, in pixels; x1 and y1 are excluded. */
final case class PixelRange(x0: Int, x1: Int, y0: Int, y1: Int)

/** Rows of the option table that pbrt-v4's command line has, too. Each call makes new rows: scopt
  * gives a row one parent.
  */
private[cli] object SwitchTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.opt

  private given Read[PixelRange] = Read.reads: text =>
    text.split(",", -1).map(_.trim.toIntOption) match
      case Array(Some(x0), Some(x1), Some(y0), Some(y1)) if x0 < x1 && y0 < y1 =>
        PixelRange(x0, x1, y0, y1)
      case _ =>
        throw IllegalArgumentException("expected x0,x1,y0,y1 with x0 < x1 and y0 < y1, in pixels")

  private given Read[GuidingMode] = Read.reads: text =>
    GuidingMode.values
      .find(_.toString.equalsIgnoreCase(text))
      .getOrElse(throw IllegalArgumentException("expected auto, on, off, directions or splitting"))

  private def change(o: Options)(f: Switches => Switches): Options =
    o.copy(switches = f(o.switches))

  private def flag(name: String, text: String)(set: Switches => Switches): Row =
    opt[Unit](name).text(text).action((_, o) => change(o)(set))

  def render(point: Read[(Int, Int)]): Vector[Row] = Vector(
    opt[PixelRange]("pixelbounds").valueName("x0,x1,y0,y1")
      .text("render only these pixels; x1 and y1 are excluded")
      .action((w, o) => o.copy(pixels = Some(w))),
    opt[(Int, Int)]("pixelmaterial")(using point).valueName("x,y")
      .text("print what the centre of the pixel shows; writes no image")
      .action((p, o) => o.copy(pixelMaterial = Some(p))),
    flag(
      "disable-pixel-jitter",
      "take all samples at the pixel centre, and the middle of the lens"
    )(
      _.copy(centers = true)
    ),
    flag("disable-texture-filtering", "point-sample textures")(_.copy(unfiltered = true)),
    flag("disable-image-textures", "replace image textures by their mean")(
      _.copy(meanImages = true)
    ),
    flag(
      "disable-wavelength-jitter",
      "take the same wavelengths for all samples, if rendering is spectral; colours are off"
    )(_.copy(oneColorSet = true)),
    opt[GuidingMode]("guiding").valueName("auto|on|off|directions|splitting")
      .text(
        "let paths learn where light comes from: where it pays, everywhere, or not at all " +
          "(default); or everywhere by one technique alone"
      )
      .action((mode, o) => change(o)(_.copy(guiding = mode))),
    flag("force-diffuse", "make all materials diffuse")(_.copy(diffuse = true)),
    opt[Double]("displacement-edge-scale").valueName("X")
      .text("scale of the edge length of displaced meshes (default 1)")
      .validate(positive("displacement-edge-scale"))
      .action((x, o) => change(o)(_.copy(edgeScale = Some(x.toFloat)))),
    opt[String]("mse-reference-image").valueName("FILE")
      .text("reference image for --mse-reference-out")
      .action((f, o) => change(o)(_.copy(reference = Some(f)))),
    opt[String]("mse-reference-out").valueName("FILE")
      .text("write the MSE at 1, 2, 4, 8, ... samples per pixel, one line each")
      .action((f, o) => change(o)(_.copy(errors = Some(f)))),
    opt[Unit]("write-partial-images")
      .text("write the image at 1, 2, 4, 8, ... samples per pixel, too")
      .action((_, o) => o.copy(partialImages = true))
  )

  /** What is wrong with the options of `render`, if anything. */
  def problem(o: Options): Option[String] =
    val s = o.switches
    if s.reference.isDefined != s.errors.isDefined then
      Some("--mse-reference-image and --mse-reference-out must be given together")
    else if s.errors.isDefined && o.files.size > 1 then
      Some("--mse-reference-out needs a single scene, found several")
    else if s.guiding != GuidingMode.Off && !o.film.shard.isWhole then
      Some("--guiding can't be divided by --shard: paths learn from those of all samples")
    else if s.guiding != GuidingMode.Off && o.cluster.master.isDefined then
      Some("--guiding can't be divided by --spark: paths learn from those of all samples")
    else if o.debug && o.pixel.isEmpty then Some("--debug needs --pixel x,y")
    else if Vector(o.cropWindow, o.pixels, o.pixel).count(_.isDefined) > 1 then
      Some("only one of --cropwindow, --pixelbounds and --pixel can be given")
    else None

  /** The options as a command line. */
  def words(o: Options): Vector[String] =
    val s = o.switches
    val flags = Vector(
      "disable-pixel-jitter" -> s.centers,
      "disable-texture-filtering" -> s.unfiltered,
      "disable-image-textures" -> s.meanImages,
      "disable-wavelength-jitter" -> s.oneColorSet,
      "force-diffuse" -> s.diffuse
    )
    flags.collect { case (name, true) => s"--$name" } ++
      Option.when(s.guiding != GuidingMode.Off):
        Vector("--guiding", s.guiding.toString.toLowerCase)
      .toVector.flatten ++
      s.edgeScale.toVector.flatMap(x => Vector("--displacement-edge-scale", x.toString)) ++
      o.pixels.toVector.flatMap: w =>
        Vector("--pixelbounds", s"${w.x0},${w.x1},${w.y0},${w.y1}")
      ++ o.pixel.toVector.flatMap((x, y) => Vector("--pixel", s"$x,$y"))
