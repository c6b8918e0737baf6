package candela.bidirectional

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.scene.Scene

/** A point where a path that came from one of its ends is scattered, or joined to the other end.
  * Mutable, for reuse.
  */
private[bidirectional] final class PathVertex(scene: Scene):
  val at: ShadingPoint = scene.newPoint()
  var bsdf: Bsdf = PathVertex.Nothing

  /** Towards where the path came from, in the world and in the frame of `at`. */
  var wo, local: Vec3 = Vec3.Z

  /** Of the path up to here. */
  var throughput: Rgb = Rgb.Black

  /** How many edges the path has had. */
  var edges: Int = 0

  /** Has it come by mirrors and smooth glass alone? */
  var isSpecularSoFar: Boolean = true
  val weights: PartialWeights = PartialWeights()

  /** Looks at the surface, once `at` is filled in.
    *
    * @param regularized see [[Bsdf.regularized]]
    */
  def look(direction: Vec3, regularized: Boolean = false): Unit =
    bsdf = if regularized then scene.bsdf(at).regularized else scene.bsdf(at)
    wo = -direction
    local = at.frame.toLocal(wo)

  /** The BSDF for light that comes from `wi` to a path from the camera. */
  def received(wi: Vec3): Rgb =
    if isOpen(wi) then bsdf.f(local, onSide(at.frame.toLocal(wi), local)) else Rgb.Black

  /** The BSDF for light of a path from a light that goes on to `wi`. */
  def sent(wi: Vec3): Rgb =
    if !isOpen(wi) then Rgb.Black
    else
      val towards = at.frame.toLocal(wi)
      bsdf.f(towards, onSide(local, towards))

  /** The density with which the path goes on to `wi`, per solid angle. */
  def pdf(wi: Vec3): Float = bsdf.pdf(local, at.frame.toLocal(wi))

  /** The density with which a path that came from `wi` goes on to where this one came from. */
  def reversePdf(wi: Vec3): Float = bsdf.pdf(at.frame.toLocal(wi), local)

  /** Cosine to the true surface. */
  def cosine(w: Vec3): Float = at.geometricNormal absDot w

  /** What the cosine of `wi` to the shading normal becomes for light that goes on to `wi`: shading
    * normals make scattering unlike in both directions (Veach 1997, §5.3.2).
    */
  def sentCosine(wi: Vec3): Float =
    val slant = cosine(wo)
    if slant > 0f then cosine(wi) * Math.abs(local.z) / slant else 0f

  /** Can what only reflects send light between `wi` and `wo` at all? */
  def isOpen(wi: Vec3): Boolean =
    !scene.sidesByGeometry || bsdf.isTransmissive ||
      ((wi dot at.geometricNormal) > 0f) == ((wo dot at.geometricNormal) > 0f)

  /** Geometry has decided that it is a reflection, whatever the shading normal says. */
  private def onSide(w: Vec3, other: Vec3): Vec3 =
    if !scene.sidesByGeometry || bsdf.isTransmissive || (w.z > 0f) == (other.z > 0f) then w
    else Vec3(w.x, w.y, -w.z)

private object PathVertex:
  /** Before anything was met. */
  private val Nothing: Bsdf = candela.bsdf.Lambert(Rgb.Black)
