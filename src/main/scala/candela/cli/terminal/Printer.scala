package candela.cli.terminal

import candela.diagnostics.Visible
import java.io.{PrintStream, Writer}

/** The door to a terminal or file: all that is printed passes it. Texts of scenes, names of files
  * and the like can't control the terminal: they are made visible. `write` passes data as they are.
  */
final class Printer private (to: PrintStream) extends PrintStream(to):

  /** Prints one line: a line end within it is shown. */
  override def println(line: String): Unit = to.println(Visible.line(line))

  override def println(what: Object): Unit = println(String.valueOf(what))

  override def println(): Unit = to.println()

  /** Prints text that may have several lines. */
  override def print(text: String): Unit = to.print(Visible.text(text))

  /** Prints a line with a coloured part.
    *
    * @param color its parameter of ECMA-48's SGR
    */
  def println(before: String, marked: String, color: String, after: String): Unit =
    val texts = Vector(before, marked, after).map(Visible.line)
    to.println(s"${texts(0)}\u001b[1;${color}m${texts(1)}\u001b[0m${texts(2)}")

  /** Prints escape sequences and carriage returns of the program itself. */
  def control(text: String): Unit = to.print(text)

  override def flush(): Unit = to.flush()
  override def checkError(): Boolean = to.checkError()
  override def write(bytes: Array[Byte], from: Int, count: Int): Unit = to.write(bytes, from, count)
  override def write(byte: Int): Unit = to.write(byte)

object Printer:
  def apply(to: PrintStream): Printer = to match
    case printer: Printer => printer
    case other => new Printer(other)

/** Prints a stream of text, of which parts arrive. */
private[cli] final class PrintingWriter(to: Printer) extends Writer:
  // The first half of a character whose second half is yet to come
  private var pending = ""

  override def write(chars: Array[Char], from: Int, count: Int): Unit =
    val text = pending + String(chars, from, count)
    pending = if text.lastOption.exists(Character.isHighSurrogate) then text.takeRight(1) else ""
    to.print(text.dropRight(pending.length))

  override def flush(): Unit = to.flush()

  override def close(): Unit =
    to.print(pending)
    to.flush()
