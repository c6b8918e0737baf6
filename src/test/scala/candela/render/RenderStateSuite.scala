package candela.render

import candela.base.CheckedFile
import candela.color.Rgb
import candela.film.GaussianFilter

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class RenderStateSuite extends AnyFunSuite:

  /** Saves to a file, and continues from one. */
  private final class FileCheckpointer(from: Option[Path], to: Path, isAlwaysDue: Boolean = false)
      extends Checkpointer:
    var saved = 0
    var copies = Vector.empty[Path]
    def restore(state: RenderState): Unit = from.foreach(CheckedFile.read(_, "state")(state.load))
    def isDue: Boolean = isAlwaysDue
    def save(state: RenderState): Unit =
      CheckedFile.write(to, "state")(state.save)
      saved += 1
      if isAlwaysDue then
        copies :+= Files.copy(to, to.resolveSibling(s"${to.getFileName}.$saved"))
    def lose(): Unit = ()
    def finish(): Unit = ()

  private def withFolder[A](body: Path => A): A =
    val folder = Files.createTempDirectory("candela-state")
    try body(folder)
    finally
      Files.list(folder).forEach(Files.delete(_))
      Files.delete(folder)

  private def plan(shares: Boolean, spp: Int)(tick: Where => Unit = _ => ()): RenderPlan =
    TinyPlan(
      width = 50,
      height = 37,
      spp = spp,
      filter = GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
      sharesSamples = shares
    ): (where, sampler) =>
      tick(where)
      Rgb(sampler.next1D(), sampler.next1D() * 1e-6f, sampler.next1D() * 1e6f)

  test("a rendering that is interrupted again and again is the one that was not, bit for bit"):
    for shares <- Vector(false, true); threads <- Vector(1, 3) do
      withFolder: folder =>
        val (whole, parts) = (folder.resolve("whole"), folder.resolve("parts"))
        val checkpointer = FileCheckpointer(None, whole)
        val _ = Renderer.render(plan(shares, 40)(), threads, checkpointer = Some(checkpointer))
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
            Renderer.render(interrupted, threads, cancellation, checkpointer = Some(checkpointer))
          done = rendering.samplesDone
          runs += 1
        assert(runs > 5)
        assert(Files.readAllBytes(parts).sameElements(Files.readAllBytes(whole)))

  test("every state that is saved while workers pause is continued to the same image"):
    for shares <- Vector(false, true) do
      withFolder: folder =>
        val checkpointer = FileCheckpointer(None, folder.resolve("a"), isAlwaysDue = true)
        val slow = plan(shares, 60): where =>
          if where.x == 7 && where.y % 16 == 3 then Thread.sleep(3)
        val _ = Renderer.render(slow, threads = 3, checkpointer = Some(checkpointer))
        // The last one, and at least one before
        assert(checkpointer.saved > 1)
        val last = Files.readAllBytes(checkpointer.copies.last)
        for copy <- checkpointer.copies.init do
          val next = FileCheckpointer(Some(copy), folder.resolve("b"))
          val _ = Renderer.render(plan(shares, 60)(), threads = 2, checkpointer = Some(next))
          assert(Files.readAllBytes(folder.resolve("b")).sameElements(last))

  test("shards share the samples of every pixel, and the work"):
    for count <- Vector(2, 5, 64) do
      val taken = Array.fill(9, 40)(0)
      for i <- 0 until count; tile <- 0 until 9; sample <- 0 until 40 do
        if Shard(i, count).takes(tile, sample) then taken(tile)(sample) += 1
      assert(taken.forall(_.forall(_ == 1)))
