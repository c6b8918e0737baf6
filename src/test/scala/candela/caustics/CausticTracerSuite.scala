package candela.caustics

import candela.guiding.GuidingMode
import candela.image.Image
import candela.integrators.CausticsMode
import candela.render.{Renderer, RenderPlan, SplattedTiles}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{BlockMeans, SceneTexts}

import org.scalatest.funsuite.AnyFunSuite

/** Emitters are wide, so that paths from the camera find all caustics, too. */
@org.scalatest.tags.Slow
final class CausticTracerSuite extends AnyFunSuite:
  import CausticTracerSuite.*

  private def plan(
      text: String,
      mode: CausticsMode,
      seed: Int = 0,
      spp: Int = 64,
      guiding: GuidingMode = GuidingMode.Off
  ): RenderPlan =
    val settings = RenderSettings(
      Some(spp),
      seed,
      color = ColorMode.Rgb,
      caustics = Some(mode),
      guiding = Some(guiding)
    )
    SceneTexts.plan(text, Dialect.V4, settings)

  private def image(plan: RenderPlan, threads: Int = 2): Image =
    Renderer.render(plan, threads).image(plan.development)

  for (what, text) <- Scenes do
    test(s"with light paths the mean of each block is that of paths alone: $what"):
      assert(plan(text, CausticsMode.On).method match
        case splatted: SplattedTiles => splatted.beside
        case _ => false)
      val expected = image(plan(text, CausticsMode.Off, seed = 1))
      BlockMeans.assertEqual(image(plan(text, CausticsMode.On)), expected)

  test("light paths beside guided paths find the same light"):
    val text = scene(GlassBall)
    BlockMeans.assertEqual(
      image(plan(text, CausticsMode.On, guiding = GuidingMode.On)),
      image(plan(text, CausticsMode.Off, seed = 1))
    )

  test("light paths reduce the noise of a caustic"):
    def noise(mode: CausticsMode): Double =
      val Vector(a, b) =
        Vector(0, 1).map(seed => image(plan(Small, mode, seed)).data.map(_.toDouble)): @unchecked
      a.indices.map(i => square(a(i) - b(i))).sum
    val ratio = noise(CausticsMode.On) / noise(CausticsMode.Off)
    assert(ratio < 0.2, ratio)

  test("an image with caustics has the same bits for any number of threads"):
    val one = image(plan(Small, CausticsMode.On), threads = 1)
    assert(image(plan(Small, CausticsMode.On), threads = 3).data.sameElements(one.data))

  test("delta lights shine through glass where caustics are on, and only there"):
    val text = scene(GlassBall, """LightSource "point" "rgb I" [9 9 9] "point3 from" [1 3 0]""")
    // Only what the ball mirrors is above zero with paths alone: the ground has its shadow
    val Vector(off, auto, on) = Vector(CausticsMode.Off, CausticsMode.Auto, CausticsMode.On)
      .map(mode => average(image(plan(text, mode, spp = 64)))): @unchecked
    val both = text.replace("\"path\"", "\"bdpt\"")
    val bdpt = average(image(plan(both, CausticsMode.Off, spp = 64)))
    assert(auto == off)
    def added(mode: CausticsMode) = plan(text, mode).method.addedLight
    assert(added(CausticsMode.On).isDefined && added(CausticsMode.Auto).isEmpty)
    assert(on > 1.05 * off)
    // Two estimates with errors of half a percent each, of which bdpt lacks what glass shows of it
    assert(Math.abs(on / bdpt - 1.0) < 0.04, (on, bdpt))

  test("a scene without glass or metal is rendered as ever, and the plan says why"):
    val text = scene("""Material "diffuse" Shape "sphere" "float radius" .5""")
    val made = plan(text, CausticsMode.Auto)
    assert(image(made).data.sameElements(image(plan(text, CausticsMode.Off)).data))
    assert(made.features.toMap.apply("caustics").startsWith("none"))

  test("the plan names what casts caustics and which lights illuminate them, a few of each"):
    def told(text: String) =
      val features = plan(text, CausticsMode.Auto, spp = 1).features.toMap
      (features.get("casters"), features.get("their lights"))
    val line = Small.linesIterator.indexWhere(_.contains("dielectric")) + 1
    assert(told(Small) == (
      Some(s"dielectric test.pbrt:$line:16 on 1 shape"),
      Some("diffuse test.pbrt:10:25")
    ))
    val made = "MakeNamedMaterial \"water\" \"string type\" \"dielectric\"\n"
    val ball = "Shape \"sphere\" \"float radius\" .1\n"
    def metal(k: Int) = s"Material \"conductor\" \"float roughness\" .0$k\n$ball"
    val many = s"$made${(1 to 4).map(metal).mkString} NamedMaterial \"water\" $ball $ball"
    val lights = (1 to 5).map(k => s"LightSource \"point\" \"rgb I\" [$k 1 1]").mkString("\n")
    val (casters, theirs) = told(scene(many, lights)): @unchecked
    assert(casters.exists(_.startsWith("\"water\" (dielectric test.pbrt:")))
    assert(casters.exists(_.contains(") on 2 shapes, conductor test.pbrt:")))
    assert(casters.exists(_.endsWith(" on 1 shape and 2 more materials")))
    assert(theirs.exists(_.endsWith(" (delta light) and 2 more lights")))
    val matte = scene("Material \"diffuse\" Shape \"sphere\"")
    assert(told(matte) == (None, None))

  test("an integrator that does not look for caustics is named in a warning"):
    val text = Small.replace("\"path\"", "\"bdpt\"")
    val settings = RenderSettings(caustics = Some(CausticsMode.Auto))
    val problems = SceneTexts.problems(text, Dialect.V4, options = settings)
    assert(problems.map(_.message) == Vector(
      "--caustics has no effect: only \"path\" and \"volpath\" look for caustics"
    ))

  test("where the camera sees no caustic, light paths end with the pilot"):
    // The ball is behind the camera, and its light falls there
    val text = scene("""Translate 0 0 -30 Material "dielectric" Shape "sphere" "float radius" .5""")
    val made = plan(text, CausticsMode.Auto)
    assert(made.features.toMap.apply("caustics").startsWith("none"))
    assert(image(made).data.sameElements(image(plan(text, CausticsMode.Off)).data))

private[candela] object CausticTracerSuite:
  val GlassBall = """Material "dielectric" Shape "sphere" "float radius" .5"""

  def square(x: Double): Double = x * x

  def average(image: Image): Double = image.data.map(_.toDouble).sum / image.data.length

  /** A thing above a ground, under an emitter. */
  def scene(thing: String, emitter: String = emitter(0.8f)): String =
    s"""
      LookAt 0 2 -4  0 .4 0  0 1 0
      Camera "perspective" "float fov" 40
      Film "rgb" "integer xresolution" 48 "integer yresolution" 32
      PixelFilter "box" "float xradius" .5 "float yradius" .5
      Sampler "independent"
      Integrator "path" "integer maxdepth" 8
      WorldBegin
      $emitter
      Material "diffuse" "rgb reflectance" [.6 .6 .5]
      Shape "trianglemesh" "point3 P" [-5 0 -5  -5 0 5  5 0 5  5 0 -5]
        "integer indices" [0 1 2 0 2 3]
      AttributeBegin
      Translate 0 .7 0
      $thing
      AttributeEnd
    """

  def emitter(radius: Float): String =
    val radiance = 3f / (radius * radius)
    s"""AttributeBegin
        AreaLightSource "diffuse" "rgb L" [$radiance $radiance $radiance]
        Translate 1 2.6 .5
        Shape "sphere" "float radius" $radius
        AttributeEnd"""

  /** The caustic of a small emitter. */
  val Small: String = scene(GlassBall, emitter(0.15f))

  private def triangles(count: Int, normal: (Double, Double) => (Double, Double, Double)): String =
    val n = count
    val points = for j <- 0 to n; i <- 0 to n yield (2.0 * i / n - 1, 2.0 * j / n - 1)
    val p = points.map((x, z) => s"$x ${0.1 * Math.sin(4 * x)} $z").mkString(" ")
    val ns = points.map((x, z) => normal(x, z)).map((a, b, c) => s"$a $b $c").mkString(" ")
    val faces =
      for j <- 0 until n; i <- 0 until n; a = j * (n + 1) + i
      yield s"$a ${a + 1} ${a + n + 1} ${a + 1} ${a + n + 2} ${a + n + 1}"
    s"""Material "dielectric" Shape "trianglemesh" "point3 P" [$p] "normal N" [$ns]
        "integer indices" [${faces.mkString(" ")}]"""

  /** Where arithmetic is hard. */
  val Hard: Vector[(String, String)] = Vector(
    "a ball that focuses in a point of the ground" -> scene(
      """Translate 0 -.2 0 Material "dielectric" "float eta" 2
         Shape "sphere" "float radius" .5"""
    ),
    "water that light grazes" -> scene(
      """Material "dielectric" "float eta" 1.33 Rotate -90 1 0 0
         Shape "disk" "float radius" 4""",
      """AttributeBegin AreaLightSource "diffuse" "rgb L" [9 9 9]
         Translate 0 1.6 3.5 Shape "sphere" "float radius" .6 AttributeEnd"""
    ),
    "an index of one, which bends nothing" ->
      scene("""Material "dielectric" "float eta" 1 Shape "sphere" "float radius" .5"""),
    "an emitter within the glass" -> scene(
      """AttributeBegin AreaLightSource "diffuse" "rgb L" [5 5 5]
         Shape "sphere" "float radius" .2 AttributeEnd """ + GlassBall
    ),
    "thousands of small triangles" -> scene(
      triangles(40, (x, _) => (-0.4 * Math.cos(4 * x), 1, 0))
    ),
    "normals that point away" -> scene(triangles(6, (x, _) => (0.3 * x, -1, 0.2)))
  )

  val Scenes: Vector[(String, String)] = Hard ++ Vector(
    "a ball of glass, which focuses" -> scene(GlassBall),
    "a ring of brushed metal" -> scene(
      """Material "conductor" "float uroughness" .02 "float vroughness" .08
         "bool remaproughness" false
         Rotate -90 1 0 0 Shape "cylinder" "float radius" .6 "float zmin" -.6 "float zmax" 0"""
    ),
    "a mirrored and stretched instance" -> scene(
      s"""ObjectBegin "ball" $GlassBall ObjectEnd
          Scale -1 .6 1.3 ObjectInstance "ball""""
    ),
    "a pane before the emitter" -> scene(
      """Material "thindielectric" Translate .4 .9 .2
         Shape "disk" "float radius" .8 Rotate 90 1 0 0 Shape "disk" "float radius" .8"""
    ),
    "a sky seen through glass" -> scene(
      GlassBall,
      """LightSource "infinite" "rgb L" [.5 .6 .8]
         LightSource "distant" "rgb L" [0 0 0] """ + emitter(0.8f)
    ),
    "fog, and a ball in it" -> inFog(scene(GlassBall))
  )

  /** @param scattering of the fog, per unit of length */
  def inFog(text: String, scattering: String = "[.15 .1 .05]"): String = text
    .replace("LookAt", fog(scattering) + "LookAt")
    .replace("WorldBegin", "WorldBegin MediumInterface \"\" \"fog\"")
    .replace("\"path\"", "\"volpath\"")

  private def fog(scattering: String) = s"""
    MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" $scattering
    "rgb sigma_a" [.02 .02 .02] "float g" .4
    MediumInterface "" "fog"
    """
