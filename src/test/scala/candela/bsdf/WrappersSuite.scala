package candela.bsdf

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.composite.{ChosenMaterial, MixedMaterial}
import candela.bsdf.microfacet.{Dispersive, DispersiveMaterial, SmoothDielectric, ThinDielectric}
import candela.color.Rgb
import candela.geometry.{Frame, ShadingPoint}
import candela.math.Vec3
import candela.textures.ConstantRgb

/** What wraps a BSDF or a material loses nothing of it by oversight. `ArchitectureSuite` finds
  * wrappers that aren't listed here.
  */
class WrappersSuite extends AnyFunSuite:
  /** Everything that a BSDF can be. */
  private object Any extends Bsdf:
    def f(wo: Vec3, wi: Vec3): Rgb = Rgb.Black
    def pdf(wo: Vec3, wi: Vec3): Float = 0f
    def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample = BsdfSample.Absorbed
    def flags: BsdfFlags = BsdfFlags.All

  private final class AnyMaterial(made: Bsdf) extends Material:
    def bsdf(at: ShadingPoint): Bsdf = made
    override def flags: MaterialFlags = MaterialFlags.All
    override def isAnisotropic: Boolean = true
    override def isDirected: Boolean = true

  private val tilted = Frame.along(Vec3(0.3f, -0.2f, 0.9f).normalized, Vec3.X)
  private val base = tilted.toLocal(Vec3.Z)

  test("a wrapper has all that its BSDF has, but for what it takes away"):
    val reflects = BsdfFlags.Transmissive | BsdfFlags.Pane
    val none = reflects.minus(reflects)
    val wrappers = Seq(
      Scaled(Any, Rgb.White) -> none,
      SentThrough(Any) -> none,
      Dispersive(Any) -> none,
      Framed(Any, tilted) -> none,
      SoftTerminator(Any, base, 0f) -> BsdfFlags.Pane,
      OneSided(Any) -> reflects,
      TwoSided(Any, Lambert.Black) -> reflects,
      TwoSided(Lambert.Black, Any) -> reflects,
      Lobes(Array(Lambert.Black, Any), Array(0.5f, 0.5f)) -> none
    )
    for (wrapper, taken) <- wrappers do
      assert(BsdfFlags.All.minus(wrapper.flags) == taken, wrapper.getClass)

  test("a material made of others has what they have, but for what it takes away"):
    import MaterialFlags.*
    val (any, black) = (AnyMaterial(Any), AnyMaterial(Lambert.Black))
    val joined = Subsurface | Interface | OwnFrame
    val mixed = MixedMaterial(any, black, ConstantRgb(Rgb.gray(0.5f)))
    val wrappers = Seq(
      DispersiveMaterial(any) -> Plain,
      OneSidedMaterial(any) -> Pane,
      SoftTerminatorMaterial(any, identity, shadows = true) -> Pane,
      FramedMaterial(any) -> OwnFrame,
      mixed -> joined,
      ChosenMaterial(mixed) -> joined,
      TwoSidedMaterial(any, black) -> (joined | Pane),
      DiffuseEquivalent(any, transmits = true) -> (joined | Pane | Caster)
    )
    for (wrapper, taken) <- wrappers do
      assert(All.minus(wrapper.flags) == taken, wrapper.getClass)
      assert(wrapper.isAnisotropic && wrapper.isDirected && !wrapper.isConstant, wrapper.getClass)

  test("specular parts and straight light are found through all wrappers"):
    val glass = Lobes(Array(Lambert(Rgb.White), SmoothDielectric(1.5f)), Array(0.5f, 0.5f))
    val pane = ThinDielectric(1.5f)
    val wo = Vec3(0.2f, 0.1f, 1f).normalized
    def through(wrap: Bsdf => Bsdf, passes: Boolean = true) =
      assert(wrap(glass).sampleSpecular(wo, 0.9f).isSpecular)
      val kept = wrap(pane).straight(wo)
      // No wrapper changes the direction; the tilt changes what is reflected by less
      assert(if passes then kept.r > 0.9f && kept.r < 0.93f else kept.isBlack, kept)
    through(Scaled(_, Rgb.White))
    through(Dispersive(_))
    through(Framed(_, tilted))
    through(SoftTerminator(_, base, 0f), passes = false)
