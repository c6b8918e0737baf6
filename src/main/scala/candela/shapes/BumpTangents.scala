package candela.shapes

/** Along which tangents displacements of a mesh with normals are differentiated, and to which side
  * they rise.
  */
enum BumpTangents:
  /** As long as the surface's own, along the normals' side (pbrt-v4). */
  case Along

  /** Unit vectors, turned half around: bumps of u and v appear as dents (pbrt-v3 and v2). */
  case Turned

  /** The same, sinking instead of rising (meshes of pbrt-v2 whose orientation is reversed). */
  case TurnedSinking
