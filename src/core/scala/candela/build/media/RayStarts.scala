package candela.build.media

import candela.math.Vec3
import candela.scenefile.SceneDescription

/** Where rays of a model's camera begin. */
private[media] object RayStarts:
  /** Those of the middle and the corners of the image, in the space of the camera. */
  def apply(scene: SceneDescription): Vector[Vec3] = scene.camera.toVector.flatMap: camera =>
    def number(name: String, default: Float) =
      camera.param(name).flatMap(_.floats.headOption).getOrElse(default)
    val near = if Projective(camera.name) then number("nearclip", 0.01f) else 0f
    val scale =
      if camera.name == "orthographic" then 1f
      else near * Math.tan(Math.toRadians(number("fov", 90f) / 2.0)).toFloat
    val window = camera.param("screenwindow").fold(wholeWindow(scene))(_.floats)
    val Array(left, right, bottom, top) = window.map(_ * scale): @unchecked
    val corners = for x <- Vector(left, right); y <- Vector(bottom, top) yield Vec3(x, y, near)
    Vec3((left + right) / 2, (bottom + top) / 2, near) +: corners

  private val Projective = Set("perspective", "orthographic")

  /** From −1 to 1 along the shorter side. */
  private def wholeWindow(scene: SceneDescription): Array[Float] =
    def pixels(name: String) =
      scene.film.flatMap(_.param(name)).flatMap(_.ints.headOption).getOrElse(1).toFloat
    val aspect = pixels("xresolution") / pixels("yresolution")
    val (x, y) = (Math.max(aspect, 1f), Math.max(1 / aspect, 1f))
    Array(-x, x, -y, y)
