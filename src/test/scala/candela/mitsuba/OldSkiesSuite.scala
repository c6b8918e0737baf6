package candela.mitsuba

import candela.color.Rgb

/** Lights of Mitsuba 0.6. */
class OldSkiesSuite extends OldScenes:

  private val up = sensor(more = "<float name=\"fov\" value=\"100\"/>")
    .replace("target=\"0,0,0\"", "target=\"0,9,5\"").replace("up=\"0,1,0\"", "up=\"0,0,1\"")

  test("a sky is that of Mitsuba 3, with its zenith at +y and the same azimuths"):
    val place = "<float name=\"hour\" value=\"9\"/><float name=\"turbidity\" value=\"5\"/>" +
      "<rgb name=\"albedo\" value=\".2\"/>"
    def view(target: String, up: String) =
      sensor(more = "<float name=\"fov\" value=\"60\"/>")
        .replace("target=\"0,0,0\"", s"target=\"$target\"").replace("up=\"0,1,0\"", s"up=\"$up\"")
    def old(target: String) = mean(view(target, "0,1,0") + "<emitter type=\"sky\"><float " +
      s"name=\"scale\" value=\"2\"/>$place</emitter>")
    def new3(target: String) = mean(
      view(target, "0,0,1").replace("toWorld", "to_world").replace("sampleCount", "sample_count")
        .replace("lookAt", "lookat") + "<emitter type=\"sunsky\"><float " +
        s"name=\"sun_scale\" value=\"0\"/><float name=\"sky_scale\" value=\"2\"/>$place</emitter>",
      "3.0.0"
    )
    // North and east
    isNear(old("0,1,4"), new3("-1,0,6"), 0.01f)
    isNear(old("1,1,5"), new3("0,-1,6"), 0.01f)

  test("the sun is that of Preetham, Shirley and Smits, of equal power at any size"):
    val floor = "<shape type=\"rectangle\"><transform name=\"toWorld\"><rotate x=\"1\" " +
      "angle=\"-90\"/></transform><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1\"/>" +
      "</bsdf></shape>"
    val down = sensor(more = "<float name=\"fov\" value=\"5\"/>")
      .replace("origin=\"0,0,5\"", "origin=\"0,5,0\"").replace("up=\"0,1,0\"", "up=\"0,0,1\"")
    def lit(degrees: Int, turbidity: Int, kind: String, more: String = "") =
      val angle = Math.toRadians(degrees)
      mean(s"""$down$floor<emitter type="$kind"><float name="turbidity" value="$turbidity"/>
        <vector name="sunDirection" x="${Math.sin(angle)}" y="${Math.cos(angle)}" z="0"/>$more
        </emitter>""") * (Math.PI / Math.cos(angle)).toFloat
    // Computed apart, from the paper's tables, in steps of 1 nm
    isNear(lit(0, 3, "sun"), Rgb(1.4607f, 1.2411f, 1.0752f), 0.01f)
    isNear(lit(60, 3, "sun"), Rgb(1.1311f, 0.8878f, 0.65f), 0.01f)
    isNear(lit(80, 6, "sun"), Rgb(0.1111f, 0.0467f, 0.0097f), 0.03f)
    for radius <- Seq("0", "8") do
      isNear(
        lit(60, 3, "sun", s"<float name=\"sunRadiusScale\" value=\"$radius\"/>"),
        lit(60, 3, "sun"),
        0.01f
      )
    val both = lit(
      60,
      3,
      "sunsky",
      "<float name=\"scale\" value=\"2\"/>" +
        "<float name=\"skyScale\" value=\"1\"/>"
    )
    val sum = lit(60, 3, "sun") * 2f + lit(60, 3, "sky")
    isNear(both, sum, 0.02f)

  test("parameters of skies are told from idle ones"):
    assert(warnings(up + "<emitter type=\"sunsky\"><integer name=\"resolution\" value=\"64\"/>" +
      "<float name=\"stretch\" value=\"1.5\"/><vector name=\"sunDirection\" x=\"0\" y=\"1\" " +
      "z=\"0\"/><float name=\"hour\" value=\"9\"/></emitter>") == Vector(
      "`hour` is ignored: the direction of the sun is given",
      "`stretch` of emitter \"sunsky\" is not supported; the sky ends at the horizon"
    ))
    assert(warnings(up + "<emitter type=\"collimated\"><spectrum name=\"power\" value=\"2\"/>" +
      "</emitter>") == Vector("emitter \"collimated\" is not supported; ignored"))

  test("a single value of a light's spectrum is white"):
    val light = "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"2\"/></emitter>"
    isNear(mean(sensor(more = fov) + light, "0.5.0"), Rgb.gray(2f), 1e-3f)

  test("a spectrum of three values is a colour"):
    val light =
      "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"1, 2 .5\"/></emitter>"
    isNear(mean(sensor(more = fov) + light, "0.6.0"), Rgb(1f, 2f, 0.5f), 1e-3f)
