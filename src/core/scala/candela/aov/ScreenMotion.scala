package candela.aov

import candela.cameras.{Camera, FilmPlace, MovingCamera, Shutter}
import candela.math.*

/** Projects points of the scene to the film at either end of the shutter interval. Mutable, one per
  * worker.
  *
  * @param camera   in a space of its own
  * @param toCamera transform from world space to that space
  */
final class ScreenMotion private (
    private val camera: Camera,
    toCamera: Motion,
    val shutter: Shutter
):
  private val map = new Array[Double](Motion.Work)
  private val filmPoint = FilmPlace()

  def copy(): ScreenMotion = new ScreenMotion(camera, toCamera, shutter)

  /** From where the shutter opens to where it closes, in pixels to the right and down; 0 if either
    * is invisible.
    *
    * @param opening the point when the shutter opens, in world space
    * @param closing the point when it closes
    */
  def of(opening: Vec3, closing: Vec3): Vec3 =
    if !project(opening, shutter.open) then Vec3.Zero
    else
      val (x, y) = (filmPoint.x, filmPoint.y)
      if project(closing, shutter.close) then Vec3(filmPoint.x - x, filmPoint.y - y, 0f)
      else Vec3.Zero

  /** Through the middle of the lens. */
  private def project(p: Vec3, time: Float): Boolean =
    toCamera.write(time, map, 0)
    def row(i: Int) = (map(i) * p.x + map(i + 1) * p.y + map(i + 2) * p.z + map(i + 3)).toFloat
    camera.project(Vec3(row(0), row(4), row(8)), 0.5f, 0.5f, filmPoint)

object ScreenMotion:
  /** None if the camera can't map points to the film. */
  def of(camera: Camera, shutter: Shutter): Option[ScreenMotion] =
    val projection = camera match
      case moving: MovingCamera =>
        new ScreenMotion(moving.camera, InverseMotion(moving.toWorld), shutter)
      case still => new ScreenMotion(still, Still(Transform.Identity), shutter)
    Option.when(projection.camera.isTraceable)(projection)
