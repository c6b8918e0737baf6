package candela.bench.robustness

import candela.math.Vec3
import candela.shapes.TriangleSoup

/** A point, in Doubles. */
final case class Spot(x: Double, y: Double, z: Double):
  def *(s: Double): Spot = Spot(s * x, s * y, s * z)
  def words: String = s"$x $y $z"
  def listed: String = s"$x, $y, $z"

object Spot:
  val Origin: Spot = Spot(0, 0, 0)

  /** A power of ten, as in `1e-6`. */
  def short(x: Double): String = s"1e${Math.round(Math.log10(x))}"
  def of(v: Vec3): Spot = Spot(v.x, v.y, v.z)

/** Shapes that all programs have. */
enum Form:
  case Ball(center: Spot, radius: Double)

  /** Along z, without caps. */
  case Tube(radius: Double, low: Double, high: Double)

  /** @param normals of the corners, or none */
  case Facets(corners: Vector[Spot], triangles: Vector[Int], normals: Vector[Spot])

object Form:
  /** A parallelogram of two triangles. */
  def sheet(a: Spot, b: Spot, c: Spot, d: Spot): Form =
    Facets(Vector(a, b, c, d), Vector(0, 1, 2, 0, 2, 3), Vector.empty)

  /** A square across y, whose normal is up. */
  def floor(half: Double, y: Double): Form =
    sheet(Spot(-half, y, -half), Spot(-half, y, half), Spot(half, y, half), Spot(half, y, -half))

  /** A square across y, whose normal is down. */
  def ceiling(half: Double, y: Double): Form =
    sheet(Spot(-half, y, -half), Spot(half, y, -half), Spot(half, y, half), Spot(-half, y, half))

  /** Of separate facets.
    *
    * @param isSmooth whether the corners are their normals, too
    */
  def facets(soup: TriangleSoup, isSmooth: Boolean = false): Form =
    val corners = Vector.tabulate(3 * soup.count)(i => Spot.of(soup.vertex(i / 3, i % 3)))
    Facets(corners, corners.indices.toVector, if isSmooth then corners else Vector.empty)

enum Surface:
  case Matte(albedo: Double)
  case Mirror
  case Glass(index: Double)

  /** A light that shines to both sides, where the program has such, and reflects nothing. */
  case Light(radiance: Double)

/** Where the picture is taken.
  *
  * @param fov   field of view in degrees
  * @param width half the width of what a parallel projection shows, instead of a field of view
  */
final case class View(from: Spot, to: Spot, up: Spot, fov: Double, width: Option[Double] = None):
  def scaled(s: Double): View = copy(from = from * s, to = to * s, width = width.map(_ * s))

/** A scene that every program can be given: of a few shapes and lights that all have.
  *
  * @param sky   radiance of an even sky, 0 for none
  * @param sun   where parallel light of irradiance π comes from
  * @param depth scattering events of a path
  * @param side  pixels
  */
final case class PeerScene(
    view: View,
    things: Vector[(Form, Surface)],
    sky: Double = 0,
    sun: Option[Spot] = None,
    depth: Int = 5,
    side: Int = 64,
    spp: Int = 16
)
