package candela.bidirectional

import candela.color.Rgb
import candela.integrators.SurfaceVertex
import candela.math.*
import candela.scene.Scene

/** A vertex of a subpath, from the camera or from a light, that can be connected to the other
  * subpath. Mutable, for reuse.
  */
private[bidirectional] final class PathVertex(scene: Scene) extends SurfaceVertex(scene):
  /** Of the subpath up to here. */
  var throughput: Rgb = Rgb.Black

  /** Edges of the subpath. */
  var edges: Int = 0

  /** Has it met specular surfaces only? */
  var isSpecularSoFar: Boolean = true
  val weights: PartialWeights = PartialWeights()

  /** What the cosine of `wi` to the shading normal becomes for light that goes on to `wi`: shading
    * normals make scattering asymmetric (Veach 1997, §5.3.2).
    */
  def sentCosine(wi: Vec3): Float =
    val slant = cosine(wo)
    if slant > 0f then cosine(wi) * Math.abs(localWo.z) / slant else 0f
