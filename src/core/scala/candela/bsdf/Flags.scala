package candela.bsdf

/** Properties of a [[Bsdf]] for light transport: a set of flags.
  *
  * That of a sum is the union of its parts', so no flag says that something is missing everywhere.
  * Whatever wraps a BSDF derives its own flags from the other's, and loses none by oversight, nor
  * one that is added here.
  */
final class BsdfFlags private (private val bits: Int) extends AnyVal:
  def |(other: BsdfFlags): BsdfFlags = new BsdfFlags(bits | other.bits)
  def mask(flags: BsdfFlags): BsdfFlags = new BsdfFlags(bits & flags.bits)
  def minus(flags: BsdfFlags): BsdfFlags = new BsdfFlags(bits & ~flags.bits)

  /** Any of these? */
  def hasAny(flags: BsdfFlags): Boolean = (bits & flags.bits) != 0

object BsdfFlags:
  /** A part of the light is scattered evenly, by a diffuse lobe. */
  def Diffuse: BsdfFlags = new BsdfFlags(1)

  /** A part of it is scattered otherwise, to a range of directions. */
  def Glossy: BsdfFlags = new BsdfFlags(2)

  /** A part of it is scattered to single directions, which light sampling can't find. */
  def Specular: BsdfFlags = new BsdfFlags(4)

  /** Light is scattered to the other side of the surface. */
  def Transmissive: BsdfFlags = new BsdfFlags(8)

  /** A specular part of the light keeps its direction on its way through ([[Bsdf.straight]]). */
  def Pane: BsdfFlags = new BsdfFlags(16)

  /** Light of other wavelengths is scattered to other directions (dispersion). Only the first
    * component of the values, that of the hero wavelength, is right.
    */
  def Dispersive: BsdfFlags = new BsdfFlags(32)

  /** Values change when `wo` and `wi` change places, by more than the square of the index in
    * refraction. Light subpaths are then weighted by the values that the camera sees.
    */
  def NonReciprocal: BsdfFlags = new BsdfFlags(64)

  /** Directions depend on the `choice` of [[Bsdf.sample]]. */
  def Choosing: BsdfFlags = new BsdfFlags(128)

  /** A part of it is scattered to single directions, or to a narrow range about them: curved
    * surfaces concentrate it to caustics.
    */
  def Narrow: BsdfFlags = new BsdfFlags(256)

  def All: BsdfFlags = new BsdfFlags(511)

/** Properties of a [[Material]] that must be known before its BSDFs are evaluated. */
final class MaterialFlags private (private val bits: Int) extends AnyVal:
  def |(other: MaterialFlags): MaterialFlags = new MaterialFlags(bits | other.bits)
  def mask(flags: MaterialFlags): MaterialFlags = new MaterialFlags(bits & flags.bits)
  def minus(flags: MaterialFlags): MaterialFlags = new MaterialFlags(bits & ~flags.bits)
  def hasAny(flags: MaterialFlags): Boolean = (bits & flags.bits) != 0

object MaterialFlags:
  def Plain: MaterialFlags = new MaterialFlags(0)

  /** Some of its BSDFs are dispersive. */
  def Dispersive: MaterialFlags = new MaterialFlags(1)

  /** Some of its BSDFs are panes, or have a part that is. */
  def Pane: MaterialFlags = new MaterialFlags(2)

  /** [[Material.bssrdf]] may return one. */
  def Subsurface: MaterialFlags = new MaterialFlags(4)

  /** Light passes unscattered, and there is no BSDF. */
  def Interface: MaterialFlags = new MaterialFlags(8)

  /** Perturbs the shading frame, but for itself alone: what it is blended with, or what is on the
    * other side, keeps that of the surface, as in Mitsuba.
    */
  def OwnFrame: MaterialFlags = new MaterialFlags(16)

  /** Casts caustics: some of its BSDFs are narrow, and have no diffuse part. */
  def Caster: MaterialFlags = new MaterialFlags(32)

  def All: MaterialFlags = new MaterialFlags(63)

  /** Of a material with this BSDF everywhere. */
  def of(bsdf: Bsdf): MaterialFlags =
    val dispersive = if bsdf.isDispersive then Dispersive else Plain
    val pane = if bsdf.isPane then Pane else Plain
    val caster = if bsdf.isNarrow && !bsdf.isDiffuse then Caster else Plain
    dispersive | pane | caster
