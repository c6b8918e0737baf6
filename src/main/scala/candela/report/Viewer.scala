package candela.report

import candela.color.Magma
import candela.image.Image
import candela.measure.{ErrorMap, ImagePair, Metric}

import java.util.Locale

import scalatags.Text.all.*

/** Image viewer: flips between images, compares them with a slider, magnifies, shows pixel values
  * and, with a reference, per-pixel error. The page's script implements it.
  */
private[candela] object Viewer:

  def apply(pictures: Vector[Picture]): Frag =
    val reduced = pictures.map(p => p.copy(image = PackedPicture.reduced(p.image.toRgb)))
    val reference = reduced.find(_.isReference)
    val full = pictures.head.image
    val firstImage = reduced.head.image
    val smaller = Option.when(firstImage.width < full.width):
      p(
        cls := "soft",
        s"Shown with ${firstImage.width}×${firstImage.height} of ${full.width}×${full.height}"
      )
    div(
      cls := "viewer card",
      div(
        cls := "choice",
        label("A ", select(cls := "a")),
        label("B ", select(cls := "b")),
        span(cls := "choice modes", modes(reference.isDefined))
      ),
      stage(
        "images: arrows move the pixel cursor, plus and minus zoom",
        span(cls := "name left"),
        span(cls := "name right")
      ),
      div(
        cls := "choice",
        zoomButtons,
        label(
          "exposure ",
          input(
            tpe := "range",
            cls := "ev",
            value := "0",
            attr("min") := "-6",
            attr("max") := "6",
            step := "0.5"
          ),
          span(cls := "evtext")
        ),
        span(
          cls := "heat",
          attr("hidden") := "",
          select(cls := "metric", attr("aria-label") := "metric", metrics(reduced)),
          " 0",
          span(cls := "scale", style := s"background:linear-gradient(90deg,$gradient)"),
          span(cls := "most"),
          " ",
          span(cls := "mean")
        )
      ),
      div(cls := "readout"),
      p(cls := "soft", keys),
      smaller,
      script(tpe := "application/json", raw(json(reduced, reference)))
    )

  /** A picture that takes keys when it has the focus, and the wheel then, too.
    *
    * @param words for those who don't see it
    */
  def stage(words: String, above: Frag*): Frag =
    div(
      cls := "stage",
      attr("tabindex") := "0",
      attr("role") := "application",
      attr("aria-label") := words,
      canvas(),
      above,
      span(cls := "hint", attr("hidden") := "", "click the image, or hold Ctrl or ⌘, to zoom")
    )

  def zoomButtons: Frag =
    span(
      cls := "choice zooms",
      Vector(("in", "zoom in", "+"), ("out", "zoom out", "−"), ("whole", "", "whole image")).map:
        (direction, words, caption) =>
          val named = Option.when(words.nonEmpty)(attr("aria-label") := words)
          button(data("zoom") := direction, named, caption)
    )

  private val keys =
    "Keys on the image: arrows move the pixel cursor (with Shift by ten), + and − zoom, 0 shows " +
      "the whole image, comma and full stop move the slider, f flips, e and E change the " +
      "exposure, and the wheel zooms; with Ctrl it always does."

  private def modes(hasReference: Boolean): Vector[Frag] =
    val choices = Vector("slider" -> "slider", "flip" -> "flip (click the image)") ++
      Option.when(hasReference)("heat" -> "error of A")
    choices.map: (mode, words) =>
      button(data("mode") := mode, attr("aria-pressed") := "false", words)

  private def metrics(pictures: Vector[Picture]): Vector[Frag] =
    val choices = Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae) ++
      Option.when(pictures.exists(_.isReference))(Metric.Flip)
    choices.map(m => option(value := m.word, m.title))

  private def gradient: String = Magma.Colors.map("#%06x".formatLocal(Locale.ROOT, _)).mkString(",")

  private def json(pictures: Vector[Picture], reference: Option[Picture]): String =
    val packed = pictures.map: p =>
      val flip = reference.filterNot(_ eq p).map: r =>
        ujson.Str(PackedPicture.bytes(ErrorMap(Metric.Flip, ImagePair(p.image, r.image))))
      ujson.Obj(
        "name" -> p.name,
        "isReference" -> p.isReference,
        "data" -> PackedPicture.floats(finite(p.image)),
        "flip" -> flip.getOrElse(ujson.Null)
      )
    val content = ujson.Obj(
      "width" -> pictures.head.image.width,
      "height" -> pictures.head.image.height,
      "magma" -> ujson.Arr.from(Magma.Colors),
      "pictures" -> ujson.Arr.from(packed)
    )
    // Within a page, a name with </script> would end the script.
    ujson.write(content, escapeUnicode = true).replace("</", "<\\/")

  /** Without NaN and infinity, which the script can't read. */
  private def finite(image: Image): Image =
    val data = image.data.map(v => if java.lang.Float.isFinite(v) then v else 0f)
    Image(image.width, image.height, image.channelNames, data)
