package candela.models

import candela.color.Rgb
import candela.diagnostics.SourcePos
import candela.math.{Transform, Vec3}
import candela.scenefile.{
  Declaration, Dialect, GraphicsState, LightDescription, MaterialRef, Param, ParamType,
  ShapeDescription
}

/** Translates lights. Candela of visible light become watts per steradian by 683 lumens per watt,
  * and lux watts per square metre, as in Blender; emission is as it is written.
  *
  * `extras.candela` gives punctual lights an extent, and nodes area lights. They cast no shadow:
  * rays pass them.
  */
private[models] final class Lights(file: GltfFile, session: Session):
  private val entries =
    file.root.extension("KHR_lights_punctual").toVector.flatMap(_.list("lights"))

  /** What a scene says of its surroundings. */
  def environment(scene: Json): Option[Extras] =
    Extras.of(scene, "scenes", "environment", session)("radiance", "rotation", "uri")

  /** The light of the surroundings, if there is any. */
  def surroundings(environment: Extras): Option[LightDescription] =
    val at = environment.entry.at
    val radiance = environment.color("radiance", Rgb.White)
    val rotation = environment("rotation").fold(Vector(0.0, 0.0, 0.0, 1.0))(_.numbers(4))
    val image = environment("uri").map(_ => file.imageName(environment.entry))
    val params =
      Picture.rgb("L", radiance, at) +: image.map(Param.string("mapname", at, _)).toVector
    // v3's maps are equirectangular, as is usual
    val light = session.declare("LightSource", "infinite", at, params, image.map(_ => Dialect.V3))
    val turn = Nodes.of(Seq(0, 0, 0), rotation, Seq(1, 1, 1))
    Option.when(radiance != Rgb.Black):
      LightDescription(light, GraphicsState.constant(turn * Lights.Forward))

  def apply(p: PlacedNode): Option[LightDescription | ShapeDescription] =
    def extras(known: String*) = Extras.of(p.node, "nodes", "light", session)(known*)
    p.node.extension("KHR_lights_punctual") match
      case Some(e) =>
        val entry = e.required("light").element(entries, "lights")
        for range <- entry("range") do
          session.warn(
            range.at,
            "`range` is ignored: light falls off with the square of the distance"
          )
        entry.required("type").text match
          case "point" => Some(point(entry, p, extras("inView", "radius")))
          case "directional" => Some(directional(entry, p, extras("angle", "inView")))
          case "spot" => Some(spot(entry, p, extras("blend", "inView", "radius")))
          case other =>
            entry.required("type").fail(s"expected point, directional or spot, found `$other`")
      case None => extras("inView", "radiance", "shape", "size", "spread").map(area(_, p))

  /** Of the type of light: radiant intensity, or irradiance. */
  private def power(entry: Json): Rgb =
    Materials.rgb(entry, "color", Rgb.White) *
      (entry.number("intensity", 1) / Lights.LumensPerWatt).toFloat

  private def point(entry: Json, p: PlacedNode, extras: Option[Extras]) =
    ball(entry, p, extras, Vector.empty).getOrElse:
      placed(declare(entry, "point", Vector(Picture.rgb("I", power(entry), entry.at))), p)

  private def directional(entry: Json, p: PlacedNode, extras: Option[Extras]) =
    val at = entry.at
    val irradiance = power(entry)
    val angle = extras.fold(0.0)(_.number("angle", 0, 0, Math.PI))
    if angle == 0 then
      placed(declare(entry, "distant", Picture.rgb("L", irradiance, at) +: axis(at)), p)
    else
      // A sun without sky, whose zenith is where it stands. Of a large one, what is far from the
      // middle adds less to the irradiance
      val size = Math.min(angle, Lights.MaxAngle)
      val c = irradiance * (2 / (1 + Math.cos(size / 2))).toFloat
      val params = Vector(
        Param.float("skyscale", at, 0f),
        Param.float("sunirradiance", at, c.r, c.g, c.b),
        Param.float("sunaperture", at, Math.toDegrees(size).toFloat)
      )
      placed(declare(entry, "sunsky", params :+ inView(extras, at)), p)

  private def spot(entry: Json, p: PlacedNode, extras: Option[Extras]) =
    val at = entry.at
    val cone = entry.required("spot")
    val (inner, outer) =
      (cone.number("innerConeAngle", 0), cone.number("outerConeAngle", Math.PI / 4))
    if !(inner >= 0 && inner < outer && outer <= Math.PI / 2 + 1e-6) then
      cone.fail(s"expected 0 ≤ inner < outer ≤ π/2, found $inner and $outer")
    // A blend is pbrt-v4's falloff, over a part of 1 − cos
    val blend = extras.filter(_("blend").isDefined).map(_.number("blend", 0, 0, 1))
    val full = blend.fold(inner)(b => Math.acos(b + (1 - b) * Math.cos(outer)))
    val angles = Vector(
      Param.float("coneangle", at, Math.toDegrees(outer).toFloat),
      Param.float("conedeltaangle", at, Math.toDegrees(outer - full).toFloat)
    )
    ball(entry, p, extras, beamAxis(p, at) +: angles).getOrElse:
      val params = (Picture.rgb("I", power(entry), at) +: axis(at)) ++ angles ++
        blend.map(_ => Param.string("falloff", at, "smoothstep"))
      placed(declare(entry, "spot", params), p)

  /** A light with a radius, as a sphere of the same intensity. */
  private def ball(
      entry: Json,
      p: PlacedNode,
      extras: Option[Extras],
      beam: Vector[Param]
  ): Option[ShapeDescription] =
    for
      e <- extras
      radius = e.size("radius", 0)
      if radius > 0
    yield
      val at = e.entry.at
      val radiance = power(entry) * (1 / (Math.PI * radius * radius)).toFloat
      val sphere =
        session.declare("Shape", "sphere", at, Vector(Param.float("radius", at, radius.toFloat)))
      emitter(sphere, Nodes.rigid(p.toWorld), radiance, beam :+ inView(extras, at), e)

  private def area(extras: Extras, p: PlacedNode): ShapeDescription =
    val at = extras.entry.at
    val Vector(width, height) = extras.sizes("size"): @unchecked
    val spread = extras.number("spread", Math.PI, Lights.MinSpread, Math.PI)
    val params = Vector(
      beamAxis(p, at),
      Param.float("spread", at, Math.toDegrees(spread).toFloat),
      inView(Some(extras), at)
    )
    val name = extras("shape").fold("rectangle")(_.text)
    val shape = name match
      case "rectangle" =>
        val corners = Vector((-1, -1), (-1, 1), (1, 1), (1, -1))
          .flatMap((x, y) => Vector((x * width / 2).toFloat, (y * height / 2).toFloat, 0f))
        session.declare(
          "Shape",
          "trianglemesh",
          at,
          Vector(
            Param.floats(ParamType.Point3, "P", at, corners.toArray),
            Param.int("indices", at, 0, 1, 2, 0, 2, 3)
          )
        )
      case "ellipse" =>
        session.declare(
          "Shape",
          "disk",
          at,
          Vector(Param.float("radius", at, 0.5f * width.toFloat))
        )
      case other => extras("shape").get.fail(s"expected rectangle or ellipse, found `$other`")
    // Disks face along z, and lights shine along -z
    val toWorld =
      if name == "rectangle" then p.toWorld
      else p.toWorld * Lights.Turned * Transform.scale(1, height / width, 1).get
    emitter(shape, toWorld, extras.color("radiance", Rgb.White), params, extras)

  private def emitter(
      shape: Declaration,
      toWorld: Transform,
      radiance: Rgb,
      params: Vector[Param],
      extras: Extras
  ): ShapeDescription =
    val at = extras.entry.at
    ShapeDescription(
      shape,
      GraphicsState.constant(toWorld),
      reverseOrientation = false,
      MaterialRef.Inline(session.declare("Material", "interface", at, Nil)),
      Some(session.declare(
        "AreaLightSource",
        "diffuse",
        at,
        Picture.rgb("L", radiance, at) +: params
      ))
    )

  private def inView(extras: Option[Extras], at: SourcePos): Param =
    Param.bool("inview", at, extras.forall(_.isInView))

  private def beamAxis(p: PlacedNode, at: SourcePos): Param =
    val d = -Nodes.rigid(p.toWorld).vector(Vec3.Z)
    Param.floats(ParamType.Vector3, "axis", at, Array(d.x, d.y, d.z))

  private def axis(at: SourcePos): Vector[Param] = Vector(end("from", at, 0f), end("to", at, -1f))

  private def end(name: String, at: SourcePos, z: Float): Param =
    Param.floats(ParamType.Point3, name, at, Array(0f, 0f, z))

  private def declare(entry: Json, name: String, params: Vector[Param]): Declaration =
    session.declare("LightSource", name, entry.at, params)

  private def placed(light: Declaration, p: PlacedNode): LightDescription =
    LightDescription(light, GraphicsState.constant(Nodes.rigid(p.toWorld)))

private[models] object Lights:
  private val LumensPerWatt = 683.0

  /** In radians. */
  private val MinSpread = 1e-3
  private val MaxAngle = Math.toRadians(179)

  private val Turned = Transform.rotate(180, 1, 0, 0).get

  /** From pbrt's maps, whose middle is at -x, to -z, where a model's front view looks. pbrt's axes
    * are left-handed, a model's right-handed.
    */
  val Forward: Transform =
    Transform.fromRows(Vector(0, -1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1)).get
