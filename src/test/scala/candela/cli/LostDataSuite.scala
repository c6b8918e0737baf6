package candela.cli

import java.io.{IOException, OutputStream, PrintStream}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.cli.files.OutputFiles
import candela.cli.terminal.{Interrupts, Terminal}
import candela.image.{Image, ImageFiles, OutputFormat}
import candela.job.Prepared
import candela.testing.TempFolder

/** No command destroys its input, takes half a file for a whole one, or loses its output. */
class LostDataSuite extends AnyFunSuite:
  import LostDataSuite.*

  test("a preview that nobody asked for does not overwrite a texture"):
    inFolder: f =>
      val before = f.bytes("tex.png")
      val (code, captured) = f.render("--spp", "1")
      assert(code == 0, captured.err)
      assert(f.bytes("tex.png") == before && Files.exists(f("tex.exr")))
      val warning = s"warning: no preview is written: `${f("tex.png")}` is an input file"
      assert(captured.err.contains(warning), captured.err)

  test("no output of a rendering is a file of its scene, by whatever name"):
    inFolder: f =>
      val link = Files.createSymbolicLink(f("link.png"), f("tex.png"))
      val hard = Files.createLink(f("hard.png"), f("tex.png"))
      val page = Files.createSymbolicLink(f("page.html"), f("part.pbrt"))
      val film = Files.createSymbolicLink(f("a.film"), f("disk.ply"))
      val log = f("s.pbrt")
      ImageFiles.write(f("r.exr"), Image.rgb(4, 4))
      val outputs = Vector(
        Vector("--outfile", f.name("tex.png")) -> f("tex.png"),
        Vector("--outfile", s"${f.name("new.exr")},${f.name(".")}/tex.png") -> f("./tex.png"),
        Vector("--outfile", link.toString) -> link,
        Vector("--outfile", hard.toString) -> hard,
        Vector("--outfile", f.name("o.exr"), "--report", page.toString) -> page,
        Vector("--outfile", f.name("o.exr"), "--checkpoint", film.toString) -> film,
        Vector("--outfile", film.toString) -> film,
        Vector("--outfile", f.name("o.exr"), "--mse-reference-image", f.name("r.exr")) ++
          Vector("--mse-reference-out", log.toString) -> log,
        Vector("--outfile", f.name("r.exr"), "--denoise", "--reference", f.name("r.exr")) ->
          f("r.exr")
      )
      val before = f.all
      for (words, file) <- outputs do
        val (code, captured) = f.render(words*)
        val message = s"`$file` is an input file; refusing to overwrite it"
        assert(code == 1 && captured.err.contains(message), s"$words ${captured.err}")
        assert(f.all == before, words)

  test("a Film that names its own texture is refused: the scene would render only once"):
    inFolder: f =>
      val _ = Files.writeString(f("s.pbrt"), scene(f.name("tex.png")))
      val (code, captured) = f.render()
      assert(code == 1 && captured.err.contains("refusing to overwrite it"))

  test("a spectrum of a Mitsuba scene is a file of the scene, too"):
    inFolder: f =>
      val _ = Files.writeString(f("lamp.exr"), "400 1\n700 2\n")
      val text = """<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant">
        |<spectrum name="radiance" filename="lamp.exr"/></emitter></scene>""".stripMargin
      val scene = Files.writeString(f("m.xml"), text)
      val (code, captured) = Captured.run(scene.toString, "--outfile", f.name("lamp.exr"))
      assert(code == 1 && captured.err.contains("refusing to overwrite it"), captured.err)

  test("other commands don't overwrite what they read"):
    inFolder: f =>
      ImageFiles.write(f("a.png"), Image.rgb(4, 4))
      ImageFiles.write(f("b.png"), Image.rgb(4, 4))
      val (a, b) = (f.name("a.png"), f.name("b.png"))
      val suite = Files.createSymbolicLink(f("suite.html"), f("tex.png"))
      val before = f.all
      val commands = Vector(
        Vector("view", a, "--outfile", a),
        Vector("view", a, b, "--outfile", b),
        Vector("image", a, "--outfile", a),
        Vector("average", a, b, "--outfile", b),
        Vector("compare", a, b, "--difference", a),
        Vector("compare", a, b, "--heatmap", b),
        Vector("convert", f.name("s.pbrt"), "--to", "v4", "--outfile", f.name("part.pbrt")),
        Vector("preview", f.name("s.pbrt"), "--outfile", f.name("tex.png"))
      )
      assert(Files.isSymbolicLink(suite))
      for words <- commands do
        val (code, captured) = Captured.run(words*)
        assert(code == 1 && captured.err.contains("refusing to overwrite it"), captured.err)
        assert(f.all == before, words)

  test("films are not merged into one of them, nor into its previous copy"):
    inFolder: f =>
      for i <- 0 to 1 do
        val (code, captured) =
          f.render("--spp", "2", "--shard", s"$i/2", "--outfile", f.name(s"$i.film"))
        assert(code == 0, captured.err)
      val films = Vector(f.name("0.film"), f.name("1.film"))
      val before = f.all
      val (code, captured) = Captured.run((Vector("merge", "--outfile", films(1)) ++ films)*)
      assert(code == 1 && captured.err.contains("refusing to overwrite it"), captured.err)
      val _ = Files.move(f("1.film"), f("x.film.previous"))
      val words = Vector("merge", films(0), f.name("x.film.previous"))
      val (other, said) = Captured.run((words ++ Vector("--outfile", f.name("x.film")))*)
      assert(other == 1 && said.err.contains("refusing to overwrite it"), said.err)
      assert(before.size == f.all.size)

  test("two outputs are never one file"):
    inFolder: f =>
      val _ = Files.createSymbolicLink(f("b.png"), f("a.exr"))
      val names = s"${f.name("a.exr")},${f.name("b.png")}"
      val (code, captured) = f.render("--outfile", names)
      assert(code == 1 && captured.err.contains("would overwrite that of"), captured.err)
      val (a, d) = (f.name("tex.png"), f.name("d.png"))
      val (other, said) = Captured.run("compare", a, a, "--difference", d, "--heatmap", d)
      assert(other == 1 && said.err.contains("the heat map of"), said.err)
      assert(said.err.contains("would overwrite the difference of"), said.err)
      val (third, more) = Captured.run(
        "preview", f.name("s.pbrt"), f.name("s.pbrt"), "--outfile", f.name("p.png")
      )
      assert(third == 2 && more.err.contains("--outfile needs a single scene, found several"))
      assert(!Files.exists(f("p.png")) && !Files.exists(f("d.png")))

  test("an image is done only when all its files are whole and of this rendering", Slow):
    inFolder: f =>
      for format <- OutputFormat.all.map(_.suffix) do
        val file = f(s"a.$format")
        val names = Vector(f.name("a.exr"), file.toString).distinct.mkString(",")
        def again() = f.render("--spp", "1", "--skip-done", "--outfile", names)._2.out
        assert(again().startsWith("wrote "), format)
        assert(again().contains("1 skipped (done already)"), format)
        val whole = f.bytes(s"a.$format")
        val longer = Vector.fill[Byte](500)(0)
        for size <- Vector(whole.size + 500, whole.size - 1, whole.size / 2, 20, 0) do
          val _ = Files.write(file, (whole ++ longer).take(size).toArray)
          assert(again().startsWith("wrote "), s"$format, $size of ${whole.size} bytes")
          assert(f.bytes(s"a.$format") == whole)
          assert(again().contains("1 skipped (done already)"), format)
      // Of another rendering
      val picture = f.name("a.png")
      val _ = f.render("--spp", "1", "--seed", "3", "--outfile", picture)
      val both = s"${f.name("a.exr")},$picture"
      val (_, captured) = f.render("--spp", "1", "--skip-done", "--outfile", both)
      assert(captured.out.startsWith("wrote "))

  test("output that is lost is an error of every command that prints"):
    inFolder: f =>
      val picture = f.name("tex.png")
      val commands = Vector(
        Vector("convert", f.name("s.pbrt"), "--to", "v4"),
        Vector("describe"),
        Vector("describe", "--markdown"),
        Vector("info", picture),
        Vector("compare", picture, picture),
        Vector("check", f.name("s.pbrt")),
        Vector("view", picture, "--thumbnail", "blocks"),
        Vector("image", picture, "--outfile", f.name("x.exr")),
        Vector("average", picture, "--outfile", f.name("x.exr")),
        Vector("render", f.name("s.pbrt"), "--spp", "1", "--outfile", f.name("x.exr")),
        Vector("preview", f.name("s.pbrt"), "--outfile", f.name("x.png")),
        Vector("render", "--help"),
        Vector("--version")
      )
      for words <- commands do
        val (code, err) = onFull("No space left on device")(words*)
        val message = "error: can't write to standard output: No space left on device [E0105]\n"
        assert(code == 1 && err.endsWith(message), s"$words $err")
      assert(onFull("Broken pipe")("describe") == (1, ""))

  test("names that the file system can't hold are found before the scene is read"):
    inFolder: f =>
      val _ = Files.writeString(f("s.pbrt"), "this is no scene")
      val long = "x" * 252
      val nowhere = f.name("no/x")
      for
        (start, why) <- Vector(
          f.name(long) -> "File name too long",
          nowhere -> s"no such folder: `${f("no")}`",
          f.name("a\u0000b") -> "Nul character not allowed"
        )
        words <- Vector(
          Vector("render", "--outfile", s"$start.exr"),
          Vector("render", "--outfile", s"$start.film"),
          Vector("render", "--outfile", f.name("o.exr"), "--report", s"$start.html"),
          Vector("render", "--outfile", f.name("o.exr"), "--checkpoint", s"$start.film"),
          Vector("preview", "--outfile", s"$start.png"),
          Vector("convert", "--to", "v4", "--outfile", s"$start.pbrt")
        )
      do
        val (code, captured) = Captured.run(words :+ f.name("s.pbrt")*)
        assert(code == 1 && captured.err.contains(why), s"$words ${captured.err}")
        assert(!captured.err.contains("no scene"), captured.err)
      for words <- Vector(Vector("describe", "--outfile", nowhere)) do
        val (code, captured) = Captured.run(words*)
        assert(code == 1 && captured.err.startsWith(s"error: can't write `$nowhere`: no such"))
      // The previous copy of a film has a longer name
      val film = f.name("x" * 249 + ".film")
      val (code, captured) = f.render("--outfile", film)
      assert(code == 1 && captured.err.contains("File name too long"))

  test("scenes that name no image get images named after them"):
    val plain = OutputFiles.ofScene("scenes/first.pbrt", Loaded.nameless)
    assert(plain.paths.map(_.toString) == Vector("first.exr", "first.png"))
    assert(plain.warnings.isEmpty)
    val packed = OutputFiles.ofScene("second.pbrt.gz", Loaded.nameless)
    assert(packed.paths.map(_.toString) == Vector("second.exr", "second.png"))

object LostDataSuite:

  private final class Folder(val folder: Path):
    def apply(name: String): Path = folder.resolve(name)
    def name(file: String): String = s"$folder/$file"
    def bytes(name: String): Vector[Byte] = Files.readAllBytes(this(name)).toVector

    /** All files and their contents. */
    def all: Map[String, Vector[Byte]] = TempFolder.names(folder).map(n => n -> bytes(n)).toMap

    def render(words: String*): (Int, Captured) = Captured.run(words :+ name("s.pbrt")*)

  private def scene(film: String): String =
    s"""Film "image" "string filename" "$film" "integer xresolution" 4 "integer yresolution" 4
       |Integrator "path" "integer maxdepth" 1
       |Sampler "random" "integer pixelsamples" 1
       |WorldBegin
       |LightSource "infinite"
       |Texture "t" "color" "imagemap" "string filename" "tex.png"
       |Material "matte" "texture Kd" "t"
       |Shape "plymesh" "string filename" "disk.ply"
       |Include "part.pbrt"
       |WorldEnd
       |""".stripMargin

  private def inFolder[A](body: Folder => A): A = TempFolder.use: folder =>
    ImageFiles.write(folder.resolve("tex.png"), Image.rgb(2, 2))
    val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"sphere\"\n")
    val _ = Files.writeString(
      folder.resolve("disk.ply"),
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" +
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
        "-9 -9 4\n9 -9 4\n0 9 4\n3 0 1 2\n"
    )
    val _ = Files.writeString(folder.resolve("s.pbrt"), scene(s"$folder/tex.exr"))
    body(Folder(folder))

  /** Runs the program where all that is printed is lost: exit code and messages. */
  private def onFull(why: String)(words: String*): (Int, String) =
    val full = new OutputStream:
      def write(byte: Int): Unit = throw IOException(why)
    val captured = Captured()
    val terminal = Terminal(
      PrintStream(full, false, UTF_8),
      captured.terminal.err,
      isInteractive = false,
      Interrupts.Ignored,
      lost = () => Some(IOException(why))
    )
    val code = Main.run(words, terminal)
    (code, captured.err)

  private object Loaded:
    import candela.scenefile.{Dialect, SceneDescription}

    def nameless: Prepared =
      val plan = candela.render.TinyPlan()((_, _) => candela.color.Rgb.White)
      Prepared(SceneDescription(Dialect.V3), plan, Vector.empty)
