package candela.convert

import candela.color.Rgb
import candela.lights.PictureLookup
import candela.math.{cos, radians, Transform}
import candela.scenefile.{AnimatedTransform, LightDescription, Param, ParamType}

/** Lights, from v3 to v4. */
object ToV4Lights:
  import Steps.*

  private val samples = drop("samples", "nsamples")

  /** The image in v4's layout. In v3, `L` (or `I`) and `scale` are factors of its pixels; v4 has
    * only a number.
    */
  private def image(color: String, optional: Boolean): Step =
    Step(
      s"`mapname`, `$color`, `scale`",
      "`filename` of an equal-area image, written beside the " +
        "scene; `scale`"
    ): s =>
      s.take("mapname").filter(_.strings.headOption.exists(_.nonEmpty)) match
        case None => Emission.toV4(color).run(s)
        case Some(p) =>
          val factor = s.takeColor(color, Rgb.White) * s.takeColor("scale", Rgb.White)
          val isGray = Values.isGray(factor)
          // "goniometric" keeps its colour as a factor; v4 takes the mean of its image's channels
          val channel = Channels.find(c => factor * c == factor && factor != Rgb.Black)
          val tint =
            if optional then if isGray then Rgb.White else factor
            else channel.fold(Rgb.White)(_ * 3f)
          val name = SkyImages.converted(p, s, toSquare = true, tint)
          s.addString("filename", name)(using p.pos)
          if !isGray && !optional then s.addRgb(color, factor)
          else if isGray && factor.r != 1f then s.addFloat("scale", factor.r)

  private val projection: Step =
    Step("`mapname`, `I`, `scale`, `fov`", "`filename` (with the colour), `scale`, `fov`"): s =>
      s.addFloat("fov", s.takeNumber("fov", 45f))
      val factor = s.takeColor("I", Rgb.White) * s.takeColor("scale", Rgb.White)
      val y = factor.luminance
      if y != 1f then s.addFloat("scale", y)
      // v4 has no colour besides the image's, and requires an image.
      val tint = if y > 0f && !Values.isGray(factor) then factor * (1f / y) else Rgb.White
      s.take("mapname") match
        case Some(p) =>
          val slide = RewrittenImages.slide(s, p, PictureLookup.SmoothRepeating, tint)
          s.addString("filename", slide)(using p.pos)
        case None => s.addString("filename", RewrittenImages.plain(s, tint))

  val table: Table = Table("LightSource")(
    Rule("point" -> "point")(retain("from"), Emission.toV4("I"), samples),
    Rule("distant" -> "distant")(retain("from", "to"), Emission.toV4("L"), samples),
    Rule.approximate("spot" -> "spot", "different falloff at the edge of the cone")(
      retain("from", "to"),
      SpotEdge.step(SpotEdge.MeanInV3 / SpotEdge.MeanInV4),
      Emission.toV4("I"),
      samples
    ),
    Rule("goniometric" -> "goniometric")(image("I", optional = false), samples),
    Rule("projection" -> "projection")(projection, samples),
    Rule("infinite|exinfinite" -> "infinite")(image("L", optional = true), samples)
  )

  val area: Table = Table("AreaLightSource")(
    Rule("diffuse|area" -> "diffuse")(retain("twosided"), Emission.toV4("L"), samples)
  )

  /** A light of v4 whose image has colours is one of each primary colour. */
  def placed(l: LightDescription, run: PassRun): Vector[LightDescription] =
    if l.light.name != "goniometric" then Vector(flipped(l))
    else if !l.light.param("mapname").exists(RewrittenImages.isColored(l.light, _)) then Vector(l)
    else
      def color(name: String) =
        l.light.param(name).flatMap(run.values.color(_, l.light)).getOrElse(Rgb.White)
      val remaining = l.light.params.filterNot(p => p.name == "I" || p.name == "scale")
      val at = l.light.param("I").fold(l.light.pos)(_.pos)
      for
        channel <- Channels
        part = color("I") * color("scale") * channel
        if part != Rgb.Black
        intensity = Param.floats(ParamType.Rgb, "I", at, Array(part.r, part.g, part.b))
      yield l.copy(light = l.light.copy(params = remaining :+ intensity))

  private val Channels = Vector(Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1))

  /** v3's projected image is flipped vertically relative to v4's. */
  def flipped(l: LightDescription): LightDescription =
    if l.light.name != "projection" then l
    else
      val flip = Transform.scale(1, -1, 1).get
      val t = l.lightToWorld
      l.copy(lightToWorld = AnimatedTransform(t.start * flip, t.end * flip))

/** The edge of a spot light, where v3's light falls off with the fourth power of the cosine's
  * distance to the end of the cone, v4's in a smoothstep of it.
  */
private object SpotEdge:
  /** The mean over the cosine, within the edge, of the intensity relative to that before it. */
  val MeanInV3 = 1f / 5f
  val MeanInV4 = 1f / 2f

  /** An edge as much narrower or wider in the cosine that the power of the light stays, unless it
    * would be wider than the sphere.
    */
  def step(ratio: Float): Step =
    Step("`coneangle`, `conedeltaangle`", "`coneangle`, `conedeltaangle` of the same power"): s =>
      val end = s.takeNumber("coneangle", 30f)
      val start = end - s.takeNumber("conedeltaangle", 5f)
      val cosStart = cos(radians(start))
      val cosEnd = cosStart - (cosStart - cos(radians(end))) * ratio
      val isSharp = end == start
      val changed =
        if isSharp then end else Math.toDegrees(Math.acos(Math.max(cosEnd, -1f))).toFloat
      s.addFloat("coneangle", changed)
      s.addFloat("conedeltaangle", changed - start)
