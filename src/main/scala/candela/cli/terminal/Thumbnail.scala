package candela.cli.terminal

import candela.base.loop
import candela.diagnostics.{Code, Problem, SceneError}
import candela.color.Srgb
import candela.image.{DisplayTransform, Image, ImageFiles, Resize}

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.util.Base64

/** Ways to show an image in a terminal.
  *
  * @param word command-line name
  */
enum ThumbnailKind(val word: String):
  /** The best that the terminal is known to support. */
  case Auto extends ThumbnailKind("auto")

  /** Source: "Terminal graphics protocol", kitty's documentation. */
  case Kitty extends ThumbnailKind("kitty")

  /** Source: "Inline Images Protocol", iTerm2's documentation. */
  case Iterm extends ThumbnailKind("iterm")

  /** Source: "VT330/VT340 Programmer Reference Manual", vol. 2, §14. */
  case Sixel extends ThumbnailKind("sixel")

  /** Two pixels per character: upper half blocks in 24-bit colours. */
  case Blocks extends ThumbnailKind("blocks")

/** Encodes an image as text that a terminal shows as a picture. */
private[cli] object Thumbnail:
  private val Esc = "\u001b"

  /** Largest width and height of pictures, in pixels. */
  private val Size = 480

  /** Longest payload of a kitty command. */
  private val Chunk = 4096

  /** The protocol to use.
    *
    * @throws SceneError if `asked` is Auto and the terminal is unknown
    */
  def kind(asked: ThumbnailKind, terminal: Terminal): ThumbnailKind =
    val chosen =
      if asked != ThumbnailKind.Auto then Some(asked)
      else if terminal.isInteractive then kindOf(terminal.environment)
      else None
    chosen.getOrElse:
      val help = "--thumbnail kitty, iterm, sixel or blocks selects a protocol"
      throw SceneError(Problem.general(
        Code.Terminal,
        "no terminal known to show images",
        Some(help)
      ))

  /** The image as text; SceneError as by [[kind]]. */
  def of(
      image: Image,
      display: DisplayTransform,
      asked: ThumbnailKind,
      terminal: Terminal
  ): String = text(image, display, kind(asked, terminal), terminal.columns)

  /** The best kind for the terminal that these environment variables describe; None: unknown. */
  def kindOf(environment: Map[String, String]): Option[ThumbnailKind] =
    def value(name: String) = environment.getOrElse(name, "")
    val (term, program) = (value("TERM"), value("TERM_PROGRAM"))
    if environment.contains("KITTY_WINDOW_ID") || term == "xterm-kitty" ||
      program == "ghostty" || program == "WezTerm"
    then Some(ThumbnailKind.Kitty)
    else if program == "iTerm.app" || value("LC_TERMINAL") == "iTerm2" then
      Some(ThumbnailKind.Iterm)
    else if term.startsWith("foot") || term.startsWith("mlterm") || term.contains("sixel") then
      Some(ThumbnailKind.Sixel)
    else if Vector("truecolor", "24bit").contains(value("COLORTERM")) && value("NO_COLOR").isEmpty
    then
      Some(ThumbnailKind.Blocks)
    else None

  /** @param columns width of the terminal */
  private def text(
      image: Image,
      display: DisplayTransform,
      kind: ThumbnailKind,
      columns: Int
  ): String =
    val displayed = display(image)
    def small = Resize.fitting(displayed, Size, Size)
    kind match
      case ThumbnailKind.Kitty => kitty(ImageFiles.png(small))
      case ThumbnailKind.Iterm => iterm(ImageFiles.png(small))
      case ThumbnailKind.Sixel => Sixel.text(small)
      case _ => blocks(Resize.fitting(displayed, columns - 1, Size))

  private def kitty(png: Array[Byte]): String =
    val chunks = base64(png).grouped(Chunk).toVector
    val commands = chunks.zipWithIndex.map: (chunk, i) =>
      val first = if i == 0 then "a=T,f=100," else ""
      val moreFlag = if i < chunks.size - 1 then 1 else 0
      s"${Esc}_G${first}m=$moreFlag;$chunk$Esc\\"
    commands.mkString("", "", "\n")

  private def iterm(png: Array[Byte]): String =
    s"$Esc]1337;File=inline=1;size=${png.length}:${base64(png)}\u0007\n"

  private def base64(bytes: Array[Byte]): String =
    String(Base64.getEncoder.encode(bytes), ISO_8859_1)

  private def blocks(image: Image): String =
    def color(x: Int, y: Int) =
      (0 until 3).map(c => Srgb.encode8(image(x, y, c))).mkString(";")
    val text = StringBuilder()
    loop((image.height + 1) / 2): row =>
      loop(image.width): x =>
        text ++= s"$Esc[38;2;${color(x, 2 * row)}m"
        if 2 * row + 1 < image.height then text ++= s"$Esc[48;2;${color(x, 2 * row + 1)}m"
        text ++= "▀"
      text ++= s"$Esc[0m\n"
    text.toString
