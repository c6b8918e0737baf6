package candela.testing

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

  /** The first result, tried again and again for two minutes. */
  def eventually[A](what: String)(found: => Option[A]): A =
    val tries = Iterator.continually:
      val result = found
      if result.isEmpty then Thread.sleep(50)
      result
    val end = System.nanoTime + 120_000_000_000L
    tries.takeWhile(_ => System.nanoTime < end).flatten.nextOption
      .getOrElse(throw IllegalStateException(s"no $what within two minutes"))

/** A page, open in a browser. */
final class OpenPage(address: URI) extends AutoCloseable:
  private val answers = LinkedBlockingQueue[ujson.Value]()
  private var calls = 0

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
        if message.obj.contains("id") then answers.put(message)
      s.request(1)
      null

  private val socket =
    HttpClient.newHttpClient.newWebSocketBuilder.buildAsync(address, listener).join()

  def close(): Unit = socket.abort()

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
    Chromium.eventually(script):
      Try(value(s"!!($script)").bool).toOption.filter(identity)
    ()

  def press(key: String, text: String = ""): Unit =
    for kind <- Vector("keyDown", "keyUp") do
      val typed = Option.when(text.nonEmpty && kind == "keyDown")("text" -> ujson.Str(text))
      val _ = call(
        "Input.dispatchKeyEvent",
        (Vector[(String, ujson.Value)]("type" -> kind, "key" -> key) ++ typed)*
      )

  /** The visible part of the page, as JPEG. */
  def screenshot(): Array[Byte] =
    val answer = call("Page.captureScreenshot", "format" -> "jpeg", "quality" -> 85)
    Base64.getDecoder.decode(answer("data").str)
