package candela.models.assimp

import candela.math.Vec3
import candela.models.{Session, View}

import org.lwjgl.assimp.*

import scala.collection.mutable

/** Cameras and lights of Assimp as nodes of glTF, which look along −z. */
private[assimp] final class AssimpViews(scene: AIScene, session: Session, suffix: String):
  import AssimpViews.*

  private val cameras, lights = mutable.ArrayBuffer.empty[ujson.Obj]

  /** With the name of the node that each belongs to. */
  private val placed: Vector[(String, ujson.Obj)] =
    Arrays.all(scene.mCameras)(AICamera.create).flatMap(camera) ++
      Arrays.all(scene.mLights)(AILight.create).flatMap(light)

  def members: Seq[(String, ujson.Value)] = Seq(
    "cameras" -> ujson.Arr.from(cameras),
    "extensions" -> ujson.Obj(Punctual -> ujson.Obj("lights" -> ujson.Arr.from(lights)))
  )

  def of(name: String): Vector[ujson.Obj] = placed.collect { case (`name`, node) => node }

  /** Those that belong to no node, with the name that it should have. */
  def loose(exists: String => Boolean): Vector[(String, ujson.Obj)] =
    placed.filterNot((name, _) => exists(name))

  private def vector(v: AIVector3D): Vec3 = Vec3(v.x, v.y, v.z)

  private def camera(c: AICamera): Option[(String, ujson.Obj)] =
    val name = c.mName.dataString
    val aspect = if c.mAspect > 0f && c.mAspect.isFinite then c.mAspect.toDouble else View.Aspect
    val across = Math.tan(c.mHorizontalFOV * (if suffix == "fbx" then 1.0 else 0.5))
    val isFlat = c.mOrthographicWidth > 0f
    if !isFlat && !(across > MinView) then
      val at = AssimpScene.position(session, s"camera $name")
      session.warn(at, "its field of view is not read; left out")
      None
    else
      val width = c.mOrthographicWidth * AssimpScene.unit(suffix)
      cameras +=
        (if isFlat then
           val sizes = ujson.Obj("xmag" -> width, "ymag" -> width / aspect)
           ujson.Obj("type" -> "orthographic", "orthographic" -> sizes)
         else
           val view = ujson.Obj("yfov" -> 2 * Math.atan(across / aspect), "aspectRatio" -> aspect)
           ujson.Obj("type" -> "perspective", "perspective" -> view))
      val node = along(name, vector(c.mPosition), vector(c.mLookAt), vector(c.mUp))
      node("camera") = cameras.size - 1
      Some(name -> node)

  private def light(l: AILight): Option[(String, ujson.Obj)] =
    val name = l.mName.dataString
    val at = AssimpScene.position(session, s"light $name")
    val kind = l.mType match
      case Assimp.aiLightSource_POINT => Some("point")
      case Assimp.aiLightSource_DIRECTIONAL => Some("directional")
      case Assimp.aiLightSource_SPOT => Some("spot")
      case other =>
        val lights = Unsupported.getOrElse(other, "lights of this type")
        session.warn(at, s"$lights are not supported; left out")
        None
    kind.map: kind =>
      val color = Vector(l.mColorDiffuse.r, l.mColorDiffuse.g, l.mColorDiffuse.b).map(_.toDouble)
      val max = Math.max(color.max, 0)
      val entry = ujson.Obj(
        "type" -> kind,
        "color" -> ujson.Arr.from(color.map(c => if max > 0 then Math.max(c, 0) / max else 0)),
        "intensity" -> max * LumensPerWatt * (if kind == "directional" then 1.0 else perWatt(l))
      )
      if kind == "spot" then
        val outer = Math.min(l.mAngleOuterCone / 2, Math.PI / 2)
        val inner = Math.max(0, Math.min(l.mAngleInnerCone / 2, outer * MaxInner))
        entry("spot") = ujson.Obj("innerConeAngle" -> inner, "outerConeAngle" -> outer)
      if kind != "directional" && suffix != "fbx" && l.mAttenuationQuadratic <= 0f then
        session.warn(at, "here its light falls off with the square of the distance")
      lights += entry
      val node = along(name, vector(l.mPosition), vector(l.mDirection), vector(l.mUp))
      // Blender's falloff, which is that of an FBX file's two cones
      if kind == "spot" && suffix == "fbx" then
        val blend = Math.max(0f, 1f - l.mAngleInnerCone / l.mAngleOuterCone).toDouble
        node("extras") = ujson.Obj("candela" -> ujson.Obj("light" -> ujson.Obj("blend" -> blend)))
      node("extensions") = ujson.Obj(Punctual -> ujson.Obj("light" -> (lights.size - 1)))
      name -> node

  /** Radiant intensity of a unit of colour. In FBX, that is watts, as in Blender; elsewhere what is
    * attenuated by the distance.
    */
  private def perWatt(l: AILight): Double =
    if suffix == "fbx" then 1 / (4 * Math.PI)
    else if l.mAttenuationQuadratic > 0f then 1.0 / l.mAttenuationQuadratic
    else 1.0

  private def along(name: String, from: Vec3, direction: Vec3, up: Vec3): ujson.Obj =
    def unit(v: Vec3) = Option.when(v.length > 0f)(v.normalized)
    val z = unit(-direction).getOrElse(Vec3.Z)
    val x = Vector(up, Vec3.Y, Vec3.X).flatMap(u => unit(u cross z)).head
    val y = z cross x
    val columns = Vector(x, y, z).flatMap(v => Vector(v.x, v.y, v.z, 0f)) ++
      Vector(from.x, from.y, from.z, 1f)
    ujson.Obj("name" -> name, "matrix" -> ujson.Arr.from(columns.map(_.toDouble)))

private object AssimpViews:
  private val Punctual = "KHR_lights_punctual"
  private val LumensPerWatt = 683.0

  /** Of half of the view: Assimp has less than a degree where it loses what Collada says. */
  private val MinView = Math.tan(Math.toRadians(0.5))

  /** Cones of glTF have a border. */
  private val MaxInner = 0.999

  private val Unsupported = Map(
    Assimp.aiLightSource_AMBIENT -> "ambient lights",
    Assimp.aiLightSource_AREA -> "area lights"
  )
