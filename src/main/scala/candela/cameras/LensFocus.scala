package candela.cameras

/** Lenses taken for one thick lens: light bends at two principal planes only.
  *
  * All places are z of camera space, at the film distance that the lenses have.
  *
  * @param filmPlane   the principal plane of light that goes to the film
  * @param filmFocus   where light parallel to the axis meets it on the film's side
  * @param scenePlane  the principal plane of light that goes to the scene
  * @param sceneFocus  where light parallel to the axis meets it on the scene's side
  */
final case class ThickLens(
    filmPlane: Double,
    filmFocus: Double,
    scenePlane: Double,
    sceneFocus: Double
):
  def focalLength: Double = filmPlane - filmFocus

  /** How much further from the film the lenses must be for what is `distance` from it to be sharp;
    * none if it is too near.
    *
    * Gauss's 1/z' − 1/z = 1/f, with distances from the principal planes, and both planes moved.
    */
  def shift(distance: Double): Option[Double] =
    val between = scenePlane - filmPlane
    val apart = distance - between
    val c = apart * (apart - 4 * focalLength)
    Option.when(apart > 4 * focalLength)((distance - scenePlane - filmPlane - Math.sqrt(c)) / 2)

object LensFocus:

  /** The thick lens that paraxial rays see, `height` from the axis; none if they are blocked. */
  def thickLens(lens: LensSystem, height: Double): Option[ThickLens] =
    val round = lens.withRoundStop
    val toFilm = Array(height, 0.0, lens.frontZ + 1, 0.0, 0.0, -1.0)
    val toScene = Array(height, 0.0, lens.rearZ - 1, 0.0, 0.0, 1.0)
    Option.when(round.fromScene(toFilm) && round.fromFilm(toScene) > 0):
      val (filmPlane, filmFocus) = cardinal(height, toFilm)
      val (scenePlane, sceneFocus) = cardinal(height, toScene)
      ThickLens(filmPlane, filmFocus, scenePlane, sceneFocus)

  /** Where the ray is as far from the axis as it came, and where it crosses the axis. */
  private def cardinal(height: Double, out: Array[Double]): (Double, Double) =
    def z(x: Double) = out(2) + (x - out(0)) / out(3) * out(5)
    (z(height), z(0.0))

  /** The lenses, moved so that what is `distance` metres from the film is sharp; or why not.
    *
    * @param diagonal of the film in metres: rays a thousandth of it from the axis count as paraxial
    */
  def focused(
      lens: LensSystem,
      distance: Double,
      diagonal: Double
  ): Either[String, LensSystem] =
    thickLens(lens, 0.001 * diagonal) match
      case None => Left("no light near its axis passes the lens: is the aperture too small?")
      case Some(thick) =>
        thick.shift(distance) match
          case None =>
            val nearest = 4 * thick.focalLength + thick.scenePlane - thick.filmPlane
            Left(f"the lens can't focus nearer than $nearest%.3f m; found $distance%.3f")
          case Some(shift) =>
            val filmDistance = lens.surfaces.last.thickness + shift
            if filmDistance > 0 then Right(lens.at(filmDistance))
            else Left("to focus there, the lens would have to be behind the film")
