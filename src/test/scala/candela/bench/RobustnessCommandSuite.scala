package candela.bench

import candela.cli.Captured
import candela.testing.TempFolder

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class RobustnessCommandSuite extends AnyFunSuite:
  private def run(args: String*): (Int, Captured) = Captured.run("robustness" +: args*)

  /** Without programs of this machine, and with the fewest trials. */
  private val short = Vector("--rays", "50", "--only", "distances", "--python", "no-such-python")

  test("the table is printed, and written in each format"):
    TempFolder.use: folder =>
      val page = folder.resolve("page.md")
      val before = "# Mine\n\n<!-- robustness: begin -->\nold\n<!-- robustness: end -->\nend\n"
      val _ = Files.writeString(page, before)
      val files = Vector("x.html", "x.json", "page.md").map(n => folder.resolve(n).toString)
      val (code, said) = run(short ++ Vector("--report", files.mkString(","))*)
      assert(code == 0, said.err)
      assert(said.out.contains("triangles in planes close to zero: candela"))
      assert(said.out.contains("Wrong distances of hits, per 10⁹ (distances)"))
      assert(said.out.contains("1 row: Candela is as promised in all"))
      assert(said.err.contains("skipped: Embree: `no-such-python` is not installed"))
      val made = Files.readString(page)
      assert(made.startsWith("# Mine") && made.endsWith("<!-- robustness: end -->\nend\n"))
      assert(made.contains("### Wrong distances of hits") && !made.contains("\nold\n"))
      for file <- files do assert(Files.size(java.nio.file.Path.of(file)) > 100, file)

  test("with --quiet, what is as promised is not told"):
    val (code, said) = run(short :+ "--quiet"*)
    assert((code, said.out, said.err) == (0, "", ""))

  test("a report that the file system refuses is told before anything is measured"):
    assume(Files.isWritable(java.nio.file.Path.of("/proc")))
    val (code, said) = run(short ++ Vector("--report", "/proc/x.html")*)
    assert((code, said.out) == (1, ""), said.err)
    assert(said.err.contains("can't write `/proc/x.html`"), said.err)

  test("unknown kinds, counts and formats are refused with what is known"):
    val (kind, saidKind) = run("--only", "leak")
    assert(kind == 2 && saidKind.err.contains("--only has no kind `leak`: did you mean `leaks`?"))
    val (count, saidCount) = run("--rays", "0")
    assert(count == 2 && saidCount.err.contains("--rays must be at least 1, found `0`"))
    val (format, saidFormat) = run(short ++ Vector("--report", "x.txt")*)
    assert(format == 1 && saidFormat.err.contains("reports are written as .html, .json or .md"))
    val (extra, saidExtra) = run("scene.pbrt")
    assert(extra == 2)
    val unexpected = "`candela robustness` takes only options; unexpected argument `scene.pbrt`"
    assert(saidExtra.err.contains(unexpected))
