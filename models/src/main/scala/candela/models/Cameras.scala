package candela.models

import candela.diagnostics.SourcePos
import candela.io.FileName
import candela.math.Transform
import candela.scenefile.{Declaration, GraphicsState, Param, SceneDescription}

/** Translates cameras. */
private[models] final class Cameras(file: GltfFile, session: Session):
  private val entries = file.root.list("cameras")

  /** The scene as the camera of a node sees it. */
  def addCamera(scene: SceneDescription, p: PlacedNode): SceneDescription =
    val entry = p.node.required("camera").element(entries, "cameras")
    entry.required("type").text match
      case "perspective" =>
        val view = entry.required("perspective")
        val natural = view.number("aspectRatio", View.Aspect)
        checkAspect(view, natural)
        val aspect = session.aspect(natural)
        val height = view.required("yfov").number
        if !(height > 0 && height < Math.PI) then
          view.required("yfov").fail(s"expected an angle between 0 and π, found $height")
        val shorter =
          if aspect >= 1 then height else 2 * Math.atan(Math.tan(height / 2) * aspect)
        val (x, y) = if aspect >= 1 then (aspect, 1.0) else (1.0, 1 / aspect)
        val params = Param.float("fov", entry.at, Math.toDegrees(shorter).toFloat) +:
          (clips(view) ++ shift(p).map(window(_, x, y, entry.at)) ++ lens(p))
        View.addCamera(scene, session, p.toWorld, aspect, "perspective", params, entry.at)
      case "orthographic" =>
        val view = entry.required("orthographic")
        val (x, y) =
          (Math.abs(view.required("xmag").number), Math.abs(view.required("ymag").number))
        if x == 0 || y == 0 then view.fail("`xmag` and `ymag` must not be 0")
        checkAspect(view, x / y)
        val aspect = session.aspect(x / y)
        val across = if aspect == x / y then x else y * aspect
        View.addCamera(
          scene,
          session,
          p.toWorld,
          aspect,
          "orthographic",
          window(shift(p).getOrElse(View.Centred), across, y, entry.at) +: (clips(view) ++ lens(p)),
          entry.at
        )
      case other =>
        entry.required("type").fail(s"expected perspective or orthographic, found `$other`")

  private def extras(p: PlacedNode): Option[Extras] =
    Extras.of(p.node, "nodes", "camera", session)("shift", "apertureRadius", "focusDistance")

  private def shift(p: PlacedNode): Option[Vector[Double]] =
    extras(p).flatMap(_("shift")).map(_.numbers(2))

  /** The screen window around a place that is moved by parts of its width and height.
    *
    * @param x, y half of its width and height
    */
  private def window(shift: Vector[Double], x: Double, y: Double, at: SourcePos): Param =
    val (dx, dy) = (2 * x * shift(0), 2 * y * shift(1))
    Param.float("screenwindow", at, Seq(dx - x, dx + x, dy - y, dy + y).map(_.toFloat)*)

  private def lens(p: PlacedNode): Vector[Param] =
    extras(p).toVector.flatMap: e =>
      val radius = e.size("apertureRadius", 0)
      val focus = e.number("focusDistance", View.FarAway, 1e-6, Double.PositiveInfinity)
      if radius == 0 then Vector.empty
      else
        Vector(
          Param.float("lensradius", e.entry.at, radius.toFloat),
          Param.float("focaldistance", e.entry.at, focus.toFloat)
        )

  private def checkAspect(view: Json, aspect: Double): Unit =
    if !(aspect > 1e-3 && aspect < 1e3) then view.fail(s"the aspect ratio is $aspect")

  private def clips(view: Json): Vector[Param] =
    val near = view.number("znear", 0)
    val far = view("zfar").map(_.number)
    for z <- far if z <= near do view.fail(s"expected `zfar` above `znear`, found $z")
    Vector(Param.float("nearclip", view.at, Math.max(near, 1e-9).toFloat)) ++
      far.map(z => Param.float("farclip", view.at, z.toFloat)).orElse:
        Some(Param.float("farclip", view.at, View.FarAway))

/** Views of scenes, with film, sampler and integrator. */
private[models] object View:
  val Aspect: Double = 4.0 / 3
  val FarAway: Float = 1e30f

  /** The shift of a camera that sees as much on both sides of its axis. */
  val Centred: Vector[Double] = Vector(0.0, 0.0)
  private val LongerSide = 720
  private val Samples = 64
  private val MaxDepth = 16

  /** Width and height of the film, in pixels. */
  def size(aspect: Double): (Int, Int) =
    if aspect >= 1 then (LongerSide, Math.max(1, Math.rint(LongerSide / aspect).toInt))
    else (Math.max(1, Math.rint(LongerSide * aspect).toInt), LongerSide)

  /** With the number in the name of its image. */
  def numbered(scene: SceneDescription, session: Session, n: Int): SceneDescription =
    scene.copy(film = scene.film.map: f =>
      val name = s"${FileName.stem(session.file)}-$n.exr"
      f.copy(params = f.params :+ Param.string("filename", f.pos, name)))

  /** @param toWorld of a camera that looks along −z */
  def addCamera(
      scene: SceneDescription,
      session: Session,
      toWorld: Transform,
      aspect: Double,
      kind: String,
      params: Vector[Param],
      at: SourcePos
  ): SceneDescription =
    val (width, height) = size(aspect)
    // pbrt's z points forward
    val axes = Transform.scale(1, 1, -1).get
    val toCamera = (Nodes.unscaled(toWorld) * axes).inverse
    def declare(category: String, name: String, params: Param*): Declaration =
      session.declare(category, name, at, params)
    val integrator = if scene.media.isEmpty then "path" else "volpath"
    scene.copy(
      camera = Some(session.declare("Camera", kind, at, params)),
      worldToCamera = GraphicsState.constant(toCamera),
      film = Some(declare(
        "Film",
        "rgb",
        Param.int("xresolution", at, width),
        Param.int("yresolution", at, height)
      )),
      sampler = Some(declare("Sampler", "zsobol", Param.int("pixelsamples", at, Samples))),
      integrator = Some(declare("Integrator", integrator, Param.int("maxdepth", at, MaxDepth)))
    )
