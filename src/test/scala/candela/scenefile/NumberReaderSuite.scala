package candela.scenefile

import java.nio.charset.StandardCharsets.ISO_8859_1

import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

class NumberReaderSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  implicit override val generatorDrivenConfig: PropertyCheckConfiguration =
    PropertyCheckConfiguration(minSuccessful = 20000)

  private def reader(text: String, after: String = ""): NumberReader =
    val number = NumberReader(Source("", (text + after).getBytes(ISO_8859_1)))
    assert(number.scan(0) == text.length, text)
    number

  /** What follows decides whether a number is read eight bytes at a time. */
  private def sameAsJdk(text: String): Unit =
    for after <- List("", "\n" + "7" * 40) do sameAsJdk(text, reader(text, after))

  private def sameAsJdk(text: String, number: NumberReader): Unit =
    val float = java.lang.Float.floatToIntBits(number.toFloat)
    assert(float == java.lang.Float.floatToIntBits(text.toFloat), text)
    val double = java.lang.Double.doubleToLongBits(number.toDouble)
    assert(double == java.lang.Double.doubleToLongBits(text.toDouble), text)
    ()

  private val digits = Gen.listOf(Gen.numChar).map(_.mkString)

  private val decimals =
    for
      sign <- Gen.oneOf("", "-", "+")
      whole <- digits
      fraction <- Gen.option(digits)
      exponent <- Gen.option(Gen.choose(-50, 50))
      if whole.nonEmpty || fraction.exists(_.nonEmpty)
    yield sign + whole + fraction.fold("")("." + _) + exponent.fold("")("e" + _)

  test("any decimal number is the Float and the Double that the JDK makes of it"):
    forAll(decimals)(sameAsJdk)

  test("every Float comes back from its shortest and from its 17-digit form"):
    forAll(Gen.choose(Int.MinValue, Int.MaxValue)): bits =>
      val float = java.lang.Float.intBitsToFloat(bits)
      whenever(java.lang.Float.isFinite(float)):
        sameAsJdk(float.toString.replace('E', 'e'))
        sameAsJdk("%.16e".formatLocal(java.util.Locale.ROOT, float.toDouble))
        assert(reader(float.toString).toFloat == float)

  test("numbers halfway between two Floats, and a trifle beside, go to the right side", Slow):
    forAll(Gen.choose(0x00800000, 0x7f000000)): bits =>
      val low = java.lang.Float.intBitsToFloat(bits).toDouble
      val high = java.lang.Float.intBitsToFloat(bits + 1).toDouble
      val halfway = BigDecimal((low + high) / 2)
      for factor <- List("1", "1.00000000000000001", "0.99999999999999999") do
        val exact = halfway * BigDecimal(factor)
        sameAsJdk(exact.bigDecimal.toPlainString)
        sameAsJdk(exact.toString.toLowerCase)

  test("numbers of every usual length, as meshes have them, are those of the JDK"):
    val lengths = Gen.choose(0, 12)
    forAll(lengths, lengths, Gen.numStr, Gen.oneOf("", "-", "+")): (whole, fraction, seed, sign) =>
      val digits = (seed * 30 + "314159265358979323846264").take(24)
      val text = digits.take(whole) + "." + digits.slice(12, 12 + fraction)
      whenever(text.length > 1)(sameAsJdk(sign + text))
      whenever(whole > 0)(sameAsJdk(sign + digits.take(whole)))

  test("the usual spellings are read"):
    val spellings = List(".5", "5.", "-0", "+3", "1e-3", "1E+3", "-.25e2", "007", "1e400", "1e-400")
    spellings.foreach(sameAsJdk)

  test("what is no number, or has something at its end, is refused"):
    for text <- "- . +. e5 1e 1e+ 1.2.3 1f 0x10 nan inf 1-2".split(' ').toList :+ "" do
      for after <- List("", " " * 40) do
        val source = Source.fromText("", text + after)
        assert(NumberReader(source).scan(0) == -1, text)

  test("a number ends before a blank, a bracket, a quote, a comma, a comment and the end"):
    for end <- List(" ", "\n", "\r", "\t", "]", "[", "\"", "#", ",", "") do
      assert(NumberReader(Source("", ("12" + end).getBytes(ISO_8859_1))).scan(0) == 2, s"`$end`")

  test("whole numbers are told from fractions, and those beyond 32 bits from the others"):
    assert(List("3", "3.0", "3e2", "-7", "30e-1").forall(reader(_).isWhole))
    assert(!List("3.5", "35e-1", "1e-9").exists(reader(_).isWhole))
    assert(List("2147483647", "-2147483648", "2147483647.5").forall(reader(_).fitsInt))
    val large = List("2147483648", "-2147483649", "1e10", "99999999999999999999")
    assert(!large.exists(reader(_).fitsInt))
    assert(reader("-2147483648").toInt == Int.MinValue)
    assert(reader("-3.9").toInt == -3)
    assert(reader("12e1").toInt == 120)
