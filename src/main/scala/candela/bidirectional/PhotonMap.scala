package candela.bidirectional

import candela.base.loop
import candela.color.Rgb
import candela.integrators.SurfaceVertex
import candela.math.*
import candela.sampling.SampleHash

/** Photons in the order in which they were stored: for each its place, where it came from (a unit
  * vector away from the surface) and its light.
  */
private[bidirectional] final class Photons:
  import PhotonMap.Numbers
  var data: Array[Float] = new Array[Float](64 * Numbers)
  var count: Int = 0

  def add(p: Vec3, from: Vec3, light: Rgb): Unit =
    val at = count * Numbers
    if at == data.length then data = java.util.Arrays.copyOf(data, 2 * data.length)
    data(at) = p.x
    data(at + 1) = p.y
    data(at + 2) = p.z
    data(at + 3) = from.x
    data(at + 4) = from.y
    data(at + 5) = from.z
    data(at + 6) = light.r
    data(at + 7) = light.g
    data(at + 8) = light.b
    count += 1

/** The photons of one pass, to be found by their places. Immutable.
  *
  * Space is divided into cubes of twice the radius, so that those around any place lie in eight of
  * them; the cubes are hashed, and the photons sorted by that.
  *
  * @param parts  in the order in which their sums are made
  * @param paths  light paths that were followed for them
  * @param radius within which photons count for a place
  */
private[bidirectional] final class PhotonMap(parts: Array[Photons], paths: Int, radius: Float):
  import PhotonMap.*

  val count: Int = parts.foldLeft(0)((n, p) => Math.addExact(n, p.count))
  private val perCube = 1f / (2f * radius)
  private val radius2 = radius * radius
  private val mask = Math.max(1, Integer.highestOneBit(Math.max(1, count)) * 2) - 1
  private val starts = new Array[Int](mask + 2)
  private val data = new Array[Float](Math.multiplyExact(count, Numbers))
  sort()

  private def sort(): Unit =
    inline def each(inline use: (Array[Float], Int, Int) => Unit): Unit =
      for part <- parts do
        loop(part.count): i =>
          val at = i * Numbers
          val d = part.data
          use(d, at, bucket(cube(d(at)), cube(d(at + 1)), cube(d(at + 2))))
    each((_, _, b) => starts(b + 1) += 1)
    loop(mask + 1)(b => starts(b + 1) += starts(b))
    val next = starts.clone()
    each: (d, at, b) =>
      System.arraycopy(d, at, data, next(b) * Numbers, Numbers)
      next(b) += 1

  private def cube(x: Float): Int = Math.floor(x.toDouble * perCube).toInt

  private def bucket(x: Int, y: Int, z: Int): Int =
    SampleHash.mix64(x * 0x9e3779b97f4a7c15L + y * 0xc2b2ae3d27d4eb4fL + z).toInt & mask

  /** Light that the photons around `vertex` bring and the surface scatters to where its path came
    * from, as far as they come from directions that the path chooses with a density of at most
    * `limit`.
    */
  def gather(vertex: SurfaceVertex, limit: Float): Rgb =
    val p = vertex.at.p
    // The corner of the eight cubes: the one before the nearest border along each axis
    val x0 = cube(p.x - radius)
    val y0 = cube(p.y - radius)
    val z0 = cube(p.z - radius)
    var sum = Rgb.Black
    var k = 0
    while k < 8 do
      sum += gather(vertex, limit, x0 + (k & 1), y0 + (k >> 1 & 1), z0 + (k >> 2))
      k += 1
    sum * (1f / (Pi * radius2 * paths))

  private def gather(vertex: SurfaceVertex, limit: Float, x: Int, y: Int, z: Int): Rgb =
    val b = bucket(x, y, z)
    val p = vertex.at.p
    var r, g, blue = 0f
    var at = starts(b) * Numbers
    val end = starts(b + 1) * Numbers
    while at < end do
      val px = data(at)
      val py = data(at + 1)
      val pz = data(at + 2)
      val distance2 = square(px - p.x) + square(py - p.y) + square(pz - p.z)
      // Other cubes may have the same hash, and be looked at in their turn
      if distance2 < radius2 && cube(px) == x && cube(py) == y && cube(pz) == z then
        val wi = Vec3(data(at + 3), data(at + 4), data(at + 5))
        val f = vertex.received(wi)
        if !f.isBlack && vertex.pdf(wi) <= limit then
          r += f.r * data(at + 6)
          g += f.g * data(at + 7)
          blue += f.b * data(at + 8)
      at += Numbers
    Rgb(r, g, blue)

private[bidirectional] object PhotonMap:
  /** Of each photon. */
  inline val Numbers = 9
