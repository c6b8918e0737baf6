package candela.cli.options

import candela.cli.Captured

import java.nio.file.{Files, Path}

import scala.util.{Try, Using}

import org.scalatest.funsuite.AnyFunSuite

/** Scripts of shells know what the program knows. */
class CompletionSuite extends AnyFunSuite:

  private def script(shell: String): String =
    val (code, said) = Captured.run("completion", shell)
    assert(code == 0 && said.err.isEmpty)
    said.out

  private def inFolder[A](body: Path => A): A =
    val folder = Files.createTempDirectory("completion")
    for name <- Vector("a.pbrt", "b.xml", "c.exr", "d.film", "e.conf") do
      Files.writeString(folder.resolve(name), "")
    Files.createDirectory(folder.resolve("folder"))
    try body(folder)
    finally
      Using.resource(Files.walk(folder)): all =>
        all.sorted(java.util.Comparator.reverseOrder()).forEach(Files.delete)

  /** What a program prints, or a note that this machine lacks it. */
  private def ran(folder: Path, words: String*): Option[String] =
    val started = Try:
      ProcessBuilder(words*).directory(folder.toFile).redirectErrorStream(true).start()
    if started.isFailure then
      info(s"skipped: ${words.head} is not installed")
      None
    else
      val process = started.get
      process.getOutputStream.close()
      val said = String(process.getInputStream.readAllBytes())
      val code = process.waitFor()
      assert(code == 0, said)
      Some(said)

  for shell <- Words.shells do
    test(s"the completion of $shell has every command and every option"):
      val text = script(shell)
      for row <- CommandTable.rows do
        assert(text.contains(row.command.word))
        for o <- row.options do
          assert(
            text.contains(if shell == "fish" then s"-l ${o.name} " else s"--${o.name}"),
            o.name
          )

  test("zsh offers an option once, but one that may be repeated again"):
    val lines = script("zsh").linesIterator.map(_.trim).toVector
    def forms(option: String) = lines.filter(_.contains(s"$option[")).map(_.takeWhile(_ != '['))
    assert(forms("--spp").nonEmpty && forms("--spp").forall(!_.contains("*")))
    assert(forms("--crop").forall(!_.contains("*")))
    assert(forms("--reference").forall(!_.contains("*")))
    assert(forms("--report").exists(_.contains("*--report")))

  for shell <- Vector("bash", "zsh", "fish") do
    test(s"$shell accepts its script"):
      inFolder: folder =>
        val file = Files.writeString(folder.resolve("script"), script(shell))
        for said <- ran(folder, shell, "-n", file.toString) do assert(said == "")

  /** Command lines, and some of what completes their last words; what does not. */
  private val lines = Vector(
    (Vector("rend"), Vector("render"), Vector("--spp")),
    (Vector(""), Vector("render", "help", "a.pbrt", "b.xml"), Vector("c.exr", "d.film")),
    (Vector("render", "--sp"), Vector("--spp", "--spark"), Vector("--max-mse")),
    (Vector("--sp"), Vector("--spp", "--spark"), Vector("--max-mse")),
    (Vector("compare", "--max"), Vector("--max-mse"), Vector("--spp")),
    (Vector("render", "--tonemap", ""), Vector("linear", "agx"), Vector("a.pbrt", "--spp")),
    (Vector("image", "--colorspace", "re"), Vector("rec2020"), Vector("srgb")),
    (Vector("render", "--aov", "alb"), Vector("albedo"), Vector("depth")),
    (Vector("render", "--aov", "depth,alb"), Vector("depth,albedo"), Vector("depth")),
    (Vector("resume", ""), Vector("d.film"), Vector("a.pbrt", "c.exr")),
    (Vector("view", ""), Vector("c.exr"), Vector("a.pbrt")),
    (Vector("bench", ""), Vector("e.conf"), Vector("a.pbrt")),
    (Vector("describe", "Cam"), Vector("Camera"), Vector("Shape")),
    (Vector("completion", ""), Vector("bash", "fish"), Vector("a.pbrt")),
    (Vector("help", "me"), Vector("merge"), Vector("render"))
  )

  test("bash completes commands, options, their values and files"):
    inFolder: folder =>
      val file = Files.writeString(folder.resolve("script"), script("bash"))
      for (words, wanted, others) <- lines do
        val all = ("candela" +: words).map(w => s"'$w'").mkString(" ")
        val call = s"source $file; COMP_WORDS=($all); COMP_CWORD=${words.size}; _candela; " +
          "printf '%s\\n' \"${COMPREPLY[@]}\""
        for said <- ran(folder, "bash", "-c", call) do
          val found = said.linesIterator.toSet
          assert(wanted.forall(found), s"$words: $found")
          assert(!others.exists(found), s"$words: $found")

  test("fish completes commands, options, their values and files"):
    inFolder: folder =>
      val file = Files.writeString(folder.resolve("script"), script("fish"))
      val calls = lines.zipWithIndex.map: (line, i) =>
        s"echo line $i; complete -C'candela ${line._1.mkString(" ")}'"
      for said <- ran(folder, "fish", "-N", "-c", s"source $file; ${calls.mkString("; ")}") do
        val parts = said.split("(?m)^line \\d+\n").drop(1)
        assert(parts.length == lines.size, said)
        for ((words, wanted, others), part) <- lines.zip(parts) do
          val found = part.linesIterator.map(_.takeWhile(_ != '\t')).toSet
          assert(wanted.forall(found), s"$words: $found")
          assert(!others.exists(found), s"$words: $found")

  test("an unknown shell is told the known ones"):
    val (code, said) = Captured.run("completion", "bahs")
    assert(code == 1)
    assert(said.err.contains("did you mean `bash`?"))
