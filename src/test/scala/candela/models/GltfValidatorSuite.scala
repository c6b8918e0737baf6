package candela.models

import candela.diagnostics.Code
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import scala.util.Try

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** What Khronos' validator says of models like those of the other suites. */
class GltfValidatorSuite extends AnyFunSuite, GltfModels:
  private val script =
    """const v = require('gltf-validator'), fs = require('fs');
      |(async () => { for (const f of process.argv.slice(1)) {
      |  const r = await v.validateBytes(new Uint8Array(fs.readFileSync(f)));
      |  const e = r.issues.messages.filter(m => m.severity == 0);
      |  console.log(e.map(m => m.code + ' ' + m.pointer).join('; '));
      |} })()""".stripMargin

  private def node(code: String, files: Path*): Option[String] = Try:
    val process = ProcessBuilder(Seq("node", "-e", code) ++ files.map(_.toString)*).start()
    val out = String(process.getInputStream.readAllBytes(), "UTF-8")
    Option.when(process.waitFor() == 0)(out)
  .toOption.flatten

  /** The errors of each model, in one line. */
  private def judged(models: Seq[String]): Vector[String] =
    if node("require('gltf-validator')").isEmpty then
      cancel("node has no package gltf-validator (npm install gltf-validator; NODE_PATH)")
    TempFolder.use: folder =>
      val files = models.zipWithIndex.map: (text, i) =>
        Files.writeString(folder.resolve(s"$i.gltf"), text)
      node(script, files*).get.linesIterator.toVector

  private val png = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9" +
    "awAAAABJRU5ErkJggg=="

  private def textured(materials: String, used: String) = model(
    ""","mode":5,"material":0""",
    others = s""","materials":[$materials],"extensionsUsed":[$used],
      "textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33648}],
      "images":[{"uri":"data:image/png;base64,$png"}]"""
  )

  private def material(name: String, members: String, others: String = "") =
    s"""{"extensions":{"KHR_materials_$name":{$members}$others}}"""

  private val volume = """,
    "KHR_materials_transmission":{"transmissionFactor":1},
    "KHR_materials_volume":{"thicknessFactor":1}"""

  private def animated(path: String, interpolation: String, kind: String, values: Double*) =
    val (accessors, views, data) = arrays("SCALAR" -> floats(0, 1), kind -> floats(values*))
    val bounded = accessors.updated(0, accessors.head.dropRight(1) + ""","min":[0],"max":[1]}""")
    model(
      ""","mode":5""",
      bounded,
      views,
      data,
      others = s""","animations":[{"samplers":[
        {"input":1,"output":2,"interpolation":"$interpolation"}],
        "channels":[{"sampler":0,"target":{"node":0,"path":"$path"}}]}]"""
    )

  private val still = Seq(0.0, 0, 0, 0, 0, 0, 0, 0, 0)

  private val sound: Vector[String] = Vector(
    model(""","mode":5"""),
    animated("translation", "LINEAR", "VEC3", 0, 0, 0, 1, 0, 0),
    animated("rotation", "STEP", "VEC4", 0, 0, 0, 1, 0, 0, 1, 0),
    animated("scale", "CUBICSPLINE", "VEC3", (still ++ still)*),
    textured(
      material("iridescence", """"iridescenceFactor":1,"iridescenceThicknessMaximum":300"""),
      "\"KHR_materials_iridescence\""
    ),
    textured(
      material("dispersion", """"dispersion":0.5""", volume),
      "\"KHR_materials_dispersion\",\"KHR_materials_transmission\",\"KHR_materials_volume\""
    ),
    textured(
      material("diffuse_transmission", """"diffuseTransmissionFactor":0.5"""),
      "\"KHR_materials_diffuse_transmission\""
    ),
    model(
      ""","mode":5,"extensions":{"KHR_materials_variants":{"mappings":
        [{"material":0,"variants":[0]}]}}""",
      others = ""","materials":[{}],"extensionsUsed":["KHR_materials_variants"],
        "extensions":{"KHR_materials_variants":{"variants":[{"name":"a"}]}}"""
    )
  )

  test("what is read without a word is valid", Slow):
    for (errors, i) <- judged(sound).zipWithIndex do
      assert(errors.isEmpty, s"model $i: $errors")
      val scene = read(sound(i))
      assert(
        scene.errors.isEmpty && scene.warnings.forall(_.code == Code.SeveralWorlds),
        scene.warnings
      )

  /** Changes that break a model. */
  private val changes: Vector[(String, String)] = Vector(
    "\"count\":4" -> "\"count\":5",
    "\"count\":4" -> "\"count\":-1",
    "\"byteLength\":48}" -> "\"byteLength\":49}",
    "5126" -> "5127",
    "\"mesh\":0" -> "\"mesh\":1",
    "VEC3" -> "VEC9",
    "\"mode\":5" -> "\"mode\":7",
    "base64," -> "base64,*",
    "\"version\":\"2.0\"" -> "\"version\":\"1.0\"",
    "\"POSITION\":0" -> "\"POSITION\":\"a\"",
    "\"scene\":0" -> "\"scene\":3",
    "\"buffer\":0" -> "\"buffer\":2"
  )

  test("what is invalid is refused, with a place", Slow):
    val broken = changes.map((from, to) => model(""","mode":5""").replace(from, to))
    for ((from, to), errors) <- changes.zip(judged(broken)) do
      assert(errors.nonEmpty, s"$from → $to")
    for json <- broken do assert(error(json).startsWith("/"), error(json))
