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
    data(at + PhotonMap.EdgesOffset) = edges.toFloat
    data(at + PhotonMap.PlaceOffset) = place.toFloat
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
    inline def each(inline use: (Array[Float], Int, Int) => Unit): Unit =
      for part <- parts do
        GivenUp.check(isStopped)
        loop(part.count): i =>
          val at = i * Numbers
          val d = part.data
          if d(at + PlaceOffset) == Surface then
            use(d, at, bucket(cell(d(at)), cell(d(at + 1)), cell(d(at + 2))))
    each((_, _, b) => starts(b + 1) += 1)
    loop(mask + 1)(b => starts(b + 1) += starts(b))
    val next = starts.clone()
    each: (d, at, b) =>
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
    val p = vertex.at.p
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
    val p = vertex.at.p
    var r, g, blue = 0f
    var at = starts(b) * Numbers
    val end = starts(b + 1) * Numbers
    while at < end do
      val px = data(at)
      val py = data(at + 1)
      val pz = data(at + 2)
      val distance2 = square(px - p.x) + square(py - p.y) + square(pz - p.z)
      // Other cells may have the same hash; they are visited separately
      if distance2 < radius2 && cell(px) == x && cell(py) == y && cell(pz) == z &&
        Math.abs(data(at + EdgesOffset)) <= most
      then
        val wi = Vec3(data(at + 3), data(at + 4), data(at + 5))
        val f = vertex.received(wi)
        if !f.isBlack && (takesAll || vertex.pdf(wi) <= limit) then
          // If both paths carry their hero alone, each stands for all three wavelengths
          val share = if isAlone && data(at + EdgesOffset) < 0f then 1f / 3f else 1f
          r += f.r * data(at + 6) * share
          g += f.g * data(at + 7) * share
          blue += f.b * data(at + 8) * share
      at += Numbers
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
