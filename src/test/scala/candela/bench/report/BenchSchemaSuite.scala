package candela.bench.report

import candela.report.Reports
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

class BenchSchemaSuite extends AnyFunSuite:
  private def read(file: String) = ujson.read(Files.readString(Path.of(file)))
  private val schema = JsonSchema(read("docs/bench/results.schema.json"))
  private def written = ujson.read(SuiteData.json(Reports.suite))

  test("what bench writes is as its schema says, every field of it"):
    assert(schema.problems(written) == Vector.empty)
    assert(written("schemaVersion").num.toInt == SuiteData.SchemaVersion)

  test("the published results are as the schema says"):
    for name <- Seq("results", "growth") do
      assert(schema.problems(read(s"docs/bench/$name.json")) == Vector.empty, name)

  test("the schema refuses fields that it does not name, and misses those that it requires"):
    val more = written
    more("scenes")(0)("speed") = 3
    assert(schema.problems(more) == Vector("$.scenes[0]: `speed`"))
    val less = written
    less.obj.remove("leftOut"): Unit
    less("seeds") = "three"
    assert(schema.problems(less).size == 2)

  test("every published chart has its numbers beside it"):
    val charts = Using.resource(Files.walk(Path.of("docs"))): files =>
      files.iterator.asScala.filter(_.toString.endsWith(".svg")).toVector
    def data(chart: Path) =
      val own = chart.getFileName.toString.stripSuffix(".svg") + ".csv"
      Vector(own, "results.json").map(chart.resolveSibling)
    val bare = charts.filterNot(data(_).exists(Files.exists(_)))
    assert(charts.nonEmpty && bare.isEmpty)
