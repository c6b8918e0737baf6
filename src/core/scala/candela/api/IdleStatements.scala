package candela.api

import candela.diagnostics.{Code, Problem as CoreProblem}
import candela.scenefile.GivenStatement

/** Finds statements of a builder that change what follows, where nothing follows that they could
  * change. Mutable.
  */
private[api] final class IdleStatements:
  import IdleStatements.*

  /** Those without a use so far, of each open block, the innermost first. */
  private var open = List(Vector.empty[GivenStatement])

  /** Those of closed blocks. */
  private var closed = Vector.empty[GivenStatement]

  def note(s: GivenStatement): Unit =
    for kind <- Kind.values if kind.uses(s.directive) do
      open = open.map(_.filterNot(earlier => kind.statements.contains(earlier.directive)))
    if Kind.values.exists(_.statements.contains(s.directive)) then
      open = (open.head :+ s) :: open.tail
    s.directive match
      case "AttributeBegin" | "ObjectBegin" => open = Vector.empty :: open
      case "AttributeEnd" | "ObjectEnd" if open.tail.nonEmpty =>
        closed ++= open.head
        open = open.tail
      case "WorldBegin" =>
        // The transform is the identity again
        val (transforms, others) = open.head.partition(s => Kind.Place.statements(s.directive))
        closed ++= transforms
        open = others :: open.tail
      case _ => ()

  /** @param isEdit whether another scene is edited, whose statements stay as they are */
  def warnings(isEdit: Boolean): Vector[CoreProblem] =
    for s <- (closed ++ open.flatten).sortBy(_.pos.line) yield
      val kind = Kind.values.find(_.statements.contains(s.directive)).get
      val help = if isEdit then kind.inEdit else kind.inScene
      CoreProblem.warning(Code.WrongPlace, s.pos, s"${s.directive} has no effect here", Some(help))

private object IdleStatements:
  private val Shapes = Set("Shape")

  /** @param statements that change what follows
    * @param uses       what may follow
    */
  private enum Kind(
      val statements: Set[String],
      val uses: Set[String],
      val inScene: String,
      val inEdit: String
  ):
    case Place
        extends Kind(
          Set("Translate", "Scale", "Rotate", "LookAt", "Transform", "ConcatTransform"),
          Shapes ++ Set("Camera", "LightSource", "Texture", "MakeNamedMedium", "ObjectInstance",
            "ObjectBegin", "CoordinateSystem", "place camera"),
          "call it before the camera, light or shape that it moves, in the same block",
          "call placeCamera() after it to move the camera, or a light or shape that it moves"
        )
    case Surface
        extends Kind(
          Set("Material", "NamedMaterial"),
          Shapes,
          "call it before the shapes that have it, in the same block",
          "shapes that are there keep theirs; changeMaterial and changeMaterialOf change them"
        )
    case Emission
        extends Kind(
          Set("AreaLightSource"),
          Shapes,
          "call it before the shapes that emit it, in the same block",
          "shapes that are there keep theirs; changeAreaLightOf changes them"
        )
