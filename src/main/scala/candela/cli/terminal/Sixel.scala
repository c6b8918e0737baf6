package candela.cli.terminal

import candela.base.loop
import candela.color.Srgb
import candela.image.Image

/** Encodes images as sixels: bands of six rows, one pass per colour of a band. Colours are those of
  * a 6 × 6 × 6 cube, chosen by ordered dithering.
  *
  * Source of the thresholds: Bayer, "An Optimum Method for Two-Level Rendition of Continuous-Tone
  * Pictures", ICC 1973.
  */
private[cli] object Sixel:
  private val Levels = 6
  private val Bayer = Array(0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5)

  /** @param image linear R, G and B */
  def text(image: Image): String =
    val codes = new Array[Int](image.width * image.height)
    loop(codes.length)(i => codes(i) = code(image, i % image.width, i / image.width))
    val text = StringBuilder(s"\u001bPq\"1;1;${image.width};${image.height}")
    for code <- codes.distinct.sorted do
      val components = Vector(code / 36, code / 6 % 6, code % 6).map(_ * 100 / (Levels - 1))
      text ++= s"#$code;2;${components.mkString(";")}"
    for top <- 0 until image.height by 6 do
      val rows = Math.min(6, image.height - top)
      def column(x: Int, wanted: Int) =
        (0 until rows).map(r => if codes((top + r) * image.width + x) == wanted then 1 << r else 0)
      val bandCodes = codes.slice(top * image.width, (top + rows) * image.width).distinct.sorted
      val passes = bandCodes.map: wanted =>
        val sixels = (0 until image.width).map(x => (63 + column(x, wanted).sum).toChar).mkString
        s"#$wanted${packed(sixels)}"
      text ++= passes.mkString("", "$", "-")
    text ++= "\u001b\\\n"
    text.toString

  private def code(image: Image, x: Int, y: Int): Int =
    val threshold = (Bayer(4 * (y & 3) + (x & 3)) + 0.5f) / 16
    def level(c: Int) =
      val value = Math.max(0f, Math.min(1f, Srgb.encode(image(x, y, c))))
      Math.min(Levels - 1, (value * (Levels - 1) + threshold).toInt)
    (level(0) * Levels + level(1)) * Levels + level(2)

  /** Run lengths of more than three. */
  private def packed(sixels: String): String =
    "(.)\\1{3,}".r.replaceAllIn(
      sixels,
      run => java.util.regex.Matcher.quoteReplacement(s"!${run.matched.length}${run.group(1)}")
    )
