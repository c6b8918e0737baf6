package candela.bench.robustness

import candela.accel.{BruteForce, Primitives}
import candela.bench.report.{Robust, RobustRow}
import candela.geometry.{Hit, Ray}
import candela.image.Image
import candela.math.*

/** Light close to light sources. */
object NearLights extends Measurement(
      "lamp",
      "Light lost or leaking close to a light",
      0,
      "A floor of albedo 0.5 closely below a wide light of radiance 1 sees nothing but it. " +
        "A light behind a black screen lights nothing, however close the screen. The figures are " +
        "means of pictures."
    ):

  def rows(by: Equipment): Iterator[RobustRow] =
    distances.iterator.map: d =>
      by.painted(
        s"a floor ${Spot.short(d)} below a light",
        PeerInput.of(floor(d))
      )(Pixels.mean(_, 0.5, Allowed))
    ++ distances.iterator.map: d =>
      by.painted(
        s"a light ${Spot.short(d)} behind a screen",
        PeerInput.of(covered(d)),
        Option.when(d < 5e-5)(EndOfRays)
      )(Pixels.mean(_, 0, 0))

  private val EndOfRays = "rays to lights end 5e-6 of their length before them, slanting ones " +
    "sooner, because rounding moves their ends"

  private final val Allowed = 0.01
  private def distances = Vector(1e-3, 1e-4, 1e-5, 1e-6)

  private def floor(d: Double): PeerScene =
    val view = View(Spot(0.01, d / 2, 0.02), Spot(0.01, 0, 0.02), Spot(1, 0, 0), 60)
    PeerScene(
      view,
      Vector(
        (Form.floor(1, 0), Surface.Matte(0.5)),
        (Form.ceiling(1, d), Surface.Light(1))
      )
    )

  private def covered(d: Double): PeerScene =
    val view = View(Spot(0, 0.5, -2), Spot.Origin, Spot(0, 1, 0), 30)
    PeerScene(
      view,
      Vector(
        (Form.floor(3, 0), Surface.Matte(0.5)),
        (Form.floor(0.5, 1 - d), Surface.Matte(0)),
        (Form.ceiling(0.25, 1), Surface.Light(10))
      )
    )

/** Facets of smooth balls that are dark where the ball is lit. */
object Terminators extends Measurement(
      "terminator",
      "Terminator artefacts of smooth balls",
      0,
      "Balls of triangles with smooth normals under parallel light. An artefact is a pixel whose " +
        "normal is lit, with a cosine above 0.1, but that has less than half of its light."
    ):

  /** What the scene's programs render is right. */
  private val Why = "facets that face away from the light are in the ball's own shadow, whatever " +
    "their smooth normals, in Candela as in the programs whose scenes these are"

  def rows(by: Equipment): Iterator[RobustRow] = Iterator.range(0, 4).map: level =>
    val ball = SmoothBall(level)
    by.painted(s"a ball of ${8 << (2 * level)} triangles", PeerInput.of(ball.scene), Some(Why)):
      ball.artefacts

/** A ball whose smooth normals are those of a sphere at its corners. */
private final class SmoothBall(level: Int):
  private val soup = Solids.icosphere(level, Transform.Identity)
  private val sun = Vec3(1f, 0.3f, -0.6f).normalized
  private val (side, half) = (128, 1.1)

  def scene: PeerScene =
    val ball = Form.facets(soup, isSmooth = true)
    val view = View(Spot(0, 0, -4), Spot.Origin, Spot(0, 1, 0), 90, Some(half))
    PeerScene(
      view,
      Vector((ball, Surface.Matte(1))),
      sun = Some(Spot.of(sun)),
      depth = 1,
      side = side
    )

  /** The value of each pixel's centre by its smooth normal; NaN beside the ball. */
  private lazy val lit: Array[Float] =
    val accelerator = BruteForce(Primitives(soup, Array.empty))
    val (ray, hit) = (Ray(), Hit())
    Array.tabulate(side * side): i =>
      val x = half * (2 * (i % side + 0.5) / side - 1)
      val y = half * (1 - 2 * (i / side + 0.5) / side)
      ray.set(Vec3(x.toFloat, y.toFloat, -4f), Vec3.Z, Float.PositiveInfinity)
      if !accelerator.closest(ray, hit) then Float.NaN
      else
        def corner(k: Int) = soup.vertex(hit.primitive, k)
        val (u, v) = (hit.u.toFloat, hit.v.toFloat)
        Math.max(0f, (corner(0) * (1f - u - v) + corner(1) * u + corner(2) * v).normalized dot sun)

  def artefacts(image: Image): Robust =
    val green = image.channelNames.indexOf("G")
    var (faults, trials) = (0L, 0L)
    for y <- 1 until side - 1; x <- 1 until side - 1 do
      // Pixels of the outline are partly background
      val neighbours = for dy <- -1 to 1; dx <- -1 to 1 yield lit((y + dy) * side + x + dx)
      val expected = lit(y * side + x)
      if neighbours.forall(!_.isNaN) && expected > 0.1f then
        trials += 1
        if image(x, y, green) < expected / 2 then faults += 1
    Robust.Counted(faults, trials)

/** Bidirectional path tracing beside path tracing. */
object Bumps extends Measurement(
      "bdpt",
      "Bidirectional path tracing under bumps",
      0,
      "Bumps change normals, so that light arriving and light leaving are weighted differently. " +
        "The means of pictures by `bdpt` must be those by `path`."
    ):

  private final val Allowed = 0.01

  def rows(by: Equipment): Iterator[RobustRow] =
    Vector(0.2, 0.5).iterator.flatMap: height =>
      Vector("a sky" -> sky, "a light" -> emitter).map: (name, light) =>
        row(by, s"bumps of $height under $name", height, light)

  private val sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]"
  private val emitter =
    """AttributeBegin Translate 0 3 0 AreaLightSource "diffuse" "rgb L" [9 9 9]
      |Shape "sphere" "float radius" 0.5 AttributeEnd""".stripMargin

  private def row(by: Equipment, what: String, height: Double, light: String): RobustRow =
    val cells =
      for
        p <- by.painters if !by.isCancelled()
        paths = p.paint(input("path", height, light)).map(Pixels.meanAndError)
        bdpt = p.paint(input("bdpt", height, light)).map(Pixels.meanAndError)
      yield p.program.key -> paths.flatMap(a => bdpt.map(a -> _)).fold(
        r => if r.isFailure then Robust.Failed(r.why) else Robust.Absent("has no bdpt"),
        { case ((expected, a), (actual, b)) =>
          Robust.Mean(actual / expected, Math.hypot(a, b) / expected, 1, Allowed)
        }
      )
    RobustRow(what, cells.toMap)

  private def input(integrator: String, height: Double, light: String): PeerInput = PeerInput(
    s"""LookAt 0 4 -4  0 0 0  0 1 0
       |Camera "perspective" "float fov" 30
       |Film "image" "integer xresolution" 64 "integer yresolution" 64 "string filename" "x.exr"
       |PixelFilter "box"
       |Sampler "random" "integer pixelsamples" 64
       |Integrator "$integrator" "integer maxdepth" 5
       |WorldBegin
       |$light
       |Texture "w" "float" "wrinkled"
       |Texture "bumps" "float" "scale" "texture tex1" "w" "float tex2" $height
       |Material "matte" "rgb Kd" [.9 .9 .9] "texture bumpmap" "bumps"
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point P" [-3 0 -3  -3 0 3  3 0 3  3 0 -3] "float uv" [0 0  0 3  3 3  3 0]
       |WorldEnd
       |""".stripMargin,
    None
  )

/** Scenes of any size. */
object Extremes extends Measurement(
      "scenes",
      "Scenes of extreme size and distance",
      0,
      "Means of pictures whose value is known."
    ):

  private final val Allowed = 0.01

  def rows(by: Equipment): Iterator[RobustRow] =
    all.iterator.map((what, scene, value) =>
      by.painted(what, PeerInput.of(scene))(Pixels.mean(_, value, Allowed))
    )

  /** Name, scene, mean of the picture. */
  private def all: Vector[(String, PeerScene, Double)] =
    Vector(
      ("a ground sphere of the Earth's radius", ground(earth), 0.5),
      ("a ground plane of 1e7", ground(Form.floor(1e7, 0)), 0.5),
      ("a ball of radius 1, from 1e5 away", telephoto(Form.Ball(Spot.Origin, 1)), 0.5),
      ("a ball of triangles, from 1e5 away", telephoto(facets), 0.5)
    ) ++ Vector(1e-2, 1e-3, 1e-4, 1e-5, 1e-6).map: d =>
      (s"two glass spheres ${Spot.short(d)} apart", gap(d), Gap)
    ++ Vector(1e-6, 1e-3, 1.0, 1e3, 1e6).map: s =>
      (s"a floor under a spherical light, scaled by ${Spot.short(s)}", lit(s), floorMean)

  private val earth = Form.Ball(Spot(0, -6.371e6, 0), 6.371e6)

  private def ground(form: Form): PeerScene =
    val view = View(Spot(0, 2, -4), Spot.Origin, Spot(0, 1, 0), 30)
    PeerScene(view, Vector((form, Surface.Matte(0.5))), sky = 1)

  private def facets = Form.facets(Solids.icosphere(ClosedMesh.Levels, Transform.Identity))

  /** The ball is twice as wide as the picture. */
  private def telephoto(form: Form): PeerScene =
    val from = Spot(6e4, 0, -8e4)
    val view = View(from, Spot.Origin, Spot(0, 1, 0), Math.toDegrees(2 * Math.atan(0.5 / 1e5)))
    PeerScene(view, Vector((form, Surface.Matte(0.5))), sky = 1)

  /** Mean of pbrt-v3, pbrt-v4, Mitsuba and Candela where they are 1e-2 apart: 0.5235 to 0.5245. */
  private final val Gap = 0.524

  /** Seen through both spheres, above black ground under a sky. */
  private def gap(d: Double): PeerScene =
    val view = View(Spot(-8, 0.5, 0), Spot.Origin, Spot(0, 1, 0), 20)
    def ball(x: Double) = (Form.Ball(Spot(x, 0, 0), 1), Surface.Glass(1.5))
    PeerScene(
      view,
      Vector(ball(-1 - d / 2), ball(1 + d / 2), (Form.floor(100, -1.5), Surface.Matte(0))),
      sky = 1,
      depth = 50,
      spp = 64
    )

  private val (radius, height) = (0.5, 3.0)

  /** A floor seen from 1 above it, 2 wide, with an emitter above the camera. */
  private def lit(s: Double): PeerScene =
    val view = View(Spot(0, 1, 0), Spot.Origin, Spot(1, 0, 0), 90).scaled(s)
    PeerScene(
      view,
      Vector(
        (Form.floor(10 * s, 0), Surface.Matte(0.5)),
        (Form.Ball(Spot(0, height * s, 0), radius * s), Surface.Light(10))
      ),
      depth = 1
    )

  /** A sphere lights a point as if its light came from its centre: with L·(r/D)²·h/D. */
  private val floorMean: Double =
    0.5 * 10 * radius * radius * Math.atan(1 / (height * Math.sqrt(height * height + 2)))
