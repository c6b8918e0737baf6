package candela.mitsuba

import candela.diagnostics.Code

/** The field of view of cameras and projectors, by an angle or a focal length. */
private[mitsuba] object FieldOfView:
  /** Instead of one that is none, in degrees: one error is enough. */
  private val StandIn = 90.0

  /** Angle along the shorter side, in degrees.
    *
    * @param aspect width over height
    */
  def shorter(in: Properties, aspect: Double): Double =
    val axis = in.word("fov_axis", "x", "x", "y", "diagonal", "smaller", "larger")
    import in.session
    in.note("focal_length", "string", "50mm")
    val focal = in.property("focal_length").map(p => (p.value, p.pos))
    val diagonal = Math.sqrt(1 + 1 / (aspect * aspect))
    def tan(degrees: Double) = Math.tan(Math.toRadians(degrees) / 2)
    // Half of the width at distance 1
    val halfWidth = (in.number("fov"), focal) match
      case (Some(written), _) =>
        val isAngle = written > 0 && written < 180
        if !isAngle then
          session.error(
            Code.ParameterValue,
            in.posOf("fov"),
            s"`fov` must be between 0 and 180 degrees, found ${Properties.text(written)}"
          )
        val degrees = if isAngle then written else StandIn
        axis match
          case "x" => tan(degrees)
          case "y" => tan(degrees) * aspect
          case "diagonal" => tan(degrees) / diagonal
          case "smaller" => tan(degrees) * Math.max(1, aspect)
          case _ => tan(degrees) * Math.min(1, aspect)
      case (None, focalLength) =>
        // On film of 36 × 24 mm, along the diagonal
        val millimetres = focalLength match
          case Some((Value.Text(text), at)) => Values.number(text.trim.stripSuffix("mm"), at)
          case Some((Value.Number(x), _)) => x
          case _ => 50.0
        Math.sqrt(36.0 * 36 + 24 * 24) / (2 * millimetres) / diagonal
    Math.toDegrees(2 * Math.atan(halfWidth / Math.max(1, aspect)))
