package candela.bsdf

import candela.color.Rgb
import candela.geometry.{Frame, ShadingPoint}
import candela.math.Vec3

class FramedSuite extends BsdfLaws:
  private val frame = Frame.along(Vec3(0.3f, -0.2f, 0.9f).normalized, Vec3.X)
  private val base = frame.toLocal(Vec3.Z)
  private val leaning =
    Framed(SoftTerminator(Lambert(Rgb(0.2f, 0.5f, 0.9f)), base, 0f), frame)

  // f takes the cosine to one normal, the integrator that to the other
  obeysLaws("diffuse", leaning, isReciprocal = false)

  test("what is blended with a normal map keeps the frame of the surface"):
    object Leaning extends Material:
      def bsdf(at: ShadingPoint): Bsdf =
        at.frame.set(frame)
        Lambert(Rgb.White)
    val at = ShadingPoint()
    val before = at.frame.toFrame
    val _ = FramedMaterial(Leaning).bsdf(at)
    assert(at.frame.n.toVec3 == before.n)
    assert(FramedMaterial.of(Leaning) eq Leaning)
