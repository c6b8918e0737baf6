package candela.bsdf

/** How a beam that enters a half-space of scattering medium along the normal comes out again: the
  * radiant exitance at distance `r`, for each unit of power. Photon beam diffusion.
  *
  * Source: Habel, Christensen, Jarosz, "Photon Beam Diffusion: A Hybrid Monte Carlo Method for
  * Subsurface Scattering", EGSR 2013; PBRT 3rd ed., §15.5.
  *
  * @param absorption coefficient
  * @param scattering coefficient
  * @param g          mean cosine of the angle of scattering, that of Henyey and Greenstein's phase
  *                   function
  * @param eta        index of refraction of the medium over that outside
  */
final class BeamDiffusion(absorption: Double, scattering: Double, g: Float, eta: Float):
  import BeamDiffusion.*

  private val extinction = absorption + scattering
  private val reducedScattering = scattering * (1 - g)
  private val reducedExtinction = absorption + reducedScattering
  private val reducedAlbedo = reducedScattering / reducedExtinction

  /** Grosjean's diffusion coefficient, good for low albedos, too. */
  private val diffusion =
    (2 * absorption + reducedScattering) / (3 * reducedExtinction * reducedExtinction)
  private val effective = Math.sqrt(absorption / diffusion)

  private val moment1 = FresnelMoments.first(eta).toDouble
  private val moment2 = FresnelMoments.second(eta).toDouble

  /** Where the fluence falls to 0, by linear extrapolation: above the surface. */
  private val zeroAt = -2 * diffusion * (1 + 3 * moment2) / (1 - 2 * moment1)
  private val fluencePart = 0.25 * (1 - 2 * moment1)
  private val fluxPart = 0.5 * (1 - 3 * moment2)

  /** What was scattered more than once: dipoles all along the beam. */
  def multiple(r: Double): Double =
    var sum = 0.0
    for i <- 0 until Steps do
      val real = depth(i, reducedExtinction)
      val mirrored = 2 * zeroAt - real
      val toReal = Math.hypot(r, real)
      val toMirrored = Math.hypot(r, mirrored)
      val near = Math.exp(-effective * toReal)
      val far = Math.exp(-effective * toMirrored)
      val fluence = InvFourPi / diffusion * (near / toReal - far / toMirrored)
      val flux = InvFourPi * (
        real * (1 + effective * toReal) * near / cube(toReal) -
          mirrored * (1 + effective * toMirrored) * far / cube(toMirrored)
      )
      // Close to the beam, where diffusion errs, light has rarely been scattered twice
      val correction = 1 - Math.exp(-2 * reducedExtinction * (toReal + real))
      sum += correction * (fluence * fluencePart + flux * fluxPart)
    reducedAlbedo * reducedAlbedo * sum / Steps

  /** What was scattered once. */
  def single(r: Double): Double =
    // From above this depth, light would be reflected back into the medium
    val least = r * Math.sqrt(Math.max(0.0, eta.toDouble * eta - 1))
    var sum = 0.0
    for i <- 0 until Steps do
      val t = least + depth(i, extinction)
      val way = Math.hypot(r, t)
      val cosine = t / way
      sum += Math.exp(-extinction * (way + least)) / (way * way) * phase(cosine) *
        (1 - Fresnel.dielectric(-cosine.toFloat, eta)) * cosine
    scattering / extinction * sum / Steps

  private def phase(cosine: Double): Double =
    val denominator = 1 + g * g + 2 * g * cosine
    InvFourPi * (1 - g * g) / (denominator * Math.sqrt(denominator))

object BeamDiffusion:
  private val InvFourPi = 1 / (4 * Math.PI)

  /** Points on the beam. */
  private inline val Steps = 100

  /** Spread like the free paths of a medium. */
  private def depth(i: Int, extinction: Double): Double =
    -Math.log(1 - (i + 0.5) / Steps) / extinction

  private def cube(x: Double) = x * x * x
