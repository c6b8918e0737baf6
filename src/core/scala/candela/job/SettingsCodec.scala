package candela.job

import candela.aov.Layer
import candela.image.DisplayTransform
import candela.settings.{
  Choices, OutputSettings, ReadSettings, RenderGoal, RenderRegion, RenderSettings
}

/** [[RenderSettings]] as words, as film files store them: `--seed 7 --quick`. Each setting has the
  * name that its option has. A setting without words has its default: so a new setting changes
  * neither files nor images' digests of renderings that don't use it.
  */
object SettingsCodec:
  private type S = RenderSettings
  private val default = RenderSettings()

  /** A setting as words.
    *
    * @param isIdentity whether it shapes the image, in a way that the samples taken don't show
    * @param values     as text; none: the default
    * @param put        the settings with this value; None: it is none
    */
  final class Stored private[SettingsCodec] (
      val name: String,
      val takesValue: Boolean,
      private[SettingsCodec] val isIdentity: Boolean,
      private[SettingsCodec] val values: S => Vector[String],
      val put: (S, String) => Option[S]
  ):
    private[SettingsCodec] def words(s: S): Vector[String] =
      if takesValue then values(s).flatMap(v => Vector(s"--$name", v))
      else values(s).map(_ => s"--$name")

    /** Of the words that tell one image from another, none. */
    private[SettingsCodec] def apart: Stored =
      Stored(name, takesValue, isIdentity = false, values, put)

  /** A setting that has a default. */
  private def value[A](name: String, of: S => A)(put: (S, A) => S)(using f: TextForm[A]): Stored =
    option(name, s => Option(of(s)).filter(_ != of(default)))(put)

  /** A setting that may be missing. */
  private def option[A](name: String, of: S => Option[A])(put: (S, A) => S)(using
      f: TextForm[A]
  ): Stored =
    many(name, of(_).toVector)(put)

  private def many[A](name: String, of: S => Vector[A])(put: (S, A) => S)(using
      f: TextForm[A]
  ): Stored =
    Stored(name, true, true, of(_).map(f.show), (s, text) => f.read(text).map(put(s, _)))

  private def flag(name: String, of: S => Boolean)(put: S => S): Stored =
    Stored(
      name,
      takesValue = false,
      isIdentity = true,
      s => Option.when(of(s))("").toVector,
      (s, _) => Some(put(s))
    )

  private def region[R <: RenderRegion: TextForm](name: String)(
      of: PartialFunction[RenderRegion, R]
  ): Stored =
    option(name, s => of.lift(s.region))((s, r) => s.copy(region = r))

  private def change(s: S)(f: OutputSettings => OutputSettings): S = s.copy(output = f(s.output))
  private def show(s: S)(f: DisplayTransform => DisplayTransform): S =
    change(s)(o => o.copy(display = f(o.display)))
  private def read(s: S)(f: ReadSettings => ReadSettings): S = s.copy(reading = f(s.reading))
  private def end(s: S)(f: RenderGoal => RenderGoal): S = s.copy(goal = f(s.goal))

  private def askedLayers(s: S): Vector[(Layer, Option[Boolean])] =
    s.layers.map(layer => layer -> s.output.precisions.get(layer))

  private def withLayers(s: S, all: Vector[(Layer, Option[Boolean])]): S =
    val precisions = all.collect { case (layer, Some(isHalf)) => layer -> isHalf }
    change(s.copy(layers = all.map(_._1)))(_.copy(precisions = precisions.toMap))

  /** All layers, in one word. */
  private val layers: TextForm[Vector[(Layer, Option[Boolean])]] = TextForm(
    TextForm.layer.expected,
    text =>
      val all = text.split(",", -1).toVector.map(TextForm.layer.read)
      Option.when(all.forall(_.isDefined))(all.flatten)
    ,
    _.map(TextForm.layer.show).mkString(",")
  )

  /** In the order of the words, which is that of the first version: digests depend on it. */
  val all: Vector[Stored] = Vector(
    value("seed", _.seed)((s, n) => s.copy(seed = n))(using TextForm.int),
    flag("quick", _.quick)(_.copy(quick = true)),
    region("cropwindow") { case w: RenderRegion.Window => w },
    value("aov", askedLayers)(withLayers)(using layers),
    option("light-groups", _.lightGroups)((s, g) => s.copy(lightGroups = Some(g))),
    flag("denoise", _.output.denoise)(change(_)(_.copy(denoise = true))),
    option("dialect", _.reading.dialect)((s, d) => read(s)(_.copy(dialect = Some(d)))),
    many("define", _.reading.defines.toVector.sorted)((s, d) =>
      read(s)(r => r.copy(defines = r.defines + d))
    )(using TextForm.definition),
    flag("keep-going", _.reading.keepGoing)(read(_)(_.copy(keepGoing = true))),
    value("color", _.color)((s, c) => s.copy(color = c)),
    option("sampler", _.points)((s, p) => s.copy(points = Some(p))),
    value("fireflies", _.fireflies)((s, f) => s.copy(fireflies = f)),
    flag("store-time", _.output.storeTime)(change(_)(_.copy(storeTime = true))),
    // Written whenever anything about pictures differs
    option(
      "tonemap",
      s => Option.when(s.output.display != DisplayTransform.Plain)(s.output.display.curve)
    )((s, c) => show(s)(_.copy(curve = c))),
    value("exposure", _.output.display.exposure)((s, e) => show(s)(_.copy(exposure = e))),
    flag("falsecolor", _.output.display.falseColor)(show(_)(_.copy(falseColor = true))),
    value("bits", _.output.display.bits)((s, n) => show(s)(_.copy(bits = n)))(using
      TextForm.int.filter("8 or 16")(Set(8, 16))
    ),
    flag("dither", _.output.display.dithers)(show(_)(_.copy(dithers = true))),
    flag("disable-pixel-jitter", _.centers)(_.copy(centers = true)),
    flag("disable-texture-filtering", _.unfiltered)(_.copy(unfiltered = true)),
    flag("disable-image-textures", _.meanImages)(_.copy(meanImages = true)),
    flag("disable-wavelength-jitter", _.oneColorSet)(_.copy(oneColorSet = true)),
    flag("force-diffuse", _.diffuse)(_.copy(diffuse = true)),
    option("guiding", _.guiding)((s, g) => s.copy(guiding = Some(g))),
    option("caustics", _.caustics)((s, c) => s.copy(caustics = Some(c))),
    option("displacement-edge-scale", _.edgeScale)((s, x) => s.copy(edgeScale = Some(x)))(using
      TextForm.float.filter("a number above 0")(_ > 0)
    ),
    region("pixelbounds") { case p: RenderRegion.Pixels => p },
    region("pixel") { case p: RenderRegion.Pixel => p },
    flag("preview", _.preview)(_.copy(preview = true)),
    option("spp", _.samples)((s, n) => s.copy(samples = Some(n)))(using
      TextForm.int.filter("at least 1")(_ >= 1)
    ).apart,
    option("time", _.goal.time)((s, t) => end(s)(_.copy(time = Some(t))))(using
      TextForm.seconds
    ).apart,
    option("error", _.goal.error)((s, x) => end(s)(_.copy(error = Some(x))))(using
      TextForm.double.filter("a number above 0")(_ > 0)
    ).apart,
    option("mse-reference-image", _.output.reference)((s, f) =>
      change(s)(_.copy(reference = Some(f)))
    )(using TextForm.string).apart,
    option("mse-reference-out", _.output.errors)((s, f) => change(s)(_.copy(errors = Some(f))))(
      using TextForm.string
    ).apart
  )

  private val byWord = all.map(stored => s"--${stored.name}" -> stored).toMap

  /** All settings. */
  def words(s: RenderSettings): Vector[String] = all.flatMap(_.words(s))

  /** Those that tell one image from another, but for its number of samples: what was chosen for a
    * goal, too.
    */
  def identity(s: RenderSettings): Vector[String] =
    val chosen = unusual(s)
    all.filter(_.isIdentity).flatMap(_.words(chosen))

  /** Without the choices that scenes make: films lack them. */
  private def unusual(s: S): S =
    val choices = s.choices
    def unless[A](usual: A)(mine: A) = Option.when(mine != usual)(mine)
    s.copy(
      points = unless(Choices.OfScene.points)(choices.points),
      guiding = unless(Choices.OfScene.guiding)(choices.guiding),
      caustics = unless(Choices.OfScene.caustics)(choices.caustics)
    )

  /** The settings of these words; or what is wrong with them, as of a forged file. */
  def settings(words: Vector[String]): Either[String, RenderSettings] =
    def next(s: RenderSettings, rest: List[String]): Either[String, RenderSettings] = rest match
      case Nil => Right(s)
      case word :: more =>
        byWord.get(word) match
          case None => Left(s"unknown setting `$word`")
          case Some(stored) =>
            val (value, left) = if stored.takesValue then more.splitAt(1) else (List(""), more)
            value.headOption.flatMap(stored.put(s, _)) match
              case Some(changed) => next(changed, left)
              case None => Left(s"wrong value of `$word`")
    next(default, words.toList)
