package candela.bsdf

import candela.geometry.ShadingPoint
import candela.textures.Varying

/** Evaluates the [[Bsdf]] at surface points.
  *
  * A textured material lists its textures once, in `extends Material, Textured(…)`, which
  * determines whether it is constant and whether it needs tangents.
  */
abstract class Material extends Varying:
  def bsdf(at: ShadingPoint): Bsdf

  def isConstant: Boolean = false

  /** This material with its BSDF precomputed if it is constant. */
  def folded: Material =
    if isConstant then ConstantMaterial(bsdf(ShadingPoint()), isAnisotropic) else this

  /** Whether any of its BSDFs is dispersive. */
  def isDispersive: Boolean = false

  /** The BSSRDF; null if light is not scattered beneath the surface here. Evaluated after [[bsdf]],
    * which may perturb the shading frame.
    */
  def bssrdf(at: ShadingPoint): Bssrdf | Null = null

  /** Whether [[bssrdf]] may return one. */
  def isSubsurface: Boolean = false

  /** Whether its BSDFs are panes, or have a part that is. */
  def isPane: Boolean = false

/** A medium interface: rays pass through unscattered (pbrt's "interface" and "none"). */
object InterfaceMaterial extends Material:
  def bsdf(at: ShadingPoint): Bsdf = throw IllegalStateException("a medium interface has no BSDF")
  override def isConstant: Boolean = true
  override def folded: Material = this

/** A material with one BSDF everywhere. */
final class ConstantMaterial(value: Bsdf, override val isAnisotropic: Boolean = false)
    extends Material:
  def bsdf(at: ShadingPoint): Bsdf = value
  override def isConstant: Boolean = true
  override def folded: Material = this
  override def isDispersive: Boolean = value.isDispersive
  override def isPane: Boolean = value.isPane
