package candela.build

import candela.diagnostics.{SceneError, Severity}
import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

final class MediaBuilderSuite extends AnyFunSuite:

  private def scene(integrator: String, body: String): String =
    s"""Camera "perspective"
       |Integrator "$integrator"
       |WorldBegin
       |LightSource "infinite"
       |$body
       |Shape "sphere"
       |""".stripMargin

  private def media(plan: candela.render.RenderPlan): String =
    plan.features.toMap.apply("media")

  private val fog = """MakeNamedMedium "fog" "string type" "homogeneous"
    MediumInterface "fog" """""

  test("the plan names the media, and none where there are none"):
    val plan = SceneTexts.plan(scene("volpath", fog), Dialect.V4)
    assert(media(plan) == "1 (homogeneous)")
    assert(media(SceneTexts.plan(scene("volpath", ""), Dialect.V4)) == "none")

  test("what is subtracted from temperatures has two names"):
    def glow(more: String) =
      val gas = s"""MakeNamedMedium "fog" "string type" "uniformgrid" "integer nx" 1
        "integer ny" 1 "integer nz" 1 "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1]
        "float density" [.1] "float temperature" [3000] "float Lescale" 1 $more
        MediumInterface "fog" "" Material "interface""""
      val view = "LookAt 0 0 -3  0 0 0  0 1 0\n" +
        "Film \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" 2\n"
      SceneTexts.mean(view + scene("volpath", gas), Dialect.V4)
    val offset = glow("\"float temperatureoffset\" 1000")
    assert(glow("\"float temperaturecutoff\" 1000") == offset)
    assert(glow("") != offset)

  test("media that nothing has around it, or that are empty space, cost nothing"):
    val unused = """MakeNamedMedium "fog" "string type" "homogeneous""""
    assert(media(SceneTexts.plan(scene("volpath", unused), Dialect.V4)) == "none")
    val empty = fog.replace("\"homogeneous\"", "\"homogeneous\" \"float scale\" 0")
    assert(media(SceneTexts.plan(scene("volpath", empty), Dialect.V4)) == "none")

  test("a medium may be black in some of the wavelengths of a spectral rendering"):
    val line = "\"spectrum sigma_a\" [499 0 500 9 505 9 506 0] \"spectrum sigma_s\" [400 0 700 0]"
    def image(coefficients: String) = SceneTexts.mean(
      "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n" + scene(
        "volpath",
        s"""MakeNamedMedium "line" "string type" "homogeneous" $coefficients
           |AttributeBegin MediumInterface "line" "" Material "interface" Translate 0 0 -9
           |Shape "sphere" AttributeEnd
           |MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.3 .2 .1]
           |MediumInterface "fog" "" Material "interface" Translate 0 0 5""".stripMargin
      ),
      Dialect.V4
    )
    assert(image(line) == image("\"rgb sigma_a\" [.1 .2 .3]"))

  for (space, camera) <- Seq("cameraworld" -> 5, "world" -> 0, "camera" -> 5) do
    test(s"a grid before the camera is placed where pbrt-v4 renders from: $space"):
      def grid(x: Int) = s"""MakeNamedMedium "fog" "string type" "uniformgrid" "integer nx" 1
        "integer ny" 1 "integer nz" 1 "point3 p0" [$x 0 0] "point3 p1" [${x + 1} 1 1]
        "float density" [1] """
      val option = s"Option \"string rendercoordsys\" \"$space\"\n"
      val before = grid(0) + "Translate -5 0 0 Camera \"perspective\" WorldBegin"
      val after = "Translate -5 0 0 Camera \"perspective\" WorldBegin " + grid(camera)
      def place(text: String) =
        val scene = SceneTexts.parse(option + text, Dialect.V4)
        val t = scene.media.head.mediumToWorld.start
        val x = scene.media.head.medium.param("p0").get.floats(0)
        (t.point(candela.math.Vec3(x, 0, 0)).x, scene.warnings.map(_.code))
      assert(place(before)._1 == place(after)._1)
      assert(place(after)._2.isEmpty)
      val warned = place(before)._2.contains(candela.diagnostics.Code.AsInPbrt)
      assert(warned == (camera != 0))

  private val blind = Seq("path" -> Dialect.V3, "path" -> Dialect.V4, "whitted" -> Dialect.V3)

  for (integrator, dialect) <- blind do
    test(s"$integrator of $dialect ignores media, with a warning"):
      val text = scene(integrator, fog)
      val found = SceneTexts.problems(text, dialect)
      assert(found.exists(_.message.contains("ignores participating media")), found)
      assert(media(SceneTexts.plan(text, dialect)) == "none")

  test("a medium that nobody made is an error, with the nearest name"):
    val text = scene("volpath", fog + "\nMediumInterface \"fogg\" \"\"")
    val found = SceneTexts.problems(text, Dialect.V4).filter(_.severity == Severity.Error)
    assert(found.map(_.message) == Vector("medium `fogg` is not defined"))
    assert(found.head.help.exists(_.contains("fog")))

  private def smoke(rest: String) = scene(
    "volpath",
    s"""MakeNamedMedium "v" "string type" "nanovdb" $rest
       |MediumInterface "v" """"".stripMargin
  )

  private def found(text: String) = SceneTexts.problems(text, Dialect.V4)

  test("nanovdb media have densities, and emit by temperature unless their scale is 0"):
    val file = "\"string filename\" \"scenes/volumes/smoke.nvdb\""
    val size = "1 (sparse grid of 17×19×16 voxels with bounds of 17×19×16"
    def described(rest: String) = media(SceneTexts.plan(smoke(s"$file $rest"), Dialect.V4))
    assert(described("") == s"$size, emissive by temperature)")
    assert(described("\"float Lescale\" 0") == s"$size)")
    assert(described("\"string gridname\" \"temperature\" \"string temperaturename\" \"x\"")
      .startsWith("1 (sparse grid of 13×13×13 voxels with bounds"))

  test("nanovdb says what is missing"):
    assert(found(smoke("")).exists(_.message == "a \"nanovdb\" medium needs `filename`"))
    val nowhere = found(smoke("\"string filename\" \"a.nvdb\""))
    assert(nowhere.map(_.message) == Vector("no file `a.nvdb`"))
    val file = "\"string filename\" \"scenes/volumes/smoke.nvdb\""
    val other = found(smoke(s"$file \"string gridname\" \"densty\"")).head
    assert(other.message == "can't read `scenes/volumes/smoke.nvdb`: it has no grid `densty`, " +
      "only `density`, `temperature`")
    assert(other.help.contains("did you mean `density`?") && other.pos.exists(_.line == 5))
    val cold = found(smoke(s"$file \"string temperaturename\" \"heat\""))
    assert(cold.exists(_.message.endsWith("has no grid `heat`; it does not emit")))
    val scene = found(smoke("\"string filename\" \"scenes/v4-fog.pbrt\""))
    assert(scene.head.message.contains("can't read `scenes/v4-fog.pbrt`: not a NanoVDB file"))

  test("a grid of the wrong size is an error that counts"):
    val text = scene(
      "volpath",
      """MakeNamedMedium "g" "string type" "uniformgrid" "integer nx" 2 "float density" [1 2 3]"""
    )
    val found = SceneTexts.problems(text, Dialect.V4).filter(_.severity == Severity.Error)
    assert(found.map(_.message) == Vector("`density` must have 2·1·1 numbers, found 3"))

  test("an unknown preset is reported, and a known one is measured"):
    val text = scene(
      "volpath",
      """MakeNamedMedium "m" "string type" "homogeneous" "string preset" "Skimmilc""""
    )
    val found = SceneTexts.problems(text, Dialect.V3)
    assert(found.exists(_.message.startsWith("unknown measured medium \"Skimmilc\"")), found)
    val known = SceneTexts.problems(text.replace("milc", "milk"), Dialect.V3)
    assert(known.isEmpty, known)

  test("phase functions of Mitsuba's that don't match their numbers are an error"):
    def problems(values: String) =
      val text = scene(
        "volpath",
        s"""MakeNamedMedium "m" "string type" "homogeneous" "string phases" [ "rayleigh" "hg" ]
           |"float phaseweights" [ .5 .5 ] "float phasevalues" [ $values ]""".stripMargin
      )
      val parsed = SceneTexts.parse(text, Dialect.V4).copy(dialect = Dialect.Mitsuba)
      val found =
        try SceneBuilder.build(parsed, RenderSettings())._2
        catch case e: SceneError => e.problems
      found.map(_.message)
    assert(problems(".5").isEmpty)
    val wrong = Vector("`phases`, `phaseweights` and `phasevalues` don't match")
    assert(problems("") == wrong && problems(".5 .5") == wrong && problems("1.5") == wrong)

  test("volumes are rendered by the surface integrator and the volume integrator together"):
    val text =
      """Camera "perspective"
        |SurfaceIntegrator "path"
        |VolumeIntegrator "single" "float stepsize" .5
        |WorldBegin
        |LightSource "point"
        |Volume "homogeneous" "color sigma_s" [1 1 1]
        |Volume "exponential" "color sigma_a" [1 1 1]
        |Shape "sphere"
        |WorldEnd
        |""".stripMargin
    val plan = SceneTexts.plan(text, Dialect.V2)
    assert(
      media(plan) == "2 (homogeneous; exponential), emission and single scattering in steps of 0.5"
    )

  test("steps through volumes must have a size"):
    val text =
      """Camera "perspective"
        |VolumeIntegrator "emission" "float stepsize" 0
        |WorldBegin
        |LightSource "point"
        |Shape "sphere"
        |WorldEnd
        |""".stripMargin
    val found = SceneTexts.problems(text, Dialect.V2)
    assert(found.exists(_.message == "`stepsize` must be above 0, found 0"), found)
