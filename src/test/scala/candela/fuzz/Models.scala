package candela.fuzz

import candela.image.{Image, ImageFiles}

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}
import java.util.Base64
import scala.util.Random

/** Broken models in glTF: values of the JSON are replaced by hostile ones, one to four at a time;
  * some are binary, with broken chunks.
  *
  * @param folder of the files that they name
  */
private[fuzz] final class Models(folder: Path, random: Random):
  import Models.*

  private val picture: Array[Byte] =
    val file = folder.resolve("small.png")
    ImageFiles.write(file, Image.rgb(4, 4))
    Files.readAllBytes(file)
  private val sample = Sample(picture)
  Files.write(folder.resolve("whole.bin"), sample.buffer): Unit

  /** A model as text, or a binary one. */
  def next(): (Array[Byte], Boolean) =
    val model = ujson.read(sample.json)
    for _ <- 0 to random.nextInt(4) do damage(model)
    val text = written(model)
    if random.nextInt(4) > 0 then (text, false)
    else
      val binary = chunks(text)
      // The JSON is whole, so that its chunks are read
      if random.nextInt(3) == 0 then (Mutator(Vector(binary), random).bytes(), true)
      else (binary, true)

  private def one[A](choices: IndexedSeq[A]): A = choices(random.nextInt(choices.size))

  /** Texts that no JSON value has are put in place of marks. */
  private def written(model: ujson.Value): Array[Byte] =
    val text = Texts.zipWithIndex.foldLeft(model.render()):
      case (text, (raw, i)) => text.replace(s"\"$Mark$i\"", raw)
    text.getBytes(UTF_8)

  private def damage(model: ujson.Value): Unit =
    var at = model
    var depth = random.nextInt(7)
    while depth > 0 do
      depth -= 1
      inside(at).filter(v => inside(v).nonEmpty) match
        case choices if choices.nonEmpty => at = one(choices)
        case _ => depth = 0
    at match
      case o: ujson.Obj if o.value.nonEmpty =>
        val key = one(o.value.keys.toVector)
        random.nextInt(8) match
          case 0 => o.value.remove(key): Unit
          case 1 => o(one(o.value.keys.toVector)) = o(key)
          case _ => o(key) = hostile(o(key))
      case a: ujson.Arr if a.value.nonEmpty =>
        val i = random.nextInt(a.value.size)
        random.nextInt(8) match
          case 0 => a.value.remove(i): Unit
          case 1 => a.value.addAll(Vector.fill(random.nextInt(200))(a(i))): Unit
          case _ => a(i) = hostile(a(i))
      case _ => ()

  private def inside(v: ujson.Value): Vector[ujson.Value] = v match
    case o: ujson.Obj => o.value.values.toVector
    case a: ujson.Arr => a.value.toVector
    case _ => Vector.empty

  private def hostile(v: ujson.Value): ujson.Value = v match
    case _: ujson.Str if random.nextInt(3) > 0 => ujson.Str(one(Names))
    case _: ujson.Num if random.nextInt(3) > 0 =>
      if random.nextBoolean() then ujson.Num(random.nextInt(8)) else ujson.Num(one(Numbers))
    case _ =>
      random.nextInt(6) match
        case 0 => ujson.Null
        case 1 => ujson.Arr()
        case 2 => ujson.Obj()
        case 3 => ujson.Str(one(Names))
        case _ => ujson.Str(s"$Mark${random.nextInt(Texts.size)}")

  private def chunks(json: Array[Byte]): Array[Byte] =
    def length(n: Int) = if random.nextInt(8) == 0 then one(Odd.Ints) else n
    val bytes = ByteBuffer.allocate(28 + json.length + sample.buffer.length)
      .order(ByteOrder.LITTLE_ENDIAN)
    bytes.putInt(0x46546c67).putInt(2).putInt(length(bytes.capacity))
    bytes.putInt(length(json.length)).putInt(0x4e4f534a).put(json)
    bytes.putInt(length(sample.buffer.length)).putInt(0x004e4942).put(sample.buffer)
    bytes.array

private object Models:
  private val Mark = "\u2620"

  /** JSON that is none, or extreme. */
  private val Texts = Vector(
    "NaN",
    "Infinity",
    "-Infinity",
    "1e999",
    "-1e999",
    "-0",
    "1e-999",
    "0x10",
    "01",
    "tru",
    "'a'",
    "[" * 100_000,
    "[" * 2000 + "]" * 2000,
    "{\"a\":" * 3000 + "0" + "}" * 3000,
    "{\"a\":1,\"a\":2}",
    "\"\\ud800\"",
    "\"\\u0000\"",
    "9" * 5000,
    "[1,]",
    "{\"a\":1,}",
    "// a\n1",
    "\u0000",
    ""
  )

  private val Numbers = Odd.Ints.map(_.toDouble) ++ Odd.Doubles.filter(java.lang.Double.isFinite) ++
    Vector(5120, 5121, 5123, 5125, 5126, 4294967295.0, 4294967296.0, 1e18, 0.5, 66_000_000, 7e8)

  private val Names = Vector(
    "",
    "/dev/zero",
    "/dev/null",
    "../secret.bin",
    "/etc/passwd",
    "file:///etc/passwd",
    "%2e%2e/x",
    "http://localhost/a.bin",
    "data:",
    "data:;base64",
    "data:;base64,",
    "data:;base64,####",
    s"data:;base64,${"A" * 100_000}",
    "data:image/png;base64,iVBORw0KGgo=",
    "pipe",
    ".",
    "..",
    "%00",
    "a%",
    "whole.bin",
    "small.png",
    "models/broken.gltf",
    "a" * 300,
    "SCALAR",
    "MAT4",
    "VEC2",
    "BLEND",
    "MASK",
    "perspective",
    "spot",
    "\u001b[31m",
    "1.0"
  )

  /** A model that has all that is read of models. */
  private final class Sample(picture: Array[Byte]):
    val buffer: Array[Byte] =
      val bytes = ByteBuffer.allocate(600 + picture.length).order(ByteOrder.LITTLE_ENDIAN)
      Vector(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0).foreach(x => bytes.putFloat(x.toFloat))
      Vector(0, 1, 2, 0, 2, 3).foreach(i => bytes.putShort(i.toShort))
      bytes.position(64)
      for i <- 0 until 100 do bytes.putFloat(i % 5 / 4f)
      bytes.position(480)
      for i <- 0 until 16 do bytes.put((i % 2).toByte)
      bytes.position(600)
      bytes.put(picture)
      bytes.array

    private def data(bytes: Array[Byte]) =
      s"data:application/octet-stream;base64,${Base64.getEncoder.encodeToString(bytes)}"

    private def accessor(view: Int, kind: Int, count: Int, shape: String, more: String = "") =
      s"""{"bufferView":$view,"componentType":$kind,"count":$count,"type":"$shape"$more}"""

    val json: String =
      val texture = """{"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":
        |{"offset":[0.1,0.2],"scale":[2,3],"rotation":0.5,"texCoord":1}}}""".stripMargin
      val sparse = ""","sparse":{"count":2,"indices":{"bufferView":3,"componentType":5121},
        |"values":{"bufferView":2,"byteOffset":0}}""".stripMargin
      val accessors = Vector(
        accessor(0, 5126, 4, "VEC3"),
        accessor(1, 5123, 6, "SCALAR"),
        accessor(2, 5126, 4, "VEC3"),
        accessor(2, 5126, 4, "VEC2"),
        accessor(3, 5121, 4, "VEC4"),
        accessor(2, 5126, 4, "VEC4"),
        accessor(2, 5126, 2, "MAT4"),
        accessor(2, 5126, 4, "VEC3", sparse),
        s"""{"componentType":5126,"count":4,"type":"VEC3"$sparse}"""
      )
      s"""{"asset":{"version":"2.0","minVersion":"2.0"},"scene":0,
         |"extensionsUsed":["KHR_lights_punctual"],"extensionsRequired":["KHR_texture_transform"],
         |"scenes":[{"nodes":[0,1]}],
         |"nodes":[{"children":[2,3,4],"translation":[1,2,3],"rotation":[0,0,0.7,0.7],
         |"scale":[1,2,1]},
         |{"mesh":0,"skin":0,"weights":[0.5]},{"camera":0},{"mesh":0,"extensions":
         |{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2,"ROTATION":5,"SCALE":0}}}},
         |{"extensions":{"KHR_lights_punctual":{"light":0}},
         |"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,1,1,1],"children":[5]},{"mesh":1,"camera":1}],
         |"skins":[{"joints":[0,2],"inverseBindMatrices":6}],
         |"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"aspectRatio":1.5,
         |"znear":0.1}},
         |{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0,"zfar":9}}],
         |"meshes":[{"weights":[0.2],"primitives":[{"attributes":{"POSITION":0,"NORMAL":2,
         |"TANGENT":5,"TEXCOORD_0":3,"TEXCOORD_1":3,"COLOR_0":5,"JOINTS_0":4,"WEIGHTS_0":5},
         |"indices":1,"mode":4,"material":0,"targets":[{"POSITION":7,"NORMAL":8,"TANGENT":2}]},
         |{"attributes":{"POSITION":7},"mode":5,"material":1}]},
         |{"primitives":[{"attributes":{"POSITION":0},"mode":6,"material":2,"extensions":
         |{"KHR_materials_variants":{}}}]}],
         |"materials":[{"name":"a","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.4,
         |"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,0.5],"baseColorTexture":$texture,
         |"metallicFactor":0.5,"roughnessFactor":0.3,"metallicRoughnessTexture":{"index":1}},
         |"normalTexture":{"index":1,"scale":0.5},"emissiveFactor":[1,1,1],
         |"emissiveTexture":{"index":0},"extensions":{
         |"KHR_materials_emissive_strength":{"emissiveStrength":3},
         |"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.1},
         |"KHR_materials_sheen":{"sheenColorFactor":[1,0,0],"sheenRoughnessFactor":0.2},
         |"KHR_materials_anisotropy":{"anisotropyStrength":0.5,"anisotropyRotation":1},
         |"KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,1,0]},
         |"KHR_materials_ior":{"ior":1.4}}},
         |{"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},
         |"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,
         |"attenuationColor":[0.5,1,1]}}},
         |{"alphaMode":"BLEND","extensions":{"KHR_materials_pbrSpecularGlossiness":{
         |"diffuseFactor":[1,1,1,0.5],"glossinessFactor":0.5,"diffuseTexture":{"index":0}}}}],
         |"textures":[{"source":0,"sampler":0},{"source":1}],
         |"images":[{"bufferView":4,"mimeType":"image/png"},{"uri":"small.png"},
         |{"uri":"${data(picture)}"}],
         |"samplers":[{"magFilter":9728,"minFilter":9987,"wrapS":33071,"wrapT":33648}],
         |"accessors":[${accessors.mkString(",")}],
         |"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},
         |{"buffer":0,"byteOffset":64,"byteLength":400},
         |{"buffer":1,"byteOffset":480,"byteLength":16,"byteStride":4},
         |{"buffer":0,"byteOffset":600,"byteLength":${picture.length}}],
         |"buffers":[{"byteLength":${buffer.length},"uri":"${data(buffer)}"},
         |{"byteLength":${buffer.length},"uri":"whole.bin"}],
         |"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,1,0],
         |"intensity":100,"range":5,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}}]}}}"""
        .stripMargin
