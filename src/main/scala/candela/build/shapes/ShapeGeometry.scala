package candela.build.shapes

import candela.math.Transform
import candela.shapes.Shape

/** What a shape statement describes, before it is placed in the world. */
enum ShapeGeometry:
  /** Triangles in object space: x y z a vertex, three vertices a triangle; normals (x y z) and uvs
    * may be empty.
    */
  case Triangles(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )

  /** A single surface, given where it stands and whether its orientation is reversed. */
  case Solid(make: (Transform, Boolean) => Shape)

  /** Many surfaces, likewise.
    *
    * @param emits can they be area lights?
    */
  case Solids(make: (Transform, Boolean) => Vector[Shape], emits: Boolean)

  /** Parts of different kinds. */
  case Several(parts: Vector[ShapeGeometry])
