package candela.lights

import candela.base.Decimal
import candela.io.{InputFile, IoReason}
import java.io.IOException
import java.util.Locale

/** The light of a file, and what of the file has no effect. */
final case class IesLight(photometry: Photometry, notes: Vector[String])

/** Why a file can't be read, with its name and line. */
final class IesError(message: String) extends Exception(message)

/** Reads photometric files of IESNA LM-63: those of 1986, 1991, 1995, 2002 and 2019.
  *
  * Source: ANSI/IES LM-63-19, "Approved Method: IES Standard File Format for the Electronic
  * Transfer of Photometric Data and Related Information".
  */
object IesFile:

  def isNamed(file: String): Boolean = file.toLowerCase(Locale.ROOT).endsWith(".ies")

  def read(file: InputFile): IesLight =
    val text =
      try file.text()
      catch case e: IOException => throw IesError(s"$file: can't be read: ${IoReason(e)}")
    parse(file.toString, text)

  /** @param name of the file, for messages */
  def parse(name: String, text: String): IesLight =
    val lines = text.linesIterator.toVector
    val tilt = lines.indexWhere(_.trim.toUpperCase(Locale.ROOT).startsWith("TILT"))
    if tilt < 0 then
      throw IesError(s"$name: expected a line `TILT=NONE`, as in all IES files; there is none")
    Reading(name, lines, tilt).light

  /** @param tilt index of the line that ends the header */
  private final class Reading(name: String, lines: Vector[String], tilt: Int):
    private var line = tilt
    private var words = Iterator.empty[String]

    private def fail(message: String): Nothing = throw IesError(s"$name:${line + 1}: $message")

    private def shortened(word: String): String =
      word.take(20)

    private def word(what: => String): String =
      while !words.hasNext do
        line += 1
        if line >= lines.length then
          line = lines.length - 1
          fail(s"expected $what, found the end of the file")
        words = lines(line).split("[\\s,;]+").iterator.filter(_.nonEmpty)
      words.next()

    private def number(what: => String): Float =
      val token = word(what)
      Decimal.float(token).filter(java.lang.Float.isFinite(_))
        .getOrElse(fail(s"expected $what, found `${shortened(token)}`"))

    private def integer(what: String, min: Int, max: Int): Int =
      val x = number(what)
      if x != x.toInt || x < min || x > max then
        fail(s"expected $what, a whole number from $min to $max, found $x")
      x.toInt

    private def numbers(count: Int, what: String): Array[Float] =
      Array.tabulate(count)(i => number(s"$what ${i + 1} of $count"))

    private def angles(count: Int, what: String): Array[Float] =
      val result = new Array[Float](count)
      for i <- 0 until count do
        result(i) = number(s"$what ${i + 1} of $count")
        if Math.abs(result(i)) > 360f then fail(s"expected an angle in degrees, found ${result(i)}")
        if i > 0 && result(i) <= result(i - 1) then
          fail(s"expected ascending angles, found ${result(i)} after ${result(i - 1)}")
      result

    def light: IesLight =
      val notes = Vector.newBuilder[String]
      val tiltValue = lines(tilt).dropWhile(_ != '=').drop(1).trim
      if tiltValue.toUpperCase(Locale.ROOT) != "NONE" then
        val value = shortened(tiltValue)
        notes += s"$name:${tilt + 1}: `TILT=$value` is ignored: the lamp is not tilted"
        if tiltValue.toUpperCase(Locale.ROOT) == "INCLUDE" then
          number("the lamp's geometry"): Unit
          val count = integer("the number of tilts", 0, 10_000)
          numbers(2 * count, "tilt or multiplier"): Unit
      number("the number of lamps"): Unit
      number("the lumens of a lamp"): Unit
      val multiplier = number("the multiplier of candelas")
      val rows = integer("the number of vertical angles", 1, 100_000)
      val planes = integer("the number of horizontal angles", 1, 100_000)
      if rows.toLong * planes > 50_000_000 then fail(s"$rows × $planes candelas are too many")
      val kind = integer("the photometric type, 1 (C), 2 (B) or 3 (A)", 1, 3) match
        case 1 => PhotometricType.C
        case 2 => PhotometricType.B
        case _ => PhotometricType.A
      numbers(4, "unit or size of the light"): Unit
      val ballast = number("the ballast factor")
      // Until 1991 another factor; since 1995 unused, since 2019 a kind of file
      val lampFactor = number("the ballast-lamp factor")
      number("the input watts"): Unit
      val factor = multiplier * ballast * (if isOld then lampFactor else 1f)
      val vertical = angles(rows, "vertical angle")
      val horizontal = angles(planes, "horizontal angle")
      val candelas = new Array[Float](rows * planes)
      var negative = 0
      for i <- candelas.indices do
        val x = number(s"candela ${i % rows + 1} of $rows in plane ${i / rows + 1} of $planes")
        if x * factor < 0f && negative == 0 then negative = line + 1
        candelas(i) = Math.max(0f, x * factor)
      if negative > 0 then notes += s"$name:$negative: negative candelas are read as 0"
      IesLight(Photometry(kind, vertical, horizontal, candelas), notes.result())

    private def isOld: Boolean =
      val mark = lines.head.trim.toUpperCase(Locale.ROOT)
      !mark.startsWith("IES") || mark.startsWith("IESNA91") || mark.contains("LM-63-1986") ||
      mark.contains("LM-63-1991")
