package candela.convert

import candela.io.InputFile
import org.scalatest.funsuite.AnyFunSuite

import candela.build.shapes.PlyFile
import candela.scenefile.*
import candela.testing.{SceneTexts, TempFolder}

/** Statements whose numbers must be calculated, so that they mean the same. */
class MeaningSuite extends AnyFunSuite:

  private val view = "Camera \"perspective\" Film \"image\" \"integer xresolution\" 4 \"integer " +
    "yresolution\" 4 Sampler \"random\" \"integer pixelsamples\" 16 WorldBegin\n"

  private def converted(world: String, from: Dialect, to: Dialect): Converted =
    val start = if from == Dialect.V4 then
      view.replace("\"image\"", "\"rgb\"")
        .replace("random", "independent")
    else view
    TempFolder.use(folder => Converter.convert(SceneTexts.parse(start + world, from), to, folder))

  test("coordinates keep the digits that Floats lack, in text and in PLY files"):
    val far = "Shape \"trianglemesh\" \"integer indices\" [0 1 2] " +
      "\"point3 P\" [4200000.123 -500000.0625 1 4200001 -500001.21 2.5 4200002.875 -500000 3]"
    val made = converted("LightSource \"infinite\"\n" + far, Dialect.V4, Dialect.V3)
    val text = Descriptions.text(made.scene)
    assert(text.contains("4200000.123 -500000.0625 1 4200001 -500001.21 2.5"), text)
    TempFolder.use: folder =>
      val files = SideFiles(folder)
      val moved = PlyWriter.extract(made.scene, 1, files)
      val name = moved.shapes.head.shape.param("filename").get.strings.head
      val mesh = PlyFile.read(InputFile.named(folder.resolve(name)))
      val x = mesh.positions(0).toDouble + mesh.rests(0)
      assert(Math.abs(x - 4200000.123) < 1e-7, x)

  private def assertSameLight(light: String, from: Dialect, to: Dialect) =
    val start = if from == Dialect.V4 then
      view.replace("\"image\"", "\"rgb\"")
        .replace("random", "independent")
    else view
    val made = converted(light, from, to)
    assert(made.warnings.isEmpty)
    val a = SceneTexts.mean(start + light, from)
    val b = SceneTexts.mean(Descriptions.text(made.scene), to)
    for (x, y) <- Seq(a.r -> b.r, a.g -> b.g, a.b -> b.b) do
      // Before and after, spectra have their colours to 1e-3: see ColorimetrySuite
      assert(Math.abs(x - y) < 2e-3 * Math.max(1f, Math.abs(x)), s"$light: $a and $b")

  test("an illuminant of which pbrt-v4 has a wrong table is a warning"):
    def warned(name: String) =
      val light = s"LightSource \"infinite\" \"spectrum L\" \"stdillum-$name\""
      converted(light, Dialect.V4, Dialect.V3).warnings.map(_.message)
    assert(warned("D50").exists(_.contains("8 % more red")) && warned("D65").isEmpty)

  test("flat spectra of media stay grey"):
    val fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" " +
      "\"spectrum sigma_s\" [300 .6 800 .6]\nWorldEnd"
    val made = converted(fog, Dialect.V4, Dialect.V3)
    val scattered = made.scene.media.head._2.param("sigma_s").get
    assert(scattered.paramType == ParamType.Rgb)
    // White is right to 1e-3: see ColorimetrySuite
    assert(scattered.floats.forall(x => Math.abs(x - 0.6f) < 1e-3f))

  test("lights are as bright and have the same colour, however they are written"):
    for light <- Vector(
        "\"blackbody L\" [3000 2.5]", "\"blackbody L\" [9000 1] \"rgb scale\" [2 2 2]",
        "\"rgb L\" [1 .5 2] \"rgb scale\" [.5 2 1]", "\"xyz L\" [.4 .5 .6]",
        "\"rgb scale\" [3 2 1]", "\"spectrum L\" [400 .5 700 1.5]"
      )
    do assertSameLight(s"LightSource \"infinite\" $light\nWorldEnd", Dialect.V3, Dialect.V4)
    for light <- Vector(
        "\"blackbody L\" 3000 \"float scale\" 2",
        "\"rgb L\" [1 .5 2] \"float scale\" 3",
        "\"float illuminance\" 7",
        "\"spectrum L\" [400 .5 700 1.5]"
      )
    do assertSameLight(s"LightSource \"infinite\" $light", Dialect.V4, Dialect.V3)

  test("a spot light keeps its power, whose edge falls off otherwise"):
    // Integrals over the cosine: before the edge, and within it
    def power(end: Double, delta: Double, within: Double) =
      val cosEnd = Math.cos(Math.toRadians(end))
      val cosStart = Math.cos(Math.toRadians(end - delta))
      1 - cosStart + within * (cosStart - cosEnd)
    for
      (end, delta) <- Vector((30, 18), (60, 60), (40, 1), (20, 0))
      (from, to, a, b) <- Vector((Dialect.V3, Dialect.V4, .2, .5), (Dialect.V4, Dialect.V3, .5, .2))
    do
      val text = s"LightSource \"spot\" \"float coneangle\" $end \"float conedeltaangle\" $delta"
      val world = if from == Dialect.V3 then s"$text\nWorldEnd" else text
      val light = converted(world, from, to).scene.lights.head.light
      val changed = power(number(light, "coneangle"), number(light, "conedeltaangle"), b)
      assert(Math.abs(changed / power(end, delta, a) - 1) < 1e-4, s"$from $end $delta")
      assert(delta > 0 || number(light, "conedeltaangle") == 0)

  test("the power of an area light is that of one side, or of two"):
    for isTwoSided <- Seq(false, true) do
      val light = s"AreaLightSource \"diffuse\" \"float power\" 5 \"bool twosided\" $isTwoSided\n" +
        "Translate 0 0 3 Shape \"sphere\""
      assertSameLight(light, Dialect.V4, Dialect.V3)

  test("colours of other spaces become sRGB's, the white of a light too"):
    for light <- Vector(
        "ColorSpace \"rec2020\" LightSource \"infinite\" \"rgb L\" [1 .8 .9]",
        "ColorSpace \"aces2065-1\" LightSource \"infinite\"",
        "ColorSpace \"dci-p3\" Attribute \"light\" \"rgb L\" [1 .8 .9] " +
          "ColorSpace \"srgb\" LightSource \"infinite\""
      )
    do assertSameLight(light, Dialect.V4, Dialect.V3)
    val deep = "ColorSpace \"rec2020\" LightSource \"infinite\" \"rgb L\" [0 1 0]"
    assert(converted(deep, Dialect.V4, Dialect.V3).warnings.exists(_.message.contains("gamut")))

  private def material(world: String, from: Dialect, to: Dialect): Declaration =
    converted(s"$world Shape \"sphere\"", from, to).scene.shapes.head.material match
      case MaterialRef.Inline(d) => d
      case other => fail(other.toString)

  private def number(d: Declaration, name: String) = d.param(name).get.floats.head

  test("bumps are a warning where they are made, unless they are flat"):
    def warned(from: Dialect, to: Dialect, bump: String) =
      val name = if from == Dialect.V3 then "\"matte\" \"texture bumpmap\""
      else "\"diffuse\" \"texture displacement\""
      val world = s"Texture \"t\" \"float\" $bump\nMaterial $name \"t\" Shape \"sphere\""
      converted(world, from, to).warnings.filter(_.message.contains("turn away from a light"))
    for (from, to) <- Seq(Dialect.V3 -> Dialect.V4, Dialect.V4 -> Dialect.V3) do
      assert(warned(from, to, "\"wrinkled\"").flatMap(_.pos).map(_.line) == Vector(3))
      assert(warned(from, to, "\"constant\"").isEmpty)

  test("quadrics of v3 have no alpha, which v4's have"):
    for kind <- Seq("sphere", "cylinder", "disk", "cone") do
      val made = converted(s"Shape \"$kind\" \"float alpha\" 0", Dialect.V3, Dialect.V4)
      assert(made.scene.shapes.head.shape.param("alpha").isEmpty)
      assert(made.warnings.exists(_.message.contains("unknown parameter `alpha`")), made.warnings)

  test("roughness is the same alpha"):
    val metal = material("Material \"metal\" \"float roughness\" .2", Dialect.V3, Dialect.V4)
    val alpha = candela.bsdf.microfacet.Roughness.polynomialAlpha(.2f)
    assert(number(metal, "roughness") == alpha)
    assert(metal.param("remaproughness").get.bools == Vector(false))
    val back = material("Material \"conductor\" \"float roughness\" .25", Dialect.V4, Dialect.V3)
    assert(number(back, "roughness") == .5f)
    val glass = material("Material \"glass\"", Dialect.V3, Dialect.V4)
    assert(number(glass, "roughness") == 0f)

  test("a coated base keeps its albedo and both roughnesses in v3"):
    val coated = "Material \"coateddiffuse\" \"rgb reflectance\" .5 \"float thickness\" 0 " +
      "\"float uroughness\" 0 \"float vroughness\" 0"
    val smooth = material(coated.replace(".5", "[.5 .5 .5]"), Dialect.V4, Dialect.V3)
    assert(smooth.name == "substrate" && Math.abs(smooth.param("Ks").get.floats(0) - .04f) < 1e-5f)
    // Of index 1.5, a diffuse coat reflects 9.2 % from outside and 59.6 % from inside (Egan and
    // Hilgeman 1973)
    val albedo = Math.pow(1 - .092, 2) / (1.5 * 1.5) * .5 / (1 - .5 * .596)
    val kd = smooth.param("Kd").get.floats(0)
    assert(Math.abs(kd / (albedo * 28 / (23 * .96)) - 1) < 5e-3, kd)
    val rough = coated.replace("uroughness\" 0", "uroughness\" .04")
      .replace("vroughness\" 0", "vroughness\" .09")
    val both = material(rough.replace(".5", "[.5 .5 .5]"), Dialect.V4, Dialect.V3)
    assert(Math.abs(number(both, "uroughness") - .2f) < 1e-5f)
    assert(Math.abs(number(both, "vroughness") - .3f) < 1e-5f)

  test("a base keeps its albedo under v4's coat"):
    // Index 1.5, a smooth coat as above, which absorbs a hundredth of its thickness
    def single(albedo: Double) = albedo * 1.5 * 1.5 / Math.pow((1 - .092) * Math.exp(-.015), 2)
    def base(albedo: Double) = single(albedo) / (1 + .596 * single(albedo))
    def reflectance(statement: String) =
      val coated = material(statement, Dialect.V3, Dialect.V4)
      assert(coated.name == "coateddiffuse" && Math.abs(number(coated, "eta") - 1.5f) < 1e-4f)
      coated.param("reflectance").get.floats(0)
    val smooth = "\"float roughness\" 0 \"bool remaproughness\" false \"rgb Kd\" [.3 .3 .3]"
    for name <- Seq("plastic", "uber") do
      val found = reflectance(s"Material \"$name\" \"rgb Ks\" [1 1 1] $smooth")
      assert(Math.abs(found / base(.3) - 1) < 2e-2, s"$name: $found")
    val both = smooth.replace("\"float r", "\"float uroughness\" 0 \"float vr")
    val blend = reflectance(s"Material \"substrate\" \"rgb Ks\" [.04 .04 .04] $both")
    assert(Math.abs(blend / base(23 / 28.0 * .3 * .96) - 1) < 2e-2, blend)

  test("plastic without gloss is diffuse, and nothing is lost"):
    val world = "Material \"plastic\" \"rgb Ks\" [0 0 0] \"rgb Kd\" [.3 .3 .3] Shape \"sphere\""
    assert(converted(world, Dialect.V3, Dialect.V4).warnings.isEmpty)

  test("mixed materials change places, for the amount is the other one's"):
    val mix = material(
      "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"",
      Dialect.V3,
      Dialect.V4
    )
    assert(mix.param("materials").get.strings == Vector("b", "a"))

  test("ReverseOrientation turns a mesh with normals"):
    val mesh = "ReverseOrientation Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] " +
      "\"integer indices\" [0 1 2] \"normal N\" [0 0 1 0 0 1 0 0 1]"
    assert(converted(mesh, Dialect.V3, Dialect.V4).scene.shapes.head.reverseOrientation)
    val turned = converted(mesh, Dialect.V4, Dialect.V3).scene.shapes.head
    assert(turned.shape.param("N").get.floats(2) == -1f && !turned.reverseOrientation)

  test("a reversed mesh in a file is a warning only if it emits: v3 lights its other side"):
    TempFolder.use: folder =>
      val ply = "ply\nformat ascii 1.0\nelement vertex 3\n" +
        Seq("x", "y", "z", "nx", "ny", "nz").map(n => s"property float $n\n").mkString +
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
        "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n"
      val _ = java.nio.file.Files.writeString(folder.resolve("a.ply"), ply)
      def warnings(light: String) =
        val text = s"${view.replace("image", "rgb")}$light ReverseOrientation " +
          "Shape \"plymesh\" \"string filename\" \"a.ply\""
        val made = Converter.convert(SceneTexts.parse(text, Dialect.V4, folder), Dialect.V3, folder)
        made.warnings.map(_.message).filter(_.contains("revers"))
      assert(warnings("").isEmpty)
      assert(warnings("AreaLightSource \"diffuse\"") == Vector(Meshes.OtherSide))

  test("lamps that both dialects have, and show otherwise, are a warning"):
    def warnings(shape: String) =
      converted(s"AreaLightSource \"diffuse\" $shape", Dialect.V3, Dialect.V4).warnings
        .map(_.message)
    for kind <- Vector("sphere", "disk", "cylinder") do
      assert(warnings(s"Scale 1 1 -1 Shape \"$kind\"").exists(_.contains("a mirrored quadric")))
      assert(!warnings(s"Shape \"$kind\"").exists(_.contains("a mirrored quadric")))
    val net = "Shape \"loopsubdiv\" \"integer indices\" [0 2 1 0 1 3 1 2 3 2 0 3] \"point P\" " +
      "[0 0 0 1 0 0 0 1 0 0 0 1]"
    assert(warnings(net).exists(_.contains("at its silhouettes")))

  test("v2's Metropolis renderer is v3's integrator"):
    val renderer =
      "Renderer \"metropolis\" \"integer maxdepth\" 3 \"integer sample\" 2\nWorldBegin\nWorldEnd"
    TempFolder.use: folder =>
      val scene = SceneTexts.parse(renderer, Dialect.V2, folder)
      for to <- Vector(Dialect.V3, Dialect.V4) do
        val made = Converter.convert(scene, to, folder)
        val d = made.scene.integrator.get
        assert(d.name == "mlt" && d.param("maxdepth").get.ints.head == 3)
        assert(d.param("largestepprobability").get.floats.head == 0.25f)
        val unknown = "unknown parameter `sample` of \"metropolis\"; ignored"
        assert(made.warnings.map(_.message) == Vector(unknown))

  test("a reversed lamp with normals is a warning: v3 lights its other side"):
    val lamp =
      "AreaLightSource \"diffuse\" ReverseOrientation Shape \"trianglemesh\" \"point3 P\" " +
        "[0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2] \"normal N\" [0 0 1 0 0 1 0 0 1]"
    val warnings = converted(lamp, Dialect.V3, Dialect.V4).warnings
    assert(warnings.exists(_.message.contains("lights the other side")), warnings)

  test("a planar mapping stays where it was: v3's is in world space"):
    val texture = "Translate .3 .2 0 Rotate 30 1 0 1 Scale 1 2 1 Texture \"t\" \"spectrum\" " +
      "\"checkerboard\" \"string mapping\" \"planar\" \"float udelta\" .4 " +
      "\"vector3 v2\" [0 1 1] \"rgb tex1\" [3 1 0] \"rgb tex2\" [0 1 3]\n"
    val made = converted(texture, Dialect.V4, Dialect.V3)
    val t = SceneTexts.parse(s"WorldBegin $texture", Dialect.V4).textures.head.textureToWorld.start
    val planar = made.scene.textures.head
    assert(planar.textureToWorld.start.isIdentity)
    def numbers(name: String) = planar.texture.param(name).get.floats.toVector
    for (x, y, z) <- Seq((0f, 0f, 0f), (1f, -2f, 3f), (.5f, 4f, -1f)) do
      val inTexture = t.inverse.point(candela.math.Vec3(x, y, z))
      def inWorld(v: String, delta: String) =
        numbers(v).zip(Seq(x, y, z)).map(_ * _).sum + numbers(delta).head
      assert(Math.abs(inWorld("v1", "udelta") - (inTexture.x + .4f)) < 1e-5f)
      assert(Math.abs(inWorld("v2", "vdelta") - (inTexture.y + inTexture.z)) < 1e-5f)

  test("a mapping has its own numbers, and cylinders are a warning"):
    def mapped(kind: String) =
      val numbers = "\"float uscale\" 4 \"float udelta\" 1 \"vector v1\" [2 0 0]"
      val texture =
        s"Texture \"t\" \"color\" \"checkerboard\" \"string mapping\" \"$kind\" $numbers"
      val made =
        converted(s"$texture Material \"matte\" \"texture Kd\" \"t\"", Dialect.V3, Dialect.V4)
      val names = made.scene.textures.last.texture.params.map(_.name).toSet
      (names - "mapping" - "dimension", made.warnings.map(_.message))
    assert(mapped("uv") == (Set("uscale", "udelta"), Vector.empty))
    assert(mapped("planar") == (Set("v1", "udelta"), Vector.empty))
    assert(mapped("spherical") == (Set.empty, Vector.empty))
    val (names, warnings) = mapped("cylindrical")
    assert(names.isEmpty && warnings.exists(_.contains("maps heights")), warnings)

  test("what v4 has no more becomes triangles, or is left out, and is named"):
    for kind <- Vector("cone", "paraboloid", "hyperboloid") do
      val made = converted(s"Shape \"$kind\"", Dialect.V3, Dialect.V4)
      assert(made.scene.shapes.map(_.shape.name) == Vector("trianglemesh"))
      assert(made.warnings.head.message.contains(kind))
    assert(converted("Shape \"nurbs\"", Dialect.V3, Dialect.V4).scene.shapes.isEmpty)
