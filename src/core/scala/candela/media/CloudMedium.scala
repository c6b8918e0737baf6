package candela.media

import candela.color.Rgb
import candela.math.*
import candela.sampling.PhaseFunction
import candela.textures.PerlinNoise

/** Procedural cloud of noise, denser at the bottom.
  *
  * @param toUnit    world space to the unit cube, which is the box in the cloud's own space
  * @param corner    lower corner of the box
  * @param extent    of the box: from `corner` to the opposite one
  * @param density   scale of the noise; the result is clamped to [0, 1]
  * @param wispiness amplitude of the displacement by finer noise
  * @param frequency frequency of the noise
  *
  * The formula is pbrt-v4's.
  */
final class CloudMedium(
    toUnit: Transform,
    corner: Vec3,
    extent: Vec3,
    absorption: Rgb,
    scattering: Rgb,
    density: Float,
    wispiness: Float,
    frequency: Float,
    val phase: PhaseFunction
) extends VaryingMedium(toUnit, MajorantGrid.constant(1f), absorption + scattering):
  def isEmissive: Boolean = false
  def isChromatic: Boolean = Medium.isChromatic(absorption, scattering)
  def describe: String = "cloud"

  protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val height = corner.y + y * extent.y
    val d = densityAt(corner.x + x * extent.x, height, corner.z + z * extent.z)
    out.setDensity(d, absorption, scattering)

  /** Density at a point of the cloud's own space. */
  private[media] def densityAt(px: Float, py: Float, pz: Float): Float =
    var x = frequency * px
    var y = frequency * py
    var z = frequency * pz
    if wispiness > 0f then
      var shift = 0.05f * wispiness
      var octave = 10f
      var i = 0
      while i < 2 do
        val ax = octave * x
        val ay = octave * y
        val az = octave * z
        val center = PerlinNoise(ax, ay, az)
        val scale = shift / CloudMedium.Step
        x += scale * (PerlinNoise(ax + CloudMedium.Step, ay, az) - center)
        y += scale * (PerlinNoise(ax, ay + CloudMedium.Step, az) - center)
        z += scale * (PerlinNoise(ax, ay, az + CloudMedium.Step) - center)
        shift *= 0.5f
        octave *= 1.99f
        i += 1
    var noise = 0f
    var weight = 0.5f
    var octave = 1f
    var i = 0
    while i < 5 do
      noise += weight * PerlinNoise(octave * x, octave * y, octave * z)
      weight *= 0.5f
      octave *= 1.99f
      i += 1
    val puffs = clamp((1f - py) * 4.5f * density * noise, 0f, 1f)
    clamp(puffs + 2f * Math.max(0f, 0.5f - py), 0f, 1f)

object CloudMedium:
  /** Step of the noise's finite differences. */
  private inline val Step = 0.01f
