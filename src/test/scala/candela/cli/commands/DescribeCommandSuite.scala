package candela.cli.commands

import candela.build.Language
import candela.cli.{Captured, Main}
import candela.mitsuba.TypeReference
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class DescribeCommandSuite extends AnyFunSuite:

  private def describe(words: String): (String, String, Int) =
    val captured = Captured()
    val code =
      Main.run("describe" +: words.split(' ').toVector.filter(_.nonEmpty), captured.terminal)
    (captured.out, captured.err, code)

  private def printed(words: String): String =
    val (out, err, code) = describe(words)
    assert(err.isEmpty && code == 0, err)
    out

  private def refused(words: String): String =
    val (out, err, code) = describe(words)
    assert(out.isEmpty && code == 1)
    err

  test("without words it lists the categories"):
    val out = printed("")
    for c <- Language.categories do assert(out.contains(c.name))

  test("a category lists its types, by any of its names, in any case"):
    for words <- Vector("material", "Material", "materials") do
      val out = printed(words)
      for name <- Vector("matte", "coateddiffuse", "hair") do assert(out.contains(s"\"$name\""))
    assert(printed("light") == printed("LightSource"))
    assert(printed("surfaceintegrator").contains("\"photonmap\""))

  test("a type prints its parameters, with or without its category"):
    val out = printed("material plastic")
    assert(printed("plastic").startsWith(out))
    assert(out.startsWith("Material \"plastic\" (v2 v3): "))
    assert(out.linesIterator.exists(_.matches(" +Kd +spectrum texture +0\\.25 +v2 v3 +.*")))

  test("Mitsuba's types have Mitsuba's names, types and defaults"):
    val out = printed("roughconductor")
    assert(out.startsWith("<bsdf type=\"roughconductor\"> (mitsuba)"))
    def row(text: String, name: String) =
      text.linesIterator.find(_.trim.startsWith(s"$name ")).map(_.trim.split(" {2,}").toVector)
    assert(row(out, "alpha").contains(Vector("alpha", "float, texture", "0.1")))
    assert(row(out, "distribution").exists(r =>
      r(1).contains("beckmann|ggx") && r(2) == "beckmann"
    ))
    assert(out.linesIterator.exists(_.endsWith("https://mitsuba.readthedocs.io")))
    assert(row(out, "alpha_u").exists(_.last == "0.1") && row(out, "eta").nonEmpty)
    assert(row(
      printed("principled"),
      "roughness"
    ).contains(Vector("roughness", "float, texture", "0.5")))
    assert(row(out, "material").contains(Vector("material", "string", "none")))
    assert(row(
      printed("thindielectric"),
      "int_ior"
    ).contains(Vector("int_ior", "float, string", "bk7")))
    val sphere = printed("sphere --dialect mitsuba")
    assert(row(sphere, "radius").contains(Vector("radius", "float", "1")))
    assert(!sphere.contains("zmin"))
    assert(row(printed("hdrfilm"), "width").contains(Vector("width", "integer", "768")))
    assert(!printed("plastic --dialect v3").contains("mitsuba"))
    assert(printed("bsdf").contains("roughplastic") && printed("bsdf plastic").startsWith("<bsdf"))
    assert(refused("roughconducter").contains("did you mean `roughconductor`?"))
    assert(printed("int_ior").contains("<bsdf type=\"plastic\">"))

  test("each type of Mitsuba that is read can be described"):
    val all =
      for e <- TypeReference.elements; name <- TypeReference.types(e)
      yield TypeReference.describe(e, name)
    val without = Set("null", "catmullrom", "isotropic", "rayleigh", "vertexcolors")
    for p <- all do assert(p.parameters.isEmpty == without(p.name), p)
    for e <- TypeReference.elements; name <- TypeReference.types(e) do
      for line <- printed(s"$e $name --dialect mitsuba").linesIterator do
        assert(line.length <= 80, line)

  test("a parameter prints the types that have it"):
    val out = printed("lensradius")
    assert(out.contains("Camera \"perspective\"") && out.contains("Camera \"orthographic\""))
    assert(out.contains("radius of the aperture") && !out.contains("focaldistance"))
    assert(refused("lensradiu").contains("did you mean `lensradius`?"))

  test("a default that depends on the dialect is printed for each"):
    assert(printed("sampler stratified").contains("2 (v2), 4 (v3 v4)"))
    val v3 = printed("film image --dialect v3")
    assert(v3.contains("1280") && !v3.contains("640"))

  test("a dialect leaves out what others know"):
    val v4 = printed("material --dialect v4")
    assert(v4.contains("\"diffuse\"") && !v4.contains("\"matte\""))
    assert(refused("matte --dialect v4").contains("unknown type `matte` in v4"))

  test("what is not supported says what is done instead"):
    def unwrapped(words: String) = printed(words).replaceAll("\\s+", " ")
    assert(unwrapped("trianglemesh").contains("not supported: tangents follow uv"))
    assert(unwrapped("igi").contains("Substituted: using \"path\""))
    assert(unwrapped("accelerator bvh").contains("no effect: Candela builds its own BVH"))

  test("the page lists what is substituted, each type with what takes its place"):
    val page = printed("--markdown")
    val list = page.drop(page.indexOf("## What is substituted"))
    val rows = list.linesIterator.takeWhile(!_.startsWith("## Shape")).toVector
    assert(rows.exists(_.startsWith("| Accelerator | `kdtree` | v2 v3 v4 | using \"bvh\"")))
    assert(rows.exists(_.startsWith("| Sampler \"halton\" | `samplepixelcenter` | v3 | samples")))
    assert(rows.exists(r => r.contains("`igi`") && r.contains("virtual point lights")))
    assert(!rows.exists(_.contains("`bvh` |")))

  test("a name in several categories is described in each"):
    val out = printed("mix")
    assert(out.contains("Material \"mix\"") && out.contains("\"float\" \"mix\""))
    assert(!printed("texture mix").contains("Material"))

  test("near misses are suggested"):
    assert(refused("plastc").contains("did you mean `plastic`?"))
    assert(refused("materail").contains("did you mean `Material`?"))
    assert(refused("camera persp").contains("did you mean `perspective`?"))
    assert(refused("material sphere").contains("unknown material `sphere`"))
    assert(refused("a b c").contains("a category, a type, or both"))

  test("no line is wider than the terminal"):
    for words <- Vector("", "material", "uber", "option", "imagemap", "integrator") do
      for line <- printed(words).linesIterator do assert(line.length <= 80, line)

  test("docs/REFERENCE.md says what the tables say"):
    val anew = "./sbt \"run describe --markdown --outfile docs/REFERENCE.md\""
    val committed = Files.readString(Path.of("docs/REFERENCE.md"))
    assert(committed == printed("--markdown"), s"; make it anew with $anew")

  test("the reference can go to a file"):
    TempFolder.use: folder =>
      val file = folder.resolve("reference.md")
      assert(printed(s"--markdown --outfile $file").isEmpty)
      assert(Files.readString(file) == printed("--markdown"))

  test("it replaces no image and no scene"):
    TempFolder.use: folder =>
      for name <- Vector("p.exr", "p.film", "p.pbrt", "p.gltf") do
        val file = Files.writeString(folder.resolve(name), "kept")
        assert(refused(s"--markdown -o $file").contains("; describe writes text [E0106]"))
        assert(Files.readString(file) == "kept")
