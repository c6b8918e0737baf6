package candela.cli.rendering

import candela.cli.Watched
import candela.color.Rgb
import candela.film.BoxFilter
import candela.image.ImageFiles
import candela.render.{TinyPlan, Where}
import candela.testing.Eventually.eventually
import candela.testing.{TempFolder, TevMessage, TevPeer}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.net.{InetAddress, ServerSocket}
import java.nio.file.Path
import java.util.concurrent.CountDownLatch

import scala.jdk.CollectionConverters.*

/** `--display-server`, against a viewer that records. */
class TevSuite extends AnyFunSuite:
  import TevMessage.*

  /** Three tiles side by side; only the first pixel changes after the first sample. Samples keep
    * away from edges of pixels, where their places could be rounded to the next pixel.
    */
  private def plan(file: Path, gate: CountDownLatch) =
    val filter = BoxFilter(0.25f, 0.25f)
    TinyPlan(300, 40, spp = 16, filename = file.toString, filter = filter): (where, _) =>
      if where == Where(0, 0, 8) then gate.await()
      if where.x == 0 && where.y == 0 then Rgb(where.sample.toFloat, 1f, 2f)
      else Rgb(where.x.toFloat, 0.25f, 2f)

  private def all(peer: TevPeer): Vector[TevMessage] = peer.messages.iterator.asScala.toVector

  test("the viewer ends with the image of the EXR; only tiles that change are sent again"):
    TempFolder.use: folder =>
      val peer = TevPeer()
      val gate = CountDownLatch(1)
      val file = folder.resolve("a.exr")
      val recording = peer.record()
      val running = Watched(plan(file, gate), "--display-server", s"localhost:${peer.port}")
      // Until it shows all that does not change any more: all values but the first
      val settled = Vector.tabulate(300 * 40): i =>
        if i == 0 then Vector(0f, 1f, 2f) else Vector((i % 300).toFloat, 0.25f, 2f)
      val first = eventually("the first image"):
        Some(all(peer)).filter(m => m.nonEmpty && TevPeer.shown(m).tail == settled.flatten.tail)
      gate.countDown()
      assert(running.ended == 0)
      recording.join()
      assert(first.head == Create("s.pbrt", 300, 40, Vector("R", "G", "B")))
      val boxes = first.tail.collect { case u: Update => (u.x, u.y, u.w, u.h) }
      assert(boxes.toSet == Set((0, 0, 128, 40), (128, 0, 128, 40), (256, 0, 44, 40)))
      val last = all(peer)
      assert(last.last == End)
      assert(TevPeer.shown(last.init) == ImageFiles.read(file).data.toVector)
      val later = last.init.drop(first.size).collect { case u: Update => (u.channel, u.x) }
      assert(later.nonEmpty && later.forall(_ == ("R", 0)), later)
      peer.close()

  test("a viewer that goes away is no error, and gets the whole image when it is back", Slow):
    TempFolder.use: folder =>
      val peer = TevPeer()
      val gate = CountDownLatch(1)
      val file = folder.resolve("a.exr")
      val _ = peer.record(most = 2)
      val running = Watched(plan(file, gate), "--display-server", s"localhost:${peer.port}")
      eventually("the first packets")(Option.when(peer.messages.size >= 2)(()))
      peer.messages.clear()
      val again = peer.record()
      gate.countDown()
      assert(running.ended == 0)
      again.join()
      assert(running.err.isEmpty)
      assert(TevPeer.shown(all(peer).init) == ImageFiles.read(file).data.toVector)
      peer.close()

  test("without a viewer a warning says so, and the image is rendered", Slow):
    TempFolder.use: folder =>
      val free = ServerSocket(0, 1, InetAddress.getLoopbackAddress)
      free.close()
      val gate = CountDownLatch(0)
      val running = Watched(
        plan(folder.resolve("a.exr"), gate),
        "--display-server",
        s"localhost:${free.getLocalPort}"
      )
      assert(running.ended == 0)
      val warning = s"warning: no viewer at localhost:${free.getLocalPort} yet: "
      assert(running.err.startsWith(warning) && running.err.linesIterator.size == 1, running.err)

  test("a viewer that never reads holds nothing up for long", Slow):
    TempFolder.use: folder =>
      val peer = TevPeer()
      peer.ignore()
      // More than the buffers of the connection hold: 24 MB
      val large = TinyPlan(
        width = 2000,
        height = 1000,
        spp = 2,
        filename = folder.resolve("a.exr").toString
      )((where, _) => Rgb(where.x + 1f, where.y + 1f, where.sample + 1f))
      val running = Watched(large, "--display-server", s"localhost:${peer.port}")
      assert(running.ended == 0)
      peer.close()
