package candela.shapes

/** A mesh that can't be what its author meant. The message names the faces and vertices, counted
  * from 0 in the order of the input; who reads scene files adds the place.
  */
final class MeshError(message: String) extends RuntimeException(message, null, false, false)
