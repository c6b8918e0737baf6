package candela.testing

import candela.testing.Eventually.eventually

import java.io.File
import java.net.URI
import java.net.http.{HttpClient, WebSocket}
import java.nio.file.{Files, Path}
import java.util.Base64
import java.util.concurrent.{CompletionStage, LinkedBlockingQueue, TimeUnit}

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** A headless Chromium of this machine, for tests of pages. */
object Chromium:
  val names: Vector[String] = Vector("chromium", "chromium-browser", "chromium-headless-shell") ++
    Vector("google-chrome", "google-chrome-stable", "chrome")

  def installed: Option[Path] =
    val folders = sys.env.getOrElse("PATH", "").split(File.pathSeparatorChar).toVector
    (for name <- names; folder <- folders yield Path.of(folder, name)).find(Files.isExecutable(_))

  /** Without a window, and without a network but this machine. */
  def command(browser: Path, profile: Path): Vector[String] =
    Vector(browser.toString, "--headless", "--no-sandbox", "--disable-gpu") ++
      Vector(s"--user-data-dir=$profile") :+
      "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost, EXCLUDE 127.0.0.1"

  def delete(folder: Path): Unit =
    Using.resource(Files.walk(folder)): files =>
      files.iterator.asScala.toVector.reverse.foreach(f => f.toFile.delete())

  def kill(process: Process): Unit =
    process.descendants.forEach(p => p.destroyForcibly(): Unit)
    val _ = process.destroyForcibly().waitFor()

  /** A page that stays open while a test uses it.
    *
    * After the Chrome DevTools Protocol: Runtime.evaluate, Input.dispatchKeyEvent,
    * Page.captureScreenshot.
    */
  def use[A](browser: Path, address: String)(test: OpenPage => A): A =
    val folder = Files.createTempDirectory("candela-chromium")
    val words = command(browser, folder) ++
      Vector("--remote-debugging-port=0", "--window-size=960,1250", address)
    val process = ProcessBuilder(words.asJava)
      .redirectOutput(folder.resolve("out.txt").toFile)
      .redirectError(folder.resolve("err.txt").toFile).start()
    try
      val page = OpenPage(socketOf(folder))
      try test(page)
      finally page.close()
    finally
      kill(process)
      delete(folder)

  private def socketOf(profile: Path): URI =
    val ports = profile.resolve("DevToolsActivePort")
    val line = eventually(s"$ports"):
      Option.when(Files.exists(ports))(Files.readAllLines(ports).asScala.headOption).flatten
    eventually("a page"):
      val list = Using.resource(URI(s"http://127.0.0.1:$line/json/list").toURL.openStream()): in =>
        ujson.read(in.readAllBytes())
      list.arr.find(_("type").str == "page").map(p => URI(p("webSocketDebuggerUrl").str))

/** A page, open in a browser. */
final class OpenPage(address: URI) extends AutoCloseable:
  private val answers = LinkedBlockingQueue[ujson.Value]()
  private var calls = 0

  private val found = LinkedBlockingQueue[String]()

  private def noted(event: ujson.Value): Unit =
    val isBad = event("method").str match
      case "Log.entryAdded" => event("params")("entry")("level").str == "error"
      case "Runtime.consoleAPICalled" => event("params")("type").str == "error"
      case method => method == "Runtime.exceptionThrown"
    if isBad then found.put(event("params").toString)

  /** Errors of its scripts, of what it loads, and against its policy. */
  def problems: Vector[String] = found.asScala.toVector

  private val listener = new WebSocket.Listener:
    private val text = StringBuilder()
    override def onText(
        s: WebSocket,
        part: CharSequence,
        last: Boolean
    ): CompletionStage[?] | Null =
      text.append(part)
      if last then
        val message = ujson.read(text.toString)
        text.clear()
        if message.obj.contains("id") then answers.put(message) else noted(message)
      s.request(1)
      null

  private val socket =
    HttpClient.newHttpClient.newWebSocketBuilder.buildAsync(address, listener).join()

  for domain <- Vector("Log", "Runtime") do call(s"$domain.enable"): Unit

  def close(): Unit = socket.abort()

  /** Shows it in a window of this size, light or dark. */
  def resize(width: Int, height: Int, isDark: Boolean = false): Unit =
    val _ = call(
      "Emulation.setDeviceMetricsOverride",
      "width" -> width,
      "height" -> height,
      "deviceScaleFactor" -> 1,
      "mobile" -> false
    )
    val scheme = if isDark then "dark" else "light"
    val feature = ujson.Obj("name" -> "prefers-color-scheme", "value" -> scheme)
    val _ = call("Emulation.setEmulatedMedia", "features" -> ujson.Arr(feature))

  /** Whether it is wider than the window. */
  def overflows: Boolean =
    value("document.documentElement.scrollWidth > document.documentElement.clientWidth").bool

  /** The elements that Tab comes to, from the beginning, by id, class or text. */
  def tabbed(most: Int): Vector[String] =
    val _ = value("document.activeElement.blur()")
    Vector.fill(most):
      press("Tab")
      value("(e => e === document.body ? '' : e.id || (e.tagName === 'BUTTON' ? e.textContent : " +
        "e.className) || e.tagName)(document.activeElement)").str

  /** Turns the mouse wheel in the middle of an element. */
  def wheel(selector: String, down: Int, modifiers: Int = 0): Unit =
    val box = value(s"(b => [b.x + b.width / 2, b.y + b.height / 2])" +
      s"(document.querySelector('$selector').getBoundingClientRect())").arr
    val _ = call(
      "Input.dispatchMouseEvent",
      "type" -> "mouseWheel",
      "x" -> box(0),
      "y" -> box(1),
      "deltaX" -> 0,
      "deltaY" -> down,
      "modifiers" -> modifiers
    )

  private def mouse(kind: String, x: Double, y: Double, buttons: Int): Unit =
    val _ = call(
      "Input.dispatchMouseEvent",
      "type" -> kind,
      "x" -> x,
      "y" -> y,
      "button" -> (if kind == "mouseMoved" && buttons == 0 then "none" else "left"),
      "buttons" -> buttons,
      "clickCount" -> 1
    )

  /** A place of an element in the window, in parts of its width and height. */
  private def place(selector: String, x: Double, y: Double): (Double, Double) =
    val box = value(s"(b => [b.x + b.width * $x, b.y + b.height * $y])" +
      s"(document.querySelector('$selector').getBoundingClientRect())").arr.map(_.num)
    (box(0), box(1))

  /** Drags the mouse over an element, by places in parts of its width and height. */
  def drag(selector: String, places: (Double, Double)*): Unit =
    val (startX, startY) = place(selector, places.head._1, places.head._2)
    mouse("mousePressed", startX, startY, 1)
    for (x, y) <- places.tail do
      val (windowX, windowY) = place(selector, x, y)
      mouse("mouseMoved", windowX, windowY, 1)
    val (endX, endY) = place(selector, places.last._1, places.last._2)
    mouse("mouseReleased", endX, endY, 0)

  /** Moves fingers over an element; each step has the places of all. */
  def touch(selector: String, steps: Vector[(Double, Double)]*): Unit =
    def send(kind: String, places: Vector[(Double, Double)]): Unit =
      val points = places.zipWithIndex.map: (at, id) =>
        val (x, y) = place(selector, at._1, at._2)
        ujson.Obj("x" -> x, "y" -> y, "id" -> id)
      val _ =
        call("Input.dispatchTouchEvent", "type" -> kind, "touchPoints" -> ujson.Arr.from(points))
    send("touchStart", steps.head)
    steps.tail.foreach(send("touchMove", _))
    send("touchEnd", Vector.empty)

  private def call(method: String, parameters: (String, ujson.Value)*): ujson.Value =
    calls += 1
    val message =
      ujson.Obj("id" -> calls, "method" -> method, "params" -> ujson.Obj.from(parameters))
    val _ = socket.sendText(ujson.write(message), true).join()
    val answer = answers.poll(60, TimeUnit.SECONDS)
    if answer == null || answer.obj.contains("error") then
      throw IllegalStateException(s"$method: $answer")
    answer("result")

  /** What a script's expression gives; promises are awaited. */
  def value(script: String): ujson.Value =
    val answer = call(
      "Runtime.evaluate",
      "expression" -> script,
      "awaitPromise" -> true,
      "returnByValue" -> true
    )
    if answer.obj.contains("exceptionDetails") then
      throw IllegalStateException(s"$script: ${answer("exceptionDetails")}")
    answer("result").obj.getOrElse("value", ujson.Null)

  /** Waits until the script's expression is true, in a page that may not be there yet. */
  def until(script: String): Unit =
    eventually(script):
      Try(value(s"!!($script)").bool).toOption.filter(identity)
    ()

  def press(key: String, text: String = ""): Unit =
    for kind <- Vector("keyDown", "keyUp") do
      val typed = Option.when(text.nonEmpty && kind == "keyDown")("text" -> ujson.Str(text))
      val code = OpenPage.codes.get(key).map("windowsVirtualKeyCode" -> ujson.Num(_))
      val _ = call(
        "Input.dispatchKeyEvent",
        (Vector[(String, ujson.Value)]("type" -> kind, "key" -> key) ++ typed ++ code)*
      )

  /** The visible part of the page, as JPEG. */
  def screenshot(): Array[Byte] =
    val answer = call("Page.captureScreenshot", "format" -> "jpeg", "quality" -> 85)
    Base64.getDecoder.decode(answer("data").str)

private object OpenPage:
  /** Of keys that do something to the browser itself. */
  private val codes = Map("Tab" -> 9.0, "Enter" -> 13.0)
