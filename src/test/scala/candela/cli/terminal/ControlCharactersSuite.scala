package candela.cli.terminal

import candela.cli.{Captured, Main}
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.io.{ByteArrayOutputStream, PrintStream}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** What files contain, and what they are called, can't control the terminal. */
class ControlCharactersSuite extends AnyFunSuite:

  /** Escape sequences of two kinds, a bell, a return and a mark of direction. */
  private val evil = "\u001b[31mred\u0007\u009b2J\r\u202e"

  private def scene(name: String, more: String = ""): String =
    s"""Camera "perspective"
       |Sampler "random" "integer pixelsamples" 1
       |Film "image" "integer xresolution" 2 "integer yresolution" 2 "string filename" "$name"
       |WorldBegin
       |LightSource "infinite"
       |$more
       |WorldEnd
       |""".stripMargin

  private def isHarmless(c: Int): Boolean =
    c == '\n' || c == '\t' || (c >= ' ' && c < 0x7f) || (c >= 0xa0 && c != 0x202e)

  private def assertHarmless(captured: Captured): String =
    val text = captured.out + captured.err
    val bad = text.codePoints.filter(!isHarmless(_)).toArray.map(_.toHexString).toVector
    assert(bad.isEmpty, text)
    text

  /** Runs the program; all it prints, which is harmless. */
  private def printed(args: String*): String = assertHarmless(Captured.run(args*)._2)

  test("names of missing files and words of the command line are shown, not obeyed"):
    assert(printed(s"$evil.pbrt").contains("`␛[31mred␇<U+009B>2J␍<U+202E>.pbrt`"))
    for command <- Vector("check", "convert", "preview", "view", "info", "resume", "describe") do
      assert(printed(command, s"no\n$evil").contains("no␊␛[31mred␇"), command)
    assert(printed(s"--$evil", "a.pbrt").contains("␛[31mred␇"))
    assert(printed("--dialect", evil, "a.pbrt").contains("␛[31mred␇"))
    assert(printed("compare", evil, evil).contains("␛[31mred␇"))
    assert(printed("merge", evil, "-o", "x.exr").contains("␛[31mred␇"))
    assert(printed("average", evil, "-o", "x.exr").contains("␛[31mred␇"))
    assert(printed("bench", evil).contains("␛[31mred␇"))

  test("a scene's line is shown with its control characters, the caret below its place"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.pbrt"), s"\tScale 1 \"$evil\" Foo\n")
      val lines = printed("check", file.toString).linesIterator.toVector
      val at = lines.indexWhere(_.contains(" | \tScale"))
      val caret = lines(at + 1).indexOf('^')
      assert(lines(at)(caret) == '"' || lines(at).startsWith("Foo", caret), lines.mkString("\n"))

  test("a caret behind longer pictures of characters stays below its place"):
    TempFolder.use: folder =>
      val text = "Texture \"\u009b\u202e\" \"spectrum\" \"nope\"\n"
      val file = Files.writeString(folder.resolve("a.pbrt"), s"WorldBegin\n$text")
      val lines = printed("check", file.toString).linesIterator.toVector
      val at = lines.indexWhere(_.contains(" | Texture"))
      val caret = lines(at + 1).indexOf('^')
      assert(lines(at).startsWith("\"nope\"", caret) || lines(at).startsWith("Texture", caret))

  test("names of scenes, images and films that are written are shown, not obeyed"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve(s"$evil.pbrt"), scene("x.exr"))
      for name <- Vector(s"$evil.exr", s"$evil.png", s"$evil.film") do
        assert(printed(file.toString, "-o", s"$folder/$name").contains("␛[31mred␇"), name)
      assert(printed("check", file.toString, "--explain").contains("␛[31mred␇"))
      assert(printed("check", file.toString, file.toString).contains("2 scenes: 2 accepted"))
      for command <- Vector("view", "image") do
        assert(printed(command, s"$folder/$evil.exr", "-o", s"$folder/$evil.tga").contains("wrote"))
      assert(printed("info", s"$folder/$evil.film").contains("scene"))
      val two = printed("info", s"$folder/$evil.exr", s"$folder/$evil.exr")
      assert(two.contains("2x2") && two.contains("␛[31mred␇"))
      assert(printed("convert", file.toString, "-o", s"$folder/b$evil.pbrt").contains("wrote"))
      val images = Files.createDirectory(folder.resolve(s"d$evil"))
      Files.copy(folder.resolve(s"$evil.png"), images.resolve(s"$evil.png"))
      assert(printed("compare", images.toString, images.toString).contains("␛[31mred␇"))

  test("metadata of an image are shown, not obeyed"):
    TempFolder.use: folder =>
      val image = Image(1, 1, Vector(s"a$evil"), Array(1f))
      ImageFiles.write(folder.resolve("a.exr"), image, Vector("title" -> s"\u001b]0;$evil"))
      val text = printed("info", s"$folder/a.exr")
      assert(text.contains("␛]0;␛[31m") && text.contains("a␛[31m"))

  test("parameters of scenes that warnings quote are shown, not obeyed"):
    TempFolder.use: folder =>
      val more = s"Material \"matte\" \"string $evil\" \"$evil\"\nNamedMaterial \"$evil\"\n" +
        s"Texture \"$evil\" \"spectrum\" \"imagemap\" \"string filename\" \"$evil.png\"\n"
      val file = Files.writeString(folder.resolve("a.pbrt"), scene("x.exr", more))
      for line <- Vector("check", "check --keep-going", "check --keep-going --verbose") do
        val _ = printed(line.split(' ').toVector :+ file.toString*)

  private def converted(folder: Path, isSeen: Boolean): String =
    // A return would end the line within the string
    val text = evil.filter(_ != '\r')
    val named = s"MakeNamedMaterial \"a$text\" \"string type\" \"matte\"\n"
    val file = Files.writeString(folder.resolve("a.pbrt"), scene("x.exr", named))
    val (out, err) = (ByteArrayOutputStream(), ByteArrayOutputStream())
    val terminal = Terminal(
      PrintStream(out, true, UTF_8),
      PrintStream(err, true, UTF_8),
      isInteractive = false,
      Interrupts.Ignored,
      isSeen = isSeen
    )
    assert(Main.run(Seq("convert", file.toString), terminal) == 0, err.toString(UTF_8))
    out.toString(UTF_8)

  test("a scene that convert prints is exact for other programs, and harmless on terminals"):
    TempFolder.use: folder =>
      assert(converted(folder, isSeen = false).contains(s"\"a\u001b[31mred"))
      val seen = converted(folder, isSeen = true)
      assert(seen.contains("\"a␛[31mred") && seen.codePoints.allMatch(isHarmless(_)))

  test("text that arrives in parts keeps its characters"):
    val out = ByteArrayOutputStream()
    val writer = PrintingWriter(Printer(PrintStream(out, true, UTF_8)))
    for c <- "a😀\u001bb" do writer.write(c.toInt)
    writer.close()
    assert(out.toString(UTF_8) == "a😀␛b")

  test("the program's own colours and progress are for the terminal"):
    val out = ByteArrayOutputStream()
    val printer = Printer(PrintStream(out, true, UTF_8))
    printer.println("a\u001b: ", "error", "31", s": \u001b")
    printer.control("\rredrawn")
    assert(out.toString(UTF_8) == "a␛: \u001b[1;31merror\u001b[0m: ␛\n\rredrawn")
    assert(Printer(printer) eq printer)
