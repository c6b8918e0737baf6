package candela.render

import candela.color.Rgb

import org.scalatest.funsuite.AnyFunSuite

class LiveSuite extends AnyFunSuite:

  test("what observers read before the end is what there is; at the end it is the result"):
    var live: Option[Live] = None
    val plan = TinyPlan(width = 20, height = 16, spp = 4): (where, _) =>
      if where == Where(0, 0, 2) then
        // The first tile's first two samples, and in its thread no others
        val now = live.get
        assert(now.tiles.map(t => (t.x0, t.x1)) == Vector((0, 16)))
        assert(now.rendering.samplesDone == 2 && !now.rendering.isComplete)
        assert(now.progress.done == 2 * 20 * 16 && now.progress.total == 4 * 20 * 16)
        val _ = assert(now.rendering.film.toImage(1f)(19, 15, 0) == 1f)
      Rgb(where.sample + 0.5f, 1f, 1f)
    val result = Renderer.render(
      plan,
      RenderControl(1, listener = RenderListener.onStart(l => live = Some(l)))
    )
    val seen = live.get.rendering
    assert(seen.isComplete && live.get.tiles.isEmpty)
    assert(seen.film.toImage(1f).data.sameElements(result.film.toImage(1f).data))

  /** The sampler's first numbers of a pixel, as they are used, and the result. */
  private def numbers(
      spp: Int,
      until: Int,
      maxSamples: Int = RenderPlan.Endless
  ): (Vector[Float], Rendering) =
    var seen = Vector.empty[Float]
    var live: Option[Live] = None
    val plan = TinyPlan(spp = spp): (where, sampler) =>
      if where.x == 5 && where.y == 7 then
        seen :+= sampler.next1D()
        if seen.size >= until then live.get.keepOn(false)
      Rgb.White
    val result = Renderer.render(
      plan.copy(maxSamples = maxSamples),
      RenderControl(
        1,
        listener = RenderListener.onStart: l =>
          live = Some(l)
          l.keepOn(until > 0)
      )
    )
    (seen, result)

  test("a rendering that keeps on takes samples beyond the planned ones, all different"):
    val (planned, plain) = numbers(spp = 5, until = 0)
    val (all, result) = numbers(spp = 5, until = 300)
    assert(planned.size == 5 && plain.samplesPerPixel == 5)
    // Waves of 64 after the planned five; from 261 samples on two at a time
    assert(all.size == 5 + 4 * 64 + 2 * 64 && result.samplesDone == all.size && result.isComplete)
    assert(result.samplesPerPixel == all.size)
    assert(all.take(5) == planned && all.distinct.size == all.size)

  test("a rendering that keeps on stays below the limit of samples"):
    val (all, result) = numbers(spp = 5, until = 300, maxSamples = 132)
    assert(all.size == 5 + 64 && result.samplesDone == all.size && result.isComplete)

  test("a rendering that no longer wants more ends with its planned samples"):
    val (all, result) = numbers(spp = 5, until = 3)
    assert(all.size == 5 && result.samplesDone == 5)

  test("shards and saved renderings don't keep on"):
    val plan = TinyPlan(spp = 2)((_, _) => Rgb.White)
    var can = true
    val listener = RenderListener.onStart(l => can = l.canKeepOn)
    val _ = Renderer.render(plan, RenderControl(1, listener = listener, shard = Shard(0, 2)))
    assert(!can)
