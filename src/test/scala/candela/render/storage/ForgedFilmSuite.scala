package candela.render.storage

import candela.io.CheckedFile
import java.io.IOException
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** Film files whose checksums are right, but not their contents. */
class ForgedFilmSuite extends AnyFunSuite:
  private val header = FilmHeader(
    "1", "s.pbrt", "", Vector.empty, Vector.empty, Vector.empty, "4x4", 16, 4, 0f, Set(0), 1
  )

  private def refusal(forged: FilmHeader): String =
    val file = Files.createTempFile("candela", ".film")
    try
      CheckedFile.write(file, FilmFile.Mark)(forged.save)
      intercept[IOException](FilmFile.open(file)).getMessage
    finally Files.delete(file)

  test("numbers that can't be are damage"):
    for
      forged <- Vector(
        header.copy(count = 0),
        header.copy(count = -1),
        header.copy(shards = Set.empty),
        header.copy(shards = Set(1)),
        header.copy(shards = Set(-1, 0)),
        header.copy(samples = 0),
        header.copy(done = -1)
      )
    do assert(refusal(forged).contains("it is damaged: it has "))

  test("fewer values than are said to follow are damage"):
    val file = Files.createTempFile("candela", ".film")
    try
      CheckedFile.write(file, FilmFile.Mark): out =>
        Vector("1", "s.pbrt", "", "4x4").foreach(out.text)
        out.int(Int.MaxValue)
      assert(intercept[IOException](FilmFile.open(file)).getMessage.contains("values are missing"))
    finally Files.delete(file)

  test("runs of missing shards are named by their ends, many by the first"):
    assert(FilmHeader.missing(Set(1, 5), 9) == Vector((0, 0), (2, 4), (6, 8)))
    assert(FilmHeader.named(FilmHeader.missing(Set(1, 5), 9), 9) == "0/9, 2/9 to 4/9, 6/9 to 8/9")
    val odd = FilmHeader.missing((0 until 100).filter(_ % 2 == 1).toSet, 100)
    assert(FilmHeader.named(odd, 100).endsWith("16/100, 18/100 and 40 more"))
