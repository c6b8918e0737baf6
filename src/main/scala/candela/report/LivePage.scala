package candela.report

import candela.color.{Rgb, ToneCurve}

import scalatags.Text.all.*

/** Page that follows a rendering; its script asks the server for state, image and charts. */
object LivePage:

  /** @param plan        features of the scene: (feature, value)
    * @param isEstimated whether errors are, for lack of a reference
    */
  def html(
      scene: String,
      version: String,
      plan: Vector[(String, String)],
      isEstimated: Boolean
  ): String =
    val error = ErrorCharts(Vector.empty, isEstimated).word("relative MSE")
    val subtitle = span(id := "stage", attr("role") := "status", "connecting")
    Page.html(scene, subtitle, version, Some("live"))(
      div(
        cls := "choice",
        button(id := "stop", "stop"),
        button(id := "keep", attr("aria-pressed") := "false", "keep on"),
        button(id := "save", "save"),
        button(id := "end", attr("hidden") := "", "end"),
        span(cls := "bar", attr("role") := "progressbar", i(id := "done"))
      ),
      div(
        cls := "tiles",
        Vector("samples" -> "samples per pixel", "left" -> "left", "seconds" -> "rendering") ++
          Vector("rate" -> "samples per second", "error" -> error) map: (key, what) =>
            div(cls := "tile", b(id := key, "–"), span(what))
      ),
      div(
        id := "live",
        cls := "viewer-live card",
        div(
          cls := "choice",
          label("layer ", select(id := "layer")),
          label(
            "tone curve ",
            select(id := "curve", curves.map(c => option(value := c.word, c.word)))
          ),
          label("exposure ", exposure, span(id := "evtext")),
          button(id := "whole", "whole image"),
          label(input(tpe := "checkbox", id := "showtiles", checked), "tiles in progress")
        ),
        div(cls := "stage", attr("tabindex") := "0", attr("aria-label") := "image", canvas()),
        div(cls := "readout", attr("aria-live") := "polite"),
        p(cls := "soft", keys)
      ),
      tables,
      h2("Error"),
      div(id := "charts", p(cls := "soft", "No estimate before the second sample.")),
      h2("Scene"),
      Page.facts(plan)
    )

  /** Those that act on each channel by itself. */
  private val curves = Vector(ToneCurve.Linear, ToneCurve.Filmic)

  /** Each curve at the places √(v / (1 + v)) of the values v, which the page interpolates. */
  private def tables: Frag =
    def table(curve: ToneCurve) = Vector.tabulate(TableSize + 1): i =>
      val place = Math.min(i.toFloat / TableSize, 0.9999f)
      val value = place * place / (1 - place * place)
      Math.min(1f, curve(Rgb.gray(value)).r)
    val all = curves.map(c => c.word -> ujson.Arr.from(table(c).map(v => ujson.Num(v.toDouble))))
    script(tpe := "application/json", id := "curves", raw(ujson.write(ujson.Obj.from(all))))

  private val TableSize = 1024

  private def exposure: Frag =
    input(
      tpe := "range",
      id := "ev",
      attr("min") := "-10",
      attr("max") := "10",
      step := "0.5",
      value := "0"
    )

  private val keys =
    "Keys: + and − zoom, arrows move the pixel cursor (with Shift by ten), e and E change the " +
      "exposure, c the tone curve, l the layer, t the tiles, 0 shows the whole image."
