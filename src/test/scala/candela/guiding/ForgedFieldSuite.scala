package candela.guiding

import candela.io.CheckedFile
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class ForgedFieldSuite extends AnyFunSuite:
  import GuideField.Start

  private def load(field: GuideField): GuideField =
    val file = Files.createTempFile("candela", ".field")
    try
      CheckedFile.write(file, "field")(field.save)
      CheckedFile.read(file, "field")(GuideField.load)
    finally Files.delete(file)

  private def field(axis: Array[Int], nodes: Array[Int]): GuideField =
    GuideField(
      axis, Start.split, nodes, Start.bsdfProbabilities, Start.centres, Start.lobes,
      Start.splittingFactors,
      Start.measurements
    )

  test("a field is read as it was written"):
    assert(load(Start).below.sameElements(Start.below))

  test("a field whose nodes lead in a circle, or nowhere, is refused"):
    for node <- Vector(0, 6, 7, Int.MaxValue, -8, Int.MinValue) do
      val nodes = Start.below.updated(0, node)
      val _ = intercept[IllegalArgumentException](load(field(Start.axis, nodes)))

  test("a field without nodes is refused"):
    val _ = intercept[IllegalArgumentException](load(field(Array.empty, Array.empty)))
