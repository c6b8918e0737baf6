package candela.settings

import candela.sampling.PointSet

/** Which points to render with.
  *
  *   - `Best`: the scene's, or those with the least noise where it asks for evenly spread points of
  *     any kind
  *   - `Progressive`: likewise, but points whose number is fixed in advance are replaced, too
  *   - `Scene`: the scene's
  *   - `Named`: these
  */
enum PointChoice:
  case Best, Progressive, Scene
  case Named(points: PointSet)

  def word: String = this match
    case Best => "best"
    case Progressive => "progressive"
    case Scene => "scene"
    case Named(points) => points.word

object PointChoice:
  val all: Vector[PointChoice] = Vector(Best, Progressive, Scene) ++ PointSet.all.map(Named(_))
