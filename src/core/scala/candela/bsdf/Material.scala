package candela.bsdf

import candela.geometry.ShadingPoint
import candela.textures.{Textured, Varying}

/** Evaluates the [[Bsdf]] at surface points.
  *
  * A textured material lists its textures once, in `extends Material, Textured(…)`, which
  * determines whether it is constant and whether it needs tangents.
  */
abstract class Material extends Varying:
  def bsdf(at: ShadingPoint): Bsdf

  def isConstant: Boolean = false

  /** What must be known of it beforehand. */
  def flags: MaterialFlags = MaterialFlags.Plain

  final def isDispersive: Boolean = flags.hasAny(MaterialFlags.Dispersive)
  final def isPane: Boolean = flags.hasAny(MaterialFlags.Pane)
  final def isSubsurface: Boolean = flags.hasAny(MaterialFlags.Subsurface)
  final def isInterface: Boolean = flags.hasAny(MaterialFlags.Interface)
  final def isCaster: Boolean = flags.hasAny(MaterialFlags.Caster)

  /** This material with its BSDF made once if it is constant, when it is first asked for. */
  def folded: Material =
    if isConstant && !isSubsurface && !isInterface then FoldedMaterial(this) else this

  /** This material where rays meet it: what [[folded]] leaves to be made is made. */
  def resolved: Material = this

  /** This material where it is seen from above, black from behind. */
  def oneSided: Material = if isInterface then this else OneSidedMaterial(this).folded

  /** The BSSRDF; null if light is not scattered beneath the surface here. Evaluated after [[bsdf]],
    * which may perturb the shading frame.
    */
  def bssrdf(at: ShadingPoint): Bssrdf | Null = null

/** A medium interface: rays pass through unscattered (pbrt's "interface" and "none"). */
object InterfaceMaterial extends Material:
  def bsdf(at: ShadingPoint): Bsdf = throw IllegalStateException("a medium interface has no BSDF")
  override def isConstant: Boolean = true
  override def flags: MaterialFlags = MaterialFlags.Interface

/** A material with one BSDF everywhere. */
final class ConstantMaterial(
    value: Bsdf,
    override val isAnisotropic: Boolean = false,
    override val isDirected: Boolean = false
) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = value
  override def isConstant: Boolean = true
  override def folded: Material = this
  override def flags: MaterialFlags = MaterialFlags.of(value)

/** A constant material whose BSDF is made when it is first asked for. */
private final class FoldedMaterial(inner: Material) extends Material:
  private lazy val constant =
    ConstantMaterial(inner.bsdf(ShadingPoint()), isAnisotropic, isDirected)
  def bsdf(at: ShadingPoint): Bsdf = constant.bsdf(at)
  override def isConstant: Boolean = true
  override def isAnisotropic: Boolean = inner.isAnisotropic
  override def isDirected: Boolean = inner.isDirected
  override def folded: Material = this
  override def resolved: Material = constant
  override def flags: MaterialFlags =
    inner.flags.mask(MaterialFlags.Dispersive | MaterialFlags.Pane | MaterialFlags.Caster)

/** A material made of another one, of which all holds but for what a subclass changes. */
abstract class WrappedMaterial(inner: Material) extends Material, Textured(inner):
  override def flags: MaterialFlags = inner.flags
  override def bssrdf(at: ShadingPoint): Bssrdf | Null = inner.bssrdf(at)

/** A material made of two, and of what else it depends on. Light beneath the surface is scattered
  * by neither.
  */
abstract class JoinedMaterial(first: Material, second: Material, by: Varying*)
    extends Material,
      Textured((Vector(first, second) ++ by)*):
  // Asked once: blends of blends have many parts
  private val joined = (first.flags | second.flags).mask(JoinedMaterial.Shared)
  override def flags: MaterialFlags = joined

private object JoinedMaterial:
  def Shared: MaterialFlags =
    MaterialFlags.Dispersive | MaterialFlags.Pane | MaterialFlags.Caster
