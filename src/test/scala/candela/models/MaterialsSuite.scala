package candela.models

import candela.build.SceneBuilder
import candela.image.Image
import candela.render.Renderer
import candela.scenefile.{Declaration, Resolution, SceneDescription}
import candela.settings.{ReadSettings, RenderSettings}

import org.scalatest.funsuite.AnyFunSuite

class MaterialsSuite extends AnyFunSuite, GltfModels:

  /** Red and green texels above blue and white ones. */
  private val png = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/u" +
    "Bfvxq7p3AAAAAElFTkSuQmCC"

  private def textured(material: String, sampler: String): String = s""",
    "materials":[{$material}],"textures":[{"source":0,"sampler":0}],"samplers":[$sampler],
    "images":[{"uri":"data:image/png;base64,$png"}]"""

  private def scene(material: String, sampler: String = "{}", primitive: String = "") =
    read(model(s""","mode":5,"material":0$primitive""", others = textured(material, sampler)))

  private def extension(name: String, members: String, others: String = ""): SceneDescription =
    scene(s""""extensions":{"KHR_materials_$name":{$members}$others}""")

  private def surface(s: SceneDescription): Declaration =
    assert(s.errors.isEmpty && s.warnings.isEmpty, (s.errors ++ s.warnings).map(_.message))
    s.namedMaterials.map(_._2).find(_.name == "gltf").get

  private def number(d: Declaration, name: String): Float = d.param(name).get.floats.head

  private def channel(s: SceneDescription, d: Declaration, name: String): String =
    s.textures.find(_.name == d.param(name).get.strings.head).get.texture
      .param("channel").get.strings.head

  test("a film has its thickness by the green channel, its strength by the red one"):
    val s = extension(
      "iridescence",
      """"iridescenceFactor":0.5,"iridescenceIor":1.8,"iridescenceThicknessMinimum":200,
        |"iridescenceTexture":{"index":0},"iridescenceThicknessTexture":{"index":0}""".stripMargin
    )
    val d = surface(s)
    assert(channel(s, d, "iridescence") == "r" && channel(s, d, "iridescencethickness") == "g")
    assert(number(d, "iridescenceeta") == 1.8f)
    assert(number(d, "iridescencemin") == 200f && number(d, "iridescencemax") == 400f)

  test("a clear coat has its own normals, or those of the mesh"):
    val coat = """"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1"""
    val apart = ""","clearcoatNormalTexture":{"index":0,"scale":0.5}}}"""
    val both = surface(scene(coat + apart + ""","normalTexture":{"index":0}"""))
    assert(both.param("clearcoatnormalmap").isDefined && both.param("normalmap").isDefined)
    assert(number(both, "clearcoatnormalscale") == 0.5f && both.param("normalscale").isEmpty)
    assert(both.params.count(_.name == "softedges") == 1)
    val smooth = surface(scene(coat + "}},\"normalTexture\":{\"index\":0}"))
    assert(smooth.param("clearcoatnormalmap").isEmpty)
    val small = ReadSettings(resolution = Some(Resolution.Size(8, 8)))
    def image(material: String) =
      val plan =
        SceneBuilder.build(scene(material), RenderSettings(samples = Some(16), reading = small))._1
      Renderer.render(plan, 1).image(plan.development).data.sum
    val images = Vector(
      coat + "}}",
      coat + apart,
      coat + "}},\"normalTexture\":{\"index\":0}",
      coat + apart + ""","normalTexture":{"index":0}"""
    ).map(image)
    assert(images.distinct.size == 4, images)

  test("diffuse transmission has its share by alpha"):
    val s = extension(
      "diffuse_transmission",
      """"diffuseTransmissionFactor":0.5,"diffuseTransmissionColorFactor":[0.1,0.2,0.3],
        |"diffuseTransmissionTexture":{"index":0}""".stripMargin
    )
    val d = surface(s)
    assert(channel(s, d, "diffusetransmission") == "a")
    assert(d.param("diffusetransmissioncolor").get.floats.toVector == Vector(0.1f, 0.2f, 0.3f))

  test("dispersion is of volumes that transmit light"):
    val volume = """,
      "KHR_materials_transmission":{"transmissionFactor":1},
      "KHR_materials_volume":{"thicknessFactor":1}"""
    val dispersing = """"dispersion":0.5"""
    assert(number(surface(extension("dispersion", dispersing, volume)), "dispersion") == 0.5f)
    val flat = extension("dispersion", dispersing)
    assert(flat.warnings.exists(_.message.contains("only volumes")))

  /** Its only warning, below the material, and what it is of. */
  private def warned(s: SceneDescription): String =
    assert(s.errors.isEmpty && s.warnings.size == 1, (s.errors ++ s.warnings).map(_.message))
    val p = s.warnings.head
    s"${p.pos.get.file.split("#/materials/0/").last}: ${p.message}"

  private def gltf(s: SceneDescription): Declaration =
    s.namedMaterials.map(_._2).find(_.name == "gltf").get

  test("colours out of range have the nearer limit, with a warning at their member"):
    val base = scene(""""pbrMetallicRoughness":{"baseColorFactor":[2,0,-1,1]}""")
    assert(warned(base) == "pbrMetallicRoughness/baseColorFactor: `baseColorFactor` must be " +
      "from 0 to 1, found 2 0 -1 1; using 1 0 0 1")
    assert(gltf(base).param("color").get.floats.toVector == Vector(1f, 0f, 0f))
    val faint =
      scene(""""alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,3]}""")
    assert(warned(faint).endsWith("found 1 1 1 3; using 1 1 1 1"))
    assert(faint.shapes.head.shape.param("alpha").get.floats.head == 1f)

  test("numbers out of range have the nearer limit, with a warning at their member"):
    for
      (name, member, parameter, range) <- Seq(
        ("specular", "specularFactor", "specular", "from 0 to 1"),
        ("specular", "specularColorFactor", "specularcolor", "at least 0"),
        ("ior", "ior", "eta", "at least 1"),
        ("transmission", "transmissionFactor", "transmission", "from 0 to 1"),
        ("clearcoat", "clearcoatFactor", "clearcoat", "from 0 to 1"),
        ("clearcoat", "clearcoatRoughnessFactor", "clearcoatroughness", "from 0 to 1"),
        ("sheen", "sheenColorFactor", "sheencolor", "from 0 to 1"),
        ("sheen", "sheenRoughnessFactor", "sheenroughness", "from 0 to 1"),
        ("anisotropy", "anisotropyStrength", "anisotropy", "from 0 to 1"),
        ("iridescence", "iridescenceFactor", "iridescence", "from 0 to 1"),
        ("iridescence", "iridescenceIor", "iridescenceeta", "at least 1"),
        ("iridescence", "iridescenceThicknessMinimum", "iridescencemin", "at least 0"),
        ("iridescence", "iridescenceThicknessMaximum", "iridescencemax", "at least 0"),
        ("diffuse_transmission", "diffuseTransmissionFactor", "diffusetransmission", "from 0 to 1"),
        (
          "diffuse_transmission",
          "diffuseTransmissionColorFactor",
          "diffusetransmissioncolor",
          "from 0 to 1"
        )
      )
    do
      val value = if member.contains("Color") then "[-2,-2,-2]" else "-2"
      val s = extension(name, s""""$member":$value""")
      assert(
        warned(s).startsWith(s"extensions/KHR_materials_$name/$member: `$member` must be $range,")
      )
      assert(number(gltf(s), parameter) == (if range == "at least 1" then 1f else 0f), member)
    val total = extension("ior", """"ior":0""")
    assert(number(surface(total), "eta") == 0f)
    assert(warned(extension("dispersion", """"dispersion":-1""")).endsWith("found -1; using 0"))
    val cutoff = scene(""""alphaMode":"MASK","alphaCutoff":-2""")
    assert(warned(cutoff) == "alphaCutoff: `alphaCutoff` must be at least 0, found -2; using 0")
    assert(cutoff.shapes.head.shape.param("alphacutoff").get.floats.head == 0f)

  test("emission above 1 is used, and below 0 is not, each with a warning"):
    def emitted(s: SceneDescription) = s.shapes.head.areaLight.get.param("L").get.floats.toVector
    val bright = scene(""""emissiveFactor":[2,0,0]""")
    assert(warned(bright) == "emissiveFactor: `emissiveFactor` should be from 0 to 1, found " +
      "2 0 0, which is used")
    assert(emitted(bright) == Vector(2f, 0f, 0f))
    val negative = scene(""""emissiveFactor":[1,-1,0]""")
    assert(warned(negative).endsWith("must be at least 0, found 1 -1 0; using 1 0 0"))
    assert(emitted(negative) == Vector(1f, 0f, 0f))
    val strength = """"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":-2}}"""
    assert(warned(scene(s""""emissiveFactor":[1,1,1],$strength""")).endsWith("using 0"))

  test("the anisotropy texture has directions and strength"):
    val s = extension(
      "anisotropy",
      """"anisotropyStrength":0.5,"anisotropyTexture":{"index":0}"""
    )
    val d = surface(s)
    val channels = Vector("anisotropyx", "anisotropyy", "anisotropy").map(channel(s, d, _))
    assert(channels == Vector("r", "g", "b"))

  private val mixed = """{"wrapS":33071,"wrapT":33648,"magFilter":9728}"""

  test("wrap modes along s and t are each what the sampler says"):
    val info = """{"index":0}"""
    val s = scene(
      s""""pbrMetallicRoughness":{"baseColorTexture":$info},"normalTexture":$info,
         |"emissiveTexture":$info,"emissiveFactor":[1,1,1]""".stripMargin,
      mixed
    )
    val texture = s.textures.head.texture
    val light = s.shapes.flatMap(_.areaLight).find(_.param("filename").isDefined).get
    def modes(d: Declaration, names: String*) = names.map(d.param(_).get.strings.head)
    assert(modes(texture, "wrap", "wrapt") == Seq("clamp", "mirror"))
    assert(modes(light, "wrap", "wrapt") == Seq("clamp", "mirror"))
    assert(modes(surface(s), "normalwrap", "normalwrapt") == Seq("clamp", "mirror"))

  /** What a camera in front of the square sees, in 8 × 8 pixels. */
  private def seen(material: String, uvs: Array[Byte], set: Int, sampler: String): Image =
    val (accessors, views, data) = arrays("VEC2" -> uvs, "VEC2" -> uvs.map(_ => 0.toByte))
    val (used, unused) = (s"TEXCOORD_$set", s"TEXCOORD_${1 - set}")
    val flat = """{"type":"orthographic",
      "orthographic":{"xmag":0.5,"ymag":0.5,"znear":0.1,"zfar":9}}"""
    val json = model(
      ""","mode":6,"material":0""",
      accessors,
      views,
      data,
      """{"mesh":0},{"camera":0,"translation":[0.5,0.5,1]}""",
      "0,1",
      textured(material, sampler) + s""","cameras":[$flat]"""
    ).replace("\"POSITION\":0", s"\"POSITION\":0,\"$used\":1,\"$unused\":2")
    val reading = ReadSettings(resolution = Some(Resolution.Size(8, 8)))
    val settings = RenderSettings(samples = Some(1), reading = reading)
    val (plan, _) = SceneBuilder.build(read(json, reading = reading), settings)
    Renderer.render(plan, 1).image(plan.development).toRgb

  test("images that emit have their own set of u and v, and wrap along each axis"):
    val emitting = """"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},
      "emissiveFactor":[1,1,1],"emissiveTexture":{"index":0,"texCoord":1}"""
    // Two images across and down
    val image = seen(emitting, floats(0, 2, 2, 2, 2, 0, 0, 0), 1, mixed)
    def channels(x: Int, y: Int) =
      image.data.slice(3 * (8 * y + x), 3 * (8 * y + x) + 3).map(_ > 0.5f).toVector
    val (red, green) = (Vector(true, false, false), Vector(false, true, false))
    val (blue, white) = (Vector(false, false, true), Vector(true, true, true))
    // Clamped across, mirrored down
    assert(Vector(0, 3, 4, 7).map(channels(0, _)) == Vector(red, blue, blue, red))
    assert(Vector(0, 3, 4, 7).map(channels(5, _)) == Vector(green, white, white, green))
