package candela.cli.terminal

import candela.diagnostics.SceneError
import candela.color.Srgb
import candela.image.{DisplayTransform, Image}

import java.io.ByteArrayInputStream
import java.util.Base64
import javax.imageio.ImageIO

import org.scalatest.funsuite.AnyFunSuite

class ThumbnailSuite extends AnyFunSuite:
  private val Esc = "\u001b"

  /** Red on the left, noise on the right: its PNG is longer than a chunk. */
  private val picture =
    val random = scala.util.Random(3)
    val data = Array.tabulate(80 * 60 * 3): i =>
      if i / 3 % 80 < 40 then (if i % 3 == 0 then 1f else 0f) else random.nextFloat()
    Image(80, 60, Image.RgbNames, data)

  private def shown(image: Image, kind: ThumbnailKind, columns: Int = 41): String =
    val terminal = Terminal(System.out, System.err, false, Interrupts.Ignored, columns)
    Thumbnail.of(image, DisplayTransform.Plain, kind, terminal)

  private def decoded(base64: String) =
    ImageIO.read(ByteArrayInputStream(Base64.getDecoder.decode(base64)))

  test("kitty: a PNG in chunks of at most 4096 bytes, all but the last marked"):
    val commands = shown(picture, ThumbnailKind.Kitty).stripSuffix("\n").split(s"$Esc\\\\").toVector
    assert(commands.size > 2 && commands.forall(_.startsWith(s"${Esc}_G")))
    val (keys, payloads) =
      commands.map(_.drop(3).split(";", 2)).map(p => (p(0), p(1))).unzip
    assert(keys.head == "a=T,f=100,m=1" && keys.last == "m=0")
    assert(keys.drop(1).dropRight(1).forall(_ == "m=1"))
    assert(payloads.forall(_.length <= 4096) && payloads.dropRight(1).forall(_.length % 4 == 0))
    val image = decoded(payloads.mkString)
    assert((image.getWidth, image.getHeight) == (80, 60))
    assert((image.getRGB(5, 5) & 0xffffff) == 0xff0000)

  test("iTerm: one PNG and its size"):
    val text = shown(picture, ThumbnailKind.Iterm)
    val Array(head, base64) = text.stripSuffix("\u0007\n").split(":"): @unchecked
    val size = Base64.getDecoder.decode(base64).length
    assert(head == s"$Esc]1337;File=inline=1;size=$size")
    assert(decoded(base64).getWidth == 80)

  test("sixel: drawn by a terminal, the picture comes back"):
    val flat = Image(13, 9, Image.RgbNames, Array.fill(13 * 9)(Vector(1f, 0f, 0f)).flatten)
    for y <- 0 until 9; c <- 0 until 3 do flat.data(3 * (13 * y + 7) + c) = 1f
    val drawn = SixelTerminal.draw(shown(flat, ThumbnailKind.Sixel))
    assert((drawn.size, drawn.head.size) == (9, 13))
    for row <- drawn; (color, x) <- row.zipWithIndex do
      assert(color == (if x == 7 then (100, 100, 100) else (100, 0, 0)), s"column $x")

  test("sixel: dithering keeps the mean of a grey"):
    val gray = Image(40, 40, Image.RgbNames, Array.fill(4800)(Srgb.decode(0.5f)))
    val drawn = SixelTerminal.draw(shown(gray, ThumbnailKind.Sixel)).flatten
    assert(drawn.toSet.size == 2)
    // Levels of 20 %, thresholds of a sixteenth of that.
    assert(Math.abs(drawn.map(_._1).sum / 1600.0 - 50) < 20.0 / 16)

  test("blocks: two pixels a character, no wider than the terminal"):
    val lines = shown(picture, ThumbnailKind.Blocks).linesIterator.toVector
    assert(lines.size == 15 && lines.forall(_.count(_ == '▀') == 40))
    assert(lines.head.startsWith(s"$Esc[38;2;255;0;0m$Esc[48;2;255;0;0m▀"))
    assert(lines.forall(_.endsWith(s"$Esc[0m")))

  test("the terminal is known by its environment variables"):
    def kind(variables: (String, String)*) = Thumbnail.kindOf(variables.toMap)
    assert(kind("TERM" -> "xterm-kitty").contains(ThumbnailKind.Kitty))
    assert(kind("TERM_PROGRAM" -> "iTerm.app").contains(ThumbnailKind.Iterm))
    assert(kind("TERM" -> "foot").contains(ThumbnailKind.Sixel))
    assert(kind("TERM" -> "xterm", "COLORTERM" -> "truecolor").contains(ThumbnailKind.Blocks))
    assert(kind("COLORTERM" -> "truecolor", "NO_COLOR" -> "1").isEmpty)
    assert(kind("TERM" -> "xterm").isEmpty)

  test("an unknown terminal, or none, is an error with the choices"):
    val error = intercept[SceneError](shown(picture, ThumbnailKind.Auto))
    assert(error.problems.map(_.message) == Vector("no terminal known to show images"))
    assert(error.problems.head.help.exists(_.contains("kitty, iterm, sixel or blocks")))

/** A terminal that draws sixels, as far as [[Sixel]] uses them. */
private object SixelTerminal:
  private type Color = (Int, Int, Int)

  def draw(text: String): Vector[Vector[Color]] =
    val body = text.stripPrefix("\u001bPq").stripSuffix("\u001b\\\n")
    val Array(_, _, width, height) = body.drop(1).takeWhile(_ != '#').split(";").map(_.toInt)
    val grid = Array.fill(height, width)((-1, -1, -1))
    val colors = scala.collection.mutable.Map.empty[Int, Color]
    val token = "#(\\d+);2;(\\d+);(\\d+);(\\d+)|#(\\d+)|!(\\d+)(.)|(\\$)|(-)|([?-~])".r
    var (x, y, color) = (0, 0, -1)
    def sixel(bits: Int) =
      for r <- 0 until 6 if (bits >> r & 1) == 1 do grid(y + r)(x) = colors(color)
      x += 1
    for m <- token.findAllMatchIn(body.dropWhile(_ != '#')) do
      if m.group(1) != null then
        colors(m.group(1).toInt) = (m.group(2).toInt, m.group(3).toInt, m.group(4).toInt)
      else if m.group(5) != null then color = m.group(5).toInt
      else if m.group(6) != null then
        for _ <- 0 until m.group(6).toInt do sixel(m.group(7).head - 63)
      else if m.group(8) != null then x = 0
      else if m.group(9) != null then
        x = 0
        y += 6
      else sixel(m.group(10).head - 63)
    grid.map(_.toVector).toVector
