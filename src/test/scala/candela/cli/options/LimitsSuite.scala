package candela.cli.options

import candela.diagnostics.{Allowance, Limit, Refusal, SourcePos}
import candela.io.SceneFolder
import java.nio.file.{Files, Path}

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.build.SceneBuilder
import candela.cli.Captured
import candela.cli.terminal.ExitCode
import candela.image.{Image, ImageFiles}
import candela.mitsuba.MitsubaScene
import candela.scenefile.Parser
import candela.testing.{Gzip, TempFolder}

/** What a scene may use has limits, each with a message. */
class LimitsSuite extends AnyFunSuite:
  import LimitsSuite.*

  private def refused(limit: String, expected: String, at: String = "s.pbrt:")(
      files: (String, String)*
  ): Assertion = TempFolder.use: folder =>
    for (name, text) <- files do Files.writeString(folder.resolve(name), text): Unit
    refused(folder, files.head._1, limit, expected, at)

  /** Refused by the limit, and not without. */
  private def refused(folder: Path, name: String, limit: String, expected: String, at: String) =
    val scene = folder.resolve(name).toString
    val (code, captured) = Captured.run("check", "--limit", limit, scene)
    assert(code == 1 && captured.err.contains(expected), s"$limit: ${captured.err}")
    assert(captured.err.contains(at), captured.err)
    assert(captured.err.contains(s"--limit ${limit.takeWhile(_ != '=')}=N"), captured.err)
    val word = limit.takeWhile(_ != '=')
    val free = Captured.run("check", "--sandbox", "--limit", s"$word=none", scene)
    assert(free._1 == 0, free._2.err)

  test("files: each counts once, however often it is read"):
    val include = "Include \"a.pbrt\"\n"
    val files = Vector("a", "b", "c").map(n => s"$n.pbrt" -> "Shape \"sphere\"\n")
    refused("files=2", "`c.pbrt` is file number 3; at most 2 are allowed", "s.pbrt:8:9")(
      ("s.pbrt" -> scene(s"$include${include}Include \"b.pbrt\"\nInclude \"c.pbrt\"\n")) +: files*
    )

  test("files: of Mitsuba's scenes, too"):
    val part = "<scene version=\"3.0.0\"/>"
    val body = "<include filename=\"a.xml\"/><include filename=\"b.xml\"/>"
    refused("files=1", "`b.xml` is file number 2", "s.xml:")(
      "s.xml" -> xml(body),
      "a.xml" -> part,
      "b.xml" -> part
    )

  test("bytes: includes, images and meshes are read no further"):
    val comment = "# " + "x" * 5000 + "\n"
    refused("bytes=4kB", "bytes are read; at most 4000 are allowed")(
      "s.pbrt" -> scene("Include \"a.pbrt\"\n"),
      "a.pbrt" -> comment
    )
    TempFolder.use: folder =>
      val texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.png\"\n"
      val _ = Files.writeString(folder.resolve("s.pbrt"), scene(texture))
      ImageFiles.write(folder.resolve("t.png"), Image.rgb(200, 200))
      val size = Files.size(folder.resolve("t.png"))
      refused(folder, "s.pbrt", s"bytes=${size - 1}", s"with `t.png`", "s.pbrt:")

  test("bytes: a gzip bomb counts as what it unpacks to"):
    TempFolder.use: folder =>
      val packed = Gzip.of(("# " + "x" * 998 + "\n").repeat(3000).getBytes)
      val _ = Files.write(folder.resolve("a.pbrt.gz"), packed)
      assert(packed.length < 100_000)
      val _ = Files.writeString(folder.resolve("s.pbrt"), scene("Include \"a.pbrt.gz\"\n"))
      refused(folder, "s.pbrt", "bytes=2MB", "with `a.pbrt.gz`", "s.pbrt:5:9")

  test("triangles: those of subdivisions, displacements, curves and objects"):
    val tetrahedron = "\"integer indices\" [0 1 2 0 2 3 0 3 1 1 3 2] " +
      "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1]"
    val cases = Vector(
      s"Shape \"loopsubdiv\" \"integer levels\" 5 $tetrahedron" -> "makes 4096 triangles",
      s"Shape \"trianglemesh\" $tetrahedron\n".repeat(300) -> "there are 1004 triangles",
      "Shape \"sphere\"\n".repeat(1100) -> "there are 1001 triangles and other shapes",
      "LightSource \"point\"\n".repeat(1100) -> "there are 1100 triangles",
      ("ObjectBegin \"o\" Shape \"sphere\" ObjectEnd\n" +
        "ObjectInstance \"o\" Translate 1 0 0\n".repeat(1100)) -> "triangles and other shapes",
      "Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 1] \"float splitdepth\" 11" ->
        "a curve of 2048 segments"
    )
    for (world, expected) <- cases do
      refused("triangles=1000", expected)("s.pbrt" -> scene(world + "\n"))

  test("triangles: displaced meshes are refined no further"):
    val ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" +
      "property float z\nproperty float u\nproperty float v\n" +
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
      "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
    val world = "Texture \"d\" \"float\" \"constant\"\nShape \"plymesh\" \"string filename\" " +
      "\"a.ply\" \"texture displacement\" \"d\" \"float edgelength\" 0.01\n"
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("s.pbrt"), scene(world)).toString
      val _ = Files.writeString(folder.resolve("a.ply"), ply)
      val (code, captured) = Captured.run("check", "--limit", "triangles=1000", file)
      assert(code == 1 && captured.err.contains("makes more than 1000 vertices"), captured.err)
      assert(Captured.run("check", "--sandbox", file)._1 == 0)

  test("pixels: of the film with its layers, and of each image that is read"):
    val plain = scene("", "\"integer xresolution\" 100 \"integer yresolution\" 100")
    refused("pixels=9999", "an image of 100×100 pixels; at most 9999 are allowed", ":1:")(
      "s.pbrt" -> plain
    )
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("s.pbrt"), plain).toString
      val image = folder.resolve("o.exr").toString
      val words = Vector("--limit", "pixels=20000", "--outfile", image, file)
      val (code, captured) = Captured.run((words ++ Vector("--aov", "depth,normal"))*)
      assert(code == 1 && captured.err.contains("100×100 pixels in 3 layers"), captured.err)
      assert(Captured.run((words ++ Vector("--cropwindow", "0,0.1,0,0.1"))*)._1 == 0)
      val texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"FILE\"\n"
      for kind <- Vector("png", "exr", "qoi", "tga", "pfm") do
        ImageFiles.write(folder.resolve(s"t.$kind"), Image.rgb(300, 200))
        val name = s"s-$kind.pbrt"
        val _ = Files.writeString(
          folder.resolve(name),
          scene(texture.replace("FILE", s"t.$kind"), Small)
        )
        val expected = s"`t.$kind` has 300×200 pixels; at most 59999 are allowed"
        refused(folder, name, "pixels=59999", expected, s"$name:5:")

  test("depth: of includes, of paths, and of what is composed"):
    val files = (1 to 5).map(i => s"$i.pbrt" -> s"Include \"${i + 1}.pbrt\"\n") :+ ("6.pbrt" -> "")
    val nested = ("s.pbrt" -> scene("Include \"1.pbrt\"\n")) +: files
    refused("depth=3", "includes are nested 4 deep; at most 3 are allowed", "3.pbrt:1:9")(
      nested*
    )
    refused("depth=50", "paths of 51 scattering events", "s.pbrt:4:")(
      "s.pbrt" -> scene("")
        .replace("WorldBegin", "Integrator \"path\" \"integer maxdepth\" 51\nWorldBegin")
    )

  test("depth: paths that Mitsuba does not limit end there"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("s.xml"), xml("<integrator type=\"path\"/>"))
      val (code, captured) =
        Captured.run("check", "--explain", "--limit", "depth=77", file.toString)
      assert(code == 0 && captured.out.contains("77"), captured.out + captured.err)

  test("samples have a limit"):
    val many = scene("").replace("\"integer pixelsamples\" 1", "\"integer pixelsamples\" 65537")
    refused("samples=65536", "65537 samples per pixel; at most 65536 are allowed", ":2:9")(
      "s.pbrt" -> many
    )
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("s.pbrt"), many).toString
      assert(Captured.run("check", "--sandbox", file)._1 == 1)

  test("samples: a goal ends at the limit, with its image, also of a film"):
    TempFolder.use: folder =>
      val lit = scene("LightSource \"infinite\"\nTranslate 0 0 3\nShape \"sphere\"\n", Small)
        .replace("\"integer pixelsamples\" 1", "\"integer pixelsamples\" 16")
      val file = Files.writeString(folder.resolve("s.pbrt"), lit).toString
      val (image, film) = (folder.resolve("o.exr").toString, folder.resolve("o.film").toString)
      def rendered(words: String*) =
        val (code, captured) = Captured.run(words*)
        assert(code == 0, captured.err)
        captured.out + captured.err
      val goal = Vector("--error", "1e-7%", "--time", "20s")
      val limit = Vector("--sandbox", "--limit", "samples=8")
      val said = rendered((Vector(file, "-o", image) ++ goal ++ limit)*)
      assert(said.contains(", 8 spp, ") && said.contains("; ended by --limit samples"), said)
      assert(said.contains(
        "all 8 samples per pixel are taken [E1104]\n --limit allows no more: samples=N"
      ))
      assert(said.contains("[E1104]"), said)
      rendered(file, "--spp", "4", "--sampler", "progressive", "-o", image, "--checkpoint", film)
      val resumed = rendered((Vector("resume", film) ++ goal ++ limit)*)
      assert(resumed.contains(", 8 spp (4 in this run), "), resumed)
      assert(resumed.contains("; ended by --limit samples"), resumed)
      val preview = rendered((Vector("preview", file, "-o", s"$folder/p.png") ++ limit)*)
      assert(preview.contains(", 8 spp, "), preview)
      val (code, refused) = Captured.run((Vector(file, "-o", image, "--spp", "9") ++ limit)*)
      assert(code == 1 && refused.err.contains("9 samples per pixel; at most 8"), refused.err)

  test("time: a rendering ends with an error and without an image; its checkpoint is kept"):
    TempFolder.use: folder =>
      val long = scene("LightSource \"infinite\"\nShape \"sphere\"\n")
        .replace("\"integer pixelsamples\" 1", "\"integer pixelsamples\" 60000")
      val file = Files.writeString(folder.resolve("s.pbrt"), long).toString
      val (image, film) = (folder.resolve("o.exr"), folder.resolve("o.film"))
      val before = Files.writeString(image, "before")
      // The whole rendering takes hours, and would replace the image
      val (code, captured) =
        Captured.run(file, "--limit", "time=0.5s", "--outfile", s"$image", "--checkpoint")
      assert(code == 1 && captured.err.contains("the time limit of 0.5 s is reached"), captured.err)
      assert(Files.readString(before) == "before" && Files.exists(film))

  test("time: the statement that is read, or built, is named"):
    TempFolder.use: folder =>
      val over = Allowance(Map(Limit.Time -> 90_000L), endsAt = Some(System.nanoTime))
      def place(body: => Any): Option[SourcePos] =
        val refusal = intercept[Refusal](body)
        assert(refusal.problem.message.contains("the time limit of 90 s is reached"))
        refusal.problem.pos
      val world = scene("Shape \"sphere\"\n")
      for (name, text) <- Vector("s.pbrt" -> world, "s.xml" -> xml("<shape type=\"sphere\"/>")) do
        val file = Files.writeString(folder.resolve(name), text)
        val within = SceneFolder.of(file, allowance = over)
        val read =
          if name == "s.xml" then
            place(MitsubaScene.readable(file, Map.empty, keepGoing = false, Some(within)))
          else place(Parser.readable(file, None, keepGoing = false, within = Some(within)))
        assert(read.map(_.toString).contains(s"$file:1:1"), "nothing but the file is read yet")
      val late = Parser.parseText("s.pbrt", world, folder)
        .copy(folder = SceneFolder.of(folder.resolve("s.pbrt"), allowance = over))
      val built = place(SceneBuilder.build(late))
      assert(built.exists(at => at.file == "s.pbrt" && at.line > 0), built)

  test("bytes: the line at which a scene's own file is too long is named"):
    val comment = "# " + "x" * 300_000
    refused("bytes=200kB", "with `s.pbrt`, ", "s.pbrt:3:")(
      "s.pbrt" -> scene("").replace("\nCamera", s"\n$comment\nCamera")
    )

  test("time: reading and building end, too"):
    TempFolder.use: folder =>
      // No machine reads a megabyte within a thousandth of a second
      val spheres = "Shape \"sphere\"\n".repeat(70_000)
      val file = Files.writeString(folder.resolve("s.pbrt"), scene(spheres))
      val (code, captured) = Captured.run("check", "--limit", "time=0.001s", file.toString)
      assert(code == 1 && captured.err.contains("limit of 0.001 s is reached"), captured.err)

  test("the option takes units, several limits and `none`, and names what it does not know"):
    def limits(words: String*) =
      CommandLine.parse(Vector("check") ++ words :+ "s.pbrt").fold(
        answer => fail(answer.err),
        _.control.limits.effective
      )
    assert(limits() == Map.empty)
    assert(limits("--sandbox") == Limit.values.map(l => l -> l.inSandbox).toMap)
    assert(
      limits("--limit", "bytes=2GB,files=7", "--limit", "time=2m,bytes=1GiB,triangles=1.5M") == Map(
        Limit.Bytes -> (1L << 30),
        Limit.Files -> 7L,
        Limit.Time -> 120_000L,
        Limit.Triangles -> 1_500_000L
      )
    )
    assert(!limits("--sandbox", "--limit", "time=none").contains(Limit.Time))
    for (text, expected) <- Vector(
        "byte=1" -> "must be NAME=N with a NAME of files, bytes, triangles",
        "files=many" -> "must be a number, e.g. files=1000",
        "bytes=" -> "must be a size, e.g. bytes=500MB",
        "time=0" -> "must be a duration, e.g. time=90s",
        "samples=-1" -> "must be a number",
        "files=3GB" -> "must be a number"
      )
    do
      val answer = CommandLine.parse(Vector("check", "--limit", text, "s.pbrt")).left.toOption.get
      assert(answer.code == ExitCode.BadUsage && answer.err.contains(expected), answer.err)

  test("SECURITY.md and the help have the defaults"):
    val page = Files.readString(Path.of("SECURITY.md"))
    for word <- LimitTable.defaults.split(", ") do
      val Array(name, most) = word.split('='): @unchecked
      assert(page.linesIterator.exists(l => l.startsWith(s"| `$name=") && l.contains(s"| $most |")))

object LimitsSuite:
  private val Small = "\"integer xresolution\" 10 \"integer yresolution\" 10"

  private def scene(world: String, film: String = ""): String =
    s"""Film "rgb" "string filename" "o.exr" $film
       |Sampler "independent" "integer pixelsamples" 1
       |Camera "perspective"
       |WorldBegin
       |$world""".stripMargin

  private def xml(body: String): String =
    s"""<scene version="3.0.0"><sensor type="perspective"/>$body</scene>"""
