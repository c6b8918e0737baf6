package candela.scene

import candela.shapes.{Shape, ShapeGroup}

/** Surfaces other than triangles, with their appearance: a row each, as scenes have millions.
  *
  * @param groups    the surfaces, by number; many rows may have one group
  * @param materials indices into the scene's materials
  * @param lights    indices into the scene's lights, −1 where a shape does not emit; empty if none
  *   does
  * @param inverted  whether the normals seen by rays are opposite to those of light sampling: some
  *   of pbrt's shapes emit visibly on one side and illuminate the other; empty if none are
  */
final class ShapeTable(
    val groups: Array[? <: ShapeGroup],
    materials: Array[Int],
    lights: Array[Int],
    inverted: Array[Boolean]
):
  def count: Int = groups.length
  def shape(i: Int): Shape = groups(i).shape(i)
  def material(i: Int): Int = materials(i)
  def light(i: Int): Int = if lights.length == 0 then ShapeTable.Dark else lights(i)
  def isInverted(i: Int): Boolean = inverted.length > 0 && inverted(i)

object ShapeTable:
  /** The light of shapes that do not emit. */
  inline val Dark = -1

  val Empty: ShapeTable = of(Array.empty)

  /** Shapes of the first material, none of which emits. */
  def of(shapes: Array[Shape]): ShapeTable =
    ShapeTable(shapes, new Array[Int](shapes.length), Array.emptyIntArray, Array.emptyBooleanArray)
