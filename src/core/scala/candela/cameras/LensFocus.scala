package candela.cameras

import java.util.Locale

/** Thick-lens approximation of a lens system: refraction at two principal planes only.
  *
  * All positions are z of camera space, for the current film distance.
  *
  * @param filmPlane   principal plane on the film's side
  * @param filmFocus   focal point on the film's side
  * @param scenePlane  principal plane on the scene's side
  * @param sceneFocus  focal point on the scene's side
  */
final case class ThickLens(
    filmPlane: Double,
    filmFocus: Double,
    scenePlane: Double,
    sceneFocus: Double
):
  def focalLength: Double = filmPlane - filmFocus

  /** Distance by which to move the lens system away from the film to focus at `distance` from the
    * film; None if that is too close.
    *
    * Gauss's 1/z' − 1/z = 1/f, with distances from the principal planes, and both planes moved.
    */
  def shift(distance: Double): Option[Double] =
    val planeDistance = scenePlane - filmPlane
    val apart = distance - planeDistance
    val c = apart * (apart - 4 * focalLength)
    Option.when(apart > 4 * focalLength)((distance - scenePlane - filmPlane - Math.sqrt(c)) / 2)

object LensFocus:

  /** Thick lens of paraxial rays at `height` from the axis; None if they are blocked. */
  def thickLens(lens: LensSystem, height: Double): Option[ThickLens] =
    val round = lens.withRoundStop
    val toFilm = Array(height, 0.0, lens.frontZ + 1, 0.0, 0.0, -1.0)
    val toScene = Array(height, 0.0, lens.rearZ - 1, 0.0, 0.0, 1.0)
    Option.when(round.fromScene(toFilm) && round.fromFilm(toScene) > 0):
      val (filmPlane, filmFocus) = cardinal(height, toFilm)
      val (scenePlane, sceneFocus) = cardinal(height, toScene)
      ThickLens(filmPlane, filmFocus, scenePlane, sceneFocus)

  /** Principal plane and focal point: where the ray is as far from the axis as it came, and where
    * it crosses the axis.
    */
  private def cardinal(height: Double, out: Array[Double]): (Double, Double) =
    def z(x: Double) = out(2) + (x - out(0)) / out(3) * out(5)
    (z(height), z(0.0))

  /** The lens system, moved to focus at `distance` metres from the film; or the reason why it
    * can't.
    *
    * @param diagonal of the film in metres: rays a thousandth of it from the axis count as paraxial
    */
  def focused(
      lens: LensSystem,
      distance: Double,
      diagonal: Double
  ): Either[String, LensSystem] =
    thickLens(lens, 0.001 * diagonal) match
      case None => Left("the lens blocks all light near its axis; is the aperture too small?")
      case Some(thick) =>
        thick.shift(distance) match
          case None =>
            val nearest = 4 * thick.focalLength + thick.scenePlane - thick.filmPlane
            Left("focus distance must be at least %.3f m, found %.3f"
              .formatLocal(Locale.ROOT, nearest, distance))
          case Some(shift) =>
            val filmDistance = lens.surfaces.last.thickness + shift
            if filmDistance > 0 then Right(lens.at(filmDistance))
            else Left("focusing there would move the lens behind the film")
