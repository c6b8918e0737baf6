package candela.diagnostics

import org.scalatest.funsuite.AnyFunSuite

class ProblemSuite extends AnyFunSuite:
  private val at = SourcePos("scene.pbrt", 3, 7)

  test("a message is one line, whatever names the file has"):
    val name = "a\nb\tc\u001bd"
    for p <- Seq(
        Problem.error(Code.Undefined, at, s"`$name` is odd", Some(s"not $name")),
        Problem.warning(Code.Undefined, at, s"`$name` is odd", Some(s"not $name")),
        Problem.missing(
          Code.Undefined,
          at,
          s"`$name` is odd",
          "nothing",
          keepGoing = false,
          Some(s"not $name")
        )
      )
    do
      assert(p.message == "`a␊b\tc␛d` is odd")
      assert(p.help.contains("not a␊b\tc␛d"))

  test("a message of a thousand characters keeps its beginning and its end"):
    val p = Problem.error(Code.Undefined, at, "first" + "x" * 1000 + "last")
    assert(p.message.length <= 500)
    assert(p.message.startsWith("first") && p.message.endsWith("last"))

  test("a long list is cut between its words"):
    val names = (100 to 300).map(i => s"parameter$i")
    val p = Problem.error(Code.Undefined, at, names.mkString("known: ", ", ", ""))
    val shown = p.message.stripPrefix("known: ").split("[ ,…]+").toVector
    assert(shown.size > 20 && shown.forall(names.contains), p.message)

  test("a message of ordinary length is as it was written"):
    val text = "`roughnes` is not a parameter of \"plastic\"; it is ignored — " + "y" * 300
    assert(Problem.error(Code.Undefined, at, text).message == text)
