package candela.sampling

import candela.geometry.Ray

/** Hash functions for samplers: map (pixel, sample, dimension, seed) to numbers that look
  * independent.
  *
  * A dimension's random bits are `mix64` of a counter that starts at [[pixel]] and grows by
  * [[Step]] with each request, as in Steele, Lea, Flood, "Fast splittable pseudorandom number
  * generators", OOPSLA 2014. There is no other state, so any sample can be computed on its own.
  */
object SampleHash:

  /** 2⁶⁴ over the golden ratio, made odd: the counter's increment. */
  inline val Step = 0x9e3779b97f4a7c15L

  /** A bijection of 64 bits in which every input bit flips every output bit with probability ½.
    *
    * Source: Stafford, "Better bit mixing: improving on MurmurHash3's 64-bit finalizer", 2011,
    * variant 13.
    */
  def mix64(key: Long): Long =
    var h = key
    h = (h ^ (h >>> 30)) * 0xbf58476d1ce4e5b9L
    h = (h ^ (h >>> 27)) * 0x94d049bb133111ebL
    h ^ (h >>> 31)

  /** The 32-bit counterpart; maps 0 to 0. Source: Appleby, MurmurHash3's finaliser, 2011. */
  def mix(key: Int): Int =
    var h = key
    h = (h ^ (h >>> 16)) * 0x85ebca6b
    h = (h ^ (h >>> 13)) * 0xc2b2ae35
    h ^ (h >>> 16)

  /** The counter at dimension 0 of a pixel, different for all pixels of the 32-bit plane. */
  def pixel(x: Int, y: Int, seed: Int): Long =
    mix64((x.toLong << 32 | (y & 0xffffffffL)) ^ mix64(seed + Step))

  /** Of a ray's origin and direction. */
  def ofRay(ray: Ray): Long =
    def bits(x: Float) = java.lang.Float.floatToRawIntBits(x) & 0xffffffffL
    var h = mix64(bits(ray.ox) << 32 | bits(ray.oy))
    h = mix64(h ^ (bits(ray.oz) << 32 | bits(ray.dx)))
    mix64(h ^ (bits(ray.dy) << 32 | bits(ray.dz)))

  /** The upper 24 bits as a fraction: in [0, 1), and a multiple of 2⁻²⁴. */
  def toUnit(bits: Int): Float = (bits >>> 8) * 5.9604645e-8f

/** Independent random numbers where their count is not known in advance: the collisions of a ray in
  * a medium. A path seeds it with numbers of its [[Sampler]], so the image still depends on neither
  * threads nor pixel order. Mutable, one per worker.
  */
final class RandomStream:
  private var counter = 0L

  /** Restarts the stream; different seeds give different streams. */
  def seed(a: Float, b: Float): Unit =
    def bits(x: Float) = java.lang.Float.floatToRawIntBits(x) & 0xffffffffL
    seed(bits(a) << 32 | bits(b))

  def seed(key: Long): Unit = counter = SampleHash.mix64(key)

  /** In [0, 1). */
  def next(): Float =
    counter += SampleHash.Step
    SampleHash.toUnit((SampleHash.mix64(counter) >>> 32).toInt)
