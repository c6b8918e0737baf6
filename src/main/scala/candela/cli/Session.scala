package candela.cli

import candela.cli.terminal.{ExitCode, Interrupts, ProgressLine, Terminal}
import candela.io.Keep
import candela.job.{Prepared, SceneLoader}
import candela.render.{Cancellation, Progress}
import candela.settings.{BuildControl, RenderSettings}

import java.io.{BufferedReader, InputStream, InputStreamReader, OutputStream, PrintStream}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path
import java.util.concurrent.LinkedBlockingQueue

import scala.util.Try

/** `candela session`: runs the command lines that another program sends, one after the other, so
  * that Java starts once, and later scenes use what earlier ones have loaded.
  *
  * Each line of input and output is a JSON object. A request has the words of a command line; if
  * one of them is the name of a scene that is no file, it has the scene's text:
  * {{{
  * {"run": ["render", "scene.xml", "--outfile", "a.npz"], "scene": "scene.xml", "text": "<scene…"}
  * }}}
  * If `image` is one of its output files, the rendering is of a single image, which is there only
  * until the program has read it.
  *
  * The answer is any number of `{"message": …}`, a line for standard error, and
  * `{"progress": {"done": 0.5, …}}`; the last has the exit code: `{"code": 0, "output": …}`.
  * `{"cancel": true}` ends the rendering early, as Ctrl-C does. The end of input ends the process
  * once all requests are answered; at once if `CANDELA_PARENT` says that its program has ended.
  *
  * @param terminal of the process; its `out` receives the answers
  * @param loader   of scenes that are files
  */
private[cli] final class Session(input: InputStream, terminal: Terminal, loader: SceneLoader):
  import Session.*

  private val cache = Keep()

  /** Requests in their order; None: no more will come. */
  private val queue = LinkedBlockingQueue[Option[(Request, Asked)]]()

  def run(): ExitCode =
    Interrupts.listening(read())
    Iterator.continually(queue.take()).takeWhile(_.nonEmpty).flatten.foreach(answer(_, _))
    ExitCode.Done

  private def read(): Unit =
    val lines = BufferedReader(InputStreamReader(input, UTF_8))
    var latest = Asked()
    val _ = Try:
      for line <- Iterator.continually(lines.readLine()).takeWhile(_ != null) do
        Request.of(line) match
          case Request.Cancel => latest.cancel()
          case request =>
            latest = Asked()
            queue.put(Some((request, latest)))
    // Then nobody waits for an answer, not even for that of a rendering in progress
    if terminal.belongsToProgram then terminal.interrupts.quit(ExitCode.Done)
    queue.put(None)

  private def answer(request: Request, asked: Asked): Unit = request match
    case Request.Run(words, scene, image) if !words.headOption.contains(Name) =>
      val output = java.io.ByteArrayOutputStream()
      val inner = Terminal(
        PrintStream(output, false, UTF_8),
        PrintStream(Lines(line => send("message" -> line)), true, UTF_8),
        isInteractive = false,
        asked,
        environment = terminal.environment,
        follow = Some(p => send("progress" -> fields(p))),
        passing = image
      )
      val scenes = scene.fold(loader)(s => SceneLoader.OfText(s.name, s.text, loader))
      val code = Main.run(words, inner, Caching(scenes, cache))
      inner.out.flush()
      inner.err.flush()
      send("code" -> code, "output" -> output.toString(UTF_8))
    case _ =>
      send("message" -> "error: not a request: expected an object with the command line in `run`")
      send("code" -> ExitCode.BadUsage.number, "output" -> "")

  private def send(fields: (String, ujson.Value)*): Unit = synchronized:
    terminal.out.println(ujson.write(ujson.Obj.from(fields), escapeUnicode = true))
    terminal.out.flush()

private[cli] object Session:
  private val Name = "session"

  /** The numbers of a rendering's progress that are known. */
  private def fields(p: Progress): ujson.Value =
    val figures = Vector(
      p.knownFraction.map("done" -> _),
      Some("seconds" -> p.seconds),
      Some("samples" -> p.done.toDouble),
      p.outlook.rate.map("samplesPerSecond" -> _),
      p.outlook.error.map("error" -> _),
      p.outlook.left.map("secondsLeft" -> _)
    ).flatten.filter((_, x) => java.lang.Double.isFinite(x))
    val numbers = figures.map((name, x) => name -> (ujson.Num(x): ujson.Value))
    ujson.Obj.from(numbers :+ ("line" -> ujson.Str(ProgressLine.line(p))))

  private enum Request:
    case Cancel
    case Run(words: Vector[String], scene: Option[SceneText], image: Option[Path])
    case Unreadable

  private object Request:
    def of(line: String): Request = Try:
      val fields = ujson.read(line).obj
      if fields.contains("cancel") then Cancel
      else
        val scene =
          for name <- fields.get("scene"); text <- fields.get("text")
          yield SceneText(name.str, text.str)
        val image = fields.get("image").map(file => Path.of(file.str))
        Run(fields("run").arr.map(_.str).toVector, scene, image)
    .getOrElse(Unreadable)

  /** A scene that is no file.
    *
    * @param name as a word of the command line; file names in the text are relative to its folder
    */
  private final case class SceneText(name: String, text: String)

  /** Loads scenes with what those before them have in common with them. */
  private final class Caching(scenes: SceneLoader, cache: Keep) extends SceneLoader:
    def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
      val isCached = control.cache.isKeeping
      scenes.load(scene, settings, if isCached then control else control.copy(cache = cache))

  /** Requests to end a rendering, from the program. */
  private final class Asked extends Interrupts:
    private var isCancelled = false
    private var running = Option.empty[Cancellation]

    def cancel(): Unit = synchronized:
      isCancelled = true
      running.foreach(_.request())

    def during[A](cancellation: Cancellation)(body: => A): A =
      synchronized:
        running = Some(cancellation)
        if isCancelled then cancellation.request()
      try body
      finally synchronized { running = None }

  /** Receives bytes, and passes lines on. */
  private final class Lines(act: String => Unit) extends OutputStream:
    private val line = java.io.ByteArrayOutputStream()

    override def write(byte: Int): Unit =
      if byte != '\n' then line.write(byte)
      else
        act(line.toString(UTF_8).stripSuffix("\r"))
        line.reset()
