package candela

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** The floors of docs/ARCHITECTURE.md, kept true; and each rule seen to fail where it should. */
class ArchitectureSuite extends AnyFunSuite:
  private lazy val core = SourceText.under(Path.of("src/core/scala/candela"))
  private lazy val main = core ++ SourceText.under(Path.of("src/main/scala/candela")) ++
    SourceText.under(Path.of("bench/src/main/scala/candela")) ++
    SourceText.under(Path.of("models/src/main/scala/candela")) ++
    SourceText.under(Path.of("assimp/src/main/scala/candela"))
  private lazy val cluster = SourceText.under(Path.of("cluster/src/main/scala/candela"))
  private lazy val tests = SourceText.under(Path.of("src/test/scala/candela"))

  private def holds(wrong: Vector[String]): Assertion =
    assert(wrong.isEmpty, wrong.mkString("\n", "\n", "\n"))

  private def planted(path: String, lines: String*) =
    Vector(SourceText(path, lines.mkString("\n")))

  test("every package has its floor, and every floor its package"):
    holds(Architecture.packages(main))
    assert(main.flatMap(Architecture.home).toSet == Architecture.allowed.keySet)

  test("the core is the two towers, the bridge, the job and the library on top, and all of them"):
    val towers = Architecture.runtime ++ Architecture.file ++ Architecture.bridge
    val others = Set("measure", "mitsuba", "job", "api")
    assert(core.flatMap(Architecture.home).toSet == towers.toSet ++ others)

  test("every use points to a lower floor"):
    holds(Architecture.floors(main))

  test("libraries stay behind the package they serve, and base uses none"):
    holds(Architecture.foreign(main))

  test("only cli prints and exits"):
    holds(Architecture.prints(main))

  test("only render makes threads"):
    holds(Architecture.threads(main))

  test("only WholeFile writes files"):
    holds(Architecture.writes(main))

  test("texts are the same in all countries"):
    holds(Architecture.locales(main.filterNot(_.path.startsWith("bench/")) ++ cluster))
    for line <- Vector("f\"$n%03d\"", "\"%.3f\".format(x)", "name.toLowerCase", "a.toUpperCase()")
    do
      assert(Architecture.locales(planted("io/Npz.scala", line)).size == 1, line)

  test("only SceneFolder opens the files that a scene names"):
    holds(Architecture.reads(main))

  test("no class of build has the name of one of the runtime"):
    holds(Architecture.names(main))

  test("no constant that is a number has a function word as its name"):
    holds(Architecture.constants(main ++ cluster) ++ Architecture.declarations(main ++ cluster))

  test("what a mutable class overwrites is typed as mutable"):
    holds(Architecture.scratch(main))

  test("what wraps a BSDF, a material or a light loses nothing that is known of it"):
    holds(Architecture.wrappers(core))

  test("no file and no line is too long, in tests neither"):
    holds(Architecture.sizes(main) ++ Architecture.sizes(tests))

  test("docs/ARCHITECTURE.md names the same floors in the same order"):
    val page = Files.readString(Path.of("docs/ARCHITECTURE.md")).split("\\s+").mkString(" ")
    val towers = Vector(Architecture.runtime, Architecture.file, Architecture.bridge)
    for tower <- towers ++ Vector(Architecture.program, Architecture.bench) do
      assert(page.contains(tower.mkString(" ")), tower)

  test("a package without a floor, and one that lies about its name, are found"):
    assert(
      Architecture.packages(planted("utils/Misc.scala", "package candela.utils")) ==
        Vector("utils/Misc.scala:1: `utils` has no floor in docs/ARCHITECTURE.md")
    )
    for text <- Vector("package candela.accel", "package candela\npackage bsdf", "class Lambert") do
      assert(
        Architecture.packages(planted("bsdf/Lambert.scala", text)) ==
          Vector("bsdf/Lambert.scala:1: must say `package candela.bsdf`, once"),
        text
      )
    val loose = Architecture.packages(planted("Loose.scala", "package candela"))
    assert(loose == Vector("Loose.scala:1: must say `package candela.<its folder>`, once"))

  test("an import of a higher floor, of the other tower or of cli is found"):
    def bsdf(line: String) =
      Architecture.floors(planted("bsdf/Lambert.scala", "package candela.bsdf", "", line))
    def wrong(used: String) = Vector(s"bsdf/Lambert.scala:3: bsdf may not use $used")
    assert(bsdf("import candela.lights.Light") == wrong("lights"))
    assert(bsdf("  import candela.scenefile.{Param, Parser}") == wrong("scenefile"))
    assert(bsdf("import candela.math.Vec3, candela.cli.Main") == wrong("cli"))
    assert(bsdf("import candela.measure.*") == wrong("measure"))
    assert(bsdf("import _root_.candela.build.Recipe") == wrong("build"))
    assert(bsdf("import candela.unheard.Of") == wrong("unheard"))
    assert(bsdf("import candela.math.*") == Vector.empty)

  test("a package within another has a floor of its own"):
    def wrong(path: String, line: String) =
      val name = "candela." + path.take(path.lastIndexOf('/')).replace('/', '.')
      val source = planted(path, s"package $name", line)
      Architecture.packages(source) ++ Architecture.floors(source)
    val bins = "accel/building/Bins.scala"
    assert(wrong(bins, "import candela.accel.{BinaryTree, Primitives}") == Vector.empty)
    assert(wrong("accel/tracing/Bvh.scala", "import candela.accel.building.Bins") == Vector.empty)
    assert(
      wrong(bins, "import candela.accel.tracing.{Bvh, Grid}") ==
        Vector(s"$bins:2: accel.building may not use accel.tracing")
    )
    assert(
      wrong("accel/Mask.scala", "val bins = candela.accel.building.Bins()") ==
        Vector("accel/Mask.scala:2: accel may not use accel.building")
    )
    for line <- Vector("building.Bins()", "import building.{Bins}", "import building as b") do
      assert(
        wrong("accel/Mask.scala", line) ==
          Vector("accel/Mask.scala:2: name a package of candela in full"),
        line
      )
    assert(wrong("accel/Mask.scala", "val tracing = (building.size, x.building.Y)").isEmpty)
    assert(
      Architecture.packages(planted(bins, "package candela.accel")) ==
        Vector(s"$bins:1: must say `package candela.accel.building`, once")
    )

  test("a use of a higher room of the bridge is found"):
    def lights(line: String) = Architecture.floors(planted("build/lights/A.scala", line))
    def wrong(used: String) = Vector(s"build/lights/A.scala:1: build.lights may not use $used")
    assert(lights("import candela.build.materials.Materials") == wrong("build.materials"))
    assert(lights("val p: candela.build.integrators.Plan") == wrong("build.integrators"))
    assert(lights("import candela.build.{SceneBuilder, materials}") == wrong("build"))
    assert(lights("import candela.build.*") == wrong("build"))
    assert(lights("import candela.cli.Main") == wrong("cli"))
    assert(lights("import candela.build.shapes.Shapes, candela.lights.Light").isEmpty)
    val bsdf = planted("bsdf/A.scala", "import candela.build.recipe.Recipe")
    assert(Architecture.floors(bsdf) == Vector("bsdf/A.scala:1: bsdf may not use build.recipe"))

  test("a name that build and the runtime both use is found"):
    val mirror = planted("bsdf/Mirror.scala", "final class Mirror(r: Rgb)", "class Smooth")
    def beside(line: String) =
      Architecture.names(mirror ++ planted("build/materials/M.scala", "", line))
    val wrong = "build/materials/M.scala:2: `Mirror` is the name of a class of the runtime, too"
    assert(beside("object Mirror extends MaterialRecipe(1)") == Vector(wrong))
    assert(beside("private[build] final case class Mirror(x: Int)") == Vector(wrong))
    assert(beside("object MirrorRecipe // object Mirror").isEmpty)

  test("a number whose name is a function word is found"):
    def constants(line: String) = Architecture.constants(planted("film/A.scala", "", line))
    def wrong(name: String) = Vector(s"film/A.scala:2: `$name` does not say what it counts")
    assert(constants("  private inline val Most = 3") == wrong("Most"))
    assert(constants("  val Least: Long = 1 << 16") == wrong("Least"))
    assert(constants("  final val Patience = -.5") == wrong("Patience"))
    for (name, usual) <- Vector("MostRays" -> "MaxRays", "FewestRuns" -> "MinRuns") do
      assert(constants(s"  val $name: Long = Rays / 2") ==
        Vector(s"film/A.scala:2: `$name` is usually `$usual`"))
    for line <- Vector("val MaxDepth = 3", "val Most = Depth(3)", "val most = 3", "// val Few = 3")
    do assert(constants(line).isEmpty, line)

  test("a declaration whose name is a function word is found, usual terms are not"):
    def declarations(line: String) = Architecture.declarations(planted("film/A.scala", "", line))
    def wrong(name: String) = Vector(s"film/A.scala:2: `$name` does not say what it is")
    assert(declarations("  val found = 3") == wrong("found"))
    assert(declarations("  private inline def most: Int = 3") == wrong("most"))
    assert(declarations("  @volatile var made = 0") == wrong("made"))
    for line <- Vector("val mean = 3", "def of(x: Int) = 3", "hit(found)", "// val found = 3")
    do assert(declarations(line).isEmpty, line)

  test("a use by full name is found"):
    val source = planted("scenefile/A.scala", "val s: candela.shapes.Shape = x // candela.render")
    assert(
      Architecture.floors(source) == Vector("scenefile/A.scala:1: scenefile may not use shapes")
    )

  test("imports that hide the package are found"):
    for line <- Vector("import candela.*", "import candela.{math, cli}", "import candela as c") do
      assert(
        Architecture.floors(planted("color/Rgb.scala", line)) ==
          Vector("color/Rgb.scala:1: name a package of candela in full")
      )

  test("measure may use images but no renderer"):
    val imports = Vector("import candela.image.Image", "import candela.film.Film")
    val source = planted("measure/M.scala", imports*)
    assert(Architecture.floors(source) == Vector("measure/M.scala:2: measure may not use film"))

  test("a library outside its package is found, and any in base"):
    def foreign(path: String, line: String) = Architecture.foreign(planted(path, line))
    val lwjgl = "import org.lwjgl.stb.STBImage"
    assert(foreign("image/Png.scala", lwjgl) == Vector.empty)
    assert(foreign("measure/T.scala", lwjgl).nonEmpty)
    assert(
      foreign("base/Loop.scala", lwjgl) ==
        Vector("base/Loop.scala:1: base may not use the library `org.lwjgl`")
    )
    assert(
      foreign("accel/building/B.scala", "import jdk.incubator.vector.FloatVector") ==
        Vector("accel/building/B.scala:1: accel.building may not use the library `jdk`")
    )
    assert(
      foreign("render/R.scala", "import com.example.Json") ==
        Vector("render/R.scala:1: render may not use the library `com`")
    )
    assert(
      foreign("base/Loop.scala", "  val png = org.lwjgl.stb.STBImage.load(x)") ==
        Vector("base/Loop.scala:1: base may not use the library `org.lwjgl`")
    )
    assert(foreign("base/Loop.scala", "  import Loop.start; import java.io.File").isEmpty)

  test("printing and exiting outside cli are found, but not where they are only spoken of"):
    def lines(path: String)(lines: String*) = Architecture.prints(planted(path, lines*))
    val bad = Vector(
      "println(x)",
      "System.out.write(1)",
      "System.err.flush()",
      "Console.print(x)",
      "sys.exit(1)",
      "System.exit(2)",
      "Runtime.getRuntime.halt(3)",
      "e.printStackTrace()"
    )
    for line <- bad do
      val found = lines("film/Film.scala")(line)
      assert(found.size == 1 && found.head.startsWith("film/Film.scala:1: only cli may"), line)
      assert(lines("cli/Main.scala")(line).isEmpty, line)
    assert(
      lines("film/Film.scala")(
        "// println(x)",
        "/** Never calls",
        "  * System.exit(1)",
        "  */",
        "val a = \"sys.exit(1)\"",
        "val b = '\"'",
        "val c = 1 // \"",
        "def blueprint(n: Int) = n"
      ).isEmpty
    )

  test("code behind comments and literals is still read"):
    val lines = Vector("val a = '\"'; println(a) // '\"'", "/* ok */ sys.exit(0)")
    val source = planted("film/Film.scala", lines*)
    assert(Architecture.prints(source).size == 2)

  test("threads outside render are found"):
    val bad = Vector(
      "val t = Thread(() => work())",
      "val t = Thread: () =>",
      "final class Mine extends Thread",
      "Thread.ofVirtual().start(x)",
      "Executors.newFixedThreadPool(2)",
      "val f = Future(1)",
      "val local = ThreadLocal.withInitial(() => 1)",
      "items.parallelStream",
      "stream.parallel()"
    )
    for line <- bad do
      val found = Architecture.threads(planted("accel/Bvh.scala", line))
      assert(found.size == 1 && found.head.startsWith("accel/Bvh.scala:1: only render may"), line)
      assert(Architecture.threads(planted("render/Workers.scala", line)).isEmpty, line)
    assert(Architecture.threads(planted("accel/Bvh.scala", "val parallel = d.x == 0f")).isEmpty)

  test("files written outside WholeFile are found, but not those read"):
    val bad = Vector(
      "Files.write(path, bytes)",
      "val _ = Files.writeString(path, text, UTF_8)",
      "Using.resource(Files.newOutputStream(path))(_.write(1))",
      "Files.move(a, b)",
      "Files.copy(a, b)",
      "new FileOutputStream(file)",
      "java.io.PrintWriter(name)",
      "RandomAccessFile(file, \"rw\")",
      "FileChannel.open(path, StandardOpenOption.WRITE)",
      "import java.nio.file.StandardOpenOption.{CREATE, WRITE}",
      "ImageIO.write(picture, name, file)"
    )
    for line <- bad do
      val found = Architecture.writes(planted("cli/Reporting.scala", line))
      val rule = "cli/Reporting.scala:1: only WholeFile may write files, but here is"
      assert(found.size == 1 && found.head.startsWith(rule), line)
      assert(Architecture.writes(planted("io/WholeFile.scala", line)).isEmpty, line)
    for line <- Vector(
        "Files.readAllBytes(path)",
        "FileChannel.open(path, StandardOpenOption.READ)",
        "FileOutputStream(FileDescriptor.out)"
      )
    do assert(Architecture.writes(planted("cli/Reporting.scala", line)).isEmpty, line)

  test("files opened beside the scene's folder are found"):
    val bad = Vector(
      "Files.readAllBytes(path)",
      "if Files.exists(path) then 1",
      "FileChannel.open(path, StandardOpenOption.READ)",
      "new java.io.File(name)",
      "java.io.FileInputStream(name)",
      "scala.io.Source.fromFile(name)",
      "ImageFiles.read(path)",
      "Source.read(InputFile.asked(path))"
    )
    for line <- bad; home <- Vector("build/recipe", "mitsuba", "scenefile", "convert", "lights") do
      val found = Architecture.reads(planted(s"$home/A.scala", line))
      val rule = s"$home/A.scala:1: only SceneFolder may open what a scene names, but here is"
      assert(found.size == 1 && found.head.startsWith(rule), s"$line in $home: $found")
    for line <- Vector("ImageFiles.load(file)", "folder.find(name, at)", "SceneFiles.of(scene)") do
      assert(Architecture.reads(planted("build/recipe/A.scala", line)).isEmpty, line)
    assert(Architecture.reads(planted("cli/A.scala", bad.head)).isEmpty)

  test("vectors that are overwritten, but typed as if they were not, are found"):
    def inside(doc: String, lines: String*) = Architecture.scratch(planted(
      "film/A.scala",
      s"/** $doc */" +: "private[film] final class A(scene: Scene):" +: lines.map("  " + _)*
    ))
    val bad = Vector(
      "var p, n: Vec3 = Vec3.Zero" -> "A overwrites `p, n`: a MutableVec3 says so",
      "private var normal = Vec3.Z" -> "A overwrites `normal`: a MutableVec3 says so",
      "def n: Vec3 = normal" -> "A may overwrite `normal`, which `n` is",
      "final def wi: Vec3 = sample.wi" -> "A may overwrite `sample.wi`, which `wi` is",
      "def from: Vec3 = if n.isZero then p else offset(p)" -> "A may overwrite `p`",
      "def side(i: Int): Vec3 =\n    own.set(i)\n    own" -> "A may overwrite `own`",
      "def to: Vec3 =\n    if a then Vec3.Z\n    else\n      b.set(1)\n      b" ->
        "A may overwrite `b`"
    )
    for
      doc <- Vector("A path. Mutable, one per worker.", "A hit; mutable.", "Mutable.")
      (line, wrong) <- bad
    do
      val found = inside(doc, "", line)
      assert(found.size == 1 && found.head.startsWith(s"film/A.scala:4: $wrong"), s"$line: $found")
      assert(inside("A hit. Immutable.", line).isEmpty, line)
    val good = Vector(
      "private val normal = MutableVec3()",
      "def n: MutableVec3 = normal",
      "def origin: Vec3 = Vec3(ox, oy, oz)",
      "def n: Vec3 = normal.toVec3",
      "def n: Vec3 = toOutput(normal.facing(wo))\n  def faces: Vec3 = if b then n else -n",
      "def turned(w: Vec3): Vec3 = if b then w else -w",
      "def walk() =\n    var from = Vec3.Zero\n    from"
    )
    for line <- good do assert(inside("A path. Mutable.", line).isEmpty, line)

  test("wrappers that lose flags are found"):
    def inside(lines: String*) = Architecture.wrappers(planted("bsdf/A.scala", lines*))
    def wrong(name: String) = Vector(s"bsdf/A.scala:1: A loses the flags of `$name`")
    val flags = "  def flags: BsdfFlags = BsdfFlags.Glossy"
    assert(inside("final class A(inner: Bsdf) extends LeanBsdf:", flags) == wrong("inner"))
    assert(inside("class A(a: Bsdf, b: Bsdf) extends WrappedBsdf(a):", flags) == wrong("b"))
    assert(inside("class A(", "    x: F = F(1),", "    m: Material", ") extends Material,",
      "      Textured(x):", flags) == wrong("m"))
    assert(inside("class A(light: SurfaceLight) extends SurfaceLight:", flags) == wrong("light"))
    val after = "class B(inner: Bsdf) extends Bsdf:\n  def flags: BsdfFlags = inner.flags"
    assert(inside("class A(inner: Bsdf) extends Bsdf:", flags, after) == wrong("inner"))
    assert(inside(after).isEmpty)
    assert(inside("class A(a: Material, b: Material) extends JoinedMaterial(a, b):", flags).isEmpty)
    assert(inside("class A(base: Bsdf):", "  val b = base").isEmpty)

  test("long files and long lines are found, counting characters and not bytes"):
    val exact = Vector.fill(Architecture.MaxLines)("π" * Architecture.MaxColumns)
    assert(Architecture.sizes(planted("math/A.scala", exact*)).isEmpty)
    assert(
      Architecture.sizes(planted("math/A.scala", exact :+ ("x" * 101)*)) ==
        Vector(
          "math/A.scala:401: 401 lines are more than 400",
          "math/A.scala:401: 101 columns are more than 100"
        )
    )
