package candela.manifold

import candela.accel.Instances
import candela.accel.tracing.Bvh
import candela.bsdf.{Bsdf, ConstantMaterial}
import candela.bsdf.microfacet.{Mirror, SmoothDielectric}
import candela.color.{MutableRgb, Rgb}
import candela.geometry.ShadingPoint
import candela.lights.{LightSelection, PointLight}
import candela.math.*
import candela.sampling.RandomStream
import candela.scene.{SceneMaterials, Instanced, Scene, ShapeTable, Surfaces}
import candela.shapes.{Mesh, Shape, Sphere, TriangleSoup}
import candela.testing.Soups

import org.scalatest.funsuite.AnyFunSuite

final class SpecularChainSuite extends AnyFunSuite:
  import SpecularChainSuite.*

  test("light is refracted at a flat interface where Snell's law says, and spreads as it says"):
    val (n, below, above, angle) = (1.33, 1.0, 2.0, 0.4)
    val out = Math.asin(n * Math.sin(angle))
    val reach = below * Math.tan(angle) + above * Math.tan(out)
    val chain = chainTo(Vec3(0f, 0f, -1f), Vec3(reach.toFloat, 0f, 2f), flat(glass(1.33f)))
    found(chain)
    near(chain.direction.x, Math.sin(angle))
    val perAngle = below / square(Math.cos(angle)) +
      above / square(Math.cos(out)) * n * Math.cos(angle) / Math.cos(out)
    near(chain.spread, Math.sin(angle) / (reach * perAngle * Math.cos(out)))

  test("in a flat mirror an emitter is seen at its virtual image"):
    val chain = chainTo(Vec3(0f, 0f, 1f), Vec3(1f, 0f, 2f), flat(Mirror(Rgb.White)))
    found(chain)
    near(chain.direction.x, 1.0 / Math.sqrt(10.0))
    near(chain.spread, 1.0 / 10.0)
    assert(chain.events == 1)

  test("a distant emitter is seen in a flat mirror as it is"):
    val chain = chainTo(Vec3(0f, 0f, 1f), Vec3(0.6f, 0f, 0.8f), flat(Mirror(Rgb.White)), true)
    found(chain)
    near(chain.direction.z, -0.8)
    near(chain.spread, 1.0)

  for a <- Seq(0.5, 1.0, 4.0) do
    test(s"along the axis of a ball, light from $a before it spreads as a thick lens says"):
      val (n, r, b) = (1.5, 1.0, 2.5)
      // Gauss: the second element of the ball's matrix is the spread's inverse root
      val power = (n - 1) / r
      val inside = 2 * r / n
      val offset = a + inside * (1 - power * a)
      val slope = (1 - power * a) - power * offset
      val span = offset + slope * b
      val at = Vec3(0f, 0f, (-r - a).toFloat)
      val chain = chainTo(at, Vec3(0f, 0f, (r + b).toFloat), ball(glass(1.5f)))
      found(chain, c => c.events == 2 && c.direction.z > 0.99999f)
      // Float differentials, of which the difference of two close ones may be left
      assert(Math.abs(chain.spread * span * span - 1) < 1e-3, s"${chain.spread}, span $span")
      val passed = MutableRgb()
      chain.throughput(passed)
      assert(Math.abs(passed.g - 0.96f * 0.96f) < 1e-4f) // to the rounding of Fresnel's terms

  test("a surface of interpolated normals spreads light as those of its neighbours do, traced"):
    val scene = hill(glass(1.33f), flipped = false)
    val x = Vec3(0.05f, 0.02f, -1f)
    def through(emitter: Vec3): Vec3 =
      val chain = chainTo(x, emitter, scene)
      found(chain, c => Math.abs(c.direction.x) < 0.3f && c.events == 1)
      chain.direction.toVec3
    val emitter = Vec3(0.2f, 0.1f, 1.5f)
    val chain = chainTo(x, emitter, scene)
    found(chain, c => Math.abs(c.direction.x) < 0.3f && c.events == 1)
    val step = 2e-3f
    val along = through(emitter + Vec3(step, 0f, 0f)) - through(emitter + Vec3(-step, 0f, 0f))
    val across = through(emitter + Vec3(0f, step, 0f)) - through(emitter + Vec3(0f, -step, 0f))
    val seen = (along cross across).length / square(2f * step)
    val facing = chain.toEmitter.z
    // Differences of directions that are known to 1e-6, of a step of 4e-3
    assert(Math.abs(chain.spread * facing / seen - 1) < 0.02, s"${chain.spread * facing}, $seen")

  test("the trials until a chain is found again have the inverse of its probability as mean"):
    val chain = chainTo(Vec3(0f, 0f, -2f), Vec3(0.3f, 0f, 3f), ball(glass(1.5f)))
    found(chain)
    chain.keep()
    val random = stream(2)
    var hits = 0
    var trials = 0L
    var last = 0L
    while hits < 400 do
      trials += 1
      if chain.find(random) && chain.isSame then
        hits += 1
        last = trials
    val other = stream(3)
    val frequency = (1 to 4000).count(_ => chain.find(other) && chain.isSame) / 4000.0
    // Deviations of 5 % of the mean of 400, and less of the frequency
    assert(Math.abs(last * frequency / hits - 1) < 0.25, s"$last trials, $frequency")

  private val hard = Seq[(String, Scene, Vec3, Vec3)](
    ("a grazing way", flat(glass(1.33f)), Vec3(-50f, 0f, -0.01f), Vec3(50f, 0f, 0.01f)),
    ("the focus of a ball", ball(glass(2f)), Vec3(0f, 0f, -1f), Vec3(0f, 0f, 1e5f)),
    ("an index close to 1", ball(glass(1.00001f)), Vec3(0f, 0f, -2f), Vec3(0f, 0f, 2f)),
    ("an emitter inside the glass", ball(glass(1.5f)), Vec3(0f, 0f, -3f), Vec3(0.2f, 0f, 0f)),
    (
      "thousands of facets",
      hill(glass(1.33f), smooth = false),
      Vec3(0f, 0f, -1f),
      Vec3(0f, 0f, 1f)
    ),
    ("normals that point away", hill(glass(1.33f), away = true), Vec3(0f, 0f, -1f), Vec3.Z),
    ("a point on the glass", ball(glass(1.5f)), Vec3(0f, 0f, -1f), Vec3(0f, 0f, 2f)),
    ("an emitter where x is", flat(Mirror(Rgb.White)), Vec3(0f, 0f, 1f), Vec3(0f, 0f, 1f))
  )
  for (name, scene, x, emitter) <- hard do
    test(s"$name is survived: walks end, and what they find is a number"):
      val chain = chainTo(x, emitter, scene)
      val random = stream(5)
      for _ <- 1 to 300 do
        if chain.find(random) then
          assert(chain.spread >= 0.0 && chain.direction.isFinite): Unit

  private def near(value: Double, expected: Double) =
    // The walk's tolerance of 1e-5, and Float rays
    assert(Math.abs(value - expected) < 1e-4 * Math.max(1.0, Math.abs(expected)), expected)

private object SpecularChainSuite:
  def square(x: Double): Double = x * x
  def glass(eta: Float): Bsdf = SmoothDielectric(eta)

  def stream(seed: Int): RandomStream =
    val random = RandomStream()
    random.seed(seed.toFloat, 0.5f)
    random

  def found(chain: SpecularChain, suits: SpecularChain => Boolean = _ => true): Unit =
    val random = stream(1)
    assert((1 to 3000).exists(_ => chain.find(random) && suits(chain)))

  def chainTo(x: Vec3, emitter: Vec3, scene: Scene, isFar: Boolean = false): SpecularChain =
    val chain = SpecularChain(scene)
    val at = ShadingPoint()
    at.p = x
    chain.begin(at, 0f, most = 2)
    chain.aim(emitter, isFar)
    chain

  /** The square of side 200 in the plane z = 0. */
  def flat(bsdf: Bsdf): Scene =
    val (a, b, c, d) = (at(-1, -1), at(1, -1), at(1, 1), at(-1, 1))
    of(Soups.of(Seq((a, b, c), (a, c, d))), Array.empty, bsdf)

  private def at(x: Int, y: Int): Vec3 = Vec3(100f * x, 100f * y, 0f)

  def ball(bsdf: Bsdf): Scene =
    val sphere = Sphere(Transform.Identity, 1f, -1f, 1f, TwoPi, reversed = false)
    of(Soups.Empty, Array(sphere), bsdf)

  /** A hill around the origin.
    *
    * @param away whether its normals point down
    */
  def hill(bsdf: Bsdf, flipped: Boolean = false, smooth: Boolean = true, away: Boolean = false) =
    val cells = 40
    val points =
      for i <- 0 to cells; j <- 0 to cells yield
        val (x, y) = (4f * i / cells - 2f, 4f * j / cells - 2f)
        Vec3(x, y, 0.1f * exp(-x * x - y * y))
    val normals = points.map: p =>
      // Of any length
      val n = Vec3(2f * p.x * p.z, 2f * p.y * p.z, 1f) * 0.5f
      if away then -n else n
    val faces =
      for i <- 0 until cells; j <- 0 until cells yield
        val k = i * (cells + 1) + j
        Seq(k, k + cells + 1, k + cells + 2, k, k + cells + 2, k + 1)
    def flat(v: Seq[Vec3]) = v.flatMap(p => Seq(p.x, p.y, p.z)).toArray
    val known = if smooth || away then flat(normals) else Array.empty[Float]
    val indices = faces.flatten.toArray
    val mesh = Mesh(0, 0, indices.length / 3, known, Array.empty, flipped, 0, -1)
    of(
      TriangleSoup(flat(points), indices, Array(mesh), tangents = false),
      Array.empty,
      bsdf
    )

  private def of(soup: TriangleSoup, shapes: Array[Shape], bsdf: Bsdf): Scene =
    val light = PointLight(Vec3(0f, 0f, 1f), Rgb.White)
    val surfaces = Surfaces(soup, ShapeTable.of(shapes))
    Scene(
      surfaces,
      Instanced(Array.empty, Instances.Empty),
      Bvh(surfaces.primitives(Instances.Empty)),
      SceneMaterials(Array(ConstantMaterial(bsdf))),
      Array(light),
      LightSelection.of(Array(light)),
      sidesByGeometry = false
    )
