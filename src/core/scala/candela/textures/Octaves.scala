package candela.textures

import candela.math.*

/** Sums of noise octaves, each with about twice the frequency of the previous one and `omega` times
  * its amplitude. Octaves beyond the Nyquist limit of the footprint are omitted, the last one
  * gradually.
  *
  * Source: Perlin and Musgrave in Ebert et al., "Texturing & Modeling", 1994; PBRT 3rd ed., §10.6.
  */
object Octaves:
  /** Not 2, to keep the octaves' zeros from coinciding. */
  private val Lacunarity = 1.99f

  /** Approximate mean magnitude of the noise. */
  private val MeanMagnitude = 0.2f

  /** Fractional Brownian motion.
    *
    * @param footprint squared, in the space of `p`
    * @param far       what to add to `p` in Double
    */
  def fbm(p: Vec3, footprint: Float, omega: Float, maxOctaves: Int, far: Position): Float =
    val count = visible(footprint, maxOctaves)
    val fullOctaves = count.toInt
    var sum = 0f
    var scale = 1f
    var strength = 1f
    var i = 0
    while i < fullOctaves do
      sum += strength * noise(p, scale, far)
      scale *= Lacunarity
      strength *= omega
      i += 1
    sum + strength * fade(count - fullOctaves) * noise(p, scale, far)

  /** Turbulence: the sum of the noises' magnitudes, with their mean in place of octaves beyond the
    * Nyquist limit.
    *
    * @param evenMean whether these means are equal, as in pbrt-v2, or scaled by their octave's
    *   amplitude
    */
  def turbulence(
      p: Vec3,
      footprint: Float,
      omega: Float,
      maxOctaves: Int,
      evenMean: Boolean,
      far: Position
  ): Float =
    val count = visible(footprint, maxOctaves)
    val fullOctaves = count.toInt
    var sum = 0f
    var scale = 1f
    var strength = 1f
    var i = 0
    while i < fullOctaves do
      sum += strength * abs(noise(p, scale, far))
      scale *= Lacunarity
      strength *= omega
      i += 1
    val lastNoise = abs(noise(p, scale, far))
    val weight = fade(count - fullOctaves)
    if evenMean then sum + strength * weight * lastNoise + (maxOctaves - count) * MeanMagnitude
    else
      sum += strength * lerp(weight, MeanMagnitude, lastNoise)
      while i < maxOctaves do
        sum += strength * MeanMagnitude
        strength *= omega
        i += 1
      sum

  /** An octave. The noise repeats, so that of `far` only the part beyond whole periods counts. */
  private def noise(p: Vec3, scale: Float, far: Position): Float =
    if far eq Position.Origin then PerlinNoise(p * scale)
    else
      PerlinNoise(
        p.x * scale + wrapped(far.x * scale),
        p.y * scale + wrapped(far.y * scale),
        p.z * scale + wrapped(far.z * scale)
      )

  private def wrapped(x: Double): Float =
    (x - PerlinNoise.Period * Math.rint(x / PerlinNoise.Period)).toFloat

  /** Number of octaves coarser than twice the footprint. */
  private def visible(footprint: Float, maxOctaves: Int): Float =
    if footprint > 0f then clamp(-1f - 0.5f * log2(footprint), 0f, maxOctaves.toFloat)
    else maxOctaves.toFloat

  private def fade(fraction: Float): Float =
    val t = clamp((fraction - 0.3f) / 0.4f, 0f, 1f)
    t * t * (3f - 2f * t)
