package candela.job

import candela.base.loop
import candela.color.Srgb
import candela.diagnostics.{Code, Problem, Severity}
import candela.image.{DisplayTransform, Image}
import candela.render.{FirstSurfaces, RenderPlan, Rendering, ViewSurvey}
import candela.scenefile.{Excerpts, NamedText}

import java.util.Locale

/** Warns of images that show nothing, with the reason as far as it can be known. */
object EmptyImage:

  /** Before rendering: the camera looks at nothing, or stands in a dark enclosure. */
  def foreseen(plan: RenderPlan, text: Option[NamedText]): Option[Problem] =
    for
      survey <- ViewSurvey.of(plan)
      if plan.lights > 0 && survey.isDark
      seen = survey.firstSurfaces
      if seen.rays > 0
      why <-
        if seen.hitsNothing then Some(s"$Past, and no light is there")
        else
          val inside = "the camera is inside a closed surface, which no light enters: "
          Option.when(survey.isEnclosed)(inside + nearest(seen))
    yield
      val help =
        if seen.hitsNothing then "turn the camera: the second point of LookAt is what it looks at"
        else "`candela preview` shows the surfaces in view"
      warning(Code.EmptyView, plan, text, why, help)

  /** Of a rendered image.
    *
    * @param isForeseen whether its user knows why it has no light
    * @param isPicture  whether its files hold what is displayed alone
    */
  def problem(
      prepared: Prepared,
      rendering: Rendering,
      image: Image,
      isForeseen: Boolean = false,
      isPicture: Boolean = false
  ): Option[Problem] =
    val plan = prepared.plan
    val isPreview = prepared.settings.preview
    val colors = Colors(image)
    val finding =
      if rendering.samplesDone == 0 || colors.pixels < MinPixels then None
      else if colors.isMostly(colors.broken) then
        Some(s"${share(colors.broken, colors)} of the pixels are NaN" -> developed(rendering))
      else if colors.black == colors.pixels then
        Option.unless(isForeseen)("the image is black" -> s": ${whyBlack(plan)}")
      else if colors.isMostly(colors.negative) then
        val message = s"${share(colors.negative, colors)} of the pixels have negative values"
        Some(message -> developed(rendering))
      // The headlight of a preview shades a wall so
      else if colors.isUniform && plan.sight.isDefined && (!isPreview || sameness(plan).nonEmpty)
      then
        Option.unless(isForeseen)("all pixels have the same colour" -> sameness(plan))
      else if isPicture then tooDark(image, prepared.settings.output.display)
      else None
    finding.map: (what, why) =>
      val preview = if isPreview then "" else "`candela preview` shows the surfaces in view, and "
      val help = s"$preview--pixelmaterial x,y prints what a pixel shows"
      warning(Code.EmptyImage, plan, prepared.description.text, what + why, help)

  /** Of light that rounds to black in the picture. */
  private def tooDark(image: Image, display: DisplayTransform): Option[(String, String)] =
    val light = Denoising.displayed(image).toRgb
    val (brightest, shown) = (light.data.max, display(light).toRgb.data.max)
    Option.when(shown > 0f && Srgb.encode(shown) * ((1 << display.bits) - 1) < 0.5f):
      val stops = Math.floor(-Math.log(brightest.toDouble) / Math.log(2)).toInt
      val value = "its brightest value is %.2g".formatLocal(Locale.ROOT, brightest)
      "the picture is black" -> s": $value; --exposure $stops shows it"

  private val Past = "the camera looks past all surfaces"

  /** Fewer pixels may be black or alike by chance. */
  private val MinPixels = 16

  /** At the nearest surface, or at the camera that sees none. */
  private def warning(
      code: Code,
      plan: RenderPlan,
      text: Option[NamedText],
      message: String,
      help: String
  ): Problem =
    val pos = plan.sight.flatMap: sight =>
      ViewSurvey(plan, sight).firstSurfaces.statement.orElse(sight.camera)
    val problem = Problem(code, Severity.Warning, pos.flatMap(_.toOption), message, Some(help))
    Excerpts.fill(Vector(problem), Excerpts.sources(text)).head

  private def whyBlack(plan: RenderPlan): String =
    if plan.lights == 0 then "the scene has no light"
    else
      ViewSurvey.of(plan).map(_.firstSurfaces).filter(_.rays > 0).fold("no sample has light"):
        seen =>
          if seen.hitsNothing then Past
          else if seen.hitsMediaOnly then "no light comes through the media that the camera sees"
          else s"no light comes from the surfaces that the camera sees: ${nearest(seen)}"

  private def nearest(seen: FirstSurfaces): String =
    "the nearest is at distance %.3g".formatLocal(Locale.ROOT, seen.distance)

  /** Whether the colours became so after the samples were added. */
  private def developed(rendering: Rendering): String =
    val light = Colors(rendering.film.toImage(1f))
    if light.isMostly(light.broken) || light.isMostly(light.negative) then ""
    else "; the light is not: the film's sensor, white balance or scale makes them so"

  private def sameness(plan: RenderPlan): String =
    ViewSurvey.of(plan).map(_.firstSurfaces).fold(""): seen =>
      if seen.hitsNothing then s": $Past"
      else if seen.hitsMediaOnly then ": all that is in view is borders of media, which are unseen"
      else ""

  private def share(count: Int, of: Colors): String =
    if count == of.pixels then "all" else s"${100L * count / of.pixels} %"

  /** Numbers of pixels of a kind. */
  private final class Colors(image: Image):
    private val channels = image.colorChannels.distinct.toArray
    val pixels: Int = image.width * image.height
    var broken, negative, black = 0
    private var isSame = true

    locally:
      val first = channels.map(image.data(_))
      loop(pixels): pixel =>
        var isBroken = false
        var isBlack = true
        var sum = 0f
        loop(channels.length): c =>
          val value = image.data(pixel * image.channels + channels(c))
          if value.isNaN then isBroken = true
          sum += value
          if value != 0 then isBlack = false
          if value != first(c) then isSame = false
        if isBroken then broken += 1
        // A single negative channel is a colour outside the gamut
        if sum < 0 then negative += 1
        if isBlack then black += 1

    def isUniform: Boolean = isSame

    /** Whether these are more than half of the pixels. */
    def isMostly(count: Int): Boolean = count > pixels / 2
