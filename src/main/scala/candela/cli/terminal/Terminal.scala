package candela.cli.terminal

import candela.render.Progress

import java.io.{
  BufferedOutputStream, Console, FileDescriptor, FileOutputStream, FilterOutputStream, IOException,
  OutputStreamWriter, PrintStream, Writer
}
import java.nio.charset.{Charset, StandardCharsets}
import java.nio.file.{Files, Path}

import scala.util.Try

/** Output streams of a run, and its interrupts.
  *
  * @param stdout results
  * @param stderr problems and progress
  * @param isInteractive whether a line on `err` can be redrawn
  * @param columns text width, in characters
  * @param environment variables of the process
  * @param lost why output was lost, if it is known
  * @param isSeen whether results are shown by a terminal, instead of going to a file or program
  * @param follow receives the progress of renderings, instead of lines on `err`
  * @param passing image file of a single image, which is there only until a program has read it
  */
final class Terminal(
    stdout: PrintStream,
    stderr: PrintStream,
    val isInteractive: Boolean,
    val interrupts: Interrupts,
    val columns: Int = Terminal.UsualColumns,
    val environment: Map[String, String] = Map.empty,
    lost: () => Option[IOException] = () => None,
    isSeen: Boolean = false,
    val follow: Option[Progress => Unit] = None,
    val passing: Option[Path] = None
):
  val out: Printer = Printer(stdout)
  val err: Printer = Printer(stderr)

  /** Where a command writes text that is data for other programs: as it is, except to terminals. */
  def data: Writer =
    if isSeen then PrintingWriter(out) else OutputStreamWriter(out, StandardCharsets.UTF_8)

  /** Why some of the output could not be written, if so. */
  def failure: Option[IOException] =
    Option.when(out.checkError())(lost().getOrElse(IOException("it is closed")))

  /** The same streams with other interrupts. */
  private[cli] def interruptedBy(other: Interrupts): Terminal =
    Terminal(
      out,
      err,
      isInteractive,
      other,
      columns,
      environment,
      lost,
      follow = follow,
      passing = passing
    )

  /** Whether `err` shows colours. Source: "NO_COLOR", no-color.org. */
  def hasColor: Boolean = isInteractive && environment.getOrElse("NO_COLOR", "").isEmpty

  /** Whether a program reads `err`, for its own display of the progress. */
  def isReadByProgram: Boolean = environment.get("CANDELA_PROGRESS").contains("lines")

  /** Is nobody left who wants the result when standard input ends? */
  def belongsToProgram: Boolean = environment.get("CANDELA_PARENT").contains("stdin")

object Terminal:

  def ofProcess: Terminal =
    val redraws = isInteractive
    val interrupts = Interrupts.fromSignals(System.err, redraws)
    val stdout = Stdout()
    val buffered = BufferedOutputStream(stdout, 1 << 13)
    Terminal(
      PrintStream(buffered, false, charset),
      System.err,
      redraws,
      interrupts,
      columns,
      sys.env,
      () => stdout.failure,
      isAttached || isDevice(1, "/dev/pts/") || isDevice(1, "/dev/tty")
    )

  /** Standard output that remembers why it can't be written: a PrintStream tells only that. */
  private final class Stdout extends FilterOutputStream(FileOutputStream(FileDescriptor.out)):
    @volatile private var first = Option.empty[IOException]

    def failure: Option[IOException] = first

    override def write(byte: Int): Unit = noting(out.write(byte))

    override def write(bytes: Array[Byte], from: Int, count: Int): Unit =
      noting(out.write(bytes, from, count))

    private def noting(body: => Unit): Unit =
      try body
      catch
        case e: IOException =>
          first = first.orElse(Some(e))
          throw e

  /** As System.out has it. */
  private def charset: Charset =
    sys.props.get("stdout.encoding").orElse(sys.props.get("sun.stdout.encoding"))
      .flatMap(name => Try(Charset.forName(name)).toOption)
      .getOrElse(Charset.defaultCharset)

  private[cli] val UsualColumns = 80

  /** Width from the shell's COLUMNS, else from the terminal, else the usual one. */
  private def columns: Int =
    def number(text: String) = text.trim.toIntOption.filter(_ >= 20)
    sys.env.get("COLUMNS").flatMap(number)
      .orElse(Option(System.console()).flatMap(_ => sizeOfTerminal.flatMap(number)))
      .getOrElse(UsualColumns)

  /** Java has no API for the terminal size; `stty` exists wherever terminals do. */
  private def sizeOfTerminal: Option[String] = Try:
    val stty = ProcessBuilder("stty", "size").redirectInput(ProcessBuilder.Redirect.INHERIT).start()
    val text = String(stty.getInputStream.readAllBytes())
    text.trim.split(' ').last
  .toOption

  private def isInteractive: Boolean =
    val isDumb = sys.env.get("TERM").contains("dumb")
    isAttached && !isDumb && !errIsRedirected

  /** Whether input comes from a terminal, and output goes to it. */
  private def isAttached: Boolean = Option(System.console()).exists: console =>
    // Since JDK 22 a console may exist without a terminal; `isTerminal` tells them apart.
    val isTerminal = Try(classOf[Console].getMethod("isTerminal").invoke(console))
    isTerminal.fold(_ => true, java.lang.Boolean.TRUE.equals)

  /** System.console ignores stderr; /proc, where it exists, has its target. */
  private def errIsRedirected: Boolean = target(2).exists(!_.startsWith("/dev"))

  private def isDevice(stream: Int, name: String): Boolean =
    target(stream).exists(_.toString.startsWith(name))

  private def target(stream: Int): Option[Path] =
    Try(Files.readSymbolicLink(Path.of(s"/proc/self/fd/$stream"))).toOption
