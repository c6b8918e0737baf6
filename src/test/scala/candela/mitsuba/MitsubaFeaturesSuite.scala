package candela.mitsuba

import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}

/** Values are Mitsuba 3.9.1's (`scalar_rgb`). */
class MitsubaFeaturesSuite extends MitsubaPictures:

  test("without sample_border, no sample is taken beyond the film"):
    def border(sampled: String) =
      val film = s"<rfilter type=\"gaussian\"/>$sampled"
      val beyond = "<shape type=\"rectangle\"><transform name=\"to_world\">" +
        "<translate x=\"2.85\"/></transform><emitter type=\"area\"/></shape>"
      mean(view(40, 64).replace("<rfilter type=\"box\"/>", film) + beyond).r
    assert(border("") == 0f)
    assert(border("<boolean name=\"sample_border\" value=\"false\"/>") == 0f)
    // The noise of 64 samples per pixel
    val sampled = border("<boolean name=\"sample_border\" value=\"true\"/>")
    assert(Math.abs(sampled - 0.0126f) < 1e-3f, sampled)

  test("without sample_border, pixels at a crop window's edge see the window only"):
    val crop = "<integer name=\"crop_offset_x\" value=\"2\"/><rfilter type=\"tent\"/>" +
      "<integer name=\"crop_width\" value=\"4\"/>"
    val beyond = "<shape type=\"rectangle\"><transform name=\"to_world\"><translate x=\"1.95\"/>" +
      "</transform><emitter type=\"area\"/></shape>"
    assert(mean(view(40, 16).replace("<rfilter type=\"box\"/>", crop) + beyond).r == 0f)

  private def withGrid[A](use: Path => A): A =
    val bytes = ByteBuffer.allocate(48 + 4).order(ByteOrder.LITTLE_ENDIAN)
    bytes.put("VOL".getBytes("US-ASCII")).put(3.toByte)
    Seq(1, 1, 1, 1, 1).foreach(bytes.putInt)
    Seq(0f, 0f, 0f, 1f, 1f, 1f, 1f).foreach(bytes.putFloat)
    val file = Files.createTempFile("candela", ".vol")
    try use(Files.write(file, bytes.array))
    finally Files.delete(file)

  test("a turned grid fills the box along the world's axes around it"):
    def seen(turn: Int, albedo: Double) = withGrid: grid =>
      mean(
        s"""<integrator type="volpath"/><sensor type="orthographic"><transform name="to_world">
        <scale value="2"/><lookat origin="0,9,0" target="0,0,0" up="0,0,1"/></transform>
        <sampler type="independent"><integer name="sample_count" value="256"/></sampler>
        <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/>
        <rfilter type="box"/></film></sensor><emitter type="constant"/><shape type="sphere">
        <float name="radius" value="1.9"/><bsdf type="null"/>
        <medium name="interior" type="heterogeneous"><volume name="sigma_t" type="gridvolume">
        <string name="filename" value="$grid"/><transform name="to_world"><translate value="-.5"/>
        <scale value="2"/><rotate y="1" angle="$turn"/></transform></volume>
        <float name="albedo" value="$albedo"/></medium></shape>"""
      ).r
    // The noise of 256 samples per pixel
    assert(Math.abs(seen(0, 0) - 0.7836f) < 3e-3f)
    assert(Math.abs(seen(90, 0) - 0.7836f) < 3e-3f)
    assert(Math.abs(seen(45, 0) - 0.5733f) < 3e-3f)
    assert(Math.abs(seen(30, 0.8) - 0.8507f) < 3e-3f)

  test("a directionalarea is seen by no path from the camera; its shape is black"):
    val lit = s"${view(40, 16)}<emitter type=\"constant\"/><shape type=\"rectangle\">" +
      "<emitter type=\"directionalarea\"/></shape>"
    using(lit): scene =>
      assert(scene.errors.isEmpty, scene.errors)
      assert(scene.warnings.exists(_.message.contains("\"directionalarea\" is ignored")))
    // The rectangle's share of the picture
    assert(Math.abs(mean(lit).r - 0.5974f) < 0.01f, mean(lit))

  test("an area emitter with an id gives light to the shape that refers to it"):
    val lit = s"${view(10, 4)}<emitter type=\"area\" id=\"lamp\"><rgb name=\"radiance\" " +
      "value=\"2\"/></emitter><shape type=\"rectangle\"><ref id=\"lamp\"/></shape>"
    using(lit)(scene => assert(scene.warnings.isEmpty && scene.lights.isEmpty, scene.warnings))
    assert(mean(lit).r == 2f)
    val lone = s"${view(10, 4)}<emitter type=\"area\"/><shape type=\"rectangle\"/>"
    using(lone)(scene => assert(scene.warnings.map(_.message).exists(_.contains("emits nothing"))))

  test("other emitters of a shape than area lights are where they would be without it"):
    def scene(inside: String, outside: String) = view(60, 16) + outside +
      "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"3\"/></transform>" +
      s"</shape><shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"0\" z=\"1\"/>" +
      s"<float name=\"radius\" value=\".5\"/>$inside</shape>"
    val black = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0\"/></bsdf>"
    val kinds = Seq(
      "<emitter type=\"point\"><point name=\"position\" value=\"0,0,3\"/></emitter>",
      "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0,0,4\" " +
        "target=\"0,0,0\" up=\"0,1,0\"/></transform></emitter>",
      "<emitter type=\"directional\"><vector name=\"direction\" value=\"0,0,-1\"/></emitter>"
    )
    for emitter <- kinds do
      val inside = mean(scene(emitter, ""))
      assert(inside.r > 0 && inside == mean(scene(black, emitter)), emitter)
