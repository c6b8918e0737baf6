package candela.bench

import candela.cli.{Captured, Main}
import candela.cli.terminal.{Interrupts, Terminal}
import candela.image.{Image, ImageFiles}
import candela.render.Cancellation
import candela.testing.TempFolder

import java.io.PrintStream
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** `candela bench`, with a program that copies a picture for a renderer. */
class BenchCommandSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run("bench" +: args*)

  private def flat(path: Path, value: Float): Unit =
    val image = Image.rgb(4, 3)
    java.util.Arrays.fill(image.data, value)
    ImageFiles.write(path, image)

  private def inSuite[A](body: (Path, String) => A): A =
    TempFolder.use: folder =>
      flat(folder.resolve("scene.exr"), 0.75f)
      flat(folder.resolve("truth.exr"), 0.5f)
      val text =
        """title = "Copies"
          |programs {
          |  copy { command = "cp {scene} {out}", reads = [exr] }
          |  gone { command = "no-such-renderer-of-candela", reads = [exr] }
          |}
          |scenes { flat { files { exr = "scene.exr" }, reference = "truth.exr" } }
          |""".stripMargin
      body(folder, Files.writeString(folder.resolve("copies.conf"), text).toString)

  test("a suite becomes a page, figures for machines and a chart"):
    inSuite: (folder, suite) =>
      val files = Vector("html", "json", "csv", "svg").map(e => folder.resolve(s"out.$e"))
      val words = Vector("--samples", "1,2", "--seeds", "2", "--report", files.mkString(","))
      val (code, captured) = run(suite +: words*)
      assert(code == 0, captured.err)
      assert(captured.out.linesIterator.toVector == files.map(f => s"wrote $f"))
      assert(captured.err.contains("gone: `no-such-renderer-of-candela` is not installed"))
      val rows = Files.readAllLines(files(2))
      // (0.25 / 0.51)²
      assert(rows.size == 5 && rows.get(1).startsWith("flat,copy,1,1,"))
      assert(rows.get(1).contains(",0.2402"))
      assert(Files.readString(files(0)).contains("is not installed"))
      assert(Files.readString(files(0)).contains("class=\"viewer card\""))
      assert(Files.readString(files(1)).contains("\"seeds\": 2"))
      assert(Files.readString(files(3)).startsWith("<svg"))

  test("--no-pictures leaves the images out, --programs all other programs"):
    inSuite: (folder, suite) =>
      val page = folder.resolve("out.html")
      val words = Vector("--no-pictures", "--programs", "copy", "--report", page.toString)
      val (code, captured) = run(Vector(suite, "--samples", "1") ++ words*)
      assert(code == 0, captured.err)
      assert(!captured.err.contains("skipped"))
      assert(!Files.readString(page).contains("class=\"viewer card\""))

  test("Candela is started by its launcher, if that started the suite"):
    inSuite: (folder, suite) =>
      val text = Files.readString(Path.of(suite)).replace("cp {scene}", "{candela} {scene}")
      val _ = Files.writeString(Path.of(suite), text)
      val launcher = Files.writeString(folder.resolve("launcher"), "#!/bin/sh\nexec cp \"$@\"\n")
      assume(launcher.toFile.setExecutable(true) && Files.isExecutable(Path.of("/bin/sh")))
      sys.props("candela.launcher") = launcher.toString
      val csv = folder.resolve("out.csv")
      try
        val (code, captured) = run(suite, "--samples", "1", "--seeds", "1", "--report", s"$csv")
        assert(code == 0 && Files.readAllLines(csv).size == 2, captured.err)
      finally
        val _ = sys.props.remove("candela.launcher")

  test("what is interrupted writes what there is"):
    inSuite: (folder, suite) =>
      val files = Vector("html", "json", "csv").map(e => folder.resolve(s"out.$e"))
      val stop = StopAfterFirst()
      val captured = Captured()
      val terminal = Terminal(captured.terminal.out, stop.heard(captured.terminal.err), false, stop)
      val words = Vector("--samples", "1,2,4", "--report", files.mkString(","))
      val code = Main.run(Vector("bench", suite) ++ words, terminal)
      assert(code == 130, captured.err)
      assert(captured.out.linesIterator.toVector == files.map(f => s"wrote $f"))
      assert(Files.readAllLines(files(2)).size == 2)
      assert(Files.readString(files(0)).contains("partly rendered when this report was written"))
      assert(!Files.list(folder).anyMatch(_.toString.endsWith(".tmp")))

  test("what is interrupted before any error is known says so, and writes nothing"):
    inSuite: (folder, suite) =>
      val text = Files.readString(Path.of(suite)).replace(", reference = \"truth.exr\"", "")
      val _ = Files.writeString(Path.of(suite), text)
      val page = folder.resolve("out.html")
      for isQuiet <- Vector(false, true) do
        val stop = StopAfterFirst()
        val captured = Captured()
        val heard = stop.heard(captured.terminal.err)
        val terminal = Terminal(captured.terminal.out, heard, false, stop)
        val words = Vector("--samples", "1,2", "--seeds", "3", "--report", page.toString)
        val quiet = Option.when(isQuiet)("--quiet")
        if isQuiet then stop.press()
        val code = Main.run(Vector("bench", suite) ++ words ++ quiet, terminal)
        assert(code == 130 && captured.out.isEmpty && !Files.exists(page), captured.err)
        val said = "nothing written: no scene has results yet; without a reference, errors are " +
          "known from 3 seeds on"
        assert(captured.err.contains(said) != isQuiet, captured.err)

  test("a report that the file system refuses is told before anything runs"):
    assume(Files.isWritable(Path.of("/proc"))) // by its permissions, for the superuser
    inSuite: (_, suite) =>
      val (code, captured) = run(suite, "--samples", "1", "--report", "/proc/x.html")
      assert(code == 1 && captured.err.contains("can't write `/proc/x.html`"), captured.err)
      assert(!captured.err.contains("spp"))

  test("names that are close to known ones are suggested"):
    inSuite: (folder, suite) =>
      val (_, file) = run(s"$folder/copied.conf")
      assert(file.err.contains("did you mean `copies.conf`?"), file.err)
      val (_, program) = run(suite, "--programs", "cpy")
      assert(program.err.contains("did you mean `copy`?"), program.err)

  test("a folder of references that isn't there is refused"):
    TempFolder.use: folder =>
      val _ = Files.writeString(folder.resolve("a.pbrt"), "")
      val _ = Files.createDirectory(folder.resolve("truths"))
      val (code, captured) = run(s"$folder", "--references", s"$folder/truth")
      assert(code == 1 && captured.err.contains(s"no such folder: `$folder/truth`"), captured.err)
      assert(captured.err.contains("did you mean `truths`?"), captured.err)

  test("a scene that no program reads is named, with --quiet, too"):
    inSuite: (_, suite) =>
      val text = Files.readString(Path.of(suite)).replace("files { exr", "files { v9")
      val _ = Files.writeString(Path.of(suite), text)
      for words <- Vector(Vector.empty, Vector("--quiet")) do
        val (code, captured) = run(Vector(suite, "--samples", "1") ++ words*)
        assert(code == 1)
        val why = "no program reads its files (v9); copy reads exr"
        assert(captured.err.contains(s"flat: $why"), captured.err)

  test("a count that is given twice is refused"):
    inSuite: (_, suite) =>
      for option <- Vector("samples", "seconds") do
        val (code, captured) = run(suite, s"--$option", "1,2,1")
        assert(code == 2 && captured.err.contains(s"--$option has `1"), captured.err)

  test("what can't be is said before anything runs"):
    inSuite: (folder, suite) =>
      def error(args: String*) =
        val (code, captured) = run(args*)
        assert(code == 1)
        captured.err
      assert(error(s"$folder/none.conf").contains("no such suite"))
      assert(error(suite, "--report", s"$folder/x.pdf").contains(".html, .json, .csv, or .svg"))
      assert(error(suite, "--report", s"$folder/none/x.html").contains("no such folder"))
      val scene = error(suite, "--scenes", "flut")
      assert(scene.contains("unknown scene `flut`") && scene.contains("did you mean `flat`?"))
      assert(error(folder.toString, "--report", s"$folder/x.csv").contains("no scene in"))
      assert(!Files.exists(folder.resolve("x.csv")))

/** Ctrl-C after the first image that counts. */
private final class StopAfterFirst extends Interrupts:
  private var asked = Option.empty[Cancellation]
  private var isPressed = false

  /** At once. */
  def press(): Unit = isPressed = true

  def during[A](cancellation: Cancellation)(body: => A): A =
    asked = Some(cancellation)
    if isPressed then cancellation.request()
    body

  def heard(to: PrintStream): PrintStream = new PrintStream(to, true):
    override def println(line: String): Unit =
      super.println(line)
      if line.contains("seed 1") then asked.foreach(_.request())
