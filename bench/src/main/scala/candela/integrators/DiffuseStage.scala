package candela.integrators

import candela.accel.tracing.{
  DiffuseVertices, LampKernel, LampSamples, RayStreams, RectangleLamp, VertexKernel
}
import candela.bsdf.Lambert
import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Ray, ShadingPoint}
import candela.lights.{AreaLight, FewLights, SingleLight}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene
import candela.shapes.RectangleSampler

/** Vertices of constant diffuse surfaces of triangles under rectangular lamps, in lanes; all others
  * are followed by [[WaveWalk]].
  */
private[integrators] final class DiffuseStage private (
    scene: Scene,
    limits: PathLimits,
    lamps: DiffuseStage.Lamps,
    albedos: Array[Rgb | Null],
    most: Int
):
  private val soup = scene.surfaces.soup
  val at: DiffuseVertices = DiffuseVertices(most)
  private val samples = LampSamples(most)
  private val weights, sums = Array.fill(lamps.rows.length)(new Array[Float](most + 16))
  private val zeros = new Array[Float](most + 16)
  private val values = albedos.map(a => if a == null then null else a * InvPi)
  private var count = 0
  private val point, normal = MutableVec3()

  def size: Int = count
  def clear(): Unit = count = 0

  /** Does it take the vertex of this triangle? */
  def takes(primitive: Int): Boolean =
    primitive < soup.count && albedos(soup.meshOf(primitive)) != null

  /** Adds a path, with what its ray has met. */
  def add(number: Int, streams: RayStreams): Unit =
    val i = count
    val triangle = streams.primitiveOf(number)
    at.who(i) = number
    at.triangle(i) = triangle
    at.u(i) = streams.u(number)
    at.v(i) = streams.v(number)
    streams.direction(number, at.dx, at.dy, at.dz, i)
    val mesh = soup.meshes(soup.meshOf(triangle))
    at.side(i) = if mesh.flipped then -1.0 else 1.0
    val p = soup.positions
    val n = mesh.normals
    var c = 0
    while c < 3 do
      val vertex = soup.indices(3 * triangle + c)
      val j = 3 * vertex
      at.corner(3 * c)(i) = p(j)
      at.corner(3 * c + 1)(i) = p(j + 1)
      at.corner(3 * c + 2)(i) = p(j + 2)
      if n.length > 0 then
        val k = 3 * (vertex - mesh.firstVertex)
        at.normal(3 * c)(i) = n(k)
        at.normal(3 * c + 1)(i) = n(k + 1)
        at.normal(3 * c + 2)(i) = n(k + 2)
      else
        at.normal(3 * c)(i) = 0f
        at.normal(3 * c + 1)(i) = 0f
        at.normal(3 * c + 2)(i) = 0f
      c += 1
    count += 1

  /** Draws the random numbers of the vertex `i`, all but that of roulette, as the walk does. */
  def draw(i: Int, sampler: Sampler): Unit =
    at.choice(i) = sampler.next1D(matters = lamps.isRandom)
    sampler.next2D()
    at.l1(i) = sampler.x
    at.l2(i) = sampler.y
    sampler.next1D(matters = false): Unit
    sampler.next2D()
    at.u1(i) = sampler.x
    at.u2(i) = sampler.y

  /** Computes all vertices. */
  def compute(): Unit =
    val n = count
    VertexKernel.place(at, n)
    VertexKernel.shade(at, n)
    choose(n)
    var k = 0
    while k < lamps.rows.length do
      light(k, n)
      k += 1
    VertexKernel.offset(at, at.lightX, at.lightY, at.lightZ, at.fromX, at.fromY, at.fromZ, n)
    VertexKernel.connect(at, n)
    VertexKernel.scatter(at, n)
    VertexKernel.offset(at, at.wx, at.wy, at.wz, at.ox, at.oy, at.oz, n)

  private def choose(n: Int): Unit =
    val few = lamps.rows.length
    if !lamps.isRandom then
      java.util.Arrays.fill(at.light, 0, n, 0)
      java.util.Arrays.fill(at.probability, 0, n, 1f)
    else
      var k = 0
      while k < few do
        val before = if k == 0 then zeros else sums(k - 1)
        LampKernel.weigh(at, lamps.data, lamps.stride * k, weights(k), sums(k), before, n)
        k += 1
      var i = 0
      while i < n do
        val total = sums(few - 1)(i)
        val goal = at.choice(i) * total
        var found = 0
        k = 0
        while k < few do
          found += (if sums(k)(i) <= goal then 1 else 0)
          k += 1
        if found == few then found -= 1
        while found > 0 && !(weights(found)(i) > 0f) do found -= 1
        at.light(i) = if total > 0f then found else -1
        at.probability(i) = weights(found)(i) / total
        i += 1

  private def light(k: Int, n: Int): Unit =
    val lamp = lamps.rows(k)
    if lamp != null then light(k, lamp, n)

  private def light(k: Int, lamp: RectangleLamp, n: Int): Unit =
    val s = samples
    var m = 0
    var i = 0
    while i < n do
      if at.light(i) == k then
        s.vertex(m) = i
        s.px(m) = at.px(i)
        s.py(m) = at.py(i)
        s.pz(m) = at.pz(i)
        s.u1(m) = at.l1(i)
        s.u2(m) = at.l2(i)
        m += 1
      i += 1
    if m > 0 then
      LampKernel.begin(s, lamp, m)
      LampKernel.measure(s, lamp, m)
      LampKernel.sample(s, lamp, m)
      LampKernel.end(s, lamp, m)
      i = 0
      while i < m do
        val to = s.vertex(i)
        at.lightX(to) = s.wx(i)
        at.lightY(to) = s.wy(i)
        at.lightZ(to) = s.wz(i)
        at.lightPdf(to) = if s.pdf(i) > 0f then at.probability(to) * s.pdf(i) else 0f
        at.endX(to) = s.endX(i)
        at.endY(to) = s.endY(i)
        at.endZ(to) = s.endZ(i)
        at.fraction(to) = s.fraction(i)
        i += 1

  /** Could it be computed? Not on a triangle without area, nor under a lamp of another shape. */
  def isSound(i: Int): Boolean =
    at.length(i) > 0.0 && (at.light(i) < 0 || lamps.rows(at.light(i)) != null)

  /** Sets the light sample's ray, and what it brings if it is visible; false: nothing. */
  def aim(i: Int, path: SurfacePath, ray: Ray, brings: MutableRgb): Boolean =
    if at.light(i) < 0 || at.arrives(i) == 0f then false
    else
      val x = at.fromX(i)
      val y = at.fromY(i)
      val z = at.fromZ(i)
      ray.set(x, y, z, at.endX(i) - x, at.endY(i) - y, at.endZ(i) - z, at.fraction(i))
      val f = values(soup.meshOf(at.triangle(i))).nn
      val sent = lamps.radiances(at.light(i))
      val factor = at.factor(i)
      val beta = path.throughput
      brings.r = beta.r * (f.r * sent.r * factor)
      brings.g = beta.g * (f.g * sent.g * factor)
      brings.b = beta.b * (f.b * sent.b * factor)
      true

  /** Sends the path on its way; false: it ends. */
  def leave(i: Int, path: SurfacePath, ray: Ray, sampler: Sampler): Boolean =
    path.depth += 1
    if !(at.woZ(i) * at.wiZ(i) > 1e-10f * 1e-10f) then false
    else
      path.scale(albedos(soup.meshOf(at.triangle(i))).nn)
      point.set(at.px(i), at.py(i), at.pz(i))
      normal.set(at.lx(i), at.ly(i), at.lz(i))
      path.turn(point, normal, Math.abs(at.wiZ(i)) * InvPi)
      ray.set(
        at.ox(i),
        at.oy(i),
        at.oz(i),
        at.wx(i),
        at.wy(i),
        at.wz(i),
        Float.PositiveInfinity
      )
      if !path.isDead && path.depth > limits.rouletteAfter then
        path.scale(
          LightTransport.roulette(path.largest * path.etaScale, limits.rouletteThreshold, sampler)
        )
      !path.isDead

private[integrators] object DiffuseStage:
  /** @param rows rectangles, of each lamp in the order of the choice; null: another shape
    * @param data numbers of [[FewLights]] of each, `stride` apart
    */
  final class Lamps(
      val rows: Array[RectangleLamp | Null],
      val radiances: Array[Rgb],
      val data: Array[Float],
      val stride: Int,
      val isRandom: Boolean
  )

  /** A private member of what it is made from. */
  private def member[A](of: AnyRef, name: String): A =
    val field = of.getClass.getDeclaredFields.find(_.getName.split("\\$").last == name)
    val found = field.getOrElse(sys.error(s"${of.getClass.getName} has no $name"))
    found.setAccessible(true)
    found.get(of).asInstanceOf[A]

  private def lamp(light: AnyRef): Option[RectangleLamp] = light match
    case area: AreaLight =>
      member[AnyRef](area, "surface") match
        case r: RectangleSampler =>
          val corners = member[RectangleSampler.Corners](r, "corners")
          Some(
            RectangleLamp(
              Array(corners.a, corners.b, corners.c, corners.d),
              member[java.lang.Float](r, "width").floatValue,
              member[java.lang.Float](r, "height").floatValue,
              Array("axisX", "axisY", "axisZ").map(member[Vec3](r, _)),
              member[Vec3](r, "center"),
              r.normal,
              member[Vec3](r, "error"),
              r.area,
              member[java.lang.Boolean](area, "twoSided").booleanValue
            )
          )
        case _ => None
    case _ => None

  private def lampsOf(scene: Scene): Option[Lamps] =
    def all(order: Array[Int], data: Array[Float], stride: Int, isRandom: Boolean) =
      val lights = order.map(scene.lights(_))
      val rows: Array[RectangleLamp | Null] = lights.map(lamp(_).orNull)
      val radiances = lights.zip(rows).map: (l, row) =>
        if row == null then Rgb.Black else member[Rgb](l, "emitted")
      Option.when(rows.exists(_ != null))(Lamps(rows, radiances, data, stride, isRandom))
    scene.selection match
      case _: SingleLight => all(Array(0), Array.empty, 0, false)
      case few: FewLights =>
        val order = member[Array[Int]](few, "index")
        val isFlat = member[java.lang.Integer](few, "round").intValue == order.length
        val infinite = member[Array[Int]](few, "infinite").length
        if isFlat && infinite == 0 then all(order, member(few, "data"), 11, true) else None
      case _ => None

  /** None if no vertex would be computed so. */
  def of(scene: Scene, limits: PathLimits, most: Int): Option[DiffuseStage] =
    val soup = scene.surfaces.soup
    val isPlain = !scene.sidesByGeometry && !member[java.lang.Boolean](soup, "tangents")
    if !isPlain then None
    else
      lampsOf(scene).flatMap: lamps =>
        val albedos: Array[Rgb | Null] = soup.meshes.map: mesh =>
          val material = scene.materials(mesh.material)
          if mesh.firstLight >= 0 || !material.isConstant || material.isInterface then null
          else
            material.bsdf(ShadingPoint()) match
              case l: Lambert =>
                val albedo = member[Rgb](l, "albedo")
                if albedo.isBlack then null else albedo
              case _ => null
        Option.when(albedos.exists(_ != null))(DiffuseStage(scene, limits, lamps, albedos, most))
