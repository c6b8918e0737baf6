package candela.api

import candela.diagnostics.{Code, Suggest}
import candela.aov.Layer
import candela.settings.{RenderGoal, RenderSettings as CoreSettings, SettingsCodec, TextForm}

import java.time.Duration
import java.util.{List as JList, Objects}

import scala.annotation.varargs
import scala.jdk.CollectionConverters.*

/** What to render. Immutable: each method returns a new value. Scene, settings and number of
  * samples determine every bit of the image.
  */
final class RenderSettings private (private[api] val core: CoreSettings):
  private def change(f: CoreSettings => CoreSettings): RenderSettings = RenderSettings(f(core))
  private def end(f: RenderGoal => RenderGoal): RenderSettings =
    change(s => s.copy(goal = f(s.goal)))

  /** Samples per pixel, at least 1, instead of the scene's; a maximum if there is a goal. */
  def withSamples(perPixel: Int): RenderSettings = withOption("spp", perPixel.toString)

  /** Random seed (default 0). */
  def withSeed(seed: Int): RenderSettings = change(_.copy(seed = seed))

  /** Goal: ends the rendering after a time, with equally many samples in every pixel. */
  def withTime(time: Duration): RenderSettings =
    end(_.copy(time = Some(Times.positive("the time", time))))

  /** Goal: ends the rendering when its estimated error is low enough.
    *
    * @param relative the root of the relative mean squared error: 0.01 is 1 %
    */
  def withError(relative: Double): RenderSettings =
    if relative >= 1 then
      Problems.fail(Code.OptionValue, s"the error must be below 1, which is 100 %, found $relative")
    end(_.copy(error = Some(positive("the error", relative))))

  /** Adds layers (AOVs) to the image: `albedo`, `normal`, `depth`, `direct`, `indirect`,
    * `variance`, …; docs/LAYERS.md lists them. Their channels follow the colours.
    */
  @varargs def withLayers(names: String*): RenderSettings =
    val added = names.toVector.map: name =>
      TextForm.layer.read(Objects.requireNonNull(name, "name")).getOrElse:
        val help = Suggest.help(name, Layer.values.map(_.word).toVector)
        Problems.fail(Code.UnknownEntry, s"unknown layer `$name`", help)
    change: s =>
      val extended = s.adding(added)
      extended.copy(layers = extended.layers.distinct)

  /** Adds a layer for each light group: `statement` makes a group of each statement, `type` of each
    * type of light; `key=point_12+spot_14,sky=infinite` names custom groups.
    */
  def withLightGroups(groups: String): RenderSettings =
    withOption("light-groups", groups)

  /** Adds denoised colours as the layer `Denoised`; requires Intel's Open Image Denoise.
    * See docs/DENOISING.md.
    */
  def withDenoising: RenderSettings = change(_.denoised)

  /** Sets a command-line option by its name, without `--`: `withOption("fireflies", "reweight")`.
    * Available are the options of `candela render` that affect the image and its files, except
    * those of reading scenes, which are [[ReadSettings.withOption]]'s.
    */
  def withOption(name: String, value: String): RenderSettings =
    change(NamedOptions.change(name, Some(value), isRead = false))

  /** An option without a value: `withOption("preview")`. */
  def withOption(name: String): RenderSettings =
    change(NamedOptions.change(name, None, isRead = false))

  private def positive(what: String, value: Double): Double =
    if value > 0 && !value.isInfinite then value
    else Problems.fail(Code.OptionValue, s"$what must be above 0, found $value")

  /** The settings that are not the default, as words of a command line. */
  def words: JList[String] = java.util.List.copyOf(SettingsCodec.words(core).asJava)

  override def equals(other: Any): Boolean = other match
    case that: RenderSettings => core == that.core
    case _ => false
  override def hashCode: Int = core.hashCode
  override def toString: String = SettingsCodec.words(core).mkString("RenderSettings(", " ", ")")

object RenderSettings:
  /** The scene's own settings. */
  def apply(): RenderSettings = new RenderSettings(CoreSettings())

  /** The scene's own settings, with another number of samples per pixel. */
  def apply(samples: Int): RenderSettings = apply().withSamples(samples)

  /** The scene's own settings, for Java and Kotlin. */
  def create(): RenderSettings = apply()

  private def apply(core: CoreSettings): RenderSettings = new RenderSettings(core)
