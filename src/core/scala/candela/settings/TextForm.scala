package candela.settings

import candela.base.Decimal
import candela.aov.Layer
import candela.color.{Rgb, ToneCurve}
import candela.film.{Fireflies, PixelBounds}
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.image.Exposure
import candela.scenefile.{Dialect, Resolution}

import java.util.Locale
import scala.util.Try

/** A value as text, in film files and on command lines.
  *
  * @param expected what messages say of other text, after "expected"
  * @param read     None: it is no such value
  * @param format   what `read` reads as the same value
  * @param wanted   what messages say of a text that is no such value, after "must be"
  * @param wrong    the part of such a text that is wrong
  */
final class TextForm[A] private (
    val expected: String,
    val read: String => Option[A],
    val format: A => String,
    val wanted: String => String,
    val wrong: String => String = identity
):
  def map[B](to: A => B)(from: B => A): TextForm[B] =
    new TextForm[B](expected, read(_).map(to), b => format(from(b)), wanted, wrong)

  def filter(rule: String)(fits: A => Boolean): TextForm[A] =
    new TextForm[A](
      rule,
      read(_).filter(fits),
      format,
      text => if read(text).isDefined then rule else wanted(text),
      wrong
    )

object TextForm:
  def apply[A](expected: String, read: String => Option[A], format: A => String): TextForm[A] =
    new TextForm(expected, read, format, _ => expected)

  private def named[A](all: Seq[A], name: A => String, expected: String): TextForm[A] =
    TextForm(expected, text => all.find(name(_).equalsIgnoreCase(text)), name)

  private def oneOf[A](all: Seq[A], name: A => String): TextForm[A] =
    named(all, name, all.map(name).mkString("one of ", ", ", ""))

  private def lower(value: Any): String = value.toString.toLowerCase(Locale.ROOT)

  /** Values of items between commas. */
  private[settings] def ofItems[I, A](
      expected: String,
      item: String => Option[I],
      format: A => String
  )(value: PartialFunction[Vector[I], A]): TextForm[A] =
    def items(text: String) = text.split(",", -1).toVector.map(_.trim)
    new TextForm(
      expected,
      text =>
        val parsed = items(text).map(item)
        Option.when(parsed.forall(_.isDefined))(parsed.flatten).flatMap(value.lift)
      ,
      format,
      _ => expected,
      text => items(text).find(item(_).isEmpty).getOrElse(text)
    )

  val int: TextForm[Int] = new TextForm(
    "a whole number",
    _.toIntOption,
    _.toString,
    text =>
      Try(BigInt(text)).toOption.fold("a whole number"): n =>
        if n > 0 then s"at most ${Int.MaxValue}" else s"at least ${Int.MinValue}"
  )
  val float: TextForm[Float] = TextForm("a number", Decimal.float(_), _.toString)
  val double: TextForm[Double] = TextForm("a number", Decimal.double(_), _.toString)
  val string: TextForm[String] = TextForm("a name", Some(_), identity)

  /** Seconds of a duration. */
  val seconds: TextForm[Double] = TextForm(
    "a duration, e.g. 90s, 10m or 2h",
    text =>
      val scale = Map("s" -> 1.0, "m" -> 60.0, "h" -> 3600.0).get(text.takeRight(1))
      val number = if scale.isDefined then text.dropRight(1) else text
      Decimal.double(number).map(_ * scale.getOrElse(1.0)).filter(s => s > 0 && s < 1e9)
    ,
    s => s"${s}s"
  )

  private val Count = """(\d+(?:\.\d+)?)(?i:([kmgt])(i?))?""".r

  /** A number of things, with a unit: 20M, 1.5G, 512Mi. */
  val count: TextForm[Long] = TextForm(
    "a number, e.g. 1000 or 20M",
    {
      case Count(digits, unit, binary) =>
        val power = Option(unit).fold(0)(u => "kmgt".indexOf(u.toLowerCase(Locale.ROOT)) + 1)
        val base = if Option(binary).exists(_.nonEmpty) then 1024 else 1000
        val value = BigDecimal(digits) * BigDecimal(base).pow(power)
        Option.when(value.isValidLong || value < Long.MaxValue)(value.toLong)
      case _ => None
    },
    _.toString
  )

  /** Bytes. */
  val size: TextForm[Long] = TextForm(
    "a size, e.g. 500MB, 2G or 1Gi",
    text => count.read(text.replaceFirst("(?i)(?<=[0-9kmgti])b$", "")),
    _.toString
  )

  /** A part of a whole: 0.002, or 0.2 %. A number of 1 or more is meant in percent. */
  val share: TextForm[Double] =
    def positive(text: String) = Decimal.double(text).filter(x => x > 0 && x.isFinite)
    val expected = "a percentage or a number below 1, e.g. 2% or 0.02"
    new TextForm(
      expected,
      text =>
        if !text.endsWith("%") then positive(text).filter(_ < 1)
        else
          val number = text.dropRight(1).trim
          positive(number).map(_ => (BigDecimal(number) / 100).toDouble)
      ,
      x => if x < 1 then x.toString else s"${BigDecimal(x) * 100}%",
      text => if positive(text).isDefined then s"$expected; did you mean $text%?" else expected
    )

  val definition: TextForm[(String, String)] = TextForm(
    "NAME=VALUE",
    text =>
      Some(text.span(_ != '=')).filter((n, v) => n.nonEmpty && v.nonEmpty)
        .map((name, value) => (name, value.drop(1))),
    (name, value) => s"$name=$value"
  )

  given TextForm[Dialect] = named(Dialect.ofPbrt, lower, "v2, v3 or v4")

  given TextForm[ColorMode] = named(ColorMode.values.toSeq, lower, "auto, rgb or spectral")

  given TextForm[GuidingMode] = named(GuidingMode.values.toSeq, lower, "auto, on or off")

  given TextForm[CausticsMode] = named(CausticsMode.values.toSeq, lower, "auto, on, off or photons")

  given TextForm[SkyView] = named(SkyView.values.toSeq, lower, "show or hide")

  given TextForm[PointChoice] = oneOf(PointChoice.all, _.word)

  given TextForm[Fireflies] = TextForm(
    "keep, reweight, or clamp:X with X > 0",
    _.toLowerCase(Locale.ROOT) match
      case Fireflies.Kept.word => Some(Fireflies.Kept)
      case Fireflies.Reweighted.word => Some(Fireflies.Reweighted)
      case s"clamp:$most" =>
        val limit = Decimal.float(most).filter(m => m > 0 && m < Float.PositiveInfinity)
        limit.map(Fireflies.Clamped(_))
      case _ => None
    ,
    fireflies =>
      fireflies match
        case Fireflies.Clamped(most) => s"${fireflies.word}:$most"
        case other => other.word
  )

  given TextForm[Sensors] = TextForm(
    "the number of a sensor, from 0 on, or `all`",
    {
      case "all" => Some(Sensors.All)
      case text => text.toIntOption.filter(_ >= 0).map(Sensors.One(_))
    },
    {
      case Sensors.All => "all"
      case Sensors.One(index) => index.toString
    }
  )

  /** Between commas, as Python writes pairs, too. */
  private val Size = raw"(\d{1,8})[x×,](\d{1,8})".r
  private val MaxAcross = 1 << 24
  private val MaxPercent = 10000.0
  private val MaxModelSeconds = 1e6

  given TextForm[Resolution] =
    def isAcross(pixels: Int) = pixels >= 1 && pixels <= MaxAcross
    TextForm(
      "a size, a width or a percentage, e.g. 640x360, 640 or 50%",
      _.toLowerCase(Locale.ROOT) match
        case Size(w, h) =>
          Option.when(isAcross(w.toInt) && isAcross(h.toInt))(Resolution.Size(w.toInt, h.toInt))
        case s"$number%" =>
          Decimal.double(number).filter(p => p > 0 && p <= MaxPercent).map(Resolution.Percent(_))
        case number => number.toIntOption.filter(isAcross).map(Resolution.Width(_))
      ,
      {
        case Resolution.Size(w, h) => s"${w}x$h"
        case Resolution.Width(w) => w.toString
        case Resolution.Percent(p) => s"$p%"
      }
    )

  given TextForm[ModelLight] = TextForm(
    "studio, sky or the file of an image of all directions",
    {
      case "studio" => Some(ModelLight.Studio)
      case "sky" => Some(ModelLight.Sky)
      case "" => None
      case file => Some(ModelLight.Surroundings(file))
    },
    {
      case ModelLight.Surroundings(file) => file
      case named => lower(named)
    }
  )

  given TextForm[ModelTimes] =
    def time(text: String) =
      Decimal.double(text.stripSuffix("s")).filter(t => t >= 0 && t < MaxModelSeconds)
    TextForm(
      "seconds of an animation, or first:step:last, e.g. 1.5 or 0:0.1:2",
      {
        case s"$first:$step:$last" =>
          for
            a <- time(first)
            d <- time(step)
            b <- time(last) if d > 0 && b >= a
            // 0:0.1:2 ends with 2, whatever the rounding of the steps
            steps = Math.floor((b - a) / d + 1e-9) if steps < ModelTimes.MaxCount
          yield ModelTimes(a, d, steps.toInt + 1)
        case single => time(single).map(ModelTimes.at)
      },
      t => if t.count == 1 then t.first.toString else s"${t.first}:${t.step}:${t(t.count - 1)}"
    )

  given TextForm[UpAxis] = named(UpAxis.values.toSeq, lower, "y or z")

  given TextForm[ModelGround] =
    val color = ofItems(
      "none, or a colour as r,g,b with numbers from 0 to 1",
      Decimal.float(_),
      (c: Rgb) => s"${c.r},${c.g},${c.b}"
    ):
      case Vector(r, g, b) if Vector(r, g, b).forall(x => x >= 0f && x <= 1f) => Rgb(r, g, b)
    TextForm(
      color.expected,
      text =>
        if text == "none" then Some(ModelGround.Empty)
        else color.read(text).map(ModelGround.Colored(_)),
      {
        case ModelGround.Empty => "none"
        case ModelGround.Colored(c) => color.format(c)
      }
    )

  given window: TextForm[RenderRegion.Window] = ofItems(
    "x0,x1,y0,y1 with 0 <= x0 < x1 <= 1, and y likewise, e.g. 0.25,0.75,0,0.5",
    Decimal.float(_),
    (w: RenderRegion.Window) => s"${w.x0},${w.x1},${w.y0},${w.y1}"
  ):
    case Vector(x0, x1, y0, y1)
        if 0 <= x0 && x0 < x1 && x1 <= 1 && 0 <= y0 && y0 < y1 && y1 <= 1 =>
      new RenderRegion.Window(x0, x1, y0, y1)

  given pixels: TextForm[RenderRegion.Pixels] = ofItems(
    "x0,x1,y0,y1 with x0 < x1 and y0 < y1, in pixels",
    _.toIntOption,
    (p: RenderRegion.Pixels) => s"${p.bounds.x0},${p.bounds.x1},${p.bounds.y0},${p.bounds.y1}"
  ):
    case Vector(x0, x1, y0, y1) if x0 < x1 && y0 < y1 =>
      new RenderRegion.Pixels(PixelBounds(x0, y0, x1, y1))

  given pixel: TextForm[RenderRegion.Pixel] = ofItems(
    "x,y in pixels, e.g. 12,40",
    _.toIntOption,
    (p: RenderRegion.Pixel) => s"${p.x},${p.y}"
  ):
    case Vector(x, y) if x >= 0 && y >= 0 => new RenderRegion.Pixel(x, y)

  /** A layer, with a precision if given: whether it is half. */
  given layer: TextForm[(Layer, Option[Boolean])] =
    val names = oneOf(Layer.values.toSeq, (l: Layer) => l.word)
    TextForm(
      Layer.values.map(_.word).mkString("one or more of ", ", ", ""),
      text =>
        val (word, precision) = text.trim.toLowerCase(Locale.ROOT) match
          case s"$w:half" => (w, Some(true))
          case s"$w:float" => (w, Some(false))
          case w => (w, None)
        names.read(word).map((_, precision))
      ,
      (layer, isHalf) => layer.word + isHalf.fold("")(if _ then ":half" else ":float")
    )

  given TextForm[LightGrouping] =
    val name = "[A-Za-z0-9_]+"
    def group(text: String): Option[(String, Vector[String])] = text match
      case s"$group=$lights" =>
        val parsed = (group, lights.split("\\+", -1).toVector)
        Option.when((group +: parsed._2).forall(_.matches(name)))(parsed)
      case _ => None
    val named = ofItems[(String, Vector[String]), LightGrouping](
      "statement, type, or names of letters, digits and _, such as " +
        "key=point_12+spot_14,sky=infinite",
      group,
      {
        case LightGrouping.Statements => "statement"
        case LightGrouping.Types => "type"
        case LightGrouping.Named(groups) =>
          groups.map((group, lights) => s"$group=${lights.mkString("+")}").mkString(",")
      }
    ):
      case groups =>
        val merged = groups.map(_._1).distinct
        LightGrouping.Named(merged.map(n => n -> groups.filter(_._1 == n).flatMap(_._2)))
    new TextForm(
      named.expected,
      {
        case "statement" => Some(LightGrouping.Statements)
        case "type" => Some(LightGrouping.Types)
        case text => named.read(text)
      },
      named.format,
      named.wanted,
      named.wrong
    )

  given TextForm[ToneCurve] =
    named(ToneCurve.values.toSeq, _.word, ToneCurve.values.map(_.word).mkString(", "))

  given TextForm[Exposure] = TextForm(
    "stops, e.g. 1.5 or -2, or auto",
    text =>
      if text.equalsIgnoreCase("auto") then Some(Exposure.Auto)
      else Decimal.float(text).filter(s => Math.abs(s) <= 100).map(Exposure.Stops(_)),
    {
      case Exposure.Auto => "auto"
      case Exposure.Stops(n) => n.toString
    }
  )
