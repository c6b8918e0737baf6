package candela.convert

import candela.base.loop
import candela.color.Rgb
import candela.lights.PictureLookup
import candela.math.{clamp, cos, Pi, radians, Transform, Vec3}
import candela.scenefile.{Param, ParamType, ShapeDescription}

/** Lights, from v4 to v3. */
object ToV3Lights:
  import Steps.*

  private type Factor = (Float, Statement) => Option[Float]
  private val point: Factor = (power, _) => Some(power / (4f * Pi))
  private val distant: Factor = (illuminance, _) => Some(illuminance)
  private val unknown: Factor = (_, _) => None

  /** Power of a cone with a soft edge, by v4's formula. */
  private def spot(power: Float, s: Statement) =
    def angle(name: String, default: Float) = s.peek(name).flatMap(s.numberOf).getOrElse(default)
    val (total, delta) = (angle("coneangle", 30f), angle("conedeltaangle", 5f))
    val (end, start) = (cos(radians(total)), cos(radians(total - delta)))
    Some(power / (2f * Pi * ((1f - start) + (start - end) * SpotEdge.MeanInV4)))

  private val infinite: Step =
    val plain = Emission.toV3("L", "illuminance", (e, _) => Some(e / Pi))
    val scaled = Emission.toV3("L", "illuminance", unknown)
    Step(
      "`filename`, `L`, `scale`, `illuminance`",
      "`mapname` of an equirectangular image, written beside the scene; `L`, `scale`"
    ): s =>
      s.take("filename").filter(_.strings.headOption.exists(_.nonEmpty)) match
        case None => plain.run(s)
        case Some(p) =>
          val name = SkyImages.converted(p, s, toSquare = false, Rgb.White)
          s.addString("mapname", name)(using p.pos)
          scaled.run(s)

  private val goniometric: Step =
    val light = Emission.toV3("I", "power", unknown)
    Step("`filename`, `I`, `scale`", "`mapname` of an equirectangular image; `I`, `scale`"): s =>
      for p <- s.take("filename") do
        val name = SkyImages.converted(p, s, toSquare = false, Rgb.White)
        s.addString("mapname", name)(using p.pos)
      light.run(s)

  private val projection: Step =
    val light = Emission.toV3("I", "power", unknown)
    Step("`filename`, `scale`, `fov`", "`mapname`, `scale`, `fov`"): s =>
      s.addFloat("fov", s.takeNumber("fov", 90f))
      for p <- s.take("filename") do
        s.addString("mapname", RewrittenImages.slide(s, p, PictureLookup.Nearest))(using p.pos)
      light.run(s)

  val table: Table = Table("LightSource")(
    Rule("point" -> "point")(retain("from"), Emission.toV3("I", "power", point)),
    Rule("distant" -> "distant")(retain("from", "to"), Emission.toV3("L", "illuminance", distant)),
    Rule.approximate("spot" -> "spot", "different falloff at the edge of the cone")(
      Emission.toV3("I", "power", spot),
      retain("from", "to"),
      SpotEdge.step(SpotEdge.MeanInV4 / SpotEdge.MeanInV3)
    ),
    Rule("goniometric" -> "goniometric")(goniometric),
    Rule("projection" -> "projection")(projection),
    Rule("infinite" -> "infinite")(
      infinite,
      unsupported("portal", "sampled over all directions")((_, _) => true)
    )
  )

  /** [[powered]] first converts a light's `power` to its `scale`, where the shape is known. */
  val area: Table = Table("AreaLightSource")(
    Rule("diffuse" -> "diffuse")(
      retain("twosided"),
      Emission.toV3("L", "power", unknown),
      unsupported("filename", "uniform emission")
    )
  )

  /** The shape with its light's `power` converted to a `scale`, if its area is known. */
  def powered(s: ShapeDescription): ShapeDescription =
    val scaledLight =
      for
        light <- s.areaLight
        power <- light.param("power").flatMap(_.floats.headOption) if power > 0f
        if light.param("filename").isEmpty
        area <- Areas.of(s)
      yield
        val sides = if light.param("twosided").exists(_.bools.contains(true)) then 2f else 1f
        val scale = light.param("scale").flatMap(_.floats.headOption).getOrElse(1f)
        val position = light.param("power").get.pos
        val scaleParam = Param(
          ParamType.Float,
          "scale",
          position,
          position,
          floats = Array(scale * power / (area * Pi * sides))
        )
        light.copy(params =
          light.params.filterNot(p => Set("power", "scale")(p.name)) :+ scaleParam
        )
    scaledLight.fold(s)(light => s.copy(areaLight = Some(light)))

/** Areas of shapes in world space, where easily computed. */
object Areas:

  def of(s: ShapeDescription): Option[Float] =
    val t = s.objectToWorld.start
    def number(name: String, default: Float) =
      s.shape.param(name).flatMap(_.floats.headOption).getOrElse(default)
    val radius = number("radius", 1f)
    val phi = radians(clamp(number("phimax", 360f), 0f, 360f))
    s.shape.name match
      case "trianglemesh" => Some(mesh(s, t))
      case "sphere" =>
        val (z0, z1) = (number("zmin", -radius), number("zmax", radius))
        val height = Math.abs(clamp(z1, -radius, radius) - clamp(z0, -radius, radius))
        uniform(t).map(_ * phi * radius * height)
      case "disk" =>
        val inner = number("innerradius", 0f)
        uniform(t).map(_ * phi * 0.5f * (radius * radius - inner * inner))
      case "cylinder" =>
        uniform(t).map(_ * phi * radius * Math.abs(number("zmax", 1f) - number("zmin", -1f)))
      case _ => None

  /** The factor of areas, if the transform is a similarity. */
  private def uniform(t: Transform): Option[Float] =
    val axes = Seq(Vec3.X, Vec3.Y, Vec3.Z).map(t.vector)
    val lengths = axes.map(_.length)
    val isEven = lengths.forall(l => Math.abs(l / lengths.head - 1f) < 1e-4f)
    val isSquare = Seq((0, 1), (0, 2), (1, 2)).forall: (i, j) =>
      Math.abs(axes(i) dot axes(j)) < 1e-4f * lengths.head * lengths.head
    Option.when(isEven && isSquare)(lengths.head * lengths.head)

  private def mesh(s: ShapeDescription, t: Transform): Float =
    val p = s.shape.param("P").fold(Array.emptyFloatArray)(_.floats)
    val indices = s.shape.param("indices").fold(Array(0, 1, 2))(_.ints)
    def vertex(i: Int) = t.point(Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2)))
    var sum = 0.0
    loop(indices.length / 3): i =>
      val corners = indices.slice(3 * i, 3 * i + 3)
      if corners.forall(k => k >= 0 && 3 * k + 2 < p.length) then
        val a = vertex(corners(0))
        sum += 0.5 * ((vertex(corners(1)) - a) cross (vertex(corners(2)) - a)).length
    sum.toFloat
