package candela.build

import candela.diagnostics.Severity
import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** Faults of scenes that pbrt renders: here, too, with a warning. The values are those of the
  * scene's own pbrt.
  */
final class ForgivenSuite extends AnyFunSuite:
  private val view = "LookAt 0 0 -5  0 0 0  0 1 0"
  private val screen = "\"orthographic\" \"float screenwindow\" [-2 2 -1.5 1.5]"
  private val triangle =
    "Shape \"trianglemesh\" \"point3 P\" [-1 -1 0 1 -1 0 0 1 0] \"integer indices\" [0 1 2]"
  private val ball = "Shape \"sphere\" \"float radius\" .5"

  /** Grey things before white light. */
  private def scene(dialect: Dialect, body: String, camera: String, place: String): String =
    val (film, material) =
      if dialect == Dialect.V4 then
        ("\"rgb\"", "\"diffuse\" \"rgb reflectance\" [.3 .3 .3]")
      else ("\"image\"", "\"matte\" \"rgb Kd\" [.3 .3 .3]")
    s"""Film $film "integer xresolution" 32 "integer yresolution" 24
       |PixelFilter "box"
       |Sampler "halton" "integer pixelsamples" 16
       |Integrator "path" "integer maxdepth" 1
       |$place
       |Camera $camera
       |WorldBegin
       |LightSource "infinite" "rgb L" [1 1 1]
       |Material $material
       |$body
       |""".stripMargin

  /** The mean with a warning of `message`, and no error. */
  private def assertMean(
      dialect: Dialect,
      body: String,
      expected: Float,
      message: String,
      camera: String = screen,
      place: String = view
  ): Unit =
    val text = scene(dialect, body, camera, place)
    val found = SceneTexts.parse(text, dialect).warnings ++ SceneTexts.problems(text, dialect)
    assert(found.forall(_.severity == Severity.Warning), found)
    assert(found.exists(_.message.contains(message)), found)
    val mean = SceneTexts.mean(text, dialect).average
    // The edges of 32 by 24 pixels at 16 samples
    assert(Math.abs(mean - expected) < 0.004f, s"$mean, not $expected"): Unit

  test("indices of an incomplete last face are ignored"):
    val body = triangle.replace("[0 1 2]", "[0 1 2 0 1]")
    for d <- Dialect.ofPbrt do assertMean(d, body, 0.8834f, "the last 2 are ignored")
    assertMean(
      Dialect.V4,
      "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] " +
        "\"integer indices\" [0 1 2 3 0]",
      0.7667f,
      "multiple of 4 numbers, found 5; the last is ignored"
    )

  test("v2 and v3 skip a mesh with wrong indices or without points, v4 refuses it"):
    for
      (mesh, what) <- Vector(
        triangle.replace("[0 1 2]", "[0 1 2 0 1 7]") -> "must be vertices of `P`",
        triangle.replace("[0 1 2]", "[0 1]") -> "multiple of 3",
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2]" -> "needs `P` and `indices`",
        "Shape \"loopsubdiv\"" -> "needs `P` and `indices`"
      )
    do
      for d <- Seq(Dialect.V2, Dialect.V3) do
        assertMean(d, s"$mesh\n$ball", 0.9545f, s"$what")
      val refused = SceneTexts.problems(scene(Dialect.V4, mesh, screen, view), Dialect.V4)
      assert(refused.exists(p => p.severity == Severity.Error && p.message.contains(what)))

  test("a third face at an edge of a subdivision surface ends there"):
    val body = "Shape \"loopsubdiv\" \"integer levels\" 2 " +
      "\"integer indices\" [0 1 2 1 0 3 0 1 4] " +
      "\"point3 P\" [-1 0 0 1 0 0 0 1 0 0 -1 0 0 .5 1]"
    for d <- Dialect.ofPbrt do assertMean(d, body, 0.9325f, "belongs to 3 faces (0, 1, 2)")

  test("quadrics without a radius have no surface"):
    for d <- Dialect.ofPbrt do
      assertMean(d, "Shape \"sphere\" \"float radius\" 0", 1f, "`radius` is 0")
      assertMean(d, "Shape \"disk\" \"float radius\" 0", 1f, "`radius` is 0")
      val ring = "Shape \"disk\" \"float radius\" .5 \"float innerradius\" "
      assertMean(d, ring + "1", 1f, "is not below `radius`")
      assertMean(d, ring + ".5", 1f, "is not below `radius`")
      assertMean(d, ring + "-.2", 0.9615f, "their squares count")

  test("a disk of negative radius is one, but is seen to emit on the other side"):
    for d <- Dialect.ofPbrt do
      assertMean(d, "Shape \"disk\" \"float radius\" -1", 0.8167f, "their squares count")
    val emitter = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nShape \"disk\" \"float radius\" "
    assertMean(Dialect.V3, emitter + "-.7", 1.0384f, "their squares count")

  test("a rotation about no axis hides what it places in v4, and is none before"):
    val body = s"Rotate 30 0 0 0\n$triangle"
    assertMean(Dialect.V4, body, 1f, "axis of length 0; what it places is invisible")
    assertMean(Dialect.V2, body, 0.8834f, "axis of length 0; the rotation is ignored")

  test("a camera that looks at its own place sees the background in v4"):
    assertMean(
      Dialect.V4,
      triangle,
      1f,
      "the image shows the background only",
      place = "LookAt 0 0 0  0 0 0  0 1 0"
    )

  test("LookAt along up is ignored in v2 and v3, and stops v4"):
    val place = "LookAt 0 0 -5  0 0 0  0 0 1"
    for d <- Seq(Dialect.V2, Dialect.V3) do
      assertMean(d, triangle, 1f, "LookAt is ignored", place = place)
    val text = scene(Dialect.V4, triangle, screen, place)
    val error = intercept[candela.diagnostics.SceneError](SceneTexts.parse(text, Dialect.V4))
    assert(error.problems.exists(_.message.contains("up is zero or parallel")))

  test("fields of view beyond 0 and 180 degrees are rendered"):
    def camera(fov: Int) = s"\"perspective\" \"float fov\" $fov"
    val message = "`fov` should be between 0 and 180 degrees"
    val window = "\"float screenwindow\" [-2 2 -1.5 1.5]"
    for d <- Seq(Dialect.V3, Dialect.V4) do
      for (fov, mean) <- Seq(0 -> 0.3f, 180 -> 1f, -40 -> 0.9646f, 200 -> 0.9998f) do
        assertMean(d, triangle, mean, message, s"${camera(fov)} $window")

  test("a screen window of three numbers is ignored"):
    val camera = "\"perspective\" \"float fov\" 40 \"float screenwindow\" [-2 2 -1.5]"
    val plain = "\"perspective\" \"float fov\" 40"
    for d <- Seq(Dialect.V3, Dialect.V4) do
      val mean = SceneTexts.mean(scene(d, triangle, plain, view), d).average
      assertMean(d, triangle, mean, "it is ignored, as pbrt does", camera)

  test("a scene without light says so, with and without a camera"):
    for camera <- Seq("", "Camera \"perspective\"\n") do
      val problems = SceneTexts.problems(s"${camera}WorldBegin\nShape \"sphere\"\n", Dialect.V4)
      assert(problems.exists(_.code == candela.diagnostics.Code.DarkScene), problems)
