package candela.photons

import candela.base.loop
import candela.concurrency.GivenUp
import candela.color.Rgb
import candela.integrators.SurfaceVertex
import candela.math.*
import candela.sampling.SampleHash

/** Photons in order of storage: position, incident direction (a unit vector away from the surface),
  * power, the number of edges of its path (below 0: it carries its hero wavelength only), and where
  * it has arrived: [[PhotonMap.Surface]], or the index of a medium.
  */
private[candela] final class Photons:
  import PhotonMap.Numbers
  var data: Array[Float] = new Array[Float](64 * Numbers)
  var count: Int = 0

  /** How many of them have arrived in media. */
  var inMedia: Int = 0

  def add(
      p: Vec3,
      from: Vec3,
      light: Rgb,
      edges: Int = 1,
      place: Int = PhotonMap.Surface
  ): Unit =
    val offset = count * Numbers
    if offset == data.length then data = java.util.Arrays.copyOf(data, 2 * data.length)
    data(offset) = p.x
    data(offset + 1) = p.y
    data(offset + 2) = p.z
    data(offset + 3) = from.x
    data(offset + 4) = from.y
    data(offset + 5) = from.z
    data(offset + 6) = light.r
    data(offset + 7) = light.g
    data(offset + 8) = light.b
    data(offset + PhotonMap.EdgesOffset) = edges.toFloat
    data(offset + PhotonMap.PlaceOffset) = place.toFloat
    count += 1
    if place >= 0 then inMedia += 1

/** The photon map of one pass. Immutable.
  *
  * Those at surfaces are in a hash grid with cells of twice the radius, so that a query touches
  * eight cells. Photons are sorted by hash.
  *
  * @param parts  photons in accumulation order
  * @param paths  number of light paths traced for them
  * @param radius query radius
  * @param draw   random: which photons are among the few
  * @param isStopped whether nobody waits for it any more, which is a GivenUp
  */
private[candela] final class PhotonMap(
    parts: Array[Photons],
    paths: Int,
    radius: Float,
    draw: Long = 0L,
    isStopped: () => Boolean = GivenUp.Never
):
  import PhotonMap.*

  /** Number of photons at surfaces. */
  val count: Int = parts.foldLeft(0)((n, p) => Math.addExact(n, p.count - p.inMedia))

  /** Those in media, for what the camera sees, and a few for what lights that: most of the time
    * would go there.
    */
  val inMedia: PhotonTree = PhotonTree(parts, paths, radius, isStopped = isStopped)
  val fewInMedia: PhotonTree =
    PhotonTree(parts, paths, Wider * radius, OneIn, Math.floorMod(draw, OneIn), isStopped)
  private val perCell = 1f / (2f * radius)
  private val radius2 = radius * radius
  private val mask = Math.max(1, Integer.highestOneBit(Math.max(1, count)) * 2) - 1
  private val starts = new Array[Int](mask + 2)
  private val data = new Array[Float](Math.multiplyExact(count, Numbers))
  sort()

  private def sort(): Unit =
    inline def eachPhoton(inline use: (Array[Float], Int, Int) => Unit): Unit =
      for part <- parts do
        GivenUp.check(isStopped)
        loop(part.count): i =>
          val offset = i * Numbers
          val d = part.data
          if d(offset + PlaceOffset) == Surface then
            use(d, offset, bucket(cell(d(offset)), cell(d(offset + 1)), cell(d(offset + 2))))
    eachPhoton((_, _, b) => starts(b + 1) += 1)
    loop(mask + 1)(b => starts(b + 1) += starts(b))
    val next = starts.clone()
    eachPhoton: (d, at, b) =>
      System.arraycopy(d, at, data, next(b) * Numbers, Numbers)
      next(b) += 1

  private def cell(x: Float): Int = Math.floor(x.toDouble * perCell).toInt

  private def bucket(x: Int, y: Int, z: Int): Int =
    SampleHash.mix64(x * 0x9e3779b97f4a7c15L + y * 0xc2b2ae3d27d4eb4fL + z).toInt & mask

  /** Density estimation: reflected radiance of the photons around `vertex`, towards the camera
    * subpath.
    *
    * @param limit   skips photons from directions whose BSDF pdf exceeds it
    * @param most    skips photons whose paths have more edges
    * @param isAlone does the path that gathers carry its hero wavelength only?
    */
  def gather(
      vertex: SurfaceVertex,
      limit: Float,
      most: Int = Int.MaxValue,
      isAlone: Boolean = false
  ): Rgb =
    val p = vertex.point.p
    // Lowest of the eight cells: the one below the nearest cell boundary along each axis
    val x0 = cell(p.x - radius)
    val y0 = cell(p.y - radius)
    val z0 = cell(p.z - radius)
    var sum = Rgb.Black
    var k = 0
    while k < 8 do
      val (x, y, z) = (x0 + (k & 1), y0 + (k >> 1 & 1), z0 + (k >> 2))
      sum += gatherCell(vertex, limit, most.toFloat, isAlone, x, y, z)
      k += 1
    sum * (1f / (Pi * radius2 * paths))

  private def gatherCell(
      vertex: SurfaceVertex,
      limit: Float,
      most: Float,
      isAlone: Boolean,
      x: Int,
      y: Int,
      z: Int
  ): Rgb =
    val takesAll = limit == Float.PositiveInfinity
    val b = bucket(x, y, z)
    val p = vertex.point.p
    var r, g, blue = 0f
    var offset = starts(b) * Numbers
    val end = starts(b + 1) * Numbers
    while offset < end do
      val px = data(offset)
      val py = data(offset + 1)
      val pz = data(offset + 2)
      val distance2 = square(px - p.x) + square(py - p.y) + square(pz - p.z)
      // Other cells may have the same hash; they are visited separately
      if distance2 < radius2 && cell(px) == x && cell(py) == y && cell(pz) == z &&
        Math.abs(data(offset + EdgesOffset)) <= most
      then
        val wi = Vec3(data(offset + 3), data(offset + 4), data(offset + 5))
        val f = vertex.received(wi)
        if !f.isBlack && (takesAll || vertex.pdf(wi) <= limit) then
          // If both paths carry their hero alone, each stands for all three wavelengths
          val share = if isAlone && data(offset + EdgesOffset) < 0f then 1f / 3f else 1f
          r += f.r * data(offset + 6) * share
          g += f.g * data(offset + 7) * share
          blue += f.b * data(offset + 8) * share
      offset += Numbers
    Rgb(r, g, blue)

private[candela] object PhotonMap:
  /** Floats per photon. */
  inline val Numbers = 11

  /** Offsets of a photon's number of edges, and of its place: a medium, or [[Surface]]. */
  inline val EdgesOffset = 9
  inline val PlaceOffset = 10

  /** The place of a photon that has arrived at a surface. */
  inline val Surface = -1

  /** Photons in media for what the camera does not see, and their radius. */
  private inline val OneIn = 16
  private inline val Wider = 2f
