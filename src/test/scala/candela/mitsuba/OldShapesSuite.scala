package candela.mitsuba

import candela.color.Rgb

import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN

/** Shapes of Mitsuba 0.6, and what moves. */
class OldShapesSuite extends OldScenes:

  private val lamp =
    "<emitter type=\"directional\"><vector name=\"direction\" x=\"-.5\" y=\"-.3\" " +
      "z=\"-1\"/></emitter>"

  private val fibres = Seq(
    Seq((-0.8, -1.0, 0.0), (-0.4, 0.0, 0.3), (-0.8, 1.0, 0.0)),
    Seq((0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    Seq((0.8, -1.0, 0.0), (0.3, 0.0, -0.3), (0.9, 1.0, 0.2))
  )

  private val textOfHair =
    fibres.map(_.map((x, y, z) => s"$x $y $z\n").mkString).mkString("\n").getBytes

  test("hair is round, of text or binary files"):
    val binary = ByteBuffer.allocate(11 + 4 + 4 * (9 * 3 + 2)).order(LITTLE_ENDIAN)
    binary.put("BINARY_HAIR".getBytes).putInt(9)
    for (fibre, i) <- fibres.zipWithIndex do
      if i > 0 then binary.putFloat(Float.PositiveInfinity): Unit
      for (x, y, z) <- fibre do Seq(x, y, z).foreach(c => binary.putFloat(c.toFloat))
    val body = sensor(more = fov) + lamp + "<shape type=\"hair\"><string name=\"filename\" " +
      "value=\"h.hair\"/><float name=\"radius\" value=\".1\"/></shape>"
    val ofText = mean(body, "0.6.0", "h.hair" -> textOfHair)
    // Mitsuba 3.9.1's cylinders; the noise of 64 samples per pixel
    isNear(ofText, Rgb.gray(0.010174f), 0.04f)
    isNear(mean(body, "0.6.0", "h.hair" -> binary.array), ofText, 1e-6f)
    def vertices(more: String) =
      using(body.replace("</shape>", more + "</shape>"), "0.6.0", "h.hair" -> textOfHair): scene =>
        assert(scene.errors.isEmpty && scene.warnings.isEmpty)
        scene.shapes.map(_.shape.param("P").get.floats.length / 3)
    // A vertex between two others on a line is left out; each segment has two rings
    assert(vertices("") == Vector(10 * 17))
    assert(vertices("<float name=\"reduction\" value=\".5\"/>") == Vector(8 * 17))

  test("a height field is the mesh of its image, whose first row is at y = -1"):
    val z = Array(0f, 0.4f, 0.1f, 0.3f, 0.7f, 0f)
    val image = candela.image.Image.rgb(3, 2)
    for i <- z.indices; c <- 0 until 3 do image.data(3 * i + c) = z(i)
    val exr = candela.image.ImageFiles.exr(image)
    val corners = z.indices.map(i => s"v ${i % 3 - 1} ${2 * (i / 3) - 1} ${z(i) / 2}\n").mkString
    val obj = s"${corners}f 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n"
    val files = Seq("z.exr" -> exr, "z.obj" -> obj.getBytes)
    def seen(shape: String) = pixels(sensor(more = fov) + lamp + shape, "0.6.0", files*)
    val flat = "<boolean name=\"shadingNormals\" value=\"false\"/>"
    val scale = "<float name=\"scale\" value=\".5\"/>"
    def field(more: String) = seen(s"<shape type=\"heightfield\">$scale$more</shape>")
    val file = "<string name=\"filename\" value=\"z.exr\"/>"
    val mesh = seen("<shape type=\"obj\"><string name=\"filename\" value=\"z.obj\"/>" +
      "<boolean name=\"faceNormals\" value=\"true\"/></shape>")
    assert(mesh.map(_.r).max > 0.1f)
    for (a, b) <- field(file + flat).zip(mesh) do assert(Math.abs(a.r - b.r) < 0.01f)
    val texture = s"<texture type=\"bitmap\">$file</texture>"
    val half = s"<texture type=\"scale\"><float name=\"scale\" value=\".5\"/>$texture</texture>"
    assert(field(texture + flat) == field(file + flat))
    assert(seen(s"<shape type=\"heightfield\">$half$flat</shape>") == field(file + flat))
    val smooth = field(file).map(_.r).sum
    assert(Math.abs(smooth / mesh.map(_.r).sum - 1) < 0.1f && field(file) != field(file + flat))
    using(
      sensor(more = fov) + "<shape type=\"heightfield\"><texture type=\"checkerboard\"/></shape>",
      "0.6.0"
    ): scene =>
      assert(scene.warnings.map(_.message) ==
        Vector("heights from a texture \"checkerboard\" are not supported; the field is flat"))

  test("a deformable shape stands still"):
    assert(warnings(sensor(more = fov) + "<shape type=\"deformable\"><string name=\"times\" " +
      "value=\"0 1\"/><shape type=\"rectangle\"/><shape type=\"rectangle\"/></shape>") ==
      Vector("shape \"deformable\" is not supported; it does not move"))

  private def animated(keys: String*) = keys.map(k =>
    val (time, x) = k.span(_ != ' ')
    s"<transform time=\"$time\"><translate x=\"${x.trim}\"/>" +
      "</transform>"
  ).mkString("<animation name=\"toWorld\">", "", "</animation>")

  private def shutter(open: String, close: String) = sensor(more =
    fov +
      s"<float name=\"shutterOpen\" value=\"$open\"/><float name=\"shutterClose\" " +
      s"value=\"$close\"/>"
  )

  test("shapes, instances and sensors move between the times of their animation"):
    def ends(body: String) = using(body, "0.6.0"): scene =>
      assert(scene.errors.isEmpty && scene.warnings.isEmpty, scene.warnings)
      assert(scene.transformTimes == (0.25f, 0.5f))
      val t = scene.shapes.headOption.map(_.objectToWorld)
        .getOrElse(scene.instances.head.instanceToWorld)
      (t.start.m(3).toFloat, t.end.m(3).toFloat)
    val motion = animated("1 8", "0 0")
    val mesh = s"<shape type=\"cube\">$motion</shape>"
    assert(ends(shutter(".25", ".5") + mesh) == (2f, 4f))
    assert(ends(shutter(".25", ".5") + s"<shape type=\"instance\">$motion<shape " +
      "type=\"shapegroup\"><shape type=\"sphere\"/></shape></shape>") == (2f, 4f))
    using(shutter("0", "0") + mesh, "0.6.0"): scene =>
      assert(!scene.shapes.head.objectToWorld.isAnimated && scene.warnings.isEmpty)
    assert(warnings(shutter("0", "1") + s"<shape type=\"cube\">${animated("0 0", ".5 1", "1 3")}" +
      "</shape>").size == 1)
    val moved = shutter("0", "1").replaceFirst("<transform.*?</transform>", motion)
    using(moved.replaceAll("(?s)<transform name.*?</transform>", motion), "0.6.0"): scene =>
      assert(scene.worldToCamera.isAnimated && scene.errors.isEmpty)
    assert(warnings(shutter("0", "1") + s"<emitter type=\"point\">$motion</emitter>") ==
      Vector("emitter \"point\" can't move; using its place as the shutter opens"))

  test("a moving shape is seen at all times of the shutter"):
    val body = shutter("0", "1") + "<shape type=\"rectangle\">" + animated("0 -1", "1 1") +
      "<bsdf type=\"diffuse\"/></shape><emitter type=\"constant\"/>"
    val row = pixels(body, "0.6.0").slice(24, 32).map(_.r)
    assert(row(0) > 0.85f && row(3) < 0.6f && row(1) > 0.55f && row(1) < 0.95f, row)

  test("normals are smooth across edges of at most `maxSmoothAngle`"):
    // Two squares at an angle of 60 degrees
    val obj = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv -.5 1 -.866025\nv -.5 0 -.866025\n" +
      "f 1 4 3\nf 1 3 2\nf 1 2 5\nf 1 5 6\n"
    def normals(degrees: String) =
      using(
        sensor(more = fov) + "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>" +
          s"<float name=\"maxSmoothAngle\" value=\"$degrees\"/><boolean name=\"collapse\" " +
          "value=\"true\"/></shape>",
        "0.6.0",
        "a.obj" -> obj.getBytes
      ): scene =>
        assert(scene.warnings.isEmpty && scene.errors.isEmpty)
        scene.shapes.head.shape.param("N").get.floats.grouped(3).map(_.toVector).toVector
    val sharp = normals("59")
    assert(sharp.take(6).forall(n => Math.abs(n(2) - 1) < 1e-6))
    assert(sharp.drop(6).forall(n => Math.abs(n(2) - 0.5) < 1e-6))
    // Between both, at the edge
    assert(Math.abs(normals("61").head(2) - Math.cos(Math.PI / 6)) < 1e-6)
    assert(Math.abs(normals("61")(1)(2) - 1) < 1e-6)
