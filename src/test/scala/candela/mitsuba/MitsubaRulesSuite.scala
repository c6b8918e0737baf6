package candela.mitsuba

import candela.build.SceneBuilder
import candela.image.{Image, ImageFiles}
import candela.render.Renderer
import candela.scenefile.SceneDescription
import candela.settings.RenderSettings

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** Values are Mitsuba 3.9.1's (`scalar_rgb`). */
class MitsubaRulesSuite extends AnyFunSuite:

  private def inFile[A](body: String, version: String = "3.0.0")(use: SceneDescription => A): A =
    val folder = Files.createTempDirectory("candela-rules")
    val text = s"<scene version=\"$version\">$body</scene>"
    val file = Files.writeString(folder.resolve("s.xml"), text)
    try use(MitsubaScene.readable(file, Map.empty, keepGoing = false))
    finally
      Files.delete(file)
      Files.delete(folder)

  private def sensor(film: String = "", more: String = "") =
    s"""<sensor type="perspective"><float name="fov" value="40"/>$more<transform name="to_world">
      <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><sampler type="independent">
      <integer name="sample_count" value="64"/></sampler><film type="hdrfilm">
      <integer name="width" value="16"/><integer name="height" value="12"/><rfilter type="box"/>
      $film</film></sensor>"""

  private val Path6 =
    "<integrator type=\"path\"><integer name=\"max_depth\" value=\"6\"/></integrator>"

  private def means(body: String): Vector[Double] = inFile(body): scene =>
    assert(scene.errors.isEmpty, scene.errors)
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    val image = Renderer.render(plan, threads = 1).image(plan.development)
    val n = image.channels
    Vector.tabulate(3)(c => image.data.indices.by(n).map(i => image.data(i + c).toDouble).sum)
      .map(_ * n / image.data.length)

  private def isNear(found: Vector[Double], right: Double*)(error: Double): Unit =
    for (a, b) <- found.zip(right) do assert(Math.abs(a - b) <= error, s"$found, not $right")

  private def warnings(body: String, version: String = "3.0.0") =
    inFile(body, version)(_.warnings)

  test("#rrggbb is a warning, for Mitsuba 3 refuses it; 0.6 reads it"):
    val bsdf = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"#ff8000\"/></bsdf>"
    val ball = sensor() + s"<shape type=\"sphere\">$bsdf</shape>"
    assert(warnings(ball).map(_.message).exists(_.contains("takes no `#ff8000`")))
    assert(!warnings(ball, "0.6.0").exists(_.message.contains("#ff8000")))
    assert(!warnings(ball.replace("#ff8000", "1,.5,0")).exists(_.message.contains("takes no")))

  test("a field of view that is none is one error, and no warning of another number"):
    inFile(sensor().replace("\"40\"", "\"-5\"")): scene =>
      val message = "`fov` must be between 0 and 180 degrees, found -5"
      assert(scene.errors.map(_.message) == Vector(message))
      assert(scene.camera.get.param("fov").get.floats.forall(a => a > 0 && a < 180))

  test("a number of samples that becomes a square is a warning"):
    def counted(count: Int) =
      val text = sensor().replace("independent", "multijitter").replace("\"64\"", s"\"$count\"")
      warnings(text).map(_.message).filter(_.contains("sample_count"))
    assert(counted(128) == Vector("`sample_count` 128 becomes 144, the next square number"))
    assert(counted(64).isEmpty)

  test("a blend with a smooth part is a warning, for Mitsuba renders it otherwise"):
    def blend(kind: String) = warnings(sensor() + "<shape type=\"sphere\"><bsdf " +
      s"type=\"blendbsdf\"><bsdf type=\"diffuse\"/><bsdf type=\"twosided\"><bsdf type=\"$kind\"/>" +
      "</bsdf></bsdf></shape>").filter(_.message.contains("smooth part of a blend"))
    assert(blend("conductor").size == 1 && blend("roughconductor").isEmpty)

  test("the sun of a sky subtends its aperture"):
    val sun = "<emitter type=\"sunsky\"><vector name=\"sun_direction\" x=\"0\" y=\"0\" z=\"1\"/>" +
      "<float name=\"sun_aperture\" value=\"20\"/><float name=\"sky_scale\" value=\"0\"/></emitter>"
    val up = sensor().replace("target=\"0,0,0\" up=\"0,1,0\"", "target=\"0,0,9\" up=\"0,1,0\"")
    inFile(up + sun): scene =>
      val plan = SceneBuilder.build(scene, RenderSettings())._1
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      val n = image.channels
      val lit = image.data.indices.by(n).map(i => image.data(i).toDouble)
      // Of 40 degrees across 16 pixels and a disk of 20: π (tan 10°)² of the film's tangents
      val share = Math.PI * Math.pow(Math.tan(Math.toRadians(10)), 2) /
        (4 * 0.75 * Math.pow(Math.tan(Math.toRadians(20)), 2))
      // The limb is darker than the centre, and a pixel is a 16th of the film
      val found = lit.sum / lit.max / lit.size
      assert(found < share * 1.1 && found > share * 0.6, s"$found of $share")

  test("a principal point moves the image to the left and down"):
    val at = "<float name=\"principal_point_offset_x\" value=\".2\"/>" +
      "<float name=\"principal_point_offset_y\" value=\"-.1\"/>"
    inFile(sensor(more = at)): scene =>
      val window = scene.camera.get.param("screenwindow").get.floats
      val right = Seq(0.4 * 4 / 3 - 4.0 / 3, 0.4 * 4 / 3 + 4.0 / 3, 0.2 - 1, 0.2 + 1)
      assert(window.toSeq.zip(right).forall((a, b) => Math.abs(a - b) < 1e-6), window.toSeq)

  test("an emitter's spectrum of one value is flat, a number and a uniform spectrum are white"):
    def sky(radiance: String) =
      means(s"$Path6${sensor()}<emitter type=\"constant\">$radiance</emitter>")
    // Digits of Mitsuba's table of the observer
    isNear(sky("<spectrum name=\"radiance\" value=\"1\"/>"), 1.2048, 0.9483, 0.9089)(6e-4)
    isNear(sky("<spectrum name=\"radiance\" value=\"400:1, 700:1\"/>"), 1.1997, .9495, .9034)(6e-4)
    isNear(sky("<float name=\"radiance\" value=\"1\"/>"), 1, 1, 1)(1e-5)
    val uniform = "<spectrum name=\"radiance\" type=\"uniform\"><float name=\"value\" value=\"1\"/>"
    isNear(sky(s"$uniform</spectrum>"), 1, 1, 1)(1e-5)

  test("the spectrum of an emitter keeps its wavelengths, whatever emitter it is"):
    def spectrum(name: String) = s"<spectrum name=\"$name\" value=\"2\"/>"
    for (kind, name) <- Seq(
        "point" -> "intensity",
        "spot" -> "intensity",
        "directional" -> "irradiance",
        "constant" -> "radiance"
      )
    do
      inFile(s"${sensor()}<emitter type=\"$kind\">${spectrum(name)}</emitter>"): scene =>
        val d = scene.lights.head.light
        val own = d.param("L").orElse(d.param("I")).get
        assert(own.floats.toSeq == Seq(360f, 2f, 830f, 2f), kind)
        // Digits of sRGB's matrix and the observer's table: see ColorimetrySuite
        assert(Math.abs(d.param("scale").get.floats.head - 2f) < 1e-3f, kind)

  test("pairs of a medium's coefficients are lit by D65, and at most 1 outside volumes"):
    def sigmaT(coefficient: String) =
      val medium = s"<medium name=\"interior\" type=\"homogeneous\">$coefficient" +
        "<float name=\"albedo\" value=\"0\"/></medium>"
      inFile(s"${sensor()}<shape type=\"sphere\"><bsdf type=\"null\"/>$medium</shape>"):
        _.media.head.medium.param("sigma_a").get.floats.toVector.map(_.toDouble)
    def pairs(name: String, x: String) = s"<spectrum name=\"$name\" value=\"360:$x, 830:$x\"/>"
    // White under D65 is right to 1e-3: see ColorimetrySuite; below, 2 to twice that
    isNear(sigmaT(pairs("sigma_t", ".5")), .5, .5, .5)(1e-3)
    isNear(sigmaT(pairs("sigma_t", "2")), 1, 1, 1)(1e-6)
    isNear(sigmaT("<spectrum name=\"sigma_t\" value=\"2\"/>"), 2, 2, 2)(1e-6)
    val volume = s"<volume name=\"sigma_t\" type=\"constvolume\">${pairs("value", "2")}</volume>"
    isNear(sigmaT(volume), 2, 2, 2)(4e-3)

  test("a transform that mirrors turns spheres inside out, not disks"):
    def emitter(shape: String, mirror: String) = means(
      s"""$Path6${sensor()}<shape type="$shape"><transform name="to_world">$mirror
        <scale value=".3"/><translate z="1"/></transform><emitter type="area">
        <rgb name="radiance" value="9"/></emitter></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="9"/><translate z="-1"/>
        </transform><bsdf type="diffuse"><rgb name="reflectance" value=".5"/></bsdf></shape>"""
    ).head
    val (z, x) = ("<scale z=\"-1\"/>", "<scale x=\"-1\"/>")
    assert(emitter("sphere", z) == 0 && emitter("sphere", x) == 0)
    assert(emitter("sphere", "<scale x=\"-1\" z=\"-1\"/>") > 0.4)
    // The noise of 64 samples per pixel
    assert(Math.abs(emitter("disk", z) - 0.0418) < 1e-3)
    assert(Math.abs(emitter("disk", x) - emitter("disk", "")) < 0.01)

  test("an instance that mirrors keeps the outside of its shapes, however often it is placed"):
    def lit(shape: String, mirror: String, copies: Int): Boolean =
      def instance(more: String) =
        "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\">" +
          s"$mirror$more</transform></shape>"
      val far = "<translate x=\"200\"/>"
      val group = s"<shape type=\"shapegroup\" id=\"g\"><shape type=\"$shape\">" +
        "<bsdf type=\"diffuse\"/></shape></shape>"
      val light = "<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"0\" z=\"5\"/>" +
        "</emitter>"
      means(s"$Path6${sensor()}$group${instance("")}${instance(far) * (copies - 1)}$light").head > 0
    val (x, z, all) = ("<scale x=\"-1\"/>", "<scale z=\"-1\"/>", "<scale value=\"-1\"/>")
    for copies <- 1 to 2 do
      for mirror <- Seq("", x, z, all) do
        assert(lit("sphere", mirror, copies), s"$mirror $copies")
        // A normal is a covector: it turns with z alone
        for shape <- Seq("disk", "rectangle") do
          assert(lit(shape, mirror, copies) == (mirror == "" || mirror == x), s"$shape $mirror")

  test("a mirrored cylinder emits outwards, but samples of its light lie within"):
    def floor(mirror: String) = means(
      s"""$Path6${sensor()}<shape type="cylinder"><float name="radius" value=".4"/>
        <point name="p0" x="-1" y="0" z="-.2"/><point name="p1" x="1" y="0" z="-.2"/>
        <transform name="to_world">$mirror</transform><emitter type="area"/></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="9"/><translate z="-1"/>
        </transform><bsdf type="diffuse"><rgb name="reflectance" value=".5"/></bsdf></shape>"""
    ).head
    // The noise of 64 samples per pixel
    isNear(Vector(floor("")), 0.1932)(0.005)
    isNear(Vector(floor("<scale x=\"-1\"/>")), 0.178)(0.005)

  test("a diffuse reflectance above 1 adds light"):
    def wall(reflectance: String) = means(
      s"""$Path6${sensor()}<shape type="rectangle"><transform name="to_world"><scale value="9"/>
        </transform><bsdf type="diffuse">$reflectance</bsdf></shape><emitter type="constant"/>"""
    )
    val d65 = "<spectrum name=\"reflectance\" type=\"d65\"><float name=\"scale\" value=\"2\"/>"
    // The noise of 64 samples
    isNear(wall(s"$d65</spectrum>"), 2, 2, 2)(0.03)
    isNear(wall(s"$d65<rgb name=\"color\" value=\".1,.2,.6\"/></spectrum>"), .2, .4, 1.2)(0.02)

  test("negative light is a warning with a place, whatever the emitter"):
    for
      (kind, name) <- Seq(
        "point" -> "intensity",
        "spot" -> "intensity",
        "directional" -> "irradiance",
        "constant" -> "radiance",
        "projector" -> "irradiance",
        "area" -> "radiance"
      )
      colour <- Seq("<rgb name=\"%s\" value=\"-1,-2,0\"/>", "<float name=\"%s\" value=\"-1\"/>")
    do
      val emitter = s"<emitter type=\"$kind\">${colour.format(name)}</emitter>"
      val body = if kind == "area" then s"<shape type=\"sphere\">$emitter</shape>" else emitter
      inFile(s"${sensor()}$body"): scene =>
        val told = scene.warnings.filter(_.message.startsWith("negative emission"))
        assert(told.size == 1 && told.head.pos.isDefined, emitter)

  test("depths that Mitsuba refuses are warnings with a place"):
    def warnings(integrator: String, name: String, value: Int) =
      inFile(
        s"<integrator type=\"$integrator\"><integer name=\"$name\" value=\"$value\"/>" +
          s"</integrator>${sensor()}"
      )(_.warnings.filter(w => w.message.matches(s"`$name` must be .*, found $value;.*")))
    for kind <- Seq("path", "volpath", "ptracer") do
      for depth <- Seq(-2, -7) do
        assert(warnings(kind, "max_depth", depth).exists(_.pos.isDefined), kind)
      for depth <- Seq(0, -1) do
        assert(warnings(kind, "rr_depth", depth).exists(_.pos.isDefined), kind)
      assert(warnings(kind, "max_depth", -1).isEmpty && warnings(kind, "rr_depth", 1).isEmpty)

  test("the shutter of a sensor neither brightens nor darkens, and may open for an instant"):
    for times <- Seq("0" -> "1", "0.5" -> "0.9", "0.5" -> "0.5") do
      val (open, close) = times
      val found = means(
        s"""$Path6${sensor()}<emitter type="constant"/>""".replace(
          "<film",
          s"""<float name="shutter_open" value="$open"/>
             <float name="shutter_close" value="$close"/><film"""
        )
      )
      isNear(found, 1, 1, 1)(1e-3)

  test("an environment map may have one row or two"):
    for (height, right) <- Seq(1 -> 0.25, 2 -> 0.5) do
      val rows = Array.fill(3)(0.25f) ++ Array.fill(3 * (height - 1))(0.75f)
      val map = Files.createTempFile("candela-map", ".exr")
      try
        ImageFiles.write(map, Image(1, height, Image.RgbNames, rows))
        val found = means(s"""$Path6${sensor()}<emitter type="envmap">
          <string name="filename" value="$map"/></emitter>""")
        // The rows are the poles, and the camera looks at the horizon
        isNear(found, right, right, right)(0.01)
      finally Files.delete(map)

  test("the axis of a rotation is not normalised"):
    inFile(
      s"""${sensor()}<shape type="sphere"><transform name="to_world">
        <rotate x="0" y="1" z="1" angle="-25"/></transform></shape>"""
    ): scene =>
      val m = scene.shapes.head.objectToWorld.start.m
      val right = Seq(.9063, .4226, -.4226, 0, -.4226, 1, .0937, 0, .4226, .0937, 1)
      // Four digits are written above
      assert(right.zip(m).forall((a, b) => Math.abs(a - b) < 1e-4), m.mkString(" "))

  test("a depth of 0 is black, emitters and sky included"):
    val scene = s"${sensor()}<emitter type=\"constant\"/>"
    val depth = "<integer name=\"max_depth\" value=\"0\"/>"
    for kind <- Seq("path", "volpath", "ptracer") do
      isNear(means(s"<integrator type=\"$kind\">$depth</integrator>$scene"), 0, 0, 0)(0)

  test("rgba is an alpha of surfaces: emitters that are hidden have none, a visible sky is opaque"):
    def alpha(body: String, hides: Boolean): Double =
      val integrator = "<integrator type=\"path\"><boolean name=\"hide_emitters\" " +
        s"value=\"$hides\"/></integrator>"
      val film = sensor("<string name=\"pixel_format\" value=\"rgba\"/>")
      inFile(s"$integrator$film$body"): scene =>
        val plan = SceneBuilder.build(scene, RenderSettings())._1
        val image = Renderer.render(plan, threads = 1).image(plan.development)
        val a = image.channelNames.indexOf("A")
        val values = image.data.indices.by(image.channels).map(i => image.data(i + a).toDouble)
        values.sum / values.size
    val ball = "<shape type=\"sphere\"><float name=\"radius\" value=\".6\"/></shape>"
    val emitter = "<shape type=\"rectangle\"><transform name=\"to_world\"><translate z=\"-1\"/>" +
      "</transform><emitter type=\"area\"/></shape>"
    val sky = "<emitter type=\"constant\"/>"
    // The share of the ball in the picture; noise of 64 samples in 192 pixels
    assert(Math.abs(alpha(ball, hides = false) - 0.1151) < 3e-3)
    assert(Math.abs(alpha(ball + emitter, hides = true) - 0.1151) < 3e-3)
    assert(Math.abs(alpha(ball + emitter + sky, hides = true) - 0.1151) < 3e-3)
    assert(alpha(ball + emitter, hides = false) > 0.2)
    assert(alpha(ball + sky, hides = false) == 1)

  test("an <rgb> that Mitsuba rejects is used with a word"):
    def rejected(body: String, version: String = "3.0.0") =
      inFile(sensor() + body, version): scene =>
        scene.warnings.map(_.message).filter(_.startsWith("Mitsuba rejects `"))
    def medium(value: String) =
      s"<medium type=\"homogeneous\" name=\"interior\">$value</medium>"
    def ball(bsdf: String, inside: String = "") =
      s"<shape type=\"sphere\"><bsdf $bsdf</bsdf>$inside</shape>"
    def rgb(name: String) = s"<rgb name=\"$name\" value=\".3, 4, .5\"/>"
    def word(name: String) =
      Vector(s"Mitsuba rejects `$name` as an <rgb> outside 0 to 1; it is used")
    for name <- Seq("sigma_t", "albedo") do
      assert(rejected(ball("type=\"null\">", medium(rgb(name)))) == word(name))
    val masked = s"type=\"mask\">${rgb("opacity")}<bsdf type=\"diffuse\"/>"
    assert(rejected(ball(masked)) == word("opacity"))
    val low = "type=\"diffuse\"><rgb name=\"reflectance\" value=\"-.1, .5, .5\"/>"
    inFile(sensor() + ball(low), "3.0.0"): scene =>
      assert(scene.warnings.map(_.message).filter(_.contains("reflectance")) == Vector(
        "Mitsuba rejects `reflectance` as an <rgb> outside 0 to 1; negative components are 0"
      ))
      val material = scene.shapes.head.material.declared(scene.namedMaterials.toMap).get
      assert(material.param("reflectance").get.floats.toSeq == Seq(0f, .5f, .5f))
    val volume = s"<volume type=\"constvolume\" name=\"sigma_t\">${rgb("value")}</volume>"
    val metal = s"type=\"conductor\">${rgb("eta")}${rgb("k")}"
    val taken = Seq(
      ball("type=\"null\">", medium("<spectrum name=\"sigma_t\" value=\"4\"/>")),
      ball("type=\"null\">", medium(volume)),
      ball(metal),
      ball(s"type=\"roughconductor\">${rgb("alpha")}"),
      ball(s"type=\"roughdielectric\">${rgb("alpha_u")}${rgb("alpha_v")}"),
      s"<emitter type=\"constant\">${rgb("radiance")}</emitter>"
    )
    for body <- taken do assert(rejected(body).isEmpty, body)
    // 0.6 took any
    val old = ball("type=\"diffuse\">", medium(rgb("sigmaT") + rgb("albedo")))
    assert(rejected(old, "0.6.0").isEmpty)

  test("of what Mitsuba takes one, others are told"):
    val ball = "<shape type=\"sphere\"><emitter type=\"area\"/><emitter type=\"area\"/></shape>"
    val twice = Path6 + Path6 + ball + "<emitter type=\"constant\"/>" * 2 +
      sensor("<rfilter type=\"box\"/>", "<sampler type=\"halton\"/>")
    inFile(twice): scene =>
      val messages = scene.warnings.map(_.message)
      for kind <- Vector("integrator", "emitter", "sampler", "rfilter") do
        assert(messages.count(_.endsWith(s"has one $kind; this one is ignored")) == 1, messages)
      assert(messages.count(_.contains("Mitsuba takes one light from everywhere")) == 1, messages)

  private def keptGoing(body: String): SceneDescription =
    val file = Files.createTempFile("candela", ".xml")
    try
      val text = s"<scene version=\"3.0.0\">${sensor()}$body</scene>"
      val _ = Files.writeString(file, text)
      val scene = MitsubaScene.readable(file, Map.empty, keepGoing = true)
      assert(scene.errors.isEmpty, scene.errors)
      scene
    finally Files.delete(file)

  private val missingFile = "<string name=\"filename\" value=\"no.png\"/>"
  private def missingMap(name: String) =
    s"<texture type=\"bitmap\" name=\"$name\">$missingFile</texture>"

  test("missing images are placeholders as those of pbrt's scenes"):
    val maps = missingMap("base_color") + missingMap("roughness")
    val scene =
      keptGoing(s"<shape type=\"sphere\"><bsdf type=\"principled\">$maps</bsdf></shape>")
    val told = scene.warnings.flatMap(_.standIn).toSet
    assert(told == Set("using magenta", "using the constant 1"), told)

  test("emitters and measured materials whose files are missing are magenta"):
    def emitter(kind: String, inner: String) = s"<emitter type=\"$kind\">$inner</emitter>"
    for
      body <- Seq(
        emitter("envmap", missingFile),
        emitter("spot", missingMap("texture")),
        emitter("projector", missingMap("irradiance")),
        s"<shape type=\"sphere\">${emitter("area", missingMap("radiance"))}</shape>",
        s"<shape type=\"sphere\"><bsdf type=\"measured\">$missingFile</bsdf></shape>"
      )
    do
      val scene = keptGoing(body)
      val lights = scene.lights.map(_.light) ++ scene.shapes.flatMap(_.areaLight)
      val declared = lights ++ scene.shapes.flatMap(_.material.declared(Map.empty))
      val colors = declared.flatMap(_.params).filter(p => Set("L", "I", "reflectance")(p.name))
        .map(_.floats.toSeq).filter(_.distinct.size > 1)
      assert(colors.exists(c => c(0) > 0f && c(0) == c(2) && c(1) == 0f), s"$body: $declared")
      assert(scene.warnings.flatMap(_.standIn) == Vector("using magenta"), scene.warnings)
