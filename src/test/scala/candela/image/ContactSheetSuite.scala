package candela.image

import org.scalatest.funsuite.AnyFunSuite

class ContactSheetSuite extends AnyFunSuite:

  private def flat(width: Int, height: Int, r: Float, g: Float, b: Float): Image =
    Image(width, height, Image.RgbNames, Array.fill(width * height)(Vector(r, g, b)).flatten)

  /** Pixels of exactly this colour. */
  private def count(image: Image, r: Float, g: Float, b: Float): Int =
    (0 until image.width * image.height).count: i =>
      Vector(r, g, b).zipWithIndex.forall((v, c) => Math.abs(image.data(3 * i + c) - v) < 1e-3f)

  test("every picture is there in its size, in rows as asked"):
    val pictures = Vector(
      "a" -> flat(100, 50, 1f, 0f, 0f),
      "b" -> flat(50, 100, 0f, 1f, 0f),
      "c" -> flat(100, 100, 0f, 0f, 1f)
    )
    val row = ContactSheet(columns = Some(3)).of(pictures)
    val square = ContactSheet().of(pictures)
    assert(row.width > 300 && row.height < 200)
    assert(square.width < 300 && square.height > 200)
    for sheet <- Vector(row, square) do
      assert(count(sheet, 1f, 0f, 0f) == 5000)
      assert(count(sheet, 0f, 1f, 0f) == 5000)
      assert(count(sheet, 0f, 0f, 1f) == 10000)

  test("large pictures are reduced in proportion, small ones stay"):
    val sheet = ContactSheet(cellSize = 80).of(Vector("a" -> flat(400, 200, 1f, 0f, 0f)))
    assert(count(sheet, 1f, 0f, 0f) == 80 * 40)

  test("names are written below, long ones from their end"):
    def ink(name: String) =
      val sheet = ContactSheet().of(Vector(name -> flat(120, 50, 1f, 0f, 0f)))
      val background = sheet(0, 0, 0)
      (0 until sheet.width * sheet.height).count: i =>
        sheet.data(3 * i) != background && sheet.data(3 * i + 1) != 0f
    assert(ink("") == 0)
    assert(ink("ab") > ink("a") && ink("a") > 20)
    // Ten letters fit a line, thirty a label
    val long = (0 until 30).map(i => ('a' + i % 26).toChar).mkString
    assert(ink(long.take(20)) > 1.5 * ink(long.take(10)))
    assert(ink("x" * 500 + "ab.exr") == ink("x" * 900 + "ab.exr"))
    assert(ink("x" * 500) > 2 * ink("xxxxxxxx"))
    assert(ink("ü") == ink("?"))

  test("NaN and infinity don't spread"):
    val image = flat(200, 200, 0.5f, 0.5f, 0.5f)
    image.data(3 * 100 * 200 + 300) = Float.NaN
    image.data(0) = Float.PositiveInfinity
    val small = Resize.fitting(image, 20, 20)
    assert(small.data.forall(v => v >= 0.3f && v <= 1f))
