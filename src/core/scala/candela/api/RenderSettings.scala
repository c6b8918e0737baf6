package candela.api

import candela.aov.Layer
import candela.base.{Code, Suggest}
import candela.build.{RenderGoal, RenderSettings as CoreSettings}
import candela.job.{SettingsCodec, TextForm}

import java.time.Duration
import java.util.List as JList

import scala.annotation.varargs
import scala.jdk.CollectionConverters.*

/** What is rendered of a scene. Immutable: each method returns another value. With the scene and
  * the number of samples it determines every bit of the image.
  */
final class RenderSettings private (private[api] val of: CoreSettings):
  private def change(f: CoreSettings => CoreSettings): RenderSettings = RenderSettings(f(of))
  private def end(f: RenderGoal => RenderGoal): RenderSettings =
    change(s => s.copy(goal = f(s.goal)))

  /** Samples per pixel, at least 1, instead of the scene's. With a goal, the most there may be. */
  def withSamples(perPixel: Int): RenderSettings = withOption("spp", perPixel.toString)

  /** Seed of all random numbers: another one gives another noise. */
  def withSeed(seed: Int): RenderSettings = change(_.copy(seed = seed))

  /** Goal: ends the rendering at a time, with equally many samples in every pixel. */
  def withTime(time: Duration): RenderSettings =
    end(_.copy(time = Some(positive("the time", time.toNanos * 1e-9))))

  /** Goal: ends the rendering when its estimated error is low enough.
    *
    * @param relative the root of the relative mean squared error: 0.01 is 1 %
    */
  def withError(relative: Double): RenderSettings =
    end(_.copy(error = Some(positive("the error", relative))))

  /** Adds layers (AOVs) to the image: `albedo`, `normal`, `depth`, `direct`, `indirect`,
    * `variance`, …; docs/LAYERS.md lists them. Their channels stand behind the colours.
    */
  @varargs def withLayers(names: String*): RenderSettings =
    val added = names.toVector.map: name =>
      TextForm.layer.read(name).getOrElse:
        val help = Suggest.help(name, Layer.values.map(_.word).toVector)
        Problems.fail(Code.UnknownEntry, s"unknown layer `$name`", help)
    change: s =>
      val all = s.adding(added)
      all.copy(layers = all.layers.distinct)

  /** Adds the light of each group of lights as layers: `statement` makes a group of each statement,
    * `type` of each type of light, `key=point_12+spot_14,sky=infinite` names its own.
    */
  def withLightGroups(groups: String): RenderSettings =
    withOption("light-groups", groups).withLayers(Layer.Lights.word)

  /** Adds denoised colours, as the layer `Denoised`, by Intel's Open Image Denoise, which must be
    * installed.
    */
  def withDenoising: RenderSettings = change(_.denoised)

  /** An option of the program's command line by its name, without `--`: `withOption("fireflies",
    * "reweight")`. Those that shape the image and its files are known: `candela render --help`.
    */
  def withOption(name: String, value: String): RenderSettings = put(name, Some(value))

  /** An option without a value: `withOption("preview")`. */
  def withOption(name: String): RenderSettings = put(name, None)

  private def put(name: String, value: Option[String]): RenderSettings =
    val known = SettingsCodec.all.find(_.name == name).getOrElse:
      val help = Suggest.help(name, SettingsCodec.all.map(_.name))
      Problems.fail(Code.UnknownEntry, s"unknown setting `$name`", help)
    if known.takesValue != value.isDefined then
      val found = if value.isDefined then "found one" else "found none"
      val wanted = if known.takesValue then "a value" else "no value"
      Problems.fail(Code.OptionValue, s"setting `$name` takes $wanted, $found")
    val text = value.getOrElse("")
    known.put(of, text) match
      case Some(settings) => RenderSettings(settings)
      case None => Problems.fail(Code.OptionValue, s"wrong value of `$name`: `$text`")

  private def positive(what: String, value: Double): Double =
    if value > 0 && !value.isInfinite then value
    else Problems.fail(Code.OptionValue, s"$what must be above 0, found $value")

  /** The settings that are not the default, as words of a command line. */
  def words: JList[String] = java.util.List.copyOf(SettingsCodec.words(of).asJava)

  override def equals(other: Any): Boolean = other match
    case that: RenderSettings => of == that.of
    case _ => false
  override def hashCode: Int = of.hashCode
  override def toString: String = SettingsCodec.words(of).mkString("RenderSettings(", " ", ")")

object RenderSettings:
  /** What the scene says. */
  def apply(): RenderSettings = new RenderSettings(CoreSettings())

  /** What the scene says, with another number of samples per pixel. */
  def apply(samples: Int): RenderSettings = apply().withSamples(samples)

  /** What the scene says, for Java and Kotlin. */
  def create(): RenderSettings = apply()

  private def apply(of: CoreSettings): RenderSettings = new RenderSettings(of)
