package candela.scene

/** Names of what can be seen, by index, each with its identifier in image layers.
  *
  * @param objects   of the scene's meshes, other shapes, and instances
  * @param materials of the materials
  * @param id        identifier of a name
  */
final class SurfaceNames(
    val objects: Vector[String],
    val materials: Vector[String],
    id: String => Float
):
  private val objectIds = objects.map(id).toArray
  private val materialIds = materials.map(id).toArray

  def objectId(i: Int): Float = if i < objectIds.length then objectIds(i) else 0f
  def materialId(i: Int): Float = if i < materialIds.length then materialIds(i) else 0f

object SurfaceNames:
  val Empty: SurfaceNames = SurfaceNames(Vector.empty, Vector.empty, _ => 0f)
