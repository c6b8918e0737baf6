package candela.models

import candela.base.loop
import candela.color.Rgb
import candela.diagnostics.Code
import candela.geometry.Bounds3
import candela.math.{Transform, Vec3}
import candela.scenefile.{
  Declaration, GraphicsState, LightDescription, MaterialRef, Param, ParamType, SceneDescription,
  ShapeDescription
}

/** What a model lacks to be shown: a view of it, and light. */
private[models] object Studio:

  /** The scene with a camera if it has none, and in a studio if nothing lights it. */
  def complete(scene: SceneDescription, session: Session): SceneDescription =
    val bounds = ModelBounds.of(scene)
    if bounds.isEmpty then
      session.error(session.at(""), "the model has no surface", Code.NoSurface)
      scene
    else
      val framed = if scene.camera.isDefined then scene else Framing.of(bounds, scene, session)
      val parts = Vector(
        Option.when(scene.camera.isEmpty)("a camera that sees all of it"),
        Option.when(!isLit(scene))("light")
      ).flatten
      val lit = if isLit(scene) then framed else Studio(bounds, framed, session).lit
      if parts.isEmpty then lit
      else lit.copy(dialectReason = s"with ${parts.mkString(" and ")}, which the model lacks")

  /** Whether there are lights. Images that glow on a surface, such as displays, are none. */
  private def isLit(scene: SceneDescription): Boolean =
    def shines(s: ShapeDescription) = s.areaLight.exists(_.param("filename").isEmpty)
    scene.lights.nonEmpty || (scene.shapes ++ scene.objects.values.flatten).exists(shines)

/** A neutral studio: a backdrop that rises behind the model, a large light before it, a fainter one
  * on the other side, one behind it, and dim light from everywhere.
  */
private final class Studio(bounds: Bounds3, scene: SceneDescription, session: Session):
  private val at = session.at("")
  private val center = (bounds.min + bounds.max) * 0.5f
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

  def lit: SceneDescription =
    if isInside then scene.copy(lights = scene.lights :+ everywhere(1f))
    else
      val panels = Vector(
        panel(-Math.PI / 4, Math.PI / 4, 4f, 1f, 8f),
        panel(Math.PI / 3, Math.PI / 7, 5f, 1.5f, 1.6f),
        panel(Math.PI * 0.9, Math.PI * 0.3, 4f, 1f, 3f)
      )
      scene.copy(
        lights = scene.lights :+ everywhere(0.4f),
        shapes = scene.shapes ++ panels :+ backdrop
      )

  private def everywhere(radiance: Float): LightDescription =
    val params = Vector(Textures.rgb("L", Rgb.gray(radiance), at))
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
      Vector(Textures.rgb("L", Rgb.gray(radiance), at))
    )
    shape(corners, Vector.empty, Vector(0, 1, 2, 0, 2, 3), 0f).copy(areaLight = Some(emission))

  private def backdrop: ShapeDescription =
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
    shape(points, normals, indices, Gray)

  private def shape(
      points: Vector[Vec3],
      normals: Vector[Vec3],
      indices: Vector[Int],
      gray: Float
  ): ShapeDescription =
    def triples(kind: ParamType, name: String, all: Vector[Vec3]) =
      Param.floats(kind, name, at, all.flatMap(p => Vector(p.x, p.y, p.z)).toArray)
    val params = Vector(
      triples(ParamType.Point3, "P", points),
      Param.int("indices", at, indices*)
    ) ++ Option.when(normals.nonEmpty)(triples(ParamType.Normal, "N", normals))
    val reflectance = Vector(Textures.rgb("reflectance", Rgb.gray(gray), at))
    ShapeDescription(
      session.declare("Shape", "trianglemesh", at, params),
      GraphicsState.Identity,
      reverseOrientation = false,
      MaterialRef.Inline(session.declare("Material", "diffuse", at, reflectance)),
      None
    )

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

  def of(bounds: Bounds3, scene: SceneDescription, session: Session): SceneDescription =
    val (c, s) = (Math.cos(Elevation), Math.sin(Elevation))
    val towardsViewer = Vec3(
      (Math.sin(Azimuth) * c).toFloat,
      s.toFloat,
      (Math.cos(Azimuth) * c).toFloat
    )
    val x = (Vec3.Y cross towardsViewer).normalized
    val y = towardsViewer cross x
    val center = (bounds.min + bounds.max) * 0.5f
    val aspect = session.aspect(View.Aspect)
    val halfWidth = HalfLonger * Math.min(1, aspect)
    val halfHeight = HalfLonger / Math.max(1, aspect)
    val distance = (0 to 7).map: k =>
      val p = bounds.corner(k) - center
      val wide = Math.abs(p dot x) / halfWidth
      val high = Math.abs(p dot y) / halfHeight
      (p dot towardsViewer) + Math.max(wide, high) / Share
    .max
    val eye = center + towardsViewer * Math.max(distance, 1e-6).toFloat
    val rows = Vector(
      x.x, y.x, towardsViewer.x, eye.x,
      x.y, y.y, towardsViewer.y, eye.y,
      x.z, y.z, towardsViewer.z, eye.z,
      0f, 0f, 0f, 1f
    ).map(_.toDouble)
    val at = session.at("")
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
