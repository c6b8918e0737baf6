package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*
import candela.shapes.Disk
import candela.testing.Draws

final class LightSelectionSuite extends AnyFunSuite:
  private val Draws_ = 20000

  private def disks(draws: Draws, count: Int): Seq[Light] = Seq.fill(count):
    val toWorld = draws.translation(5) * draws.rotation()
    val disk = Disk(toWorld, 0f, 0.3f, 0f, TwoPi, false)
    val (axis, spread) = disk.normals
    AreaLight(disk, Rgb.gray(draws.between(0.1f, 10f)), draws.coin(), disk.bounds, axis, spread)

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
      "one disk and the sun" -> (disks(draws, 1) :+ sun),
      "all kinds" -> (Seq(sky) ++ points(draws, 3) ++ Seq(sun, unused) ++ disks(draws, 6))
    )

  private val around = Bounds3(Vec3(-6, -6, -6), Vec3(6, 6, 6))

  for (set, lights) <- sets; strategy <- LightStrategy.values do
    val name = s"$set, $strategy"
    val selection = LightSelection.of(lights.toArray, strategy, around)

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
          assert(selection.choose(p, n, (i + 0.5f) / Draws_) == choice.light): Unit
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
        if out.pdf > 0f && !edgeOn && Math.abs(out.wi dot n) > 1e-3f then
          assert(selection.probability(p, n, i) > 0f, s"light $i at $p"): Unit

  test("points that face all around always find one of some point lights"):
    val lights = points(Draws(31), 9)
    val selection = LightSelection.of(lights.toArray)
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
    assert(selection.choose(Vec3.Zero, Vec3.Z, 0.5f) == -1)

  test("no lights: none is chosen"):
    assert(LightSelection.of(Array.empty[Light]).choose(Vec3.Zero, Vec3.Z, 0.5f) == -1)
