package candela.stability

import java.math.{BigDecimal, MathContext}
import java.nio.file.{Files, Path}

import candela.image.Image

/** What is right in a picture: one value everywhere, or the picture of another scene. */
enum Expected:
  case Value(x: Double)
  case Like(scene: String)

/** A scene of `docs/stability` whose picture is known.
  *
  * @param words what it shows
  * @param from  the part of the picture, from the top, that isn't compared
  */
final case class HardScene(name: String, words: String, expected: Expected, from: Double = 0):
  def text: String = Files.readString(HardScenes.Folder.resolve(s"$name.pbrt"))

  /** Values are compared in units of the expected one, or of 1 if that is 0. */
  def unit(right: Image): Double = expected match
    case Expected.Value(0) => 1
    case Expected.Value(x) => x
    case Expected.Like(_) => Blocks.mean(right)

  /** What the picture should be. */
  def right(like: Image, other: String => Option[Image]): Option[Image] = expected match
    case Expected.Value(x) =>
      val data = Array.fill(3 * like.width * like.height)(x.toFloat)
      Some(Image(like.width, like.height, Image.RgbNames, data))
    case Expected.Like(scene) => other(scene)

object HardScenes:
  val Folder: Path = Path.of("docs", "stability")
  val OnSmallPlane = "ball-on-plane-reference"
  private val like = Expected.Like(OnSmallPlane)
  private val horizon = 3.0 / 8 // of the small plane: above it that shows the sky

  import Expected.Value

  val all: Seq[HardScene] = Seq(
    HardScene("ground-sphere", "a ground that is a sphere of radius 1e6", Value(0.5)),
    HardScene("ball-on-plane", "a ball of 0.01 on a plane 2e6 wide", like, horizon),
    HardScene("ball-on-ball", "a ball of 0.01 on a sphere of radius 1e6", like, horizon),
    HardScene("two-planes", "a plane 1e-5 above a bright light", Value(0.5)),
    HardScene(
      "covered-lamp",
      "a light covered by a black screen 5e-5 before it, 1 above a floor",
      Value(0)
    ),
    // Σ 0.999ᵏ for k to 1000
    HardScene("mirrors", "1,000 bounces", Value((1 - Math.pow(0.999, 1001)) / (1 - 0.999))),
    HardScene("nested-glass", "glass within glass within glass", Value(1)),
    HardScene("grazing", "light at 0.1 degrees", Value(500 / Math.PI * Math.sin(0.1.toRadians))),
    HardScene("far-mesh", "a triangle 1 wide, from 1e6 away", Value(0.5)),
    HardScene("tiny-room", "a closed room 1e-6 wide", Value(2)),
    HardScene("moved-room", "a closed room 2000 wide at (1e6, 1e6, 1e6)", Value(2)),
    HardScene("needle-room", "a closed room as thin as a needle", Value(2)),
    HardScene("cone-tip", "a cone from above its tip", Value(0.5)),
    HardScene("inside-lamp", "a floor within a light", Value(0.5)),
    HardScene("far-lamp", "a floor under a light that is 1e-5 radians small", Value(0.5)),
    HardScene("bright-texel", "a floor under a sky with one bright pixel", Value(0.5))
  )

/** Means of 8 by 8 pixels, of green. */
object Blocks:
  private val Side = 8

  def mean(image: Image): Double =
    val green = image.channelNames.indexOf("G")
    val all = for y <- 0 until image.height; x <- 0 until image.width yield image(x, y, green)
    all.map(_.toDouble).sum / all.size

  /** How far each block is from what is right, and the standard error of that as the scatter of
    * its pixels tells it, in that scene's unit.
    */
  def differences(scene: HardScene, image: Image, right: Image): Seq[(Double, Double)] =
    val (a, b) = (image.channelNames.indexOf("G"), right.channelNames.indexOf("G"))
    for
      row <- 0 until image.height / Side if row * Side >= scene.from * image.height
      column <- 0 until image.width / Side
    yield
      val off =
        for y <- row * Side until (row + 1) * Side; x <- column * Side until (column + 1) * Side
        yield (image(x, y, a).toDouble - right(x, y, b)) / scene.unit(right)
      val n = off.size
      val mean = off.sum / n
      val variance = off.map(d => (d - mean) * (d - mean)).sum / (n - 1)
      (Math.abs(mean), Math.sqrt(variance / n))

/** What came of a program with a scene.
  *
  * @param mean    of the picture
  * @param worst   block's difference from what is right, 0.01 being a hundredth
  * @param isNoise is no block off by more than 4.5 standard errors, and the whole by no more than
  *                what is allowed?
  */
final case class Verdict(mean: Double, worst: Double, isNoise: Boolean):
  /** Are all blocks within 5 %? */
  def isCorrect: Boolean = worst <= Verdict.Allowed
  def isRight: Boolean = isCorrect || isNoise
  def words: String = if isCorrect then "correct" else if isNoise then "noise" else "**artefact**"

  /** `0.5004, 1.7 %` */
  def figures: String =
    if worst.isNaN then "not a number"
    else s"${Verdict.digits(mean, 4)}, ${Verdict.digits(100 * worst, 2)} %"

object Verdict:
  val Allowed = 0.05

  def of(scene: HardScene, image: Image, right: Image): Verdict =
    val all = Blocks.differences(scene, image, right)
    val isNumber = all.forall((off, _) => java.lang.Double.isFinite(off))
    val unit = scene.unit(right)
    val whole = Math.abs(Blocks.mean(image) - Blocks.mean(right)) / unit
    val isNoise = whole <= Allowed && all.forall((off, e) => off <= Math.max(Allowed, 4.5 * e))
    Verdict(Blocks.mean(image), if isNumber then all.map(_._1).max else Double.NaN, isNoise)

  def digits(x: Double, count: Int): String =
    if x == 0 || x.isNaN || x.isInfinite then x.toString.stripSuffix(".0")
    else BigDecimal(x).round(MathContext(count)).stripTrailingZeros.toPlainString
