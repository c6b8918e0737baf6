package candela.report

import scalatags.Text.TypedTag
import scalatags.Text.all.{attr, stringAttr, stringFrag, tag, Frag}

import java.util.Locale

/** SVG elements. */
private[report] object Svg:
  type Node = TypedTag[String]

  def element(name: String, attributes: (String, String)*)(children: Frag*): Node =
    tag(name)(attributes.map((key, value) => attr(key) := value)*)(children*)

  def text(x: Double, y: Double, css: String, anchor: String)(words: String): Node =
    element("text", "x" -> px(x), "y" -> px(y), "class" -> css, "text-anchor" -> anchor)(
      stringFrag(words)
    )

  def line(x1: Double, y1: Double, x2: Double, y2: Double, css: String): Node =
    element(
      "line",
      "x1" -> px(x1),
      "y1" -> px(y1),
      "x2" -> px(x2),
      "y2" -> px(y2),
      "class" -> css
    )()

  /** A tooltip. */
  def tip(words: String): Node = element("title")(stringFrag(words))

  def picture(width: Double, height: Double, label: String)(children: Frag*): Node =
    element(
      "svg",
      "xmlns" -> "http://www.w3.org/2000/svg",
      "viewBox" -> s"0 0 ${px(width)} ${px(height)}",
      "role" -> "img",
      "aria-label" -> label
    )(children*)

  /** A standalone file with the charts' style. */
  def standalone(width: Double, height: Double, label: String)(content: Vector[Frag]): String =
    val style = element("style")(scalatags.Text.all.raw(Page.chartStyle))
    val background = element("rect", "width" -> "100%", "height" -> "100%", "class" -> "back")()
    picture(width, height, label)((Vector(style, background) ++ content)*).render

  /** A group translated right and down. */
  def moved(x: Double, y: Double)(children: Vector[Frag]): Node =
    element("g", "transform" -> s"translate(${px(x)} ${px(y)})")(children*)

  /** Tenths of a pixel, finer than the display. */
  def px(value: Double): String = "%.1f".formatLocal(Locale.ROOT, value).stripSuffix(".0")
