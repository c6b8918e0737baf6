package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.build.integrators.Integrators
import candela.cameras.Shutter
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.Vec3
import candela.render.{Cost, CostKind}
import candela.scene.{Footprints, Scene}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts

/** Meshes have partial derivatives and footprints only where something reads them. */
class PartialsReadSuite extends AnyFunSuite:

  /** Squares in a row, two units apart, each with these statements. Their normals lean. */
  private def scene(squares: String*): Scene =
    val shapes = squares.zipWithIndex.map: (statements, i) =>
      s"""AttributeBegin
      Translate ${2 * i} 0 0
      $statements
      Shape "trianglemesh" "point3 P" [-.5 -.5 0 .5 -.5 0 .5 .5 0 -.5 .5 0]
        "point2 uv" [0 0 1 0 1 1 0 1] "integer indices" [0 1 2 0 2 3]
        "normal N" [.6 0 .8 .6 0 .8 .6 0 .8 .6 0 .8]
      AttributeEnd"""
    val text =
      s"""WorldBegin
      ${if squares.contains(textured) then checkerboard else ""}
      ${if squares.contains(bumpy) then wrinkles else ""}
      LightSource "point"
      ${shapes.mkString("\n")}"""
    val context = BuildContext(SceneTexts.parse(text, Dialect.V4), RenderSettings())
    def integrator(in: BuildContext) = in.build(None, Integrators.all, "path")
    WorldBuilder(
      context,
      integrator(context),
      integrator,
      Shutter(0f, 1f),
      samples = 1,
      ColorMode.Rgb,
      sensor = None,
      grouping = None,
      MemoryCheck(Long.MaxValue, Cost(CostKind.Film, 0), context)
    ).build(Footprints(followsSpecular = true, otherwise = None)).scene

  private def look(scene: Scene, square: Int, at: ShadingPoint, isKnown: Boolean = false) =
    val (ray, hit) = (Ray(), Hit())
    ray.set(Vec3(2f * square + 0.1f, 0.2f, 3f), Vec3(0f, 0f, -1f), Float.PositiveInfinity)
    ray.differential.isKnown = isKnown
    assert(scene.closest(ray, hit))
    scene.surface(ray, hit, at)
    at.hasPartials

  private val checkerboard = "Texture \"squares\" \"spectrum\" \"checkerboard\""
  private val wrinkles = "Texture \"wrinkles\" \"float\" \"wrinkled\""
  private val bumpy = "Material \"diffuse\" \"texture displacement\" \"wrinkles\""
  private val plain = "Material \"diffuse\""
  private val textured = "Material \"diffuse\" \"texture reflectance\" \"squares\""
  private val emitter = s"AreaLightSource \"diffuse\" $plain"

  test("textured materials and emitters have them, constant materials don't"):
    val mixed = scene(plain, textured, emitter)
    val at = mixed.newPoint()
    // Back and forth: a hit must not depend on the one before
    for _ <- 0 until 2 do
      assert(!look(mixed, 0, at))
      assert(look(mixed, 1, at) && at.dpdu == Vec3(1f, 0f, 0f))
      assert(look(mixed, 2, at))

  test("so do all where differentials go on, or somebody asks for them"):
    val mixed = scene(plain, textured)
    val at = mixed.newPoint()
    assert(look(mixed, 0, at, isKnown = true) && !look(mixed, 0, at))
    assert(look(mixed, 0, mixed.newPoint(always = true)))

  test("tangents to which displacements are added follow the normals if there are displacements"):
    def tangent(material: String): Vec3 =
      val one = scene(material)
      val at = one.newPoint()
      assert(look(one, 0, at))
      at.tangentU.toVec3
    assert(tangent(textured) == Vec3(1f, 0f, 0f))
    assert((tangent(bumpy) - Vec3(0.64f, 0f, -0.48f)).length < 1e-6f)

  test("none have them where nothing in the scene reads them"):
    val bare = scene(plain)
    assert(!look(bare, 0, bare.newPoint(always = true)))
