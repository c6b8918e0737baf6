package candela.settings

import candela.aov.Layer
import candela.color.ToneCurve
import candela.image.{Contents, DisplayTransform, OutputFormat}
import candela.settings.Setting.*

/** All settings, a row each: command lines, film files and the library read them here. */
object SettingsTable:
  private type S = RenderSettings

  private def write(s: S)(f: OutputSettings => OutputSettings): S = s.copy(output = f(s.output))
  private def display(s: S)(f: DisplayTransform => DisplayTransform): S =
    write(s)(o => o.copy(display = f(o.display)))
  private def parse(s: S)(f: ReadSettings => ReadSettings): S = s.copy(reading = f(s.reading))
  private def model(s: S)(f: ModelSettings => ModelSettings): S =
    parse(s)(r => r.copy(model = f(r.model)))
  private def state(s: S)(f: ModelState => ModelState): S =
    model(s)(m => m.copy(state = f(m.state)))
  private def aim(s: S)(f: RenderGoal => RenderGoal): S = s.copy(goal = f(s.goal))

  private type Layers = Vector[(Layer, Option[Boolean])]

  private def storedLayers(s: S): Layers =
    s.layers.map(layer => layer -> s.output.precisions.get(layer))

  private given TextForm[Layers] =
    val layer = TextForm.layer
    TextForm.ofItems(
      layer.expected,
      layer.read,
      (all: Layers) => all.map(layer.format).mkString(",")
    ) { case all => all }

  /** Of pbrt-v4's films. */
  private val filmLayers: TextForm[Vector[Layer]] =
    val names = Layer.films.keys.toVector.sorted
    TextForm(names.mkString(" or "), Layer.films.get, _ => "")

  private val pictures = OutputFormat.listed(Contents.Display)
  private val curves = ToneCurve.values.toVector

  /** Digests of films depend on the order of those with identity: a new one comes last of these. */
  val all: Vector[Setting] = Vector(
    option("spp", "N", "samples per pixel; overrides the scene")(_.samples)((s, n) =>
      s.copy(samples = Some(n))
    )(using TextForm.int.filter("at least 1")(_ >= 1)).withoutIdentity,
    option(
      "time",
      "TIME",
      "end after this rendering time, e.g. 90s, 10m or 2h; --spp N is then a maximum"
    )(_.goal.time)((s, t) => aim(s)(_.copy(time = Some(t))))(using TextForm.seconds).withoutIdentity
      .explained(
        "Starting, preparing the scene and writing don't count. With `--error`, whichever comes " +
          "first ends it: [time and error](NOISE.md#time-and-error)."
      ),
    option(
      "error",
      "X",
      "end when the relative error is expected to be below X, e.g. 2% or 0.02; the error is " +
        "estimated from the noise, or measured with --report and --reference; --spp N is then a " +
        "maximum"
    )(_.goal.error)((s, x) => aim(s)(_.copy(error = Some(x))))(using TextForm.share).withoutIdentity
      .explained("[How the error is estimated](NOISE.md)."),
    value("seed", "N", "random seed (default 0)")(_.seed)((s, n) => s.copy(seed = n))(using
      TextForm.int
    ),
    flag(
      "quick",
      "draft: a quarter of the width and height, unless --resolution is given, and one sample " +
        "per pixel, unless --spp is"
    )(_.quick)(
      _.copy(quick = true)
    ),
    region(
      "cropwindow",
      "x0,x1,y0,y1",
      "render only this window, in fractions of width and height"
    ) { case w: RenderRegion.Window => w },
    value(
      "aov",
      "LAYER[,LAYER]",
      s"add AOVs to the ${OutputFormat.listed(Contents.Channels)} image: " +
        Layer.values.map(_.word).mkString(", ") +
        "; LAYER:half and LAYER:float select its precision"
    )(storedLayers)((s, layers) => s.adding(layers)).repeatable
      .explained("[All layers](LAYERS.md)."),
    option(
      "light-groups",
      "statement|type|NAME=LIGHT[+LIGHT],…",
      "groups of the layer lights, which is added: each light statement (default), each type, " +
        "or named groups of statements (point_12: type and line) and types"
    )(_.lightGroups)((s, g) => s.copy(lightGroups = Some(g)))
      .implying(s => s.copy(layers = (s.layers :+ Layer.Lights).distinct))
      .explained("For example `key=point_12+spot_14,sky=infinite`."),
    shorthand("film", "gbuffer|rgba", "add all AOVs of pbrt-v4's gbuffer film, or alpha")(
      (s, layers: Vector[Layer]) => s.copy(layers = s.layers ++ layers)
    )(using filmLayers)
      .explained("PNG and TGA images have the alpha, too."),
    flag(
      "denoise",
      "add the image denoised by Open Image Denoise; .png and .jpg show it " +
        s"(layers ${Layer.denoising.map(_.word).mkString(" and ")} are added, too)"
    )(_.output.denoise)(write(_)(_.copy(denoise = true))).implying(_.denoised)
      .explained("[How to install Open Image Denoise](DENOISING.md)."),
    option("dialect", "v2|v3|v4", "parse the scene as this pbrt version (default: auto-detected)")(
      _.reading.dialect
    )((s, d) => parse(s)(_.copy(dialect = Some(d)))),
    list(
      "define",
      "NAME=VALUE",
      "set $NAME in the scene's files and in that of --camera; also -DNAME=VALUE"
    )(
      _.reading.defines.toVector.sorted
    )((s, d) => parse(s)(r => r.copy(defines = r.defines + d)))(using TextForm.definition)
      .repeatable.short('D')
      .explained("In a sequence, `%d` in a value is the frame's number: " +
        "[a turntable](guide/13-recipes.md#turntable)."),
    flag("keep-going", "replace missing files and types with placeholders, with a warning each")(
      _.reading.keepGoing
    )(parse(_)(_.copy(keepGoing = true))).explained(
      "Missing or unreadable images, textures and materials become magenta (float textures 1), " +
        "meshes and objects are dropped, includes are skipped; the last line counts these " +
        "placeholders."
    ),
    value(
      "color",
      "auto|rgb|spectral",
      "render RGB or sampled wavelengths (default auto: RGB where it is accurate)"
    )(_.color)((s, c) => s.copy(color = c))
      .explained("`auto` uses RGB where its error is below half a percent."),
    option(
      "sampler",
      PointChoice.all.map(_.word).mkString("|"),
      "sample points: those with the least noise (best, the default), the scene's own, or these"
    )(_.points)((s, p) => s.copy(points = Some(p))).explained(
      "`progressive` is the default with `--time` and `--error`; " +
        "[measurements](SAMPLERS.md)."
    ),
    value(
      "fireflies",
      "keep|reweight|clamp:X",
      "trade noise for bias: omit light that few samples have found, or limit each sample's " +
        "indirect light to X (default: keep)"
    )(_.fireflies)((s, f) => s.copy(fireflies = f))
      .explained("[Fireflies](NOISE.md#fireflies)."),
    flag(
      "store-time",
      "store the render time in the image file; equal images are then different files"
    )(_.output.storeTime)(write(_)(_.copy(storeTime = true))),
    // Written whenever anything about pictures differs
    option(
      "tonemap",
      curves.map(_.word).mkString("|"),
      s"tone curve of $pictures: " +
        curves.map(c => s"${c.word} (${c.meaning})").mkString(", ") + "; default linear"
    )(s => Option.when(s.output.display != DisplayTransform.Plain)(s.output.display.curve))(
      (s, c) => display(s)(_.copy(curve = c))
    ).explained("[The curves and their sources](PICTURES.md)."),
    value(
      "exposure",
      "STOPS",
      s"scale of the light in $pictures, in stops; auto: the mean becomes middle grey"
    )(_.output.display.exposure)((s, e) => display(s)(_.copy(exposure = e))),
    flag(
      "falsecolor",
      s"show luminance in false colours in $pictures: from -6 to 6 stops about middle grey"
    )(_.output.display.falseColor)(display(_)(_.copy(falseColor = true))),
    value("bits", "8|16", "bits per channel of .png (default 8)")(_.output.display.bits)((s, n) =>
      display(s)(_.copy(bits = n))
    )(using TextForm.int.filter("8 or 16")(Set(8, 16))),
    flag("dither", "round 8-bit values at random, which hides banding")(_.output.display.dithers)(
      display(_)(_.copy(dithers = true))
    ),
    flag(
      "disable-pixel-jitter",
      "take all samples at the pixel centre, and the middle of the lens"
    )(_.centers)(_.copy(centers = true)),
    flag("disable-texture-filtering", "point-sample textures")(_.unfiltered)(
      _.copy(unfiltered = true)
    ),
    flag("disable-image-textures", "replace image textures by their mean")(_.meanImages)(
      _.copy(meanImages = true)
    ),
    flag(
      "disable-wavelength-jitter",
      "take the same wavelengths for all samples, if rendering is spectral; colours are off"
    )(_.oneColorSet)(_.copy(oneColorSet = true)),
    flag("force-diffuse", "make all materials diffuse")(_.diffuse)(_.copy(diffuse = true)),
    option(
      "guiding",
      "auto|on|off",
      "path guiding: where it reduces noise (auto), everywhere (on), off " +
        "(default: auto with --time or --error, else off)"
    )(_.guiding)((s, g) => s.copy(guiding = Some(g))).explained(
      "`path` and `volpath` learn incident light, on surfaces and in media, from a quarter of " +
        "the samples. A guided sample takes 1.2 to 16 times as long, with less noise, so " +
        "compare by time or error: [measurements](decisions/0020-path-guiding.md)."
    ),
    option(
      "caustics",
      "auto|on|off|photons",
      "find caustics, on surfaces and in media: by light paths or photon maps, where these " +
        "reduce the noise (auto); by light paths, also those of delta lights (on); by photon " +
        "maps, which blur them and thick fog a little (photons); or not (off, default with a " +
        "number of samples)"
    )(_.caustics)((s, c) => s.copy(caustics = Some(c))).explained(
      "`auto` is the default with `--time` and `--error`. [What it brings](CAUSTICS.md)."
    ),
    option(
      "sky",
      "show|hide",
      "whether the camera sees the sky, which lights the scene in any case (default: hide with " +
        "--film rgba or --aov alpha, else show)"
    )(_.sky)((s, v) => s.copy(sky = Some(v))),
    option(
      "displacement-edge-scale",
      "X",
      "scale of the edge length of displaced meshes (default 1)"
    )(_.edgeScale)((s, x) => s.copy(edgeScale = Some(x)))(using
      TextForm.float.filter("above 0")(x => x > 0 && x < 1e30f)
    ),
    region("pixelbounds", "x0,x1,y0,y1", "render only these pixels; x1 and y1 are excluded") {
      case p: RenderRegion.Pixels => p
    },
    region(
      "pixel",
      "x,y",
      "render only this pixel, from 0,0 at the top left; with --debug, trace it"
    ) { case p: RenderRegion.Pixel => p },
    flag("preview", "a small image, shaded by a headlight")(_.preview)(_.copy(preview = true)),
    option(
      "sensor",
      "N|all",
      "render sensor N of a Mitsuba scene, or camera N of a model, from 0 on, or all, one image " +
        "each (default: the first)"
    )(_.reading.sensors)((s, all) => parse(s)(_.copy(sensors = Some(all))))
      .explained(
        "Of several, the images are `SCENE-0.exr`, `SCENE-1.exr` …; `%d` in `--outfile` is N."
      ),
    option(
      "resolution",
      "WxH|W|P%",
      "image size in place of the scene's: 640x360, 640 (the height follows) or 50%"
    )(_.reading.resolution)((s, r) => parse(s)(_.copy(resolution = Some(r)))).explained(
      "The scene is rendered as if its film had this size: crop windows show the same part, and " +
        "another aspect ratio changes the view as it does in the scene's own program."
    ),
    option(
      "light",
      "studio|sky|FILE",
      "light a model by a studio, by the sky and the sun, or by an image of all directions, " +
        "instead of by its own lights"
    )(_.reading.model.light)((s, x) => model(s)(_.copy(light = Some(x)))),
    option(
      "background",
      "none|r,g,b",
      "the ground of the studio or below the sky: nothing, or of this linear colour"
    )(_.reading.model.background)((s, x) => model(s)(_.copy(background = Some(x))))
      .explained("With `--film rgba`, `none` leaves all transparent but the model."),
    option(
      "turntable",
      "N",
      "render N images of a model, which turns around once"
    )(_.reading.model.turntable)((s, n) => model(s)(_.copy(turntable = Some(n))))(using
      TextForm.int.filter("from 1 to 10000")(n => n >= 1 && n <= 10000)
    ).explained("The images are `MODEL-0.exr`, `MODEL-1.exr` …; `%d` in `--outfile` is N."),
    option(
      "at",
      "TIME|FIRST:STEP:LAST",
      "show a model at this time of an animation, e.g. 1.5 or 1.5s, or render an image of each " +
        "of these times, e.g. 0:0.1:2 (default: at rest)"
    )(_.reading.model.state.times)((s, t) => state(s)(_.copy(times = Some(t))))
      .explained(
        "Of several, the images are `MODEL-0.exr`, `MODEL-1.exr` …; `%d` in `--outfile` is N."
      ),
    option(
      "animation",
      "NAME|INDEX",
      "the animation of --at (default: the first)"
    )(_.reading.model.state.animation)((s, n) => state(s)(_.copy(animation = Some(n))))(using
      TextForm.string
    ),
    option(
      "variant",
      "NAME",
      "show a model with this variant of its materials"
    )(_.reading.model.state.variant)((s, n) => state(s)(_.copy(variant = Some(n))))(using
      TextForm.string
    ),
    option(
      "camera",
      "FILE",
      "a camera instead of the scene's: LookAt and Camera statements, or a <sensor> of Mitsuba"
    )(_.reading.camera)((s, f) => parse(s)(_.copy(camera = Some(f))))(using TextForm.string)
      .explained(
        "For scenes of every format. pbrt's cameras are left-handed: for models and Mitsuba's " +
          "scenes, begin with `Scale -1 1 1`. `candela move` writes such files: " +
          "[moving the camera](WATCHING.md#moving-the-camera)."
      ),
    option(
      "up",
      "y|z",
      "which axis of a model points up (default: y in OBJ, z in PLY and STL)"
    )(_.reading.model.up)((s, axis) => model(s)(_.copy(up = Some(axis)))),
    option(
      "mse-reference-image",
      "FILE",
      "reference image for --mse-reference-out, which it needs"
    )(_.output.reference)((s, f) => write(s)(_.copy(reference = Some(f))))(using
      TextForm.string
    ).withoutIdentity,
    option(
      "mse-reference-out",
      "FILE",
      "write the MSE at 1, 2, 4, 8, ... samples per pixel, one line each"
    )(_.output.errors)((s, f) => write(s)(_.copy(errors = Some(f))))(using
      TextForm.string
    ).withoutIdentity
  )

  private val byName = all.map(s => s.name -> s).toMap

  def named(name: String): Option[Setting] = byName.get(name)
