package candela.mitsuba

import candela.scenefile.{Declaration, MediumDescription, Param, SceneDescription}

import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}

/** Textures, media, volumes and phase functions of Mitsuba 0.6. */
final class EarlierMediaSuite extends MitsubaPictures:
  override protected def version: String = "0.6.0"

  private def float(name: String, x: Double) = s"<float name=\"$name\" value=\"$x\"/>"
  private def string(name: String, x: String) = s"<string name=\"$name\" value=\"$x\"/>"
  private def rgb(name: String, x: String) = s"<rgb name=\"$name\" value=\"$x\"/>"
  private val White = "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>"

  private def scene(body: String): SceneDescription = read(view(20, 1) + body)
  private def clean(body: String): SceneDescription =
    val s = scene(body)
    assert(s.errors.isEmpty && s.warnings.isEmpty, (s.errors ++ s.warnings).map(_.message))
    s
  private def warning(body: String): String =
    val s = scene(body)
    assert(s.errors.isEmpty && s.warnings.size == 1, (s.errors ++ s.warnings).map(_.message))
    assert(s.warnings.head.pos.exists(_.line >= 1))
    s.warnings.head.message

  private def diffuse(texture: String) =
    s"<shape type=\"rectangle\"><bsdf type=\"diffuse\">$texture</bsdf></shape>"

  /** Of a surface under a white sky. */
  private def albedo(texture: String) =
    val c = mean(view(1, 64) + diffuse(texture) + White)
    Vector(c.r, c.g, c.b)

  private def near(found: Seq[Float], expected: Seq[Double], tolerance: Double): Unit =
    assert(
      found.lazyZip(expected).forall((a, b) => Math.abs(a - b) < tolerance),
      s"$found instead of $expected"
    ): Unit

  private def board(color: String) =
    s"<texture type=\"checkerboard\"$color>" + rgb("color0", ".2 .4 .6") + rgb("color1", ".9") +
      float("uvscale", 0.01) + "</texture>"

  test("a scale multiplies a texture, or a value, by a number or a colour"):
    def scaled(content: String) = s"<texture type=\"scale\" name=\"reflectance\">$content</texture>"
    near(albedo(scaled(float("scale", 0.5) + board(""))), Seq(0.1, 0.2, 0.3), 1e-4)
    near(albedo(scaled(rgb("scale", "1 .5 .1") + board(""))), Seq(0.2, 0.2, 0.06), 1e-4)
    near(albedo(scaled(float("scale", 0.5) + rgb("value", ".4 .6 .8"))), Seq(0.2, 0.3, 0.4), 1e-4)
    val twice = scaled(float("scale", 0.5) + "<texture type=\"scale\">" + float("scale", 0.5) +
      board("") + "</texture>")
    near(albedo(twice), Seq(0.05, 0.1, 0.15), 1e-4)
    assert(scene(diffuse(scaled(float("scale", 0.5)))).errors.map(_.message).mkString
      .contains("must contain a texture"))

  test("the lines of a gridtexture are twice as wide as they say"):
    val grid = "<texture type=\"gridtexture\" name=\"reflectance\">" + float("lineWidth", 0.1) +
      rgb("color0", ".2") + rgb("color1", ".9") + float("uscale", 300) + float("vscale", 300) +
      "</texture>"
    // (1 − 2 · 0.1)² between the lines; 3,072 samples of two colours
    near(albedo(grid), Seq.fill(3)(0.2 * 0.64 + 0.9 * 0.36), 4 * 0.35 * 0.96 / Math.sqrt(3072))

  private val chart = Path.of("scenes/textures/chart.png").toAbsolutePath
  private def bitmap(more: String): Declaration =
    clean(diffuse(picture(more))).textures.head.texture
  private def picture(more: String) =
    "<texture type=\"bitmap\" name=\"reflectance\">" +
      string("filename", chart.toString) + more + "</texture>"
  private def word(d: Declaration, name: String) = d.param(name).map(_.strings.head)

  test("bitmaps have 0.6's gamma and wrap modes"):
    assert(word(bitmap(float("gamma", 1)), "encoding").contains("linear"))
    assert(word(bitmap(float("gamma", -1)), "encoding").contains("sRGB"))
    assert(word(bitmap(float("gamma", 2.2)), "encoding").contains("gamma 2.2"))
    assert(word(bitmap(string("wrapMode", "zero")), "wrap").contains("black"))
    assert(word(bitmap(string("wrapModeU", "clamp") + string("wrapModeV", "clamp")), "wrap")
      .contains("clamp"))
    assert(warning(diffuse(picture(string("filterType", "ewa")))).contains("using `bilinear`"))
    assert(warning(diffuse(picture(string("wrapModeU", "clamp")))).contains("using `clamp`"))
    assert(warning(diffuse(picture(string("channel", "a")))).contains("`channel` of texture"))

  test("wireframes and curvatures become constants, with a warning"):
    val wires = "<texture type=\"wireframe\" name=\"reflectance\">" + rgb("interiorColor", ".3") +
      rgb("edgeColor", "1") + float("lineWidth", 0.1) + "</texture>"
    near(albedo(wires), Seq.fill(3)(0.3), 1e-4)
    assert(warning(diffuse(wires)).contains("using the colour of its interior"))
    val curved =
      "<texture type=\"curvature\" name=\"reflectance\">" + float("scale", 1) + "</texture>"
    assert(warning(diffuse(curved)).contains("texture \"curvature\" is not supported; using 0.5"))

  test("vertexcolors are those of a mesh, decoded from sRGB unless it says no"):
    val file = Files.createTempFile("candela", ".ply")
    try
      val colors = Seq(51, 102, 204)
      val vertices =
        for (x, y) <- Seq((-1, -1), (1, -1), (1, 1), (-1, 1))
        yield s"$x $y 0 ${colors.mkString(" ")}"
      val _ = Files.writeString(
        file,
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" +
          "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n" +
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
          vertices.mkString("\n") + "\n4 0 1 2 3\n"
      )
      def seen(more: String) =
        val c =
          mean(view(1, 64) + s"<shape type=\"ply\">${string("filename", file.toString)}$more" +
            "<bsdf type=\"diffuse\"><texture type=\"vertexcolors\" name=\"reflectance\"/></bsdf>" +
            s"</shape>$White")
        Vector(c.r, c.g, c.b)
      def decoded(x: Double) = Math.pow((x + 0.055) / 1.055, 2.4)
      near(seen(""), colors.map(c => decoded(c / 255.0)), 1e-4)
      near(seen("<boolean name=\"srgb\" value=\"false\"/>"), colors.map(_ / 255.0), 1e-4)
    finally Files.delete(file)

  private def medium(content: String, kind: String = "homogeneous") =
    "<shape type=\"cube\"><bsdf type=\"null\"/><medium name=\"interior\" " +
      s"type=\"$kind\">$content</medium></shape>"
  private def numbers(m: MediumDescription, name: String) =
    m.medium.param(name).fold(Vector.empty)(_.floats.toVector)
  private def coefficients(m: MediumDescription): Seq[Float] =
    val Vector(scale) = numbers(m, "scale"): @unchecked
    (numbers(m, "sigma_s") ++ numbers(m, "sigma_a")).map(_ * scale)
  private def homogeneous(content: String) = coefficients(clean(medium(content)).media.head)

  test("a homogeneous medium is described by name, or by two of its coefficients"):
    val skin = Seq(74.0, 88.0, 101.0, 3.2, 17.0, 48.0)
    near(homogeneous(""), skin, 1e-3)
    near(homogeneous(string("material", "Skin1") + float("scale", 0.1)), skin.map(_ / 10), 1e-4)
    // Scattering is reduced
    near(homogeneous(string("material", "regular milk")), Seq(455.13, 582.94, 713.6), 0.01)
    near(
      homogeneous(rgb("sigmaS", "1 2 3") + float("sigmaA", 4) + float("densityMultiplier", 2)),
      Seq(2.0, 4.0, 6.0, 8.0, 8.0, 8.0),
      1e-4
    )
    near(
      homogeneous(float("sigmaT", 5) + float("albedo", 0.8) + float("g", 0.5)),
      Seq(2.0, 2.0, 2.0, 1.0, 1.0, 1.0),
      1e-4
    )
    val unknown = scene(medium(string("material", "skim1"))).errors
    assert(unknown.map(_.message) == Vector("unknown medium `skim1`"))
    assert(unknown.head.help.exists(_.contains("skin1")))

  private val density =
    "<volume name=\"density\" type=\"constvolume\">" + float("value", 3) + "</volume>"
  private val grey =
    "<volume name=\"albedo\" type=\"constvolume\">" + float("value", 0.5) + "</volume>"

  test("a heterogeneous medium has a density and an albedo"):
    val constant = clean(medium(
      density + grey + float("scale", 2) + string("method", "simpson"),
      "heterogeneous"
    )).media.head
    assert(constant.medium.name == "homogeneous")
    near(coefficients(constant), Seq.fill(6)(3.0), 1e-4)
    val orientation = "<volume name=\"orientation\" type=\"constvolume\">" +
      "<vector name=\"value\" x=\"0\" y=\"1\" z=\"0\"/></volume>"
    assert(warning(medium(density + grey + orientation, "heterogeneous")).contains("orientations"))

  test("the values of a gridvolume reach from border to border of its box"):
    val bytes = ByteBuffer.allocate(48 + 4 * 6).order(ByteOrder.LITTLE_ENDIAN)
    bytes.put("VOL".getBytes("US-ASCII")).put(3.toByte).putInt(1)
    Seq(3, 2, 1, 1).foreach(bytes.putInt)
    Seq(-1f, 0f, 0f, 1f, 1f, 1f).foreach(bytes.putFloat)
    (1 to 6).foreach(i => bytes.putFloat(i.toFloat))
    val file = Files.createTempFile("candela", ".vol")
    try
      val _ = Files.write(file, bytes.array)
      def grid(more: String) = "<volume name=\"density\" type=\"gridvolume\">" +
        string("filename", file.toString) + more + "</volume>"
      def box(content: String) =
        val m = clean(medium(content + grey, "heterogeneous")).media.head
        (numbers(m, "p0") ++ numbers(m, "p1"))
      near(box(grid("")), Seq(-1.5, -0.5, 0.0, 1.5, 1.5, 1.0), 1e-5)
      val stated =
        "<point name=\"min\" x=\"0\" y=\"0\" z=\"0\"/><point name=\"max\" x=\"4\" y=\"1\" z=\"1\"/>"
      near(box(grid(stated)), Seq(-1.0, -0.5, 0.0, 5.0, 1.5, 1.0), 1e-5)
      val cached =
        "<volume name=\"density\" type=\"volcache\"><integer name=\"blockSize\" value=\"8\"/>" +
          grid("") + "</volume>"
      near(box(cached), Seq(-1.5, -0.5, 0.0, 1.5, 1.5, 1.0), 1e-5)
    finally Files.delete(file)
    val parts =
      "<volume name=\"density\" type=\"hgridvolume\">" + string("filename", "x.dict") + "</volume>"
    assert(warning(medium(
      parts + grey,
      "heterogeneous"
    )).contains("volume \"hgridvolume\" is not supported"))

  private def phase(content: String) =
    medium(float("sigmaS", 2) + float("sigmaA", 1) + content)

  test("a mixturephase is a sum, and absorbs what its weights leave"):
    val hg = "<phase type=\"hg\">" + float("g", 0.5) + "</phase>"
    def mixture(weights: String) = phase("<phase type=\"mixturephase\">" +
      string("weights", weights) + hg + "<phase type=\"rayleigh\"/></phase>")
    val m = clean(mixture("0.3, 0.2")).media.head
    assert(m.medium.param("phases").get.strings == Vector("hg", "rayleigh"))
    near(numbers(m, "phaseweights"), Seq(0.6, 0.4), 1e-5)
    near(coefficients(m), Seq(1.0, 1.0, 1.0, 2.0, 2.0, 2.0), 1e-5)
    assert(warning(mixture("2 1")).contains("sum to more than 1"))
    assert(scene(mixture("1")).errors.map(_.message).mkString.contains("2 numbers"))

  test("phase functions of fibres become isotropic, with a warning"):
    val kajiya = phase("<phase type=\"kkay\">" + float("kd", 0.25) + float("ks", 0.5) + "</phase>")
    assert(warning(kajiya).contains("phase \"kkay\" is not supported; using \"isotropic\""))
    near(coefficients(scene(kajiya).media.head), Seq(0.5, 0.5, 0.5, 2.5, 2.5, 2.5), 1e-5)
    val flakes = phase("<phase type=\"microflake\">" + float("stddev", 0.2) + "</phase>")
    assert(warning(flakes).contains("phase \"microflake\" is not supported"))

  private def beneath(content: String, bsdf: String = "", kind: String = "dipole") =
    s"<shape type=\"sphere\"><subsurface type=\"$kind\">$content</subsurface>$bsdf</shape>"
  private def material(body: String): Declaration =
    val s = scene(body)
    s.shapes.head.material.declared(s.namedMaterials.toMap).get
  private def floats(p: Option[Param]) = p.fold(Vector.empty)(_.floats.toVector)

  test("what scatters beneath a surface is pbrt's, with a warning"):
    val content = rgb("sigmaS", "87.2, 127.2, 143.2") + rgb("sigmaA", "1.04, 5.6, 11.6") +
      string("intIOR", "water") + "<integer name=\"irrSamples\" value=\"64\"/>"
    val plastic = "<bsdf type=\"roughplastic\">" + float("alpha", 0.2) +
      "<spectrum name=\"diffuseReflectance\" value=\"0\"/></bsdf>"
    for kind <- Seq("dipole", "singlescatter") do
      assert(warning(beneath(
        content,
        plastic,
        kind
      )).startsWith(s"subsurface \"$kind\" is rendered"))
    val found = material(beneath(content, plastic))
    assert(found.name == "subsurface" && floats(found.param("uroughness")) == Vector(0.2f))
    near(floats(found.param("sigma_s")), Seq(87.2, 127.2, 143.2), 1e-4)
    near(floats(found.param("eta")), Seq(1.333 / 1.000277), 1e-5)
    near(floats(material(beneath(string("material", "Marble"))).param("eta")), Seq(1.5), 1e-5)
    val diffuse = scene(beneath(content, "<bsdf type=\"plastic\"/>")).warnings.map(_.message)
    assert(diffuse.exists(_.contains("diffuse reflection is not supported beside")))

  test("skin of a ball under a white sky reflects more red than blue light"):
    val ball = beneath(string("material", "skin1") + float("scale", 1))
    val found = mean(view(8, 64) + ball + White)
    assert(found.r > 1.3f * found.b && found.r < 1f && found.b > 0.1f, found)

  test("messages and their help have the names of the file"):
    def problem(kind: String, name: String) =
      val s =
        scene(s"<shape type=\"rectangle\"><bsdf type=\"$kind\">${float(name, 1)}</bsdf></shape>")
      s.warnings.head
    val other = problem("diffuse", "maxSmoothAngle")
    assert(other.message.contains("`maxSmoothAngle`"))
    assert(problem("phong", "specularReflectence").help.exists(_.contains("`specularReflectance`")))
    assert(problem("dielectric", "intIOS").help.exists(_.contains("`intIOR`")))
