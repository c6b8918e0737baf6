package candela.manifold

import candela.bsdf.{Bounce, Bsdf}
import candela.geometry.{Hit, ShadingPoint}
import candela.math.*
import candela.scene.Scene

/** Which surfaces chains consist of: casters that reflect light to one direction, or refract it to
  * one, or both, and whose curvature is known. Mutable, one per worker.
  */
final class Coverage(scene: Scene):
  private val first, last = Bounce()

  /** @param at   the surface, its BSDF evaluated
    * @param hit  of the ray that met it
    * @param wo   local direction
    */
  def covers(hit: Hit, at: ShadingPoint, bsdf: Bsdf, wo: Vec3): Boolean =
    scene.isCaster(at) && bsdf.isSpecular && bsdf.isReciprocal && !scene.isPane(at) &&
      scene.isBent(hit) && (scene.isTriangle(hit) || isEven(at)) && isSimple(bsdf, wo)

  /** Is the shading normal that of the shape? The curvature of others is known on triangles. */
  private def isEven(at: ShadingPoint): Boolean =
    Math.abs(at.frame.n dot at.geometricNormal) > Coverage.MinEvenCosine

  /** Are there no more directions than the two that the choices of 0 and of 1 sample? */
  private def isSimple(bsdf: Bsdf, wo: Vec3): Boolean =
    bsdf.draw(wo, 0f, 0.5f, 0.5f, first)
    bsdf.draw(wo, OneMinusEpsilon, 0.5f, 0.5f, last)
    first.isSpecular && last.isSpecular && {
      val isOne = (first.wi.z > 0f) == (last.wi.z > 0f)
      Math.abs((if isOne then first.pdf else first.pdf + last.pdf) - 1f) < Coverage.PdfTolerance
    }

private[candela] object Coverage:
  private inline val MinEvenCosine = 0.9999999f

  /** Rounding of probabilities. */
  private inline val PdfTolerance = 1e-3f
