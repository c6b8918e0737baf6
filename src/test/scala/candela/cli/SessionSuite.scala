package candela.cli

import candela.cli.terminal.{ExitCode, Interrupts, Terminal}
import candela.image.ImageFiles
import candela.job.SceneLoader
import candela.render.Cancellation
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.io.{ByteArrayInputStream, ByteArrayOutputStream, PrintStream}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

class SessionSuite extends AnyFunSuite:
  private val scene =
    """<scene version="3.0.0">
      |<sensor type="perspective">
      |<film type="hdrfilm">
      |<integer name="width" value="12"/><integer name="height" value="8"/>
      |</film>
      |</sensor>
      |<emitter type="constant"/>
      |<shape type="sphere"><point name="center" value="0, 0, 4"/></shape>
      |</scene>""".stripMargin

  /** The answers to requests, which come one after the other. */
  private def answers(requests: ujson.Value*): Vector[ujson.Value] =
    lines(requests.map(ujson.write(_))*)

  private def lines(input: String*): Vector[ujson.Value] =
    val out = ByteArrayOutputStream()
    val printed = PrintStream(out, false, UTF_8)
    var hasQuit = false
    // As in a process, which nothing leaves afterwards
    val interrupts = new Interrupts:
      def during[A](cancellation: Cancellation)(body: => A): A = body
      override def quit(code: ExitCode): Unit = hasQuit = true
    val terminal = Terminal(printed, printed, isInteractive = false, interrupts)
    val bytes = input.map(_ + "\n").mkString.getBytes(UTF_8)
    val session = Session(ByteArrayInputStream(bytes), terminal, SceneLoader.FromFile)
    assert(session.run() == ExitCode.Done && !hasQuit)
    out.toString(UTF_8).linesIterator.map(ujson.read(_)).toVector

  private def render(file: Path, spp: Int = 4)(text: String = scene): ujson.Obj =
    val words = Vector("render", "a.xml", s"--spp=$spp", s"--outfile=$file")
    ujson.Obj("run" -> words, "scene" -> "a.xml", "text" -> text)

  private def adding(request: ujson.Obj, words: String*): ujson.Obj =
    request("run").arr ++= words.map(ujson.Str(_))
    request

  private def codes(answers: Vector[ujson.Value]): Vector[Int] =
    answers.flatMap(_.obj.get("code")).map(_.num.toInt)

  private def messages(answers: Vector[ujson.Value]): Vector[String] =
    answers.flatMap(_.obj.get("message")).map(_.str)

  test("scenes that are no files are rendered, and changed, in one process"):
    TempFolder.use: folder =>
      val files = Vector("a", "b", "c").map(name => folder.resolve(s"$name.pfm"))
      val file = Files.writeString(folder.resolve("scene.xml"), scene)
      val answered = answers(
        render(files(0))(),
        render(files(1))(scene.replace("0, 0, 4", "0, 0, 6")),
        ujson.Obj("run" -> Vector(s"$file", "--spp=4", s"--outfile=${files(2)}"))
      )
      assert(codes(answered) == Vector(0, 0, 0) && messages(answered).isEmpty, answered)
      val Vector(a, b, c) = files.map(Files.readAllBytes(_).toVector): @unchecked
      assert(a == c && a != b)

  test("an answer has the output of the command, and the progress in numbers"):
    TempFolder.use: folder =>
      val answered = answers(render(folder.resolve("a.pfm"))())
      assert(answered.last("output").str.startsWith("wrote "))
      val progress = answered.flatMap(_.obj.get("progress"))
      assert(progress.last("done").num == 1 && progress.last("samples").num == 12 * 8 * 4)
      assert(progress.last("seconds").num > 0)

  test("what is wrong with a scene is told with its place, and the next request goes on"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.pfm")
      val answered = answers(render(file)(scene.replace("sphere", "spere")), render(file)())
      assert(codes(answered) == Vector(1, 0))
      assert(messages(answered).head.startsWith("a.xml:8:1: error: unknown shape \"spere\""))

  test("of a text with several sensors, that which is asked for is rendered, or all"):
    TempFolder.use: folder =>
      val second = scene.substring(scene.indexOf("<sensor"), scene.indexOf("<emitter"))
        .replace("\"12\"", "\"20\"")
      val text = scene.replace("<emitter", s"$second<emitter")
      def file(name: String) = folder.resolve(s"$name.pfm")
      def asked(name: String, words: String*) =
        adding(render(file(name))(text), words*)
      val answered =
        answers(asked("first"), asked("n-%d", "--sensor=all"), asked("last", "--sensor=1"))
      assert(codes(answered) == Vector(0, 0, 0), answered)
      assert(messages(answered).head.contains("only the first sensor is rendered"), answered)
      val widths = Vector("first", "n-0", "n-1", "last").map(n => ImageFiles.read(file(n)).width)
      assert(widths == Vector(12, 12, 20, 20))

  test("of a text with several worlds each is an image, unless a program asks for a single one"):
    TempFolder.use: folder =>
      val world = "WorldBegin\nShape \"sphere\"\nWorldEnd\n"
      val text = "Camera \"perspective\"\nFilm \"image\" \"integer xresolution\" 4 " +
        s"\"integer yresolution\" 4\n$world$world"
      def request(file: Path, isSingle: Boolean) =
        val words = Vector("render", "a.pbrt", "--dialect=v3", "--spp=1", s"--outfile=$file")
        val fields = ujson.Obj("run" -> words, "scene" -> "a.pbrt", "text" -> text)
        if isSingle then fields("image") = s"$file"
        fields
      val single = folder.resolve("single.pfm")
      val answered =
        answers(request(folder.resolve("n-%d.pfm"), isSingle = false), request(single, true))
      assert(codes(answered) == Vector(0, 0), answered)
      val files = Vector("n-1.pfm", "n-2.pfm", "single.pfm").map(folder.resolve(_))
      assert(files.forall(Files.exists(_)))
      assert(messages(answered).exists(_.contains("the file has several worlds")), answered)

  test("the film of a text is continued without its file, and names no image that is passed on"):
    TempFolder.use: folder =>
      val Vector(film, image, passed, whole) =
        Vector("x.film", "x.pfm", "passed.pfm", "whole.pfm").map(folder.resolve(_)): @unchecked
      val request = adding(render(film)(), s"--outfile=$image", s"--outfile=$passed")
      request("image") = s"$passed"
      assert(codes(answers(request, request, render(whole, spp = 8)())) == Vector(0, 0, 0))
      Files.delete(passed)
      val (code, captured) = Captured.run("resume", s"$film", "--spp", "8")
      assert(code == 0, captured.err)
      assert(Files.readAllBytes(image).sameElements(Files.readAllBytes(whole)))
      assert(!Files.exists(passed))
      val merged = folder.resolve("merged.pfm")
      assert(Captured.run("merge", s"$film", "--outfile", s"$merged")._1 == 0)
      assert(Files.readAllBytes(merged).sameElements(Files.readAllBytes(whole)))

  test("the fraction of a rendering that an error ends is told once it is known"):
    TempFolder.use: folder =>
      val request = adding(render(folder.resolve("a.pfm"), spp = 100_000)(), "--error=5%")
      val progress = answers(request).flatMap(_.obj.get("progress"))
      for p <- progress do
        assert(p.obj.contains("done") == p.obj.contains("secondsLeft"), progress)

  test("lines that are no requests are refused, and the next one goes on"):
    val answered = lines(
      "", "[]", "{\"run\": 3}", "{\"run\": [\"session\"]}", "{\"run\": [\"explain\", \"E0401\"]}"
    )
    assert(codes(answered) == Vector(2, 2, 2, 2, 0))
    assert(messages(answered).forall(_.startsWith("error: not a request")))
    assert(answered.last("output").str.contains("E0401"))

  test("a rendering ends when that is asked for, and the next one is whole"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.pfm")
      val endless = render(file, spp = 100_000_000)()
      val answered = answers(endless, ujson.Obj("cancel" -> true), render(file)())
      assert(codes(answered) == Vector(130, 0), answered)
