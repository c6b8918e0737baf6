package candela.models

import candela.base.loop
import candela.color.Rgb
import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.geometry.Bounds3
import candela.image.ImageSize
import candela.io.SceneFolder
import candela.math.{Transform, Vec3}
import candela.scenefile.{
  Declaration, Dialect, GraphicsState, LightDescription, MaterialRef, Param, ParamType,
  SceneDescription,
  ShapeDescription
}
import candela.settings.{ModelGround, ModelLight, ReadSettings}

import java.nio.file.{Files, Path}

/** What a model lacks to be shown: a view of it, and light. */
private[models] object Studio:

  /** The scene with a camera if it has none, and in a studio if nothing lights it, or as settings.
    *
    * @param world   number of the image of a turntable
    * @param isWhole whether it needs no light
    * @param framed  the scene whose bounds choose the view and the studio; none: itself
    */
  def complete(
      scene: SceneDescription,
      session: Session,
      reading: ReadSettings,
      world: Int,
      isWhole: Boolean,
      framed: Option[SceneDescription] = None
  ): SceneDescription =
    val settings = reading.model
    val bounds = ModelBounds.of(framed.getOrElse(scene))
    val isDark = !isWhole && !isLit(scene)
    if isWhole && bounds.isEmpty && scene.camera.isDefined && settings.light.isEmpty then scene
    else if bounds.isEmpty then
      session.error(session.position, "the model has no surface", Code.NoSurface)
      scene
    else
      val images = settings.turntable.getOrElse(1)
      val viewed =
        if scene.camera.isDefined then scene else Framing.of(bounds, scene, session, images)
      val turn = settings.turntable.fold(0.0)(world * 360.0 / _)
      val turned =
        if settings.turntable.isEmpty then viewed
        else
          View.numbered(viewed, session, world).copy(
            worldToCamera = GraphicsState.constant(
              viewed.worldToCamera.start * turning(bounds.center, -turn)
            ),
            isFollowed = world + 1 < images
          )
      val light = settings.light.orElse(Option.when(isDark)(ModelLight.Studio))
      if settings.background.nonEmpty && !light.exists(_.hasGround) then
        val help = "--light studio and --light sky have one"
        throw SceneError(Problem.general(
          Code.OptionMisfit,
          s"`${session.file}` is shown without a ground, which --background changes",
          Some(help)
        ))
      val dark = if settings.light.isEmpty then turned else turned.copy(lights = Vector.empty)
      val lit = light.fold(dark)(Surroundings(bounds, dark, session, settings.background, turn).lit)
      val missing = Vector(
        Option.when(scene.camera.isEmpty && reading.camera.isEmpty)("a camera that sees all of it"),
        Option.when(settings.light.isEmpty && isDark)("a studio with light")
      ).flatten
      lit.copy(additions =
        Option.when(missing.nonEmpty)(s"shown by ${missing.mkString(" and ")}, which it lacks")
      )

  private def turning(p: Vec3, degrees: Double): Transform =
    val (x, y, z) = (p.x.toDouble, p.y.toDouble, p.z.toDouble)
    val turn = Transform.rotate(degrees, 0, 1, 0).getOrElse(Transform.Identity)
    Transform.translate(x, y, z) * turn * Transform.translate(-x, -y, -z)

  /** Whether there are lights. Images that glow on a surface, such as displays, are none. */
  private def isLit(scene: SceneDescription): Boolean =
    def shines(s: ShapeDescription) = s.areaLight.exists(_.param("filename").isEmpty)
    scene.lights.nonEmpty || (scene.shapes ++ scene.objects.values.flatten).exists(shines)

/** What surrounds a model.
  *
  * @param turn of a turntable, in degrees
  */
private final class Surroundings(
    bounds: Bounds3,
    scene: SceneDescription,
    session: Session,
    background: Option[ModelGround],
    turn: Double
):
  private val at = session.position
  private val center = bounds.center
  private val radius = Math.max(0.5f * (bounds.max - bounds.min).length, 1e-6f)
  private val eye = scene.worldToCamera.start.inverse.point(Vec3.Zero)

  /** Where the camera is, around the vertical axis. */
  private val azimuth =
    val d = eye - center
    if Math.hypot(d.x, d.z) < 1e-3 * radius then Framing.Azimuth
    else Math.atan2(d.x.toDouble, d.z.toDouble)

  private def isInside: Boolean =
    def isBetween(lo: Float, x: Float, hi: Float) = lo < x && x < hi
    isBetween(bounds.min.x, eye.x, bounds.max.x) && isBetween(bounds.min.y, eye.y, bounds.max.y) &&
    isBetween(bounds.min.z, eye.z, bounds.max.z)

  def lit(light: ModelLight): SceneDescription = light match
    case ModelLight.Studio =>
      if isInside then scene.copy(lights = scene.lights :+ everywhere(1f)) else inStudio
    case ModelLight.Sky =>
      val ground = if isInside then None else onGround(flat(_))
      scene.copy(lights = scene.lights :+ sky, shapes = scene.shapes ++ ground)
    case ModelLight.Surroundings(file) =>
      if !Files.exists(Path.of(file)) then
        val near = Suggest.nearest(file, Vector("studio", "sky"))
          .orElse(SceneFolder.suggestionFor(Path.of(file)))
        val help =
          near.fold("--light takes studio, sky or an image file")(n => s"did you mean `$n`?")
        throw SceneError(Problem.general(Code.NoSuchFile, s"no such file: `$file`", Some(help)))
      val path = Path.of(file).toAbsolutePath.toString
      for
        size <- session.folder.glance(path).flatMap(ImageSize.guess)
        if size.height > 1 && size.width != 2 * size.height
      do
        val message = s"`$file` has ${size.width}×${size.height} pixels, and is stretched: an " +
          "equirectangular map is twice as wide as high"
        session.warn(at, message, Code.ImageContents)
      val params = Vector(Param.string("mapname", at, path))
      // v3's maps are equirectangular, as is usual
      val image = session.declare("LightSource", "infinite", at, params, Some(Dialect.V3))
      val toWorld = Transform.rotate(turn, 0, 1, 0).fold(Lights.Forward)(_ * Lights.Forward)
      scene.copy(lights =
        scene.lights :+ LightDescription(image, GraphicsState.constant(toWorld))
      )

  /** From pbrt's and Mitsuba's z, which points up, to y. */
  private val upright = Transform.rotate(-90, 1, 0, 0).getOrElse(Transform.Identity)

  /** A neutral studio: a backdrop that rises behind the model, a large light before it, a fainter
    * one on the other side, one behind it, and dim light from everywhere.
    */
  private def inStudio: SceneDescription =
    val panels = Vector(
      panel(-Math.PI / 4, Math.PI / 4, 4f, 1f, 8f),
      panel(Math.PI / 3, Math.PI / 7, 5f, 1.5f, 1.6f),
      panel(Math.PI * 0.9, Math.PI * 0.3, 4f, 1f, 3f)
    )
    scene.copy(
      lights = scene.lights :+ everywhere(0.4f),
      shapes = scene.shapes ++ panels ++ onGround(backdrop)
    )

  private def onGround(shape: Rgb => ShapeDescription): Option[ShapeDescription] =
    background.getOrElse(ModelGround.Colored(Rgb.gray(Backdrop.Gray))) match
      case ModelGround.Empty => None
      case ModelGround.Colored(color) => Some(shape(color))

  /** Sun and clear sky, the sun to the left of the camera. */
  private def sky: LightDescription =
    val d = upright.inverse.vector(direction(-Math.PI / 4, Math.PI / 4))
    val params = Vector(
      Param.floats(ParamType.Vector3, "sun", at, Array(d.x, d.y, d.z)),
      Param.float("skyscale", at, Sky.Scale),
      Param.float("sunscale", at, Sky.Scale)
    )
    val light = session.declare("LightSource", "sunsky", at, params)
    LightDescription(light, GraphicsState.constant(upright))

  private def flat(color: Rgb): ShapeDescription =
    val (w, y) = (Sky.Width * radius, bounds.min.y)
    val corners = Vector((-w, w), (w, w), (w, -w), (-w, -w))
      .map((x, z) => Vec3(center.x + x, y, center.z + z))
    shape(corners, Vector.empty, Vector(0, 1, 2, 0, 2, 3), color)

  private def everywhere(radiance: Float): LightDescription =
    val params = Vector(Picture.rgb("L", Rgb.gray(radiance), at))
    LightDescription(
      session.declare("LightSource", "infinite", at, params),
      GraphicsState.Identity
    )

  /** The direction from the model at an angle to the camera's, and one above the ground. */
  private def direction(angle: Double, elevation: Double): Vec3 =
    val a = azimuth + angle
    Vec3(
      (Math.sin(a) * Math.cos(elevation)).toFloat,
      Math.sin(elevation).toFloat,
      (Math.cos(a) * Math.cos(elevation)).toFloat
    )

  /** A square light that faces the model.
    *
    * @param distance, half in radii of the model
    */
  private def panel(
      angle: Double,
      elevation: Double,
      distance: Float,
      half: Float,
      radiance: Float
  ): ShapeDescription =
    val d = direction(angle, elevation)
    val x = (Vec3.Y cross d).normalized * (half * radius)
    val y = (d cross x).normalized * (half * radius)
    val p = center + d * (distance * radius)
    val corners = Vector(p - x - y, p - x + y, p + x + y, p + x - y)
    val emission = session.declare(
      "AreaLightSource",
      "diffuse",
      at,
      Vector(Picture.rgb("L", Rgb.gray(radiance), at))
    )
    shape(corners, Vector.empty, Vector(0, 1, 2, 0, 2, 3), Rgb.Black).copy(areaLight =
      Some(emission)
    )

  private def backdrop(color: Rgb): ShapeDescription =
    import Backdrop.*
    val towardsCamera = -direction(0, 0)
    val side = (Vec3.Y cross towardsCamera) * (Width * radius)
    val foot = Vec3(center.x, bounds.min.y, center.z)
    // Along the floor, up a quarter of a circle, and up the wall: distance, height, slope
    val arc = (0 to Steps).map: k =>
      val a = k * Math.PI / 2 / Steps
      (Depth + Bend * Math.sin(a), Bend * (1 - Math.cos(a)), a)
    val profile = ((-Width.toDouble, 0.0, 0.0) +: arc) :+ (Depth + Bend, Height, Math.PI / 2)
    val points = profile.toVector.flatMap: (distance, height, _) =>
      val p =
        foot + towardsCamera * (distance * radius).toFloat + Vec3.Y * (height * radius).toFloat
      Vector(p - side, p + side)
    val normals = profile.toVector.flatMap: (_, _, a) =>
      val n = Vec3.Y * Math.cos(a).toFloat - towardsCamera * Math.sin(a).toFloat
      Vector(n, n)
    val indices = (0 until profile.size - 1).toVector.flatMap: k =>
      val i = 2 * k
      Vector(i, i + 1, i + 3, i, i + 3, i + 2)
    shape(points, normals, indices, color)

  private def shape(
      points: Vector[Vec3],
      normals: Vector[Vec3],
      indices: Vector[Int],
      color: Rgb
  ): ShapeDescription =
    def triples(kind: ParamType, name: String, all: Vector[Vec3]) =
      Param.floats(kind, name, at, all.flatMap(p => Vector(p.x, p.y, p.z)).toArray)
    val params = Vector(
      triples(ParamType.Point3, "P", points),
      Param.int("indices", at, indices*)
    ) ++ Option.when(normals.nonEmpty)(triples(ParamType.Normal, "N", normals))
    val reflectance = Vector(Picture.rgb("reflectance", color, at))
    ShapeDescription(
      session.declare("Shape", "trianglemesh", at, params),
      GraphicsState.Identity,
      reverseOrientation = false,
      MaterialRef.Inline(session.declare("Material", "diffuse", at, reflectance)),
      None
    )

  private object Sky:
    /** A white ground has about a radiance of 1. */
    val Scale = 2.8f

    /** Half of the ground, in radii of the model. */
    val Width = 1e4f

  private object Backdrop:
    // In radii of the model
    val Width = 60f
    val Depth = 8.0
    val Bend = 6.0
    val Height = 60.0

    val Steps = 16
    val Gray = 0.7f

/** A view of a model from before it, a little to its left and from above. */
private[models] object Framing:
  /** Around the vertical axis, from the front of the model (+z) towards +x. */
  val Azimuth: Double = Math.toRadians(30)
  private val Elevation = Math.toRadians(15)

  /** Half of the longer side of a film of 36 mm over a focal length of 35 mm. */
  private val HalfLonger = 18.0 / 35

  /** Share of the image that the model may take. */
  private val Share = 0.9

  /** @param images of a turntable; the model fits into each */
  def of(
      bounds: Bounds3,
      scene: SceneDescription,
      session: Session,
      images: Int
  ): SceneDescription =
    val (c, s) = (Math.cos(Elevation), Math.sin(Elevation))
    val towardsViewer = Vec3(
      (Math.sin(Azimuth) * c).toFloat,
      s.toFloat,
      (Math.cos(Azimuth) * c).toFloat
    )
    val x = (Vec3.Y cross towardsViewer).normalized
    val y = towardsViewer cross x
    val center = bounds.center
    val aspect = session.aspect(View.Aspect)
    val halfWidth = HalfLonger * Math.min(1, aspect)
    val halfHeight = HalfLonger / Math.max(1, aspect)
    def distanceFor(p: Vec3) =
      val wide = Math.abs(p dot x) / halfWidth
      val high = Math.abs(p dot y) / halfHeight
      (p dot towardsViewer) + Math.max(wide, high) / Share
    val turns =
      (0 until images).map(k => Transform.rotate(k * 360.0 / images, 0, 1, 0).get)
    val distance = turns.map(t =>
      (0 to 7).map(k => distanceFor(t.vector(bounds.corner(k) - center))).max
    ).max
    val eye = center + towardsViewer * Math.max(distance, 1e-6).toFloat
    val rows = Vector(
      x.x, y.x, towardsViewer.x, eye.x,
      x.y, y.y, towardsViewer.y, eye.y,
      x.z, y.z, towardsViewer.z, eye.z,
      0f, 0f, 0f, 1f
    ).map(_.toDouble)
    val at = session.position
    val params = Vector(
      Param.float(
        "fov",
        at,
        Math.toDegrees(2 * Math.atan(Math.min(halfWidth, halfHeight))).toFloat
      ),
      Param.float("nearclip", at, (1e-4 * distance).toFloat),
      Param.float("farclip", at, View.FarAway)
    )
    val toWorld = Transform.fromRows(rows).getOrElse(Transform.Identity)
    View.addCamera(scene, session, toWorld, aspect, "perspective", params, at)

/** The box around a model. */
private object ModelBounds:
  def of(scene: SceneDescription): Bounds3 =
    val ofObjects = scene.objects.map((name, shapes) =>
      name -> shapes.map(s => box(s.shape, Transform.Identity)).foldLeft(Bounds3.Empty)(_.union(_))
    )
    val ofShapes = scene.shapes.iterator.map(s => box(s.shape, s.objectToWorld.start))
    val ofInstances = scene.instances.iterator.map: i =>
      val inner = ofObjects.getOrElse(i.name, Bounds3.Empty)
      if inner.isEmpty then inner
      else Bounds3.of((0 to 7).map(k => i.instanceToWorld.start.point(inner.corner(k))))
    (ofShapes ++ ofInstances).foldLeft(Bounds3.Empty)(_.union(_))

  private def box(shape: Declaration, toWorld: Transform): Bounds3 =
    val p = shape.param("P").fold(Array.emptyFloatArray)(_.floats)
    var (lo, hi) =
      (Vec3(1f, 1f, 1f) * Float.PositiveInfinity, Vec3(1f, 1f, 1f) * Float.NegativeInfinity)
    loop(p.length / 3): i =>
      val q = toWorld.point(Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2)))
      lo = Vec3(Math.min(lo.x, q.x), Math.min(lo.y, q.y), Math.min(lo.z, q.z))
      hi = Vec3(Math.max(hi.x, q.x), Math.max(hi.y, q.y), Math.max(hi.z, q.z))
    if lo.x > hi.x then Bounds3.Empty else Bounds3(lo, hi)
