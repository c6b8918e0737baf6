package candela.cameras

/** A lens interface, or the plane of the aperture stop; lengths in metres.
  *
  * @param radius    radius of curvature, positive if convex towards the scene; 0 for the stop
  * @param thickness distance along the axis to the next surface towards the film
  * @param eta       index of refraction between here and that surface; 0 stands for air
  * @param aperture  radius up to which light passes
  */
final case class LensSurface(radius: Double, thickness: Double, eta: Double, aperture: Double)

/** Spherical surfaces on a common axis, through which rays are traced.
  *
  * Camera space: the film's centre is at the origin, the scene along +z. A ray is six numbers in
  * the caller's array: its origin, then its direction.
  *
  * @param surfaces from the scene to the film
  * @param stop     shape of the aperture; empty for a disk
  *
  * Source: Kolb, Mitchell, Hanrahan, "A Realistic Camera Model for Computer Graphics", SIGGRAPH
  * 1995; PBRT 4th ed., §5.4.
  */
final class LensSystem(val surfaces: Vector[LensSurface], val stop: Option[StopShape] = None):
  require(surfaces.nonEmpty, "no lens")
  private val count = surfaces.size
  private val radius = surfaces.map(_.radius).toArray
  private val limit = surfaces.map(s => s.aperture * s.aperture).toArray
  private val vertex = surfaces.map(_.thickness).scanRight(0.0)(_ + _).init.toArray
  private val rearEta = surfaces.map(s => if s.eta == 0.0 then 1.0 else s.eta).toArray
  private val frontEta = 1.0 +: rearEta.init
  private val shape: StopShape | Null = stop.orNull

  /** Vertices of the front surface and of the rear surface, next to the film. */
  def frontZ: Double = vertex(0)
  def rearZ: Double = vertex(count - 1)

  /** Radius of the rear surface. */
  def rearAperture: Double = surfaces.last.aperture

  /** The same system at another distance from the film. */
  def at(filmDistance: Double): LensSystem =
    LensSystem(surfaces.init :+ surfaces.last.copy(thickness = filmDistance), stop)

  /** The same system with a circular stop that contains the stop's shape. */
  def withRoundStop: LensSystem =
    stop.fold(this): s =>
      val open = surfaces.map: e =>
        if e.radius == 0.0 then e.copy(aperture = e.aperture * s.extent) else e
      LensSystem(open)

  /** Traces a ray from the film into the scene.
    *
    * @return transmitted fraction: 1, or the transmission of the stop's shape; 0 if the ray is
    *   blocked
    */
  def fromFilm(ray: Array[Double]): Double =
    unit(ray)
    var weight = 1.0
    var i = count - 1
    while i >= 0 && weight > 0.0 do
      weight *= pass(i, ray, rearEta(i), frontEta(i))
      i -= 1
    weight

  /** Traces a ray from the scene to the film's side; false if it is blocked. */
  def fromScene(ray: Array[Double]): Boolean =
    unit(ray)
    var passes = true
    var i = 0
    while i < count && passes do
      passes = pass(i, ray, frontEta(i), rearEta(i)) > 0.0
      i += 1
    passes

  /** Moves the ray to surface `i` and refracts it there. */
  private def pass(i: Int, ray: Array[Double], from: Double, to: Double): Double =
    if radius(i) == 0.0 then throughStop(i, ray)
    else if intersect(i, ray) && refracts(i, ray, from / to) then 1.0
    else 0.0

  private def throughStop(i: Int, ray: Array[Double]): Double =
    val t = (vertex(i) - ray(2)) / ray(5)
    if !(t >= 0.0) then 0.0
    else
      advance(ray, t)
      val x = ray(0)
      val y = ray(1)
      val form = shape
      if form != null then
        val scale = 1.0 / Math.sqrt(limit(i))
        form.transmission(x * scale, y * scale)
      else if x * x + y * y <= limit(i) then 1.0
      else 0.0

  private def intersect(i: Int, ray: Array[Double]): Boolean =
    val r = radius(i)
    val center = vertex(i) - r
    val oz = ray(2) - center
    val b = ray(0) * ray(3) + ray(1) * ray(4) + oz * ray(5)
    val c = ray(0) * ray(0) + ray(1) * ray(1) + oz * oz - r * r
    val discriminant = b * b - c
    if discriminant < 0.0 then false
    else
      val root = Math.sqrt(discriminant)
      // The root on the surface's side of the sphere
      val t = if (ray(5) > 0.0) == (r < 0.0) then -b - root else -b + root
      if !(t >= 0.0) then false
      else
        advance(ray, t)
        ray(0) * ray(0) + ray(1) * ray(1) <= limit(i)

  /** Snell's law; false at total internal reflection. */
  private def refracts(i: Int, ray: Array[Double], ratio: Double): Boolean =
    val center = vertex(i) - radius(i)
    val inverse = 1.0 / radius(i)
    var nx = ray(0) * inverse
    var ny = ray(1) * inverse
    var nz = (ray(2) - center) * inverse
    var cosine = -(nx * ray(3) + ny * ray(4) + nz * ray(5))
    if cosine < 0.0 then
      nx = -nx
      ny = -ny
      nz = -nz
      cosine = -cosine
    val sine2 = ratio * ratio * Math.max(0.0, 1.0 - cosine * cosine)
    if sine2 >= 1.0 then false
    else
      val along = ratio * cosine - Math.sqrt(1.0 - sine2)
      ray(3) = ratio * ray(3) + along * nx
      ray(4) = ratio * ray(4) + along * ny
      ray(5) = ratio * ray(5) + along * nz
      true

  private def advance(ray: Array[Double], t: Double): Unit =
    ray(0) += t * ray(3)
    ray(1) += t * ray(4)
    ray(2) += t * ray(5)

  private def unit(ray: Array[Double]): Unit =
    val inverse = 1.0 / Math.sqrt(ray(3) * ray(3) + ray(4) * ray(4) + ray(5) * ray(5))
    ray(3) *= inverse
    ray(4) *= inverse
    ray(5) *= inverse
