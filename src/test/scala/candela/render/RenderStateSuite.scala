package candela.render

import candela.bdpt.ChainPaths
import candela.io.CheckedFile
import candela.mlt.{MarkovChains, MetropolisSettings}
import candela.color.Rgb
import candela.film.GaussianFilter
import candela.geometry.Ray
import candela.sampling.Sampler

import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.nio.file.{Files, Path}
import java.util.concurrent.atomic.AtomicInteger

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class RenderStateSuite extends AnyFunSuite:

  /** Saves to a file, and continues from one. */
  private final class FileCheckpointer(from: Option[Path], to: Path, isAlwaysDue: Boolean = false)
      extends Checkpointer:
    var saved, lost = 0
    var copies = Vector.empty[Path]
    def restore(state: RenderState): Unit = from.foreach(CheckedFile.read(_, "state")(state.load))
    def isDue: Boolean = isAlwaysDue
    def save(state: RenderState): Unit =
      CheckedFile.write(to, "state")(state.save)
      saved += 1
      if isAlwaysDue then
        copies :+= Files.copy(to, to.resolveSibling(s"${to.getFileName}.$saved"))
    def discard(): Unit = lost += 1
    def finish(): Unit = ()

  private def withFolder[A](body: Path => A): A =
    val folder = Files.createTempDirectory("candela-state")
    try body(folder)
    finally
      Files.list(folder).forEach(Files.delete(_))
      Files.delete(folder)

  private def plan(shares: Boolean, spp: Int, few: Option[Int] = None)(
      tick: Where => Unit = _ => ()
  ): RenderPlan =
    TinyPlan(
      width = 50,
      height = 37,
      spp = spp,
      filter = GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
      sharesSamples = shares,
      adaptive = few.map(n => AdaptiveSampling(HashSampler(n), SampleDifference.Contrast))
    ): (where, sampler) =>
      tick(where)
      Rgb(sampler.next1D(), sampler.next1D() * 1e-6f, sampler.next1D() * 1e6f)

  /** A rendering that continues the state of a file, and saves its own in another. */
  private def continued(
      plan: RenderPlan,
      shard: Shard,
      from: Option[Path],
      to: Path,
      stop: Cancellation
  ): Rendering =
    val checkpointer = FileCheckpointer(from, to)
    val keep = Some(checkpointer)
    val control = RenderControl(threads = 2, stop, shard = shard, checkpointer = keep)
    val done = Renderer.render(plan, control)
    assert(checkpointer.lost == 0)
    done

  test("a rendering that is interrupted again and again is the one that was not, bit for bit"):
    for shares <- Vector(false, true); threads <- Vector(1, 3) do
      withFolder: folder =>
        val (whole, parts) = (folder.resolve("whole"), folder.resolve("parts"))
        val checkpointer = FileCheckpointer(None, whole)
        val _ = Renderer.render(
          plan(shares, 40)(),
          RenderControl(threads, checkpointer = Some(checkpointer))
        )
        var runs = 0
        var done = 0
        while done < 40 do
          val cancellation = Cancellation()
          var left = 3001
          val interrupted = plan(shares, 40): _ =>
            left -= 1
            if left < 0 && runs < 30 then cancellation.request()
          val from = Option.when(runs > 0)(parts)
          val checkpointer = FileCheckpointer(from, parts)
          val rendering =
            Renderer.render(
              interrupted,
              RenderControl(threads, cancellation, checkpointer = Some(checkpointer))
            )
          done = rendering.samplesDone
          runs += 1
        assert(runs > 5)
        assert(Files.readAllBytes(parts).sameElements(Files.readAllBytes(whole)))

  test("pixels whose samples decide on their number are continued to the same image", Slow):
    for shares <- Vector(false, true); shard <- Vector(Shard.Whole, Shard(1, 2)) do
      withFolder: folder =>
        val (whole, parts) = (folder.resolve("whole"), folder.resolve("parts"))
        def render(plan: RenderPlan, from: Option[Path], to: Path, stop: Cancellation) =
          continued(plan, shard, from, to, stop)
        // Two samples contrast with a probability between those of none and all
        val all = render(plan(shares, 8, Some(2))(), None, whole, Cancellation())
        assert(all.takenShare > 0.3 && all.takenShare < 0.9, all.takenShare)
        var from = Option.empty[Path]
        for last <- Vector(400, 1000, 300) do
          val cancellation = Cancellation()
          val taken = AtomicInteger()
          val slow = plan(shares, 8, Some(2)): _ =>
            if taken.incrementAndGet() > last then
              cancellation.request()
              Thread.sleep(20)
          val stopped = render(slow, from, parts, cancellation)
          assert(stopped.samplesDone == 0 && taken.get < last + 200, taken)
          from = Some(parts)
        val _ = render(plan(shares, 8, Some(2))(), from, parts, Cancellation())
        assert(Files.readAllBytes(parts).sameElements(Files.readAllBytes(whole)))

  test("every state that is saved while workers pause is continued to the same image"):
    for shares <- Vector(false, true) do
      withFolder: folder =>
        val checkpointer = FileCheckpointer(None, folder.resolve("a"), isAlwaysDue = true)
        val slow = plan(shares, 60): where =>
          if where.x == 7 && where.y % 16 == 3 then Thread.sleep(3)
        val _ = Renderer.render(slow, RenderControl(threads = 3, checkpointer = Some(checkpointer)))
        // The last one, and at least one before
        assert(checkpointer.saved > 1)
        val last = Files.readAllBytes(checkpointer.copies.last)
        for copy <- checkpointer.copies.init do
          val next = FileCheckpointer(Some(copy), folder.resolve("b"))
          val _ = Renderer.render(
            plan(shares, 60)(),
            RenderControl(threads = 2, checkpointer = Some(next))
          )
          assert(Files.readAllBytes(folder.resolve("b")).sameElements(last))

  test(
    "a sample of a tile that takes long is left in its midst, and continued to the same image",
    Slow
  ):
    for shares <- Vector(false, true); shard <- Vector(Shard.Whole, Shard(1, 2)) do
      withFolder: folder =>
        val (whole, parts) = (folder.resolve("whole"), folder.resolve("parts"))
        def render(plan: RenderPlan, from: Option[Path], to: Path, stop: Cancellation) =
          continued(plan, shard, from, to, stop)
        val _ = render(plan(shares, 3)(), None, whole, Cancellation())
        val cancellation = Cancellation()
        val taken = AtomicInteger()
        val slow = plan(shares, 3): _ =>
          if taken.incrementAndGet() > 300 then
            cancellation.request()
            Thread.sleep(20)
        val stopped = render(slow, None, parts, cancellation)
        // Two tiles have 512 pixels
        assert(stopped.samplesDone == 0 && taken.get < 500, taken)
        val _ = render(plan(shares, 3)(), Some(parts), parts, Cancellation())
        assert(Files.readAllBytes(parts).sameElements(Files.readAllBytes(whole)))

  test("merged shards have no tail of one that others are ahead of, in any order"):
    withFolder: folder =>
      val (left, other) = (folder.resolve("left"), folder.resolve("other"))
      def render(plan: RenderPlan, index: Int, to: Path, stop: Cancellation) =
        val checkpointer = Some(FileCheckpointer(None, to))
        Renderer.render(
          plan,
          RenderControl(2, stop, shard = Shard(index, 2), checkpointer = checkpointer)
        )
      val cancellation = Cancellation()
      val taken = AtomicInteger()
      val slow = plan(shares = false, 3): _ =>
        if taken.incrementAndGet() > 300 then
          cancellation.request()
          Thread.sleep(20)
      val _ = render(slow, 0, left, cancellation)
      val _ = render(plan(shares = false, 3)(), 1, other, Cancellation())
      def merged(films: Path*) =
        val to = folder.resolve("merged")
        val _ = Renderer.gather(
          plan(shares = false, 3)(),
          state =>
            for film <- films do CheckedFile.read(film, "state")(state.load)
            CheckedFile.write(to, "state")(state.save)
        )
        Files.readAllBytes(to).toVector
      // Without mark, length and checksum; a tail is its length, and three numbers for each tile
      val numbers = Files.readAllBytes(left).drop(9).dropRight(16).grouped(4)
        .map(ByteBuffer.wrap(_).order(LITTLE_ENDIAN).getInt).toVector
      val tail = (1 to 2).find(k => numbers(numbers.size - 1 - 3 * k) == k).map(1 + 3 * _)
      assert(tail.nonEmpty)
      val cut = folder.resolve("cut")
      CheckedFile.write(cut, "state")(out => numbers.dropRight(tail.getOrElse(0)).foreach(out.int))
      assert(Files.size(cut) < Files.size(left))
      val all = merged(left, other)
      assert(merged(other, left) == all && merged(cut, other) == all)

  /** @param tick called for each path */
  private def chains(tick: () => Unit = () => ()): RenderPlan =
    final class Paths extends ChainPaths:
      def raysTraced = 0L
      def lastMaterial = -1
      def radiance(ray: Ray, light: Sampler, joins: Sampler, onward: Sampler): Rgb =
        tick()
        // Nearly alike, so that few paths are made before the chains
        Rgb(1f + light.next1D(), 1f + joins.next1D() * 0.1f, 1f - onward.next1D() * 0.2f)
    val settings = MetropolisSettings(bootstrap = 1000, chains = 5, largeStep = 0.3f, sigma = 0.1f)
    val method = Chains(
      (_, _) => Paths(),
      (view, paths) => MarkovChains(paths, settings, view),
      _ => throw AssertionError("single samples")
    )
    TinyPlan(50, 37, spp = 20, method = Some(method))((_, _) => Rgb.Black)

  test(
    "chains whose paths take long are left in their midst, and continued to the same image",
    Slow
  ):
    withFolder: folder =>
      val (whole, parts) = (folder.resolve("whole"), folder.resolve("parts"))
      def render(plan: RenderPlan, from: Option[Path], to: Path, stop: Cancellation) =
        val checkpointer = FileCheckpointer(from, to)
        val done =
          Renderer.render(plan, RenderControl(threads = 2, stop, checkpointer = Some(checkpointer)))
        assert(checkpointer.lost == 0)
        done
      val complete = render(chains(), None, whole, Cancellation())
      val size = Files.size(whole)
      var from = Option.empty[Path]
      for stop <- Vector(10_500, 5_700) do
        val cancellation = Cancellation()
        val made = AtomicInteger()
        val slow = chains: () =>
          if made.incrementAndGet() > stop then
            cancellation.request()
            Thread.sleep(20)
        val stopped = render(slow, from, parts, cancellation)
        assert(made.get < stop + 200 && stopped.samplesDone < 20, made)
        // The tail, with at least one chain
        assert(Files.size(parts) >= size + 4 + 20)
        from = Some(parts)
      val continued = render(chains(), from, parts, Cancellation())
      assert(Files.readAllBytes(parts).sameElements(Files.readAllBytes(whole)))
      val images = Vector(complete, continued).map(_.image(chains().development).data)
      assert(images(0).sameElements(images(1)))

  test("the light of chains that were left is in the image, but not in the state"):
    withFolder: folder =>
      val file = folder.resolve("a")
      val cancellation = Cancellation()
      val made = AtomicInteger()
      val slow = chains: () =>
        if made.incrementAndGet() > 2500 then
          cancellation.request()
          Thread.sleep(20)
      val keep = Some(FileCheckpointer(None, file))
      val stopped =
        Renderer.render(slow, RenderControl(threads = 1, cancellation, checkpointer = keep))
      val read = Renderer.gather(chains(), s => CheckedFile.read(file, "state")(s.load))
      def light(rendering: Rendering) = rendering.image(slow.development).data
      assert(light(stopped).sum > 0 && light(stopped).sameElements(light(read)))

  test("no piece has a progress that it can't have"):
    withFolder: folder =>
      val file = folder.resolve("a")
      for wrong <- Vector(-1L, 1L << 31, Long.MaxValue, Long.MinValue) do
        CheckedFile.write(file, "state"): out =>
          out.int(12)
          for i <- 0 until 12 do out.long(if i == 7 then wrong else 1L)
        val checkpointer = FileCheckpointer(Some(file), folder.resolve("b"))
        val why = intercept[IllegalArgumentException]:
          Renderer.render(
            plan(shares = false, 1)(),
            RenderControl(1, checkpointer = Some(checkpointer))
          )
        assert(why.getMessage.endsWith(s"piece 7 has $wrong samples"))

  test("chains make as many paths as all pixels have samples"):
    val schedule = ChainSchedule(3, pixels = 10, samplesPerPixel = 4, Shard.Whole)
    val paths = (0 until 3).map(schedule.paths(_, Int.MaxValue))
    assert(paths.sum == 10L * Int.MaxValue && paths.max == schedule.maxProgress)

  test("no tile has a sample in part that it can't have"):
    withFolder: folder =>
      val file = folder.resolve("a")
      val plain = plan(shares = false, 1)()
      val _ =
        Renderer.render(plain, RenderControl(1, checkpointer = Some(FileCheckpointer(None, file))))
      // Without mark, length and checksum
      val numbers = Files.readAllBytes(file).drop(9).dropRight(16).grouped(4).toVector
      for (tile, pixels, sums) <- Vector((-1, 5, 0), (99, 5, 0), (1, 0, 0), (1, 256, 0), (1, 5, 2))
      do
        CheckedFile.write(file, "state"): out =>
          for four <- numbers do out.int(ByteBuffer.wrap(four).order(LITTLE_ENDIAN).getInt)
          for number <- Vector(1, tile, pixels, sums) do out.int(number)
          for _ <- 0 until sums do out.double(1)
        val checkpointer = FileCheckpointer(Some(file), folder.resolve("b"))
        val why = intercept[IllegalArgumentException]:
          Renderer.render(plain, RenderControl(1, checkpointer = Some(checkpointer)))
        assert(why.getMessage.endsWith(s"piece $tile has $pixels parts of a sample"))

  test("shards share the samples of every pixel, and the work"):
    for count <- Vector(2, 5, 64) do
      val taken = Array.fill(9, 40)(0)
      for i <- 0 until count; tile <- 0 until 9; sample <- 0 until 40 do
        if Shard(i, count).takesTile(tile, sample) then taken(tile)(sample) += 1
      assert(taken.forall(_.forall(_ == 1)))
