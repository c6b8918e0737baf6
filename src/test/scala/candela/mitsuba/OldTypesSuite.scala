package candela.mitsuba

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.image.{DisplayTransform, Exposure, Image}
import candela.render.Renderer
import candela.settings.{OutputSettings, RenderSettings}

/** Types and parameters of Mitsuba 0.6, by its manual. */
class OldTypesSuite extends OldScenes:

  test("each integrator renders, with a warning if another takes its place"):
    val alone =
      Seq("path", "volpath", "volpath_simple", "direct", "bdpt", "ptracer", "ao", "pssmlt")
    val replaced = Seq("photonmapper", "ppm", "sppm", "vpl", "mlt", "erpt", "field", "motion")
    for kind <- alone ++ replaced do
      val found = warnings(s"${sensor(more = fov)}<integrator type=\"$kind\"/>$box")
      assert(found.size == (if replaced.contains(kind) then 1 else 0), s"$kind: $found")
      assert(found.forall(_.contains("is not supported; using \"")), found)

  test("`adaptive` and `irrcache` render the integrator within"):
    for kind <- Seq("adaptive", "irrcache") do
      val body = s"""${sensor(more = fov)}<integrator type="$kind"><float name="quality" value="2"/>
        <integrator type="field">
          <string name="field" value="uv"/><spectrum name="undefined" value="nan"/>
        </integrator>
        <integrator type="bdpt"><integer name="maxDepth" value="3"/></integrator>
        </integrator>$box"""
      using(body, "0.6.0"): scene =>
        assert(scene.errors.isEmpty)
        assert(scene.warnings.map(_.message) ==
          Vector(s"integrator \"$kind\" is not supported; using the integrator within"))
        assert(scene.integrator.get.name == "bdpt")
        assert(scene.integrator.get.param("maxdepth").get.ints.head == 2)

  test("`multichannel` has the layers of `field`, as colours under the film's names"):
    def fields(names: String*) = names.map: name =>
      s"<integrator type=\"field\"><string name=\"field\" value=\"$name\"/></integrator>"
    def scene(within: String, names: String) =
      val film = s"<string name=\"channelNames\" value=\"$names\"/>" +
        "<string name=\"pixelFormat\" value=\"rgb, rgb, luminance\"/>"
      s"<integrator type=\"multichannel\">$within</integrator>" +
        sensor(more = fov, film = film) +
        "<shape type=\"rectangle\"/><emitter type=\"constant\"/>"
    val within = fields("shNormal").mkString + "<integrator type=\"direct\"/>" +
      fields("distance", "uv").mkString
    val body = scene(within, "n, color, t, st")
    assert(warnings(body) == Vector.empty)
    val image = using(body, "0.6.0"): description =>
      val plan = SceneBuilder.build(description, RenderSettings())._1
      Renderer.render(plan, threads = 1).image(plan.development)
    val channels = "n.R n.G n.B color.R color.G color.B color.A t.Y st.R st.G".split(" ")
    assert(image.channelNames.toSet == (Image.RgbNames ++ channels).toSet)
    val center = (image.width / 2, image.height / 2)
    def value(name: String) = image(center._1, center._2, image.channelNames.indexOf(name))
    assert(value("n.B") == 1)
    assert(Math.abs(value("t.Y") - 5) < 0.1)
    assert(value("color.R") == value("R"))
    val others = fields("relPosition").mkString +
      "<integrator type=\"path\"/><integrator type=\"ao\"/>"
    assert(warnings(scene(others, "")).sorted == Vector(
      "`field` of integrator \"field\" is not supported; `relPosition` is not written",
      "only the first integrator of integrator \"multichannel\" is rendered; this one is ignored"
    ))
    using(scene(fields("normal").mkString, ""), "0.6.0"): description =>
      assert(description.errors.map(_.message) == Vector("unknown `field` `normal`"))

  test("parameters that change time and noise alone are read, others are named as in the file"):
    assert(warnings(s"""${sensor(more = fov)}<integrator type="bdpt">
      <boolean name="lightImage" value="false"/><boolean name="showWeighted" value="true"/>
      <integer name="samplez" value="3"/></integrator>$box""") == Vector(
      "`showWeighted` of integrator \"bdpt\" is not supported; only the image is rendered",
      "`samplez` is not a parameter of integrator \"bdpt\"; it is ignored"
    ))

  test("bidirectional paths render what paths render"):
    val scene = sensor(more = fov) + "<shape type=\"cube\"><bsdf type=\"diffuse\"/></shape>" +
      "<shape type=\"rectangle\"><transform name=\"toWorld\"><translate z=\"4.5\"/></transform>" +
      "<emitter type=\"area\"><rgb name=\"radiance\" value=\"3\"/></emitter></shape>"
    val facing = "<rotate y=\"1\" angle=\"180\"/><translate z=\"6\"/>"
    def by(kind: String) = mean(s"<integrator type=\"$kind\"/>${
        scene.replace("<translate z=\"4.5\"/>", facing)
      }")
    // The noise of 64 samples per pixel
    isNear(by("bdpt"), by("path"), 0.02f)
    isNear(by("pssmlt"), by("path"), 0.05f)

  test("ambient occlusion is 1 beyond all surfaces, and ends at a half of the scene's radius"):
    val floor = "<shape type=\"rectangle\"/>"
    isNear(mean(s"<integrator type=\"ao\"/>${sensor(more = fov)}$floor"), Rgb.White, 1e-6f)
    def roof(length: String) =
      mean(s"<integrator type=\"ao\">$length</integrator>${sensor(more =
          "<float name=\"fov\" value=\"1\"/><float name=\"nearClip\" value=\"4\"/>"
        )}$floor<shape type=\"rectangle\"><transform name=\"toWorld\"><scale value=\"9\"/>" +
        "<translate z=\"2\"/></transform></shape>").r
    // Those longer than a quarter of the diagonal
    assert(Math.abs(roof("") - 4 / 40.75f) < 0.01f, roof(""))
    assert(roof("<float name=\"rayLength\" value=\"1.9\"/>") == 1f)
    val half = roof("<float name=\"rayLength\" value=\"4\"/>")
    // Those longer than 4: cos² θ = 1 / 4
    assert(Math.abs(half - 0.25f) < 0.02f, half)

  test("a panorama's azimuth begins at -z and turns to +x"):
    val walls = Seq("x=\"9\"" -> "1 0 0", "x=\"-9\"" -> "0 1 0", "z=\"9\"" -> "0 0 1").map:
      (at, c) =>
        s"<shape type=\"sphere\"><point name=\"center\" ${Seq("x", "y", "z")
            .map(k => if at.startsWith(k) then at else s"$k=\"0\"").mkString(" ")}/>" +
          s"<emitter type=\"area\"><rgb name=\"radiance\" value=\"$c\"/></emitter></shape>"
    val view = sensor("spherical").replace(
      "origin=\"0,0,5\" target=\"0,0,0\"",
      "origin=\"0,0,0\" target=\"0,0,1\""
    ).replace(
      "name=\"width\" value=\"8\"",
      "name=\"width\" value=\"16\""
    )
    val all = pixels(view + walls.mkString, "0.6.0")
    def column(x: Int) = (0 until 8).map(y => all(16 * y + x)).reduce(_ + _)
    // The azimuths 90, 270 and 180 degrees
    assert(column(3).r + column(4).r > 0.1f && column(3).g == 0f, all)
    assert(column(11).g + column(12).g > 0.1f, all)
    assert(column(7).b + column(8).b > 0.1f, all)
    assert(warnings(view + walls.mkString).isEmpty)

  test("each sensor renders, also one within a shape"):
    assert(warnings(sensor(
      "telecentric",
      "<float name=\"apertureRadius\" value=\".1\"/>" +
        "<float name=\"focusDistance\" value=\"4\"/>"
    ) + box).isEmpty)
    assert(warnings(sensor(
      "thinlens",
      "<float name=\"apertureRadius\" value=\".1\"/>" +
        fov
    ) + box).isEmpty)
    val distorted = "<string name=\"kc\" value=\"0.1, -0.02\"/>" + fov
    assert(warnings(sensor("perspective_rdist", distorted) + box) ==
      Vector("`kc` of sensor \"perspective_rdist\" is not supported; the image is not distorted"))
    assert(warnings(sensor("perspective_rdist", "<string name=\"kc\" value=\"0, 0\"/>" + fov) +
      box).isEmpty)
    for kind <- Seq("fluencemeter", "radiancemeter") do
      assert(warnings(sensor(kind) + box) ==
        Vector(s"sensor \"$kind\" is not supported; using \"perspective\""))
    val meter = "<shape type=\"sphere\"><sensor type=\"irradiancemeter\"/></shape>"
    assert(warnings(meter) ==
      Vector("sensor \"irradiancemeter\" is not supported; using \"perspective\""))

  test("a telecentric lens is as large in the world as it says"):
    def lens(scale: String) =
      using(
        sensor("telecentric", "<float name=\"apertureRadius\" value=\".5\"/>")
          .replace("<lookAt", s"$scale<lookAt"),
        "0.6.0"
      )(_.camera.get.param("lensradius").get)
        .floats.head
    assert(lens("") == 0.5f && lens("<scale value=\"2\"/>") == 0.25f)

  test("samplers, films and filters are read; what can't be done is told"):
    for kind <- Seq("independent", "stratified", "ldsampler", "halton", "hammersley", "sobol") do
      val found = warnings(sensor(more = fov).replace(
        "sampler type=\"independent\"",
        s"sampler type=\"$kind\""
      ).replace(
        "</sampler>",
        "<integer name=\"scramble\" value=\"1\"/>" +
          "<integer name=\"dimension\" value=\"4\"/></sampler>"
      ) + box)
      val instead = "sampler \"hammersley\" is not supported; using \"halton\""
      assert(found == (if kind == "hammersley" then Vector(instead) else Vector.empty))
    for kind <- Seq("hdrfilm", "ldrfilm", "tiledhdrfilm") do
      val found = warnings(sensor(
        more = fov,
        film = "<boolean name=\"banner\" value=\"false\"/>" +
          "<string name=\"fileFormat\" value=\"png\"/><boolean name=\"attachLog\" value=\"false\"/>"
      )
        .replace("hdrfilm", kind) + box)
      assert(found.isEmpty, found)
    val told = warnings(sensor(
      more = fov,
      film = "<string name=\"tonemapMethod\" " +
        "value=\"reinhard\"/><float name=\"exposure\" value=\"1\"/><float name=\"gamma\" " +
        "value=\"-1\"/><string name=\"label[1,2]\" value=\"$scene['renderTime']\"/>"
    ) + box)
    assert(told == Vector(
      "`tonemapMethod` of film \"hdrfilm\" is not supported; the image has linear values",
      "`label[1,2]` of film \"hdrfilm\" is not supported; nothing is written in its place"
    ))
    using("<sensor type=\"perspective\"><film type=\"mfilm\"/></sensor>", "0.6.0"): scene =>
      assert(scene.film.get.param("xresolution").get.ints.head == 1)
      assert(
        scene.warnings.exists(_.message == "film \"mfilm\" is not supported; using \"hdrfilm\"")
      )

  test("the exposure of a film is told with the option that shows it, unless that is given"):
    val film = "<float name=\"exposure\" value=\"1.5\"/>"
    using(sensor(more = fov, film = film) + box, "0.6.0"): scene =>
      def told(stops: Float) =
        val output = OutputSettings(display = DisplayTransform(exposure = Exposure.Stops(stops)))
        SceneBuilder.build(scene, RenderSettings(output = output))._2
      assert(scene.warnings.isEmpty && told(1.5f).isEmpty)
      val Vector(warning) = told(0f): @unchecked
      assert(warning.message == "`exposure` is not supported; the image has linear values")
      assert(warning.help.exists(_.startsWith("--exposure 1.5 shows it")))
    assert(warnings(sensor(more = fov, film = film.replace("1.5", "0")) + box).isEmpty)

  test("names of versions before 0.4 are read"):
    val old =
      """<camera type="perspective"><boolean name="mapSmallerSide" value="false"/>
      <transform name="toWorld"><lookAt ox="0" oy="0" oz="5" tx="0" ty="0" tz="0"
      uy="1"/></transform>
      <sampler type="ldsampler"><integer name="sampleCount" value="64"/></sampler>
      <film type="exrfilm"><boolean name="alpha" value="false"/><integer name="width" value="8"/>
      <integer name="height" value="4"/></film></camera><luminaire type="constant">
      <rgb name="intensity" value="3"/></luminaire><shape type="sphere">
      <boolean name="inverted" value="false"/><bsdf type="lambertian"/></shape>
      <integrator type="errctrl"><integrator type="path"/></integrator>"""
    using(old, "0.2.0"): scene =>
      assert(scene.errors.isEmpty && scene.warnings.size == 1, scene.warnings)
      assert(scene.lights.head.light.param("L").get.floats.head == 3f)
      assert(Math.abs(scene.camera.get.param("fov").get.floats.head - 50) > 1)
    val smaller = old.replace("<boolean name=\"mapSmallerSide\" value=\"false\"/>", fov)
    using(smaller, "0.3.0"): scene =>
      assert(Math.abs(scene.camera.get.param("fov").get.floats.head - 40) < 1e-4)

  test("sRGB, black bodies with a scale, and axes of any length"):
    def seen(light: String) = mean(sensor(more = fov) + "<emitter type=\"constant\">" +
      s"$light</emitter>")
    // The image has 16-bit numbers
    isNear(seen("<srgb name=\"radiance\" value=\"0.5 1 1\"/>"), Rgb(0.21404f, 1f, 1f), 5e-3f)
    isNear(seen("<srgb name=\"radiance\" value=\"#80ffff\"/>"), Rgb(0.21586f, 1f, 1f), 5e-3f)
    def body(scale: String) = seen(s"<blackbody name=\"radiance\" temperature=\"5000K\"$scale/>")
    isNear(body(" scale=\"2\""), body("") * 2f, 1e-3f)
    def turned(axis: Int) = using(
      sensor(more = fov) + "<shape type=\"sphere\"><transform " +
        s"name=\"toWorld\"><rotate z=\"$axis\" angle=\"30\"/></transform></shape>",
      "0.6.0"
    ): scene =>
      scene.shapes.head.objectToWorld.start
    assert(turned(5) == turned(1))
