package candela.mitsuba

import candela.diagnostics.SceneError
import candela.io.InputFile
import candela.scenefile.{MaterialRef, Parser, SceneDescription, ShapeDescription}

import java.io.{ByteArrayOutputStream, PrintStream}
import java.nio.charset.Charset
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_16, UTF_8}
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class MitsubaSceneSuite extends AnyFunSuite:

  private def read(body: String, defines: (String, String)*): SceneDescription =
    inFolder(body)(MitsubaScene.readable(_, defines.toMap, keepGoing = false))

  private def inFolder[A](body: String, others: (String, String)*)(use: Path => A): A =
    val folder = Files.createTempDirectory("candela-mitsuba")
    val files = (("scene.xml" -> s"""<scene version="3.0.0">$body</scene>""") +: others)
      .map((name, text) => Files.writeString(folder.resolve(name), text))
    try use(files.head)
    finally
      files.foreach(Files.delete)
      Files.delete(folder)

  private val Sensor = "<sensor type=\"perspective\"/>"

  /** Place and message of all problems. */
  private def problems(body: String): Vector[String] =
    val scene = read(Sensor + body)
    (scene.errors ++ scene.warnings).map: p =>
      val place = p.pos.fold("")(at => s"${at.line}:${at.column}: ")
      s"$place${p.message}${p.help.fold("")(h => s" ($h)")}"

  private def fatal(body: String, defines: (String, String)*): String =
    val p = intercept[SceneError](read(body, defines*)).problems.head
    s"${p.message}${p.help.fold("")(h => s" ($h)")}"

  test("misspelled types and parameters are reported at their element, with the nearest name"):
    assert(
      problems("\n  <bsdf type=\"difuse\"/>") ==
        Vector("2:3: unknown bsdf \"difuse\" (did you mean `diffuse`?)")
    )
    assert(
      problems("\n<bsdf type=\"diffuse\">\n  <rgb name=\"reflectanse\" value=\"1\"/></bsdf>") ==
        Vector("3:3: `reflectanse` is not a parameter of bsdf \"diffuse\"; it is ignored " +
          "(did you mean `reflectance`?)")
    )
    assert(
      problems("\n<shap type=\"sphere\"/>") ==
        Vector("2:1: unknown element <shap> (did you mean `shape`?)")
    )
    assert(
      problems("<shape type=\"sphere\">\n<string name=\"radius\" value=\"a\"/></shape>") ==
        Vector("2:1: `radius` of shape \"sphere\" must be a number, found a string")
    )
    assert(
      problems("<shape type=\"sphere\">\n<ref id=\"a\"/></shape>").head ==
        "2:1: no object has the id `a`"
    )
    assert(problems("\n<bsdf type=\"diffuse\" id=\"a\"/>\n<ref id=\"a\"/><ref id=\"b\"/>") ==
      Vector("3:14: no object has the id `b` (did you mean `a`?)"))

  test("types that Mitsuba has and Candela lacks are warnings that name the substitute"):
    assert(
      problems("\n<shape type=\"sdfgrid\"/>") ==
        Vector("2:1: shape \"sdfgrid\" is not supported; skipped")
    )

  test("defaults of defaults that grow without bound are refused"):
    val nested = for i <- 1 to 12 yield s"""<default name="a$i" value="${s"$$a${i - 1} " * 10}"/>"""
    assert(fatal(s"""<default name="a0" value="1"/>${nested.mkString}""") ==
      "values of parameters add up to more than 20000000 characters")

  test("a spectrum is not read from a device"):
    val spectrum = """<spectrum name="radiance" filename="/dev/zero"/>"""
    val body = s"""<emitter type="constant">$spectrum</emitter>"""
    assert(problems(body).exists(_.contains("can't read the spectrum `/dev/zero`")))

  test("-D replaces a default, and must be a parameter of the scene"):
    val body = "<default name=\"w\" value=\"30\"/><sensor type=\"perspective\">" +
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"$w\"/></film></sensor>"
    def width(scene: SceneDescription) = scene.film.get.param("xresolution").get.ints.toVector
    assert(width(read(body)) == Vector(30))
    assert(width(read(body, "w" -> "7")) == Vector(7))
    assert(fatal(body, "v" -> "7") == "the scene has no parameter `$v` (did you mean `w`?)")

  test("what needs an undefined value is left out, and the rest is checked"):
    val told = problems(
      "<shape type=\"$kind\"/><bsdf type=\"no-such\" id=\"$name\"/>" +
        "<shape type=\"sphere\"><float name=\"radius\" value=\"$r$s\"/></shape>" +
        "<shape type=\"spher\"/>"
    )
    val undefined = Seq("kind", "name", "r", "s").map(n => s"undefined parameter `$$$n`")
    assert(undefined.forall(u => told.exists(_.contains(u))), told)
    assert(told.exists(_.contains("spher")) && !told.exists(_.contains("no-such")), told)

  test("includes see the parameters, and are refused in circles"):
    val other = """<scene version="3.0.0"><shape type="$kind"/></scene>"""
    val body = Sensor + """<default name="kind" value="sphere"/><include filename="b.xml"/>"""
    inFolder(body, "b.xml" -> other): file =>
      val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
      assert(scene.shapes.map(_.shape.name) == Vector("sphere"))
      assert(scene.sources.map(_.getFileName.toString) == Vector("scene.xml", "b.xml"))
    assert(fatal("<include filename=\"scene.xml\"/>") == "`scene.xml` includes itself")

  test("circles of references and deep nesting are errors"):
    val circle = "<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>" +
      "<bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>"
    assert(problems(circle).exists(_.contains("more than 50 BSDFs refer to each other")))
    val deep = "<shape type=\"merge\">" * 200 + "</shape>" * 200
    assert(fatal(deep) == "more than 100 elements within each other")

  test("document types are not expanded, and malformed XML is reported with its place"):
    inFolder("", "bomb.xml" -> "<!DOCTYPE s [<!ENTITY a 'x'>]><scene version='3.0.0'>&a;</scene>"):
      file =>
        val bomb = file.resolveSibling("bomb.xml")
        val error = intercept[SceneError](MitsubaScene.readable(bomb, Map.empty, false))
        assert(error.problems.head.message.contains("entity"), error.problems.head)
    assert(fatal("<shape>").startsWith("malformed XML"))
    assert(fatal("<a x=\"1\" x=\"2\"/>") == "malformed XML: <a> has the attribute `x` twice")

  test("XML has the encoding that it declares; text of another is reported, and nothing printed"):
    val folder = Files.createTempDirectory("candela-xml")
    def name(declared: String, bytes: Charset, mark: String = ""): String =
      val xml = s"$mark<?xml version='1.0'$declared?>\n<scene version='é'/>"
      val file = InputFile.named(Files.write(folder.resolve("a.xml"), xml.getBytes(bytes)))
      XmlFile.read(file, None)("version").get
    assert(name("", UTF_8) == "é")
    assert(name(" encoding='utf-8'", UTF_8, mark = "\uFEFF") == "é")
    assert(name(" encoding=\"ISO-8859-1\"", ISO_8859_1) == "é")
    assert(name(" encoding='UTF-16'", UTF_16) == "é")
    val printed = ByteArrayOutputStream()
    val before = System.err
    System.setErr(PrintStream(printed))
    val error =
      try intercept[SceneError](name("", ISO_8859_1)).problems.head
      finally System.setErr(before)
    assert(error.message.contains("the text is not of its encoding"), error)
    assert(!printed.toString.contains("Error"), printed.toString)
    val unknown = intercept[SceneError](name(" encoding='klingon'", UTF_8)).problems.head
    assert(unknown.message == "malformed XML: unknown encoding klingon")

  test("files of a version before 2 may use the old names"):
    val old = """<scene version="0.6.0"><sensor type="perspective">
      <transform name="toWorld"><lookAt origin="0,0,1" target="0,0,0" up="0,1,0"/></transform>
      <string name="fovAxis" value="smaller"/><float name="fov" value="50"/></sensor></scene>"""
    inFolder("", "old.xml" -> old): file =>
      val scene = Parser.validated(
        MitsubaScene.readable(file.resolveSibling("old.xml"), Map.empty, keepGoing = false)
      )
      assert(scene.warnings.isEmpty)
      assert(Math.abs(scene.camera.get.param("fov").get.floats.head - 50f) < 1e-4f)
    assert(OldNames.snake("intIOR") == "int_ior")
    assert(OldNames.snake("alphaU") == "alpha_u")

  test("one-sided BSDFs are told from two-sided and transmissive ones"):
    def sides(bsdf: String) =
      read(Sensor + s"<shape type=\"sphere\">$bsdf</shape>").shapes.head.oneSided
    assert(sides(""))
    assert(sides("<bsdf type=\"diffuse\"/>"))
    assert(!sides("<bsdf type=\"dielectric\"/>"))
    assert(!sides("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>"))

  test("parameters of `principled` that are not given are Mitsuba's, not pbrt's"):
    def material(kind: String) =
      val bsdf = s"<bsdf type=\"$kind\"><float name=\"sheen\" value=\"1\"/></bsdf>"
      read(s"$Sensor<shape type=\"sphere\">$bsdf</shape>").shapes.head.material match
        case MaterialRef.Inline(d) => d
        case other => fail(other.toString)
    for kind <- Seq("principled", "principledthin") do
      for name <- Seq("sheentint", "clearcoatgloss", "difftrans") do
        assert(material(kind).param(name).get.floats.head == 0f, s"$kind $name")
    assert(material("principledthin").param("thin").get.bools.head)

  test("two-sided surfaces have two materials if the sides differ, or are black from behind"):
    def sides(inner: String) =
      val scene =
        read(s"$Sensor<shape type=\"sphere\"><bsdf type=\"twosided\">$inner</bsdf></shape>")
      scene.shapes.head.material match
        case MaterialRef.Inline(d) if d.name == "twosided" =>
          val named = scene.namedMaterials.toMap
          d.param("materials").get.strings.toVector.map(named(_).name)
        case _ => Vector.empty
    val plastic = "<bsdf type=\"plastic\"/>"
    assert(sides(plastic) == Vector.empty)
    assert(sides(plastic + "<bsdf type=\"diffuse\"/>") == Vector("roughplastic", "diffuse"))
    assert(sides("<bsdf type=\"principled\"/>") == Vector("principled", "principled"))
    assert(sides("<bsdf type=\"principledthin\"/>") == Vector.empty)
  test("filters of polarized light pass a share of light that is not"):
    def passed(bsdf: String) =
      val scene = read(Sensor + s"<shape type=\"rectangle\"><bsdf $bsdf</bsdf></shape>")
      assert(scene.errors.isEmpty && scene.warnings.isEmpty)
      scene.shapes.head.material match
        case MaterialRef.Inline(d) =>
          assert(d.name == "thindielectric" && d.param("eta").get.floats.toVector == Vector(1f))
          (scene, d.param("transmittance").get)
        case other => fail(other.toString)
    val tint = "<rgb name=\"transmittance\" value=\"1, 0.5, 0\"/>"
    for (kind, share) <- Seq("polarizer" -> 0.5f, "circular" -> 0.5f, "retarder" -> 1f) do
      val found = passed(s"type=\"$kind\">$tint")._2.floats.toVector
      assert(found == Vector(share, share * 0.5f, 0f))
    val checks = "<texture type=\"checkerboard\" name=\"transmittance\"/>"
    val (scene, p) = passed(s"type=\"polarizer\">$checks")
    val texture = scene.textures.find(t => p.strings.contains(t.name)).get.texture
    assert(texture.name == "scale" && texture.param("scale").get.floats.toVector == Vector(0.5f))

  test("a rotated texture and a mirrored one keep their coordinates, with v from the bottom"):
    def texture(more: String) =
      val bsdf = s"<bsdf type=\"diffuse\"><texture name=\"reflectance\" $more</texture></bsdf>"
      inFolder(s"$Sensor<shape type=\"sphere\">$bsdf</shape>", "a.png" -> ""): file =>
        val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
        assert(scene.warnings.isEmpty && scene.errors.isEmpty)
        scene.textures.head.texture
    // s = 2u − 3v + 5, t = 7u + 11v + 13
    val matrix =
      "<transform name=\"to_uv\"><matrix value=\"2 -3 0 5 7 11 0 13 0 0 1 0 0 0 0 1\"/>" +
        "</transform>"
    def place(more: String) =
      val d = texture(more)
      val names = Vector("uscale", "uskew", "udelta", "vskew", "vscale", "vdelta")
      names.map(n => d.param(n).fold(0f)(_.floats.head))
    assert(place(s"type=\"checkerboard\">$matrix").map(_ / 2) == Vector(2f, 3f, 2f, 7f, -11f, 24f))
    val image = "type=\"bitmap\"><string name=\"filename\" value=\"a.png\"/>"
    assert(place(image + matrix) == Vector(2f, 3f, 2f, -7f, 11f, -23f))
    def normals(more: String) =
      val map = s"<texture name=\"normalmap\" $image$more</texture><bsdf type=\"diffuse\"/>"
      val body = s"$Sensor<shape type=\"sphere\"><bsdf type=\"normalmap\">$map</bsdf></shape>"
      inFolder(body, "a.png" -> ""): file =>
        val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
        assert(scene.warnings.isEmpty && scene.errors.isEmpty)
        scene.shapes.head.material match
          case MaterialRef.Inline(d) => d.param("normalmapuv").map(_.floats.toVector)
          case other => fail(other.toString)
    assert(normals(matrix).contains(Vector(2f, 3f, 2f, -7f, 11f, -23f)))
    assert(normals("").isEmpty)
    val mirrored = texture(image + "<string name=\"wrap_mode\" value=\"mirror\"/>")
    assert(mirrored.param("wrap").get.strings.toVector == Vector("mirror"))

  test("a lookat without up, or of length 0, has the up that Mitsuba takes"):
    def camera(lookat: String) =
      val sensor = s"<transform name=\"to_world\"><lookat $lookat/></transform>"
      read(s"<sensor type=\"perspective\">$sensor</sensor>").worldToCamera.start.m
    // The y axis of to_world in Mitsuba 3.9.1
    for (from, to, up) <- Vector(
        ("0,0,5", "0,0,0", "1,0,0"),
        ("0,0,-5", "0,0,0", "1,0,0"),
        ("4,0,0", "0,0,0", "0,0,1"),
        ("0,3,0", "0,0,0", "1,0,0"),
        ("1,2,3", "0,.5,-1", ".97283,-.04076,-.22792"),
        ("1,2,3", "-2,.5,7", ".81301,-.0935,.57470")
      )
    do
      val expected = camera(s"origin=\"$from\" target=\"$to\" up=\"$up\"")
      for without <- Vector("", " up=\"0,0,0\"") do
        val found = camera(s"origin=\"$from\" target=\"$to\"$without")
        for i <- 0 until 16 do assert(Math.abs(found(i) - expected(i)) < 1e-4, s"$from $to $i")

  test("cameras clip, and lenses focus at the far plane unless told otherwise"):
    def camera(more: String) = read(s"<sensor type=\"thinlens\">$more</sensor>").camera.get
    def number(more: String, name: String) = camera(more).param(name).map(_.floats.head)
    assert(number("", "nearclip").isEmpty && number("", "focaldistance").contains(1e4f))
    val planes = "<float name=\"near_clip\" value=\"0.5\"/><float name=\"far_clip\" value=\"9\"/>"
    assert(number(planes, "nearclip").contains(0.5f) && number(planes, "farclip").contains(9f))
    assert(number(planes, "focaldistance").contains(9f))

  test("emitters and sky are hidden from the camera where paths begin there"):
    def hides(kind: String) =
      val flag = "<boolean name=\"hide_emitters\" value=\"true\"/>"
      val scene = read(s"$Sensor<integrator type=\"$kind\">$flag</integrator>")
      (scene.integrator.get.param("hideemitters").exists(_.bools.head), scene.warnings.size)
    for kind <- Seq("path", "prb", "direct", "volpath", "volpathmis") do
      assert(hides(kind) == (true, 0), kind)
    assert(hides("ptracer") == (false, 1))

  test("every type that is read has its row in docs/MITSUBA.md"):
    val page = Files.readString(Path.of("docs/MITSUBA.md"))
    val missing = Plugins.read.values.flatten.filterNot(name => page.contains(s"`$name`"))
    assert(missing.isEmpty)
    val others =
      Plugins.unsupportedTypes.values.flatten.filterNot(name => page.contains(s"`$name`"))
    assert(others.isEmpty)

  test("phase functions are blended by constant weights, and checked"):
    def medium(phase: String) =
      s"<shape type=\"cube\"><medium type=\"homogeneous\" name=\"interior\">\n$phase" +
        "</medium></shape>"
    def table(values: String) =
      s"<phase type=\"tabphase\"><string name=\"values\" value=\"$values\"/></phase>"
    def blend(parts: String) =
      "<phase type=\"blendphase\"><volume type=\"constvolume\" name=\"weight\">" +
        s"<float name=\"value\" value=\"0.75\"/></volume>$parts</phase>"
    val d = read(Sensor + medium(blend(table("1, 2 3") + "<phase type=\"rayleigh\"/>")))
      .media.head.medium
    assert(d.param("phases").get.strings == Vector("tabulated", "rayleigh"))
    assert(d.param("phaseweights").get.floats.toSeq == Seq(0.25f, 0.75f))
    assert(d.param("phasevalues").get.floats.toSeq == Seq(3f, 1f, 2f, 3f))
    assert(
      problems(medium(table("1 -2"))) == Vector(
        "2:24: `values` of phase \"tabphase\" must be two numbers or more, at least 0, and not " +
          "all 0, found 2: 1.0, -2.0"
      )
    )
    assert(
      problems(medium(blend("<phase type=\"rayleigh\"/>"))) ==
        Vector("2:1: phase \"blendphase\" must have two phase functions, found 1")
    )

  test("grids texture surfaces, as colours or numbers; constant volumes are constants"):
    val file = Path.of("scenes/mitsuba/colors.vol").toAbsolutePath
    def grid(name: String, volume: String) =
      s"<texture type=\"volume\" name=\"$name\"><volume name=\"volume\" $volume</volume></texture>"
    val cells = s"type=\"gridvolume\"><string name=\"filename\" value=\"$file\"/>"
    val even = "type=\"constvolume\"><float name=\"value\" value=\"0.25\"/>"
    def scene(bsdf: String) = read(s"$Sensor<shape type=\"sphere\">$bsdf</shape>")
    val made = scene(
      s"<bsdf type=\"principled\">${grid("base_color", cells)}${grid("roughness", cells)}</bsdf>"
    ).textures
    assert(made.map(t => (t.valueType, t.texture.name)).toSet ==
      Set(("spectrum", "grid"), ("float", "grid")))
    val sizes = made.map(t => t.valueType -> t.texture.param("values").get.floats.length).toMap
    assert(sizes == Map("spectrum" -> 72, "float" -> 24))
    val plain = scene(s"<bsdf type=\"diffuse\">${grid("reflectance", even)}</bsdf>")
    assert(plain.textures.isEmpty && plain.errors.isEmpty && plain.warnings.isEmpty)
    val raw = "<texture type=\"rawconstant\" name=\"reflectance\"/>"
    assert(
      problems(s"<shape type=\"sphere\"><bsdf type=\"diffuse\">\n$raw</bsdf></shape>") ==
        Vector("2:1: texture \"rawconstant\" must have a `value`")
    )

  test("each mesh has its own attributes, and a missing one is reported"):
    val quilt = Path.of("scenes/mitsuba/quilt.ply").toAbsolutePath
    def texture(name: String) = "<texture type=\"mesh_attribute\" name=\"reflectance\">" +
      s"<string name=\"name\" value=\"$name\"/></texture>"
    def body(name: String, types: String*) =
      s"<bsdf type=\"diffuse\" id=\"b\">\n${texture(name)}</bsdf>" + types.map(t =>
        s"<shape type=\"$t\"><string name=\"filename\" value=\"$quilt\"/><ref id=\"b\"/></shape>"
      ).mkString
    val scene = read(Sensor + body("vertex_color", "ply", "ply"))
    assert(scene.textures.map(_.texture.name) == Vector("grid", "grid"))
    assert(scene.shapes.map(_.material).distinct.size == 2 && scene.warnings.isEmpty)
    val missing = "2:51: the mesh has no attribute `vertex_colors`; using 0.5"
    assert(problems(body("vertex_colors", "ply")) ==
      Vector(s"$missing (did you mean `vertex_color`?)"))

  test("curves are tubes; of much hair, pbrt's curves, one by one"):
    def material(s: ShapeDescription) = s.material match
      case MaterialRef.Inline(d) => d
      case other => fail(other.toString)
    def scene(bsdf: String, points: Seq[String], kind: String = "bsplinecurve") =
      val file = Files.createTempFile("candela", ".txt")
      try
        Files.writeString(file, points.mkString("\n")): Unit
        read(
          s"$Sensor<shape type=\"$kind\"><string name=\"filename\" value=\"$file\"/>" +
            s"<bsdf type=\"$bsdf\"/></shape>"
        )
      finally Files.delete(file)
    val even = Seq("0 0 0 .4", "1 0 0 .3", "2 0 0 .2", "3 0 0 .1", "4 1 0 0", "")
    val bulge = Seq("0 0 0 .1", "1 0 0 .1", "2 0 0 .3", "3 0 0 .1", "4 1 0 .1")
    val long = "" +: Seq.tabulate(1000)(i => s"$i 0 0 .1")
    val hair = scene("hair", even ++ bulge ++ long).shapes
    val fibres = hair.map(_.shape)
    assert(fibres.map(_.name).distinct == Vector("curve") && fibres.size > 3)
    assert(hair.forall(s => material(s).param("ribbon").exists(_.bools.head)))
    assert(fibres.take(3).map(_.param("P").get.floats.length / 3) == Vector(5, 4, 4))
    val widths = fibres.head.params.filter(_.name.startsWith("width")).map(_.floats.head)
    assert(widths.zip(Seq(0.6f, 0.2f)).forall((a, b) => Math.abs(a - b) < 1e-6f), widths)
    for
      (bsdf, kind) <-
        Seq("diffuse" -> "bsplinecurve", "hair" -> "bsplinecurve", "hair" -> "linearcurve")
    do
      val tubes = scene(bsdf, even ++ bulge, kind).shapes
      assert(tubes.map(_.shape.name) == Vector("trianglemesh"), bsdf)
      assert(tubes.head.shape.param("cullbackfaces").exists(_.bools.head), s"$bsdf, $kind")
      assert(material(tubes.head).param("ribbon").isEmpty)

  test("a heterogeneous medium of constant extinction fills its volume's cube"):
    def medium(volume: String) =
      val sigmaT = s"<volume type=\"constvolume\" name=\"sigma_t\">$volume" +
        "<float name=\"value\" value=\"2\"/></volume>"
      val fog = s"<medium type=\"heterogeneous\" name=\"interior\">$sigmaT</medium>"
      read(s"$Sensor<shape type=\"cube\"><bsdf type=\"null\"/>$fog</shape>").media.head.medium
    val unit = medium("")
    assert(unit.param("p0").get.floats.toSeq == Seq(0f, 0f, 0f))
    assert(unit.param("p1").get.floats.toSeq == Seq(1f, 1f, 1f))
    assert(unit.param("sigma_s").get.floats.head == 1.5f)
    assert(unit.param("density").get.floats.forall(_ == 1f))
    // Of a turned cube, the box along the axes
    val turned = medium("<transform name=\"to_world\"><rotate z=\"1\" angle=\"45\"/></transform>")
    assert(Math.abs(turned.param("p0").get.floats(0) + 0.7071f) < 1e-4f)
    assert(Math.abs(turned.param("p1").get.floats(1) - 1.4142f) < 1e-4f)
