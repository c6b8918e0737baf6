package candela.cli.options

import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.settings.{RenderRegion, RenderSettings}

import scopt.OParser

/** Rows of the option table that pbrt-v4's command line has, too. Each call makes new rows: scopt
  * gives a row one parent.
  */
private[cli] object SwitchTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.opt

  private def flag(name: String, text: String)(change: RenderSettings => RenderSettings): Row =
    opt[Unit](name).text(text).action(set((_, s) => change(s)))

  def render: Vector[Row] = Vector(
    opt[RenderRegion.Pixels]("pixelbounds").valueName("x0,x1,y0,y1")
      .text("render only these pixels; x1 and y1 are excluded")
      .action(setRegion),
    opt[RenderRegion.Pixel]("pixelmaterial").valueName("x,y")
      .text("print what the centre of the pixel shows; writes no image")
      .action((p, o) => o.copy(pixelMaterial = Some((p.x, p.y)))),
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
    opt[GuidingMode]("guiding").valueName("auto|on|off")
      .text(OptionText(
        "path guiding: where it reduces noise (auto), everywhere (on), off " +
          "(default: auto with --time or --error, else off)",
        "`path` and `volpath` learn incident light, on surfaces and in media, from a quarter of " +
          "the samples. A guided sample takes 1.2 to 16 times as long, with less noise, so " +
          "compare by time or error: [measurements](decisions/0020-path-guiding.md)."
      ))
      .action(set((mode, s) => s.copy(guiding = Some(mode)))),
    opt[CausticsMode]("caustics").valueName("auto|on|off|photons")
      .text(OptionText(
        "look for caustics, on surfaces and in media: by light paths, and by paths that photons " +
          "guide or walks complete, where these reduce the noise (auto); also for those of " +
          "delta lights (on); by photon maps, which blur them and thick fog a little " +
          "(photons); or not (off, default with a number of samples)",
        "`auto` is the default with `--time` and `--error`. [What it brings](CAUSTICS.md)."
      ))
      .action(set((mode, s) => s.copy(caustics = Some(mode)))),
    flag("force-diffuse", "make all materials diffuse")(_.copy(diffuse = true)),
    opt[Double]("displacement-edge-scale").valueName("X")
      .text("scale of the edge length of displaced meshes (default 1)")
      .validate(positive("displacement-edge-scale"))
      .action(set((x, s) => s.copy(edgeScale = Some(x.toFloat)))),
    opt[String]("mse-reference-image").valueName("FILE")
      .text("reference image for --mse-reference-out, which it needs")
      .action(setOutput((f, w) => w.copy(reference = Some(f)))),
    opt[String]("mse-reference-out").valueName("FILE")
      .text("write the MSE at 1, 2, 4, 8, ... samples per pixel, one line each")
      .action(setOutput((f, w) => w.copy(errors = Some(f)))),
    opt[Unit]("write-partial-images")
      .text("write the image at 1, 2, 4, 8, ... samples per pixel, too")
      .action((_, o) => o.copy(partialImages = true))
  )

  /** Was it asked for? A goal that chooses it can't be divided itself, and is refused as such. */
  private def guides(s: RenderSettings): Boolean = s.guiding.exists(_ != GuidingMode.Off)

  /** What is wrong with the options of `render`, if anything. */
  def problem(o: Options): Option[String] =
    val s = o.settings
    val isPixel = s.region match
      case RenderRegion.Pixel(_, _) => true
      case _ => false
    if s.output.reference.isDefined != s.output.errors.isDefined then
      Some("--mse-reference-image and --mse-reference-out must be given together")
    else if s.output.errors.isDefined && o.files.size > 1 then
      Some("--mse-reference-out needs a single scene, found several")
    else if guides(s) && !o.film.shard.isWhole then
      Some("--guiding can't be divided by --shard: paths learn from those of all samples")
    else if guides(s) && o.cluster.master.isDefined then
      Some("--guiding can't be divided by --spark: paths learn from those of all samples")
    else if o.debug && !isPixel then Some("--debug needs --pixel x,y")
    else if o.regions.size > 1 then
      Some("only one of --cropwindow, --pixelbounds and --pixel can be given")
    else None
