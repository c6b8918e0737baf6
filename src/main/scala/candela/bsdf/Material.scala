package candela.bsdf

import candela.geometry.ShadingPoint
import candela.textures.Varying

/** Gives every point of a surface its [[Bsdf]].
  *
  * A material of textures names them once, in `extends Material, Textured(…)`: whether it is
  * constant and whether it needs tangents follows from them.
  */
abstract class Material extends Varying:
  def bsdf(at: ShadingPoint): Bsdf

  def isConstant: Boolean = false

  /** The same, with its BSDF made once if it is the same everywhere. */
  def folded: Material =
    if isConstant then ConstantMaterial(bsdf(ShadingPoint()), isAnisotropic) else this

  /** Are any of its BSDFs? */
  def isDispersive: Boolean = false

  /** How light that was sent into the surface here comes out again elsewhere; null: it goes on
    * straight inside. Asked after [[bsdf]], which may have turned the frame.
    */
  def bssrdf(at: ShadingPoint): Bssrdf | Null = null

  /** Does [[bssrdf]] have an answer? */
  def isSubsurface: Boolean = false

/** No surface at all: rays go straight on (pbrt's "interface" and "none"). */
object InterfaceMaterial extends Material:
  def bsdf(at: ShadingPoint): Bsdf = throw IllegalStateException("an interface has no BSDF")
  override def isConstant: Boolean = true
  override def folded: Material = this

/** The same everywhere. */
final class ConstantMaterial(value: Bsdf, override val isAnisotropic: Boolean = false)
    extends Material:
  def bsdf(at: ShadingPoint): Bsdf = value
  override def isConstant: Boolean = true
  override def folded: Material = this
  override def isDispersive: Boolean = value.isDispersive
