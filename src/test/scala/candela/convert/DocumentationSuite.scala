package candela.convert

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class DocumentationSuite extends AnyFunSuite:

  test("docs/CONVERTING.md has the tables as they are"):
    val page = Files.readString(Path.of("docs/CONVERTING.md"))
    val start = page.indexOf("## From v3 to v4")
    assert(start > 0)
    val wanted = page.take(start) + Documentation.markdown
    if page != wanted then
      val _ = Files.writeString(Path.of("target/CONVERTING.md"), wanted)
    assert(page == wanted, "target/CONVERTING.md is as it should be")

  test("no type and no parameter has two rules"):
    for
      pass <- Vector(FromV2.pass, ToV4View.pass, ToV3View.pass)
      table <- pass.tables
    do
      val names = table.rules.flatMap(_.sourceNames)
      assert(names == names.distinct)
