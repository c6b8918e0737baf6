package candela.cli.rendering

import candela.aov.Layer
import candela.cli.Watched
import candela.color.Rgb
import candela.image.ImageFiles
import candela.render.{TinyPlan, Where}
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.Eventually.eventually
import candela.testing.{SceneTexts, TempFolder, WebClient}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.net.ServerSocket
import java.nio.file.Path
import java.nio.{ByteBuffer, ByteOrder}
import java.util.concurrent.CountDownLatch

import scala.jdk.CollectionConverters.*

/** What the live page's server answers, and what watching does to a rendering: nothing. */
class WatchingSuite extends AnyFunSuite:

  private def plan(spp: Int, file: Path) =
    TinyPlan(spp = spp, filename = file.toString): (where, sampler) =>
      Rgb(sampler.next1D(), 2 * sampler.next1D(), where.x / 40f)

  private def floats(bytes: Array[Byte]): Vector[Float] =
    val buffer = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).asFloatBuffer
    Vector.fill(buffer.remaining)(buffer.get())

  /** A rendering that has ended, and whose page stays. */
  private def stays[A](words: String*)(test: (Watched, Path) => A): A =
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val running = Watched(plan(16, file), words :+ "--watch-after"*)
      try
        eventually("end")(Option.when(running.out.contains("wrote"))(()))
        test(running, file)
      finally
        val _ = WebClient.post(s"${running.link}end")
        val _ = running.ended

  test("the image of a watched rendering has the same bits, and viewers get all of them"):
    stays("--watch", "0", "--nthreads", "2"): (running, file) =>
      val answer = WebClient.get(s"${running.link}image?layer=color")
      assert(answer.header("X-Channels").contains("3"))
      val image = ImageFiles.read(file)
      assert(floats(answer.body) == image.data.toVector)
      TempFolder.use: other =>
        val plain = Watched(plan(16, other.resolve("a.exr")), "--nthreads", "1")
        assert(plain.ended == 0)
        assert(ImageFiles.read(other.resolve("a.exr")).data.sameElements(image.data))
        assert(plain.err.isEmpty)

  test("while it renders, the state tells how far it is, and the image is that of the samples"):
    TempFolder.use: folder =>
      val gate = CountDownLatch(1)
      val file = folder.resolve("a.exr")
      val halting =
        TinyPlan(width = 20, height = 16, spp = 16, filename = file.toString): (where, sampler) =>
          if where == Where(0, 0, 8) then gate.await()
          Rgb(sampler.next1D(), 2 * sampler.next1D(), 0)
      val running = Watched(halting, "--watch", "0", "--watch-after", "--nthreads", "1")
      def state = ujson.read(WebClient.get(s"${running.link}state?viewer=a&shown=0").text)
      val early = eventually("snapshot"):
        Some(state).filter(_("version").num > 0)
      assert(early("stage").str == "rendering" && early("samples").num == 8)
      assert(early("tiles").arr.map(_.arr.map(_.num)) == Seq(Seq(0, 0, 16, 16)))
      assert(early("part").num == 0.5 && early("error").isNull && early("viewers").num == 1)
      assert(early("planned").num == 16 && early("left").isNull)
      def image(layer: String) = floats(WebClient.get(s"${running.link}image?layer=$layer").body)
      val first = image("color")
      gate.countDown()
      val late =
        eventually("end")(Some(state).filter(_("stage").str == "done"))
      assert(late("version").num > early("version").num && image("color") != first)
      assert(late("layers").arr.map(_("name").str) == Seq("color", "noise"))
      // Means of 16 uniform numbers, times 1, 2 and 0
      val noise = image("noise")
      for (c, scale) <- Vector(0 -> 1, 1 -> 2) do
        val squares = noise.indices.filter(_ % 3 == c).map(i => noise(i) * noise(i))
        val truth = scale * scale / 12.0 / 16
        // 320 pixels with one degree of freedom: 8 %; four times that
        assert(Math.abs(squares.sum / squares.size / truth - 1) < 0.32, c)
      assert(Math.abs(late("error").num) > 0)
      assert(WebClient.get(s"${running.link}charts").text.contains("<svg"))
      val _ = WebClient.post(s"${running.link}end")
      assert(running.ended == 0)

  test("the state tells that it is done, and what is not there is not found"):
    stays("--watch", "0"): (running, _) =>
      val state = ujson.read(WebClient.get(s"${running.link}state?viewer=a&shown=0").text)
      assert(state("stage").str == "done" && state("part").num == 1 && state("samples").num == 16)
      assert(state("tiles").arr.isEmpty)
      assert(WebClient.get(running.link).text.contains("<!DOCTYPE html>"))
      assert(WebClient.get(s"${running.link}nonsense").code == 404)
      assert(WebClient.get(s"${running.link}pixel?x=40&y=0").code == 404)

  test("`add samples` goes on beyond the planned samples, until it is stopped", Slow):
    TempFolder.use: folder =>
      val gate = CountDownLatch(1)
      val endless = TinyPlan(spp = 16, filename = folder.resolve("a.exr").toString): (where, _) =>
        if where == Where(0, 0, 8) then gate.await()
        Rgb.White
      val running = Watched(endless, "--watch", "0")
      def state = ujson.read(WebClient.get(s"${running.link}state?viewer=a&shown=0").text)
      assert(state("keepsOn").bool == false)
      val _ = WebClient.post(s"${running.link}keep")
      assert(state("keepsOn").bool)
      gate.countDown()
      val later = eventually("more samples"):
        Some(state).filter(_("samples").num >= 160)
      assert(later("stage").str == "rendering" && later("planned").num > 160)
      assert(later("part").num <= 1)
      val _ = WebClient.post(s"${running.link}stop")
      assert(running.ended == 0)
      val samples = raw", (\d+) spp, ".r.findFirstMatchIn(running.out).get.group(1)
      assert(samples.toInt >= 160)

  test("a page that stays outlives a rendering that its button stopped"):
    TempFolder.use: folder =>
      val words = Vector("--watch", "0", "--watch-after")
      val running = Watched(plan(1_000_000_000, folder.resolve("a.exr")), words*)
      def state = ujson.read(WebClient.get(s"${running.link}state").text)
      val _ = WebClient.post(s"${running.link}stop")
      val late =
        eventually("files")(Some(state).filter(!_("files").isNull))
      assert(late("stage").str == "stopped" && late("stays").bool)
      Thread.sleep(300)
      assert(running.isRunning)
      val _ = WebClient.post(s"${running.link}end")
      assert(running.ended == 130)

  test("the page needs nothing but its server"):
    stays("--watch", "0"): (running, _) =>
      val page = WebClient.get(running.link).text
      val addresses = """https?://[^\s"'<]+""".r.findAllIn(page).toSet
      assert(addresses.isEmpty)
      val bare = page.replace("<link rel=\"icon\" href=\"data:,\"", "")
      for word <- Vector("src=", "<link", "@import", "url(") do assert(!bare.contains(word), word)
      assert(!page.contains("offline") && page.contains("Served by Candela"))

  test("when it is over, the state names the files; layers have names for readers"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val text = s"""Film "image" "integer xresolution" 8 "integer yresolution" 8
        "string filename" "$file" Camera "perspective" Sampler "random" "integer pixelsamples" 4
        WorldBegin LightSource "infinite" Translate 0 0 3 Shape "sphere" """
      val layers = RenderSettings(layers = Vector(Layer.Normal, Layer.Depth, Layer.Uv))
      val plan = SceneTexts.plan(text, Dialect.V3, layers)
      val running = Watched(plan, "--watch", "0", "--watch-after")
      try
        val state = eventually("files"):
          Some(ujson.read(WebClient.get(s"${running.link}state").text)).filter(!_("files").isNull)
        val picture = folder.resolve("a.png")
        assert(state("files").arr.map(_.str) == Seq(file, picture).map(_.toAbsolutePath.toString))
        val titles = state("layers").arr.map(l => l("name").str -> l("title").str).toMap
        assert(titles("N") == "normals" && titles("Z") == "depth")
        assert(titles("u") == "surface parameters: u")
        val meanings = state("layers").arr.map(l => l("name").str -> l("meaning").str).toMap
        assert(meanings("Z") == "distance along the ray" && meanings("color") == "the image")
      finally
        val _ = WebClient.post(s"${running.link}end")
      assert(running.ended == 0)

  test("what can only be read is not posted to, what acts is not read; HEAD is silent"):
    stays("--watch", "0"): (running, _) =>
      def ask(method: String, name: String) = WebClient.ask(method, s"${running.link}$name")
      for name <- Vector("stop", "keep", "save", "end"); method <- Vector("GET", "HEAD", "PUT") do
        val answer = ask(method, name)
        assert(answer.code == 405 && answer.header("Allow").contains("POST"), s"$method $name")
      for name <- Vector("", "state", "charts") do
        assert(ask("POST", name).header("Allow").contains("GET, HEAD"), name)
        val (get, head) = (ask("GET", name), ask("HEAD", name))
        assert(head.code == 200 && head.body.isEmpty)
        assert(get.header("Content-Length").contains(get.body.length.toString))
        val lengths = Vector(get, head).flatMap(_.header("Content-Length"))
        // The state's times have more digits or fewer
        assert(lengths.distinct.size == 1 || name == "state")
      assert(running.isRunning)

  test("the page may run its own script and style, and nothing else"):
    stays("--watch", "0"): (running, _) =>
      val answer = WebClient.get(running.link)
      val policy = answer.header("Content-Security-Policy").get
      assert(policy.startsWith("default-src 'none'; ") && policy.contains("frame-ancestors 'none'"))
      assert(!policy.contains("unsafe"))
      for (element, source) <- Vector("script" -> "script-src", "style" -> "style-src") do
        val text = s"(?s)<$element>(.*?)</$element>".r.findFirstMatchIn(answer.text).get.group(1)
        val sum = java.security.MessageDigest.getInstance("SHA-256").digest(text.getBytes("UTF-8"))
        val hash = java.util.Base64.getEncoder.encodeToString(sum)
        assert(policy.contains(s"$source 'sha256-$hash'"), element)

  test("pages of other servers can neither read nor stop a rendering"):
    stays("--watch", "0"): (running, _) =>
      val foreign = "Origin" -> "http://example.com"
      assert(WebClient.post(s"${running.link}end", foreign).code == 404)
      assert(WebClient.get(s"${running.link}state", foreign).code == 404)
      assert(running.isRunning)
      val own = "Origin" -> running.link.stripSuffix("/")
      assert(WebClient.get(s"${running.link}state", own).code == 200)

  test("at another address, only those see anything who have the link"):
    stays("--watch", "0.0.0.0:0"): (running, _) =>
      val port = raw":(\d+)/".r.findFirstMatchIn(running.link).get.group(1)
      val token = running.link.split('/').last
      assert(token.length == 32)
      val here = s"http://127.0.0.1:$port"
      assert(WebClient.get(s"$here/").code == 404 && WebClient.get(s"$here/state").code == 404)
      assert(WebClient.post(s"$here/end").code == 404)
      assert(WebClient.get(s"$here/$token/state").code == 200)

  test("a link works as it is printed, whatever the address"):
    val own = java.net.NetworkInterface.networkInterfaces.iterator.asScala.toVector
      .flatMap(_.inetAddresses.iterator.asScala)
      .find(a => !a.isLoopbackAddress && !a.isLinkLocalAddress).map(_.getHostAddress)
    val all = Vector("127.0.0.1", "127.0.0.5", "127.1.2.3", "localhost", "[::1]", "0.0.0.0", "[::]")
    for address <- all ++ own.filter(!_.contains(':')) if canBind(address) do
      stays("--watch", s"$address:0"): (running, _) =>
        assert(WebClient.get(running.link).code == 200, running.link)
        val origin = "Origin" -> running.link.split('/').take(3).mkString("/")
        assert(WebClient.get(s"${running.link}state", origin).code == 200, running.link)
        assert(!running.link.contains("0.0.0.0") && !running.link.contains("0:0"), running.link)

  /** Whether this machine has the address. */
  private def canBind(address: String): Boolean =
    val name = address.stripPrefix("[").stripSuffix("]")
    scala.util.Try(ServerSocket(0, 1, java.net.InetAddress.getByName(name)).close()).isSuccess

  test("a port that is taken is refused if it was asked for"):
    TempFolder.use: folder =>
      val taken = ServerSocket(0, 1, java.net.InetAddress.getLoopbackAddress)
      try
        val running =
          Watched(plan(1, folder.resolve("a.exr")), "--watch", taken.getLocalPort.toString)
        assert(running.ended == 1)
        val message = s"error: can't serve the live page at ${taken.getLocalPort}: "
        assert(running.err.startsWith(message), running.err)
      finally taken.close()
