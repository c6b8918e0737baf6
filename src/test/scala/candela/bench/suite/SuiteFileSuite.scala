package candela.bench.suite

import candela.diagnostics.SceneError
import candela.bench.report.Growth
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

class SuiteFileSuite extends AnyFunSuite:

  private def read(text: String): Suite =
    val file = Files.createTempFile("candela", ".conf")
    try SuiteFile.read(Files.writeString(file, text))
    finally Files.delete(file)

  private val good =
    """title = "Race"
      |samples = [4, 1]
      |seeds = 2
      |_flags = "--quiet"
      |programs {
      |  b { title = "B", command = "b "${_flags}" {scene}", reads = [v4, v3], threads = 1
      |      color = 3
      |      edits = [{ find = "spp (\\d+)", replace = "spp {spp}" }], seeded = false, thin = true }
      |  a { command = ${?NO_SUCH_VARIABLE}, reads = [v3], needs = [X] }
      |}
      |scenes {
      |  z { files { v3 = "z.pbrt" }, reference = "z.exr", target = 0.01, needs = [SOMETHING]
      |      grows { of = "knots", size = 1e3 } }
      |  y { files { v4 = "/tmp/y.pbrt" }, reference = "y.exr", seconds = [1, 2], programs = [b] }
      |}
      |""".stripMargin

  test("a suite says what it says, in the order of its file"):
    val suite = read(good)
    assert((suite.title, suite.seeds, suite.work) == ("Race", 2, Work.Samples(Vector(1, 4))))
    val Vector(b, a) = suite.programs: @unchecked
    assert(b.command == Vector("b", "--quiet", "{scene}") && b.kinds == Vector("v4", "v3"))
    assert((b.threads, b.color, b.isThin, b.isSeeded) == (1, 3, true, false))
    assert(b.edits.head.find.replaceAllIn("spp 8", b.edits.head.replacement) == "spp {spp}")
    assert(a.command.isEmpty && a.needs == Vector("X"))
    assert(a.title == "a" && a.color == 1 && a.isSeeded)
    val Vector(z, y) = suite.scenes: @unchecked
    assert(z.target.contains(0.01) && z.needs == Vector("SOMETHING") && z.work.isEmpty)
    assert(z.growth.contains(Growth("knots", 1000)) && y.growth.isEmpty)
    assert(z.files("v3").isAbsolute && z.reference.exists(_.endsWith("z.exr")))
    assert(y.files("v4") == Path.of("/tmp/y.pbrt") && y.programs.contains(Vector("b")))
    assert(y.work.contains(Work.Seconds(Vector(1, 2))))

  test("the suite of growing scenes has three sizes of each at least"):
    val scenes = SuiteFile.read(Path.of("bench/suites/growth.conf")).scenes
    val sizes = scenes.groupMap(_.growth.get.quantity)(_.growth.get.size)
    assert(sizes.size == 20 && sizes.values.forall(_.sizeIs >= 3))
    assert(sizes.values.forall(s => s.lazyZip(s.tail).forall((a, b) => b >= 3 * a)))
    assert(scenes.forall(s => s.name.endsWith(f"-${s.growth.get.size}%.0f")))
    assert(scenes.forall(s => s.files("v4").getFileName.toString == s"${s.name}.pbrt"))

  test("each edit of the repository's suites finds something in each scene that it is for"):
    val files = Using.resource(Files.list(Path.of("bench/suites")))(_.toList.asScala)
    for
      // Those without scenes have programs for others
      file <- files if Files.readString(file).contains("\nscenes {")
      suite = SuiteFile.read(file)
      scene <- suite.scenes
      program <- suite.programs
      text <- scene.file(program) if Files.isRegularFile(text)
    do
      val useless = SceneCopy.useless(text, program.edits)
      assert(useless.isEmpty, s"$file: ${program.name} on ${scene.name}")

  private val wrong = Vector(
    ("seeds = 2", "seeds = 0", "`seeds` must be at least 1"),
    (
      "command = \"b \"${_flags}\" {scene}\"",
      "command = \"b {scen}\"",
      "unknown placeholder `{scen}`"
    ),
    (
      "command = \"b \"${_flags}\" {scene}\"",
      "command = \"./{candela} {scene}\"",
      "`{candela}` must be a word of its own in program b, found `./{candela}`"
    ),
    ("replace = \"spp {spp}\"", "replace = \"spp {sp}\"", "unknown placeholder `{sp}`"),
    ("programs = [b]", "programs = [bb]", "unknown program `bb` in `programs` of scene y"),
    ("thin = true", "counterpart = aa", "unknown program `aa` in `counterpart` of program b"),
    ("samples = [4, 1]", "samples = [4, 1, 4]", "`samples` has `4` twice"),
    ("seconds = [1, 2]", "seconds = [2, 2.0]", "`seconds` has `2.0` twice"),
    ("seeds = 2", "seedz = 2", "unknown key `seedz` in the suite"),
    ("threads = 1", "treads = 1", "unknown key `treads` in program b"),
    ("target = 0.01", "tarket = 0.01", "unknown key `tarket` in scene z"),
    ("size = 1e3", "size = 0", "`size` must be greater than 0"),
    ("size = 1e3", "sizes = 1", "unknown key `sizes` in `grows` of scene z"),
    ("samples = [4, 1]", "samples = [0]", "`samples` must be at least 1"),
    ("seconds = [1, 2]", "seconds = [-1]", "`seconds` must be greater than 0"),
    ("spp (", "spp ((", "invalid regular expression"),
    ("reads = [v3], ", "", "reads"),
    ("scenes {", "scenes [", "suite")
  )

  test("a folder is a suite of its scenes of all formats, with the references that there are"):
    TempFolder.use: folder =>
      for name <- Vector("a.pbrt", "b.xml", "b.exr", "c.pbrt.gz", "d.xml", "d.pbrt", "e.ply") do
        Files.writeString(folder.resolve(name), ""): Unit
      val scenes = SuiteFolder.read(folder, folder).scenes
      assert(scenes.map(_.name) == Vector("a", "b", "c", "d.pbrt", "d.xml"))
      assert(scenes.map(_.files("scene").getFileName.toString) ==
        Vector("a.pbrt", "b.xml", "c.pbrt.gz", "d.pbrt", "d.xml"))
      assert(scenes.filter(_.reference.isDefined).map(_.name) == Vector("b"))

  test("a folder without scenes says which formats scenes have"):
    TempFolder.use: folder =>
      val e = intercept[SceneError](SuiteFolder.read(folder, folder))
      assert(e.getMessage.startsWith("no scene in"))
      assert(e.problems.head.help.exists(_.contains("Mitsuba (.xml)")))

  for (written, instead, message) <- wrong do
    test(s"`$instead` for `$written` is refused: $message"):
      assert(good.contains(written))
      val error = intercept[SceneError](read(good.replace(written, instead)))
      val said = error.problems.map(_.message).mkString
      if message == "suite" then assert(said.nonEmpty) else assert(said.contains(message))

  test("programs and scenes can be chosen, by names that there are"):
    val suite = read(good).restricted(Vector("b"), Vector("y"))
    assert(suite.programs.map(_.name) == Vector("b") && suite.scenes.map(_.name) == Vector("y"))
    val error = intercept[SceneError](read(good).restricted(Vector("c"), Vector.empty))
    assert(error.problems.head.message == "unknown program `c`")

  test("what is misspelt is told with its place and the nearest name"):
    def problem(written: String, instead: String) =
      assert(good.contains(written))
      intercept[SceneError](read(good.replace(written, instead))).problems.head
    val slips = Vector(
      ("programs {", "progams {", 5, "programs"),
      ("seeded =", "sedeed =", 8, "seeded"),
      ("spp {spp}", "spp {sp}", 8, "{spp}"),
      (" {scene}\"", " {scen}\"", 6, "{scene}"),
      ("programs = [b]", "programs = [bb]", 14, "b"),
      ("of = \"knots\"", "off = 1", 13, "of")
    )
    for (written, instead, line, meant) <- slips do
      val p = problem(written, instead)
      assert(p.help.contains(s"did you mean `$meant`?"), p)
      assert(p.pos.exists(_.line == line), p)

  test("braces that are no placeholders stay: of variables, of JSON, behind a backslash"):
    val suite = read(good.replace("spp {spp}", """spp \\{sp}""")
      .replace(" {scene}\"", """ ${HOME} {\"a\":1}""" + "\""))
    assert(suite.programs.head.command.drop(2) == Vector("${HOME}", "{\"a\":1}"))

  test("without a title, a suite has the name of its file"):
    TempFolder.use: folder =>
      val file = folder.resolve("quick.conf")
      val untitled = good.linesIterator.drop(1).mkString("\n")
      val suite = SuiteFile.read(Files.writeString(file, untitled))
      assert(suite.title == "quick" && suite.programs.map(_.name) == Vector("b", "a"))

  test("the suites of the repository can be read"):
    for name <- Vector("own", "peers", "long", "mitsuba") do
      val suite = SuiteFile.read(Path.of("bench", "suites", s"$name.conf"))
      assert(suite.programs.nonEmpty && suite.scenes.nonEmpty)
      for scene <- suite.scenes; kinds <- scene.programs.toVector.flatten do
        assert(suite.programs.exists(_.name == kinds), s"$name: ${scene.name} names $kinds")
      // What lies in the repository must be there.
      for scene <- suite.scenes if scene.needs.isEmpty; file <- scene.files.values do
        assert(Files.isRegularFile(file), file)
        assert(scene.reference.exists(Files.isRegularFile(_)), scene.reference)
