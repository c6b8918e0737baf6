package candela.cli.options

import candela.cli.Captured
import candela.cli.terminal.ExitCode

import java.nio.file.{Files, Path}

import scala.util.Try

import org.scalatest.funsuite.AnyFunSuite

/** The pages of commands are those of the option tables. */
class ManPageSuite extends AnyFunSuite:

  private def printed(words: String*): String =
    val (code, said) = Captured.run("describe" +: words*)
    assert(code == 0 && said.err.isEmpty)
    said.out

  test("docs/COMMANDS.md is what the option tables say"):
    val help = "./sbt \"run describe --commands --outfile docs/COMMANDS.md\""
    assert(Files.readString(Path.of("docs/COMMANDS.md")) == printed("--commands"), help)

  test("the manual page has every command, option and exit code"):
    val page = printed("--man").replace("\\-", "-")
    for row <- CommandTable.rows do
      assert(page.contains(s".SS ${row.usage}"), row.usage)
      for o <- row.options do assert(page.contains(s"\\fB--${o.name}\\fR"), o.name)
    for c <- ExitCode.values do assert(page.contains(s"\n.TP\n${c.number}\n"), c)

  /** Formatters that warn of what is wrong in a page. */
  private val readers = Vector(
    Vector("man", "--warnings", "-l"),
    Vector("mandoc", "-T", "lint", "-W", "warning")
  )

  for reader <- readers do
    test(s"${reader.head} finds nothing wrong in the manual page"):
      val file = Files.createTempFile("candela", ".1")
      try
        Files.writeString(file, printed("--man"))
        val builder = ProcessBuilder((reader :+ file.toString)*)
        val _ = builder.environment.put("MANPAGER", "cat")
        val _ = builder.redirectOutput(ProcessBuilder.Redirect.DISCARD)
        Try(builder.start()).toOption match
          case None => info(s"skipped: ${reader.head} is not installed")
          case Some(process) =>
            val warnings = String(process.getErrorStream.readAllBytes())
            assert(process.waitFor() == 0 && warnings.isBlank, warnings)
      finally Files.delete(file)
