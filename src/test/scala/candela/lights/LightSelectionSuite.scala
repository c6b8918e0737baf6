package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*
import candela.render.ThreadPool
import candela.shapes.Disk
import candela.testing.Draws

final class LightSelectionSuite extends AnyFunSuite:
  private val Draws_ = 20000

  private def disks(draws: Draws, count: Int): Seq[Light] = Seq.fill(count):
    val toWorld = draws.translation(5) * draws.rotation()
    val disk = Disk(toWorld, 0f, 0.3f, 0f, TwoPi, false)
    val (axis, spread) = disk.normals
    AreaLight(disk, Rgb.gray(draws.between(0.1f, 10f)), draws.coin(), disk.bounds, axis, spread)

  private def spots(draws: Draws, count: Int): Seq[Light] = Seq.fill(count):
    val frame = LightFrame(draws.translation(5) * draws.rotation())
    SpotLight(frame, Vec3.Z, Rgb.gray(draws.between(0.1f, 10f)), 0.3f, 0.6f, Fade.Cubic)

  private def points(draws: Draws, count: Int): Seq[Light] =
    Seq.fill(count)(PointLight(draws.vec(-5, 5), Rgb.gray(draws.between(0.1f, 10f))))

  private val sky = ConstantEnvironment(Rgb.White, complete = true)
  private val sun = DistantLight(Vec3.Z, Rgb.White)
  private val unused = ConstantEnvironment(Rgb.White, complete = false)

  private val sets: Seq[(String, Seq[Light])] =
    val draws = Draws(21)
    Seq(
      "one light" -> Seq(sky),
      "two at infinity" -> Seq(sky, sun),
      "points" -> points(draws, 7),
      "disks" -> disks(draws, 13),
      "spots" -> spots(draws, 5),
      "one disk and the sun" -> (disks(draws, 1) :+ sun),
      "all kinds" -> (Seq(sky) ++ points(draws, 3) ++ Seq(sun, unused) ++ disks(draws, 6)),
      "many" -> (disks(draws, 60) ++ spots(draws, 5))
    )

  private val around = Bounds3(Vec3(-6, -6, -6), Vec3(6, 6, 6))

  private def byImportance(lights: Seq[Light]): LightSelection =
    LightSelection.of(lights.toArray, LightStrategy.Importance, around)

  private def chosen(selection: LightSelection, p: Vec3, n: Vec3, u: Float): Int =
    val choice = LightChoice()
    selection.choose(p, n, u, choice)
    choice.light

  /** All that may be used for so many lights or more. */
  private def selections(lights: Array[Light]): Seq[(String, LightSelection)] =
    val byStrategy = LightStrategy.values.toSeq.map: strategy =>
      s"$strategy" -> LightSelection.of(lights, strategy, around)
    byStrategy :+ ("light BVH" -> LightTree(lights)) :+ ("few" -> FewLights(lights))

  for (set, lights) <- sets; (how, selection) <- selections(lights.toArray) do
    val name = s"$set, $how"

    test(s"$name: probabilities are those with which lights are chosen"):
      val draws = Draws(22)
      for round <- 1 to 20 do
        val p = draws.vec(-6, 6)
        val n = if round % 2 == 0 then draws.direction() else Vec3.Zero
        val counts = new Array[Int](lights.size + 1)
        val choice = LightChoice()
        for i <- 0 until Draws_ do
          selection.choose(p, n, (i + 0.5f) / Draws_, choice)
          counts(choice.light + 1) += 1
          if choice.light >= 0 then
            assert(selection.probability(p, n, choice.light) == choice.probability): Unit
        val chances = lights.indices.map(selection.probability(p, n, _))
        for i <- lights.indices do
          // Evenly spaced numbers are right to one in 20000 at each of the tree's borders
          assert(Math.abs(counts(i + 1).toFloat / Draws_ - chances(i)) < 5e-4f, s"light $i")
        // What is missing to 1 is no light at all; rounding of the sum
        assert(Math.abs(chances.sum + counts(0).toFloat / Draws_ - 1f) < 5e-4f)

    test(s"$name: a light that sends light to a point may be chosen there"):
      val draws = Draws(23)
      val out = LightSample()
      for _ <- 1 to 2000; i <- lights.indices do
        val (p, n) = (draws.vec(-6, 6), draws.direction())
        lights(i).sample(p, draws.unit(), draws.unit(), out)
        val edgeOn = !out.isInfinite && !out.target.n.isZero &&
          Math.abs(out.wi dot out.target.n) < 1e-3f // all digits lost
        if out.pdf > 0f && !out.radiance.isBlack && !edgeOn && Math.abs(out.wi dot n) > 1e-3f then
          assert(selection.probability(p, n, i) > 0f, s"light $i at $p"): Unit

  /** Second moment of light sampling at random points, by the lights' contributions there without
    * shadows, in units of the squared mean.
    */
  private def noise(lights: Array[Light], selection: LightSelection, seed: Int): Double =
    val draws = Draws(seed)
    val out = LightSample()
    val moments = Seq.fill(400):
      val (p, n) = (draws.vec(-6, 6), draws.direction())
      val found = lights.map: light =>
        val samples = Seq.fill(32):
          light.sample(p, draws.unit(), draws.unit(), out)
          if out.pdf > 0f then out.radiance.g / out.pdf * Math.max(0f, out.wi dot n) else 0f
        samples.sum.toDouble / samples.size
      val all = found.sum
      Option.when(all > 0):
        lights.indices.filter(found(_) > 0)
          .map(i => found(i) * found(i) / selection.probability(p, n, i)).sum / (all * all)
    val known = moments.flatten
    known.sum / known.size

  test(
    "a few lights are chosen with less noise than by a tree, and much less than by equal chances"
  ):
    for (count, seed) <- Seq(4, 13, 36).zipWithIndex do
      val lights = disks(Draws(41 + seed), count).toArray
      val few = noise(lights, FewLights(lights), seed)
      val tree = noise(lights, LightTree(lights), seed)
      val uniform = noise(lights, FixedSelection.uniform(lights), seed)
      assert(few < tree && few < 0.7 * uniform, s"$count: $few, $tree, $uniform")

  test("few lights take a loop, many a tree; spotlights count more"):
    assert(byImportance(disks(Draws(51), 36)).isInstanceOf[FewLights])
    assert(byImportance(disks(Draws(51), 60)).isInstanceOf[LightTree])
    assert(byImportance(spots(Draws(51), 6)).isInstanceOf[FewLights])
    assert(byImportance(spots(Draws(51), 20)).isInstanceOf[LightTree])

  test("points that face all around always find one of some point lights"):
    val lights = points(Draws(31), 9)
    val selection = byImportance(lights)
    val sum = lights.indices.map(selection.probability(Vec3(1, 2, 3), Vec3.Zero, _)).sum
    assert(Math.abs(sum - 1f) < 1e-5f) // rounding

  test("by power: a light with twice the power is chosen twice as often; all alike: as often"):
    val lights = Array[Light](PointLight(Vec3.X, Rgb.White), PointLight(Vec3.Y, Rgb.gray(2f)))
    val byPower = LightSelection.of(lights, LightStrategy.Power, around)
    val alike = LightSelection.of(lights, LightStrategy.Uniform, around)
    for p <- Seq(Vec3.Zero, Vec3(5, 5, 5)) do
      assert(Math.abs(byPower.probability(p, Vec3.Z, 1) - 2f / 3) < 1e-6f): Unit
      assert(alike.probability(p, Vec3.Z, 1) == 0.5f)

  test("lights without power: none is chosen by it"):
    val black = Array[Light](PointLight(Vec3.X, Rgb.Black), PointLight(Vec3.Y, Rgb.Black))
    val selection = LightSelection.of(black, LightStrategy.Power, around)
    assert(chosen(selection, Vec3.Zero, Vec3.Z, 0.5f) == -1)

  test("no lights: none is chosen"):
    assert(chosen(byImportance(Seq.empty), Vec3.Zero, Vec3.Z, 0.5f) == -1)

  test("a tree that several threads build is that of one"):
    val draws = Draws(7)
    // In a grid, too, where many are equal
    val places = Vector.fill(9000)(draws.vec(-1, 1)) ++
      Vector.tabulate(9000)(i => Vec3((i % 20).toFloat, (i / 20 % 20).toFloat, 0f))
    val lights = places.map(p => PointLight(p, Rgb.White)).toArray[Light]
    val pool = ThreadPool(3)
    val (alone, together) = (LightTree(lights), LightTree(lights, pool))
    pool.close()
    for _ <- 1 to 500 do
      val (p, n, u) = (draws.vec(-2, 2), draws.direction(), draws.unit())
      assert(chosen(alone, p, n, u) == chosen(together, p, n, u))
      val light = (u * lights.length).toInt
      assert(alone.probability(p, n, light) == together.probability(p, n, light))
