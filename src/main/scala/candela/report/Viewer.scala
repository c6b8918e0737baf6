package candela.report

import candela.color.Magma
import candela.image.Image
import candela.measure.{ErrorMap, ImagePair, Metric}

import scalatags.Text.all.*

/** Image viewer: flips between images, compares them with a slider, magnifies, shows pixel values
  * and, with a reference, per-pixel error. The page's script implements it.
  */
private[report] object Viewer:

  def apply(pictures: Vector[Picture]): Frag =
    val shown = pictures.map(p => p.copy(image = PackedPicture.reduced(p.image.toRgb)))
    val reference = shown.find(_.isReference)
    val full = pictures.head.image
    val first = shown.head.image
    val smaller = Option.when(first.width < full.width):
      p(cls := "soft", s"Shown with ${first.width}×${first.height} of ${full.width}×${full.height}")
    div(
      cls := "viewer card",
      div(
        cls := "choice",
        label("A ", select(cls := "a")),
        label("B ", select(cls := "b")),
        span(cls := "choice modes", modes(reference.isDefined))
      ),
      div(
        cls := "stage",
        canvas(),
        span(cls := "name left"),
        span(cls := "name right")
      ),
      div(
        cls := "choice",
        label(
          "exposure ",
          input(
            tpe := "range",
            cls := "ev",
            attr("min") := "-6",
            attr("max") := "6",
            step := "0.5"
          ),
          span(cls := "evtext")
        ),
        span(
          cls := "heat",
          attr("hidden") := "",
          select(cls := "metric", metrics(shown)),
          " 0",
          span(cls := "scale", style := s"background:linear-gradient(90deg,$gradient)"),
          span(cls := "most"),
          " ",
          span(cls := "mean")
        )
      ),
      div(cls := "readout"),
      smaller,
      script(tpe := "application/json", raw(json(shown, reference)))
    )

  private def modes(hasReference: Boolean): Vector[Frag] =
    val all = Vector("slider" -> "slider", "flip" -> "flip (click the image)") ++
      Option.when(hasReference)("heat" -> "error of A")
    all.map((mode, words) => button(data("mode") := mode, words))

  private def metrics(shown: Vector[Picture]): Vector[Frag] =
    val all = Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae) ++
      Option.when(shown.exists(_.isReference))(Metric.Flip)
    all.map(m => option(value := m.word, m.title))

  private def gradient: String = Magma.Colors.map("#%06x".format(_)).mkString(",")

  private def json(shown: Vector[Picture], reference: Option[Picture]): String =
    val packed = shown.map: p =>
      val flip = reference.filterNot(_ eq p).map: r =>
        ujson.Str(PackedPicture.bytes(ErrorMap(Metric.Flip, ImagePair(p.image, r.image))))
      ujson.Obj(
        "name" -> p.name,
        "isReference" -> p.isReference,
        "data" -> PackedPicture.floats(finite(p.image)),
        "flip" -> flip.getOrElse(ujson.Null)
      )
    val all = ujson.Obj(
      "width" -> shown.head.image.width,
      "height" -> shown.head.image.height,
      "magma" -> ujson.Arr.from(Magma.Colors),
      "pictures" -> ujson.Arr.from(packed)
    )
    // Within a page, a name with </script> would end the script.
    ujson.write(all, escapeUnicode = true).replace("</", "<\\/")

  /** Without NaN and infinity, which the script can't read. */
  private def finite(image: Image): Image =
    val data = image.data.map(v => if java.lang.Float.isFinite(v) then v else 0f)
    Image(image.width, image.height, image.channelNames, data)
