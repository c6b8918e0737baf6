package candela.report

import candela.color.{Rgb, ToneCurve}

import scalatags.Text.all.*

/** Page that follows a rendering; its script asks the server for state, image and charts. */
object LivePage:

  /** @param scene       as users named it: the title is its file's name
    * @param plan        features of the scene: (feature, value)
    * @param warnings    of reading and building the scene
    * @param isEstimated whether errors are, for lack of a reference
    * @param isMoving    whether viewers move the camera
    */
  def html(
      scene: String,
      version: String,
      plan: Vector[(String, String)],
      warnings: Vector[String],
      isEstimated: Boolean,
      isMoving: Boolean = false
  ): String =
    val subtitle = span(id := "stage", attr("role") := "status", "connecting")
    Page.served(scene.split(raw"[/\\]").last, subtitle, version, scripts(isMoving))(
      div(
        id := "live",
        Viewer.stage(
          "image: arrows move the pixel cursor, plus and minus zoom",
          p(id := "waiting", cls := "waiting", "waiting for the first pass")
        ),
        div(
          cls := "beside",
          actions(isMoving),
          p(
            id := "files",
            attr("role") := "status",
            attr("tabindex") := "-1",
            attr("hidden") := ""
          ),
          Option.when(isMoving)(CameraControls.all),
          Option.when(warnings.nonEmpty)(warned(warnings)),
          figures(isEstimated, isMoving),
          display,
          div(cls := "readout")
        )
      ),
      tables,
      p(cls := "soft", if isMoving then CameraControls.keys else keys),
      div(
        id := "errors",
        Option.when(isMoving)(attr("hidden") := ""),
        h2("Error"),
        div(id := "charts", p(cls := "soft", "No estimate before the second sample."))
      ),
      h2("Scene"),
      Page.facts(("file" -> scene) +: plan)
    )

  private def scripts(isMoving: Boolean): Vector[String] =
    if isMoving then Vector("live", "move") else Vector("live")

  private def actions(isMoving: Boolean): Frag =
    div(
      cls := "choice",
      Option.when(isMoving)(CameraControls.tools),
      button(id := "stop", "stop"),
      button(id := "keep", attr("aria-pressed") := "false", "add samples"),
      button(id := "save", if isMoving then "write camera" else "save"),
      button(id := "end", attr("hidden") := "", "end"),
      span(
        id := "progress",
        cls := "bar",
        attr("role") := "progressbar",
        attr("aria-label") := "rendered",
        attr("aria-valuemin") := "0",
        attr("aria-valuemax") := "100",
        i(id := "done")
      )
    )

  private def warned(warnings: Vector[String]): Frag =
    val count = if warnings.sizeIs == 1 then "1 warning" else s"${warnings.size} warnings"
    tag("details")(cls := "warning", tag("summary")(count), warnings.map(p(_)))

  private def figures(isEstimated: Boolean, isMoving: Boolean): Frag =
    val error = ErrorCharts(Vector.empty, isEstimated).word("relative error")
    val figures = Vector("samples" -> "samples per pixel", "left" -> "left") ++
      Vector("seconds" -> "rendering", "rate" -> "samples per second", "error" -> error)
    val absent = if isMoving then Set("left", "error") else Set.empty
    def hides(key: String) = Option.when(absent(key))(attr("hidden") := "")
    div(
      cls := "tiles",
      figures.map((key, words) => div(cls := "tile", hides(key), b(id := key, "–"), span(words)))
    )

  /** Controls of how the image is shown. */
  private def display: Frag =
    val curves = ToneCurve.values.toVector.map(c => option(value := c.word, c.word))
    div(
      cls := "choice",
      label("layer ", select(id := "layer", disabled, option("no image yet"))),
      label("tone curve ", select(id := "curve", curves)),
      label("exposure ", exposure, span(id := "evtext")),
      Viewer.zoomButtons,
      label(input(tpe := "checkbox", id := "showtiles", checked), "tiles in progress")
    )

  /** The stages of each tone curve, so that the page shows what a picture of the program does: what
    * it does to a channel's values v, at the places √(v / (1 + v)), and the matrices around it.
    */
  private def tables: Frag =
    def numbers(values: Seq[Float]) = ujson.Arr.from(values.map(v => ujson.Num(v.toDouble)))
    def stages(curve: ToneCurve) =
      val table = Vector.tabulate(TableSize + 1): i =>
        val coordinate = Math.min(i.toFloat / TableSize, 0.9999f)
        Math.min(curve.channel(coordinate * coordinate / (1 - coordinate * coordinate)), 2f)
      val mixing = curve.mixing.fold(ujson.Null: ujson.Value): (before, after) =>
        ujson.Arr(numbers(before), numbers(after))
      ujson.Obj("table" -> numbers(table), "mixing" -> mixing, "power" -> curve.power)
    val luminance = Vector(Rgb(1f, 0f, 0f), Rgb(0f, 1f, 0f), Rgb(0f, 0f, 1f)).map(_.luminance)
    val display = ujson.Obj(
      "luminance" -> numbers(luminance),
      "curves" -> ujson.Obj.from(ToneCurve.values.map(c => c.word -> stages(c)))
    )
    script(tpe := "application/json", id := "display", raw(ujson.write(display)))

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
    "Keys: + and − zoom, 0 shows the whole image, e and E change the exposure, c the tone curve, " +
      "l the layer, t the tiles. On the image, arrows move the pixel cursor (with Shift by ten), " +
      "and the wheel zooms; with Ctrl it always does."
