package candela.image

import candela.base.loop
import candela.color.Srgb

import org.lwjgl.stb.STBEasyFont
import org.lwjgl.system.MemoryUtil

/** Several pictures in one, in rows, each with its name below, over several lines if it is long.
  *
  * @param columns  pictures per row; None: about as many as rows
  * @param cellSize largest width and height of each picture, in pixels
  */
final class ContactSheet(columns: Option[Int] = None, cellSize: Int = ContactSheet.UsualSize):
  import ContactSheet.*

  /** @param pictures names, and images of display-referred colours */
  def of(pictures: Vector[(String, Image)]): Image =
    require(pictures.nonEmpty)
    val cells = pictures.map((name, image) => name -> Resize.fitting(image, cellSize, cellSize))
    val perRow = Math.min(
      columns.getOrElse(Math.ceil(Math.sqrt(cells.size.toDouble)).toInt),
      cells.size
    )
    val rows = (cells.size + perRow - 1) / perRow
    val cellWidth = Math.max(cells.map(_._2.width).max, SmallestCell)
    val cellHeight = cells.map(_._2.height).max
    val labels = cells.map((name, _) => lines(name, cellWidth))
    val labelHeight = LabelGap + LineHeight * labels.map(_.size).max
    val (stepX, stepY) = (cellWidth + Gap, cellHeight + labelHeight + Gap)
    val sheet = Canvas(perRow * stepX + Gap, rows * stepY + Gap)
    for (((_, image), label), i) <- cells.zip(labels).zipWithIndex do
      val (x, y) = (Gap + i % perRow * stepX, Gap + i / perRow * stepY)
      sheet.draw(image, x + (cellWidth - image.width) / 2, y + cellHeight - image.height)
      for (line, j) <- label.zipWithIndex do
        sheet.write(line, x, y + cellHeight + LabelGap + j * LineHeight)
    sheet.image

  /** A name, or the end of one that is too long for the lines, which tells files apart. */
  private def lines(name: String, width: Int): Vector[String] =
    val text = name.map(c => if c >= ' ' && c <= '~' then c else '?')
    def fits(t: String) = Scale * STBEasyFont.stb_easy_font_width(t) <= width
    def wrapped(t: String): Vector[String] =
      if fits(t) then Vector(t)
      else
        val line = t.inits.find(i => i.length <= 1 || fits(i)).get
        line +: wrapped(t.drop(line.length))
    val label = wrapped(text.takeRight(LabelCharacters))
    if text.length <= LabelCharacters && label.size <= LabelLines then label
    else
      val ends = text.takeRight(LabelCharacters).tails.map(t => wrapped(".." + t))
      ends.find(_.size <= LabelLines).get

object ContactSheet:
  val UsualSize = 320
  private val SmallestCell = 64
  private val Gap = 12

  /** Pixels per pixel of the font. */
  private val Scale = 2
  private val LabelGap = 4
  private val LineHeight = 12 * Scale
  private val LabelLines = 3

  /** More than fit. */
  private val LabelCharacters = 300

  private val Background = Srgb.decode(0.13f)
  private val Ink = Srgb.decode(0.85f)

  /** The sheet, being drawn. */
  private final class Canvas(width: Int, height: Int):
    val image: Image = Image.rgb(width, height)
    java.util.Arrays.fill(image.data, Background)

    def draw(picture: Image, x0: Int, y0: Int): Unit =
      loop(picture.height): y =>
        val to = 3 * ((y0 + y) * width + x0)
        System.arraycopy(picture.data, 3 * y * picture.width, image.data, to, 3 * picture.width)

    /** The font consists of rectangles: four vertices of 16 bytes each. */
    def write(text: String, x0: Int, y0: Int): Unit =
      val vertices = MemoryUtil.memAlloc(270 * (text.length + 1))
      try
        val count = STBEasyFont.stb_easy_font_print(0f, 0f, text, null, vertices)
        loop(count): i =>
          def coordinate(vertex: Int, axis: Int) =
            (Scale * vertices.getFloat(64 * i + 16 * vertex + 4 * axis)).toInt
          for
            y <- Math.max(0, y0 + coordinate(0, 1)) until Math.min(height, y0 + coordinate(2, 1))
            x <- Math.max(0, x0 + coordinate(0, 0)) until Math.min(width, x0 + coordinate(2, 0))
            c <- 0 until 3
          do image.data(3 * (y * width + x) + c) = Ink
      finally MemoryUtil.memFree(vertices)
