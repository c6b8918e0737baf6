package candela.models

import candela.io.SceneFolder
import candela.scenefile.SceneDescription
import candela.settings.ReadSettings
import candela.testing.TempFolder

import java.io.ByteArrayInputStream
import java.nio.file.Files
import java.util.Base64
import javax.imageio.ImageIO

import org.scalatest.funsuite.AnyFunSuite

class WebPImagesSuite extends AnyFunSuite, GltfModels:

  /** Red, half green, blue, transparent white; lossless. */
  private val sharp = "UklGRjAAAABXRUJQVlA4TCMAAAAvAUAAEB8w/wKCIv9H23+BAMG5c8GNKkFN2wYsfpOOiP7HAQA="

  /** 8 × 8 pixels of (200, 100, 50), lossy. */
  private val lossy =
    "UklGRkIAAABXRUJQVlA4IDYAAABQAgCdASoIAAgAAAAAJaACdLoB+AH6AfwAB5AA/u3O3/+SD15PPz/yQj/+1J" +
      "+vMHK/+0yAAAA="

  private def textured(texture: String, images: String): String = model(
    ""","mode":5,"material":0""",
    others = s""","extensionsRequired":["EXT_texture_webp"],
      "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
      "textures":[$texture],"images":[$images]"""
  )

  private val extended = """{"extensions":{"EXT_texture_webp":{"source":0}}}"""

  private def inside(data: String) =
    textured(extended, s"""{"mimeType":"image/webp","uri":"data:image/webp;base64,$data"}""")

  /** Colours of the image of the scene's texture, with alpha. */
  private def pixels(scene: SceneDescription): Vector[Int] =
    assert(scene.errors.isEmpty && scene.warnings.isEmpty, scene.errors ++ scene.warnings)
    val texture = scene.textures.head.texture
    val name = texture.param("filename").get.strings.head
    val file = texture.folder.part(name).get
    val image = ImageIO.read(ByteArrayInputStream(file.bytes()))
    Vector.tabulate(image.getHeight, image.getWidth)((y, x) => image.getRGB(x, y)).flatten

  test("lossless images keep each pixel, and lossy ones nearly"):
    assert(pixels(read(inside(sharp))) == Vector(0xffff0000, 0x8000ff00, 0xff0000ff, 0x00ffffff))
    val all = pixels(read(inside(lossy)))
    assert(all.size == 64)
    for p <- all; (shift, wanted) <- Vector(16 -> 200, 8 -> 100, 0 -> 50) do
      assert(Math.abs((p >> shift & 0xff) - wanted) <= 3)

  test("images in files of their own are read, and preferred to those of other formats"):
    TempFolder.use: folder =>
      Files.write(folder.resolve("a.webp"), Base64.getDecoder.decode(sharp)): Unit
      val both = """{"source":1,"extensions":{"EXT_texture_webp":{"source":0}}}"""
      val json = textured(both, """{"uri":"a.webp"},{"uri":"none.png"}""")
      val file = folder.resolve("model.gltf")
      Files.writeString(file, json): Unit
      val reading = ReadSettings()
      val scene = format.read(file, SceneFolder.of(file, true), reading, None)
      assert(pixels(scene).size == 4)

  test("damaged images and formats that are not read are errors with their place"):
    val bytes = Base64.getDecoder.decode(lossy)
    val random = java.util.SplittableRandom(5)
    for i <- 0 until 100 do
      val broken = bytes.clone
      for _ <- 0 to random.nextInt(4) do
        broken(12 + random.nextInt(broken.length - 12)) = random.nextInt().toByte
      val data = Base64.getEncoder.encodeToString(if i % 3 == 0 then broken.take(30) else broken)
      val errors = read(inside(data)).errors
      assert(errors.forall(_.pos.exists(_.file.endsWith("#/images/0"))), errors)
    val ktx2 = Base64.getEncoder.encodeToString(
      Array(0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb).map(_.toByte)
    )
    val problem = read(inside(ktx2)).errors.head
    assert(problem.message.contains("KTX2") && problem.help.exists(_.contains("ktxdecompress")))

  test("a texture without an image that is read is left out, with a cure"):
    val basis = """{"extensions":{"KHR_texture_basisu":{"source":0}}}"""
    val scene = read(textured(basis, """{"uri":"a.ktx2"}"""))
    assert(scene.errors.isEmpty && scene.textures.isEmpty)
    val warning = scene.warnings.find(_.message.contains("KHR_texture_basisu")).get
    assert(warning.help.exists(_.contains("ktxdecompress")))
