package candela.base

import org.scalatest.funsuite.AnyFunSuite

class DecimalSuite extends AnyFunSuite:

  test("decimal numbers are read, those of Java and C are not"):
    for text <- Seq("1", "+1", "-1", "1.", ".5", "1e3", "1E+3", "-2.5e-7") do
      assert(Decimal.double(text).contains(text.toDouble))
      assert(Decimal.float(text).contains(text.toFloat))
    val others =
      Seq("1e3f", "0.0F", "1d", "1D", "0x1p3", "0x10", "NaN", "nan", "Infinity", "-inf", "1_0")
    for text <- others ++ Seq("", ".", "1e", "--1", " 1", "1,5") do
      assert(Decimal.double(text).isEmpty && Decimal.float(text).isEmpty, text)
