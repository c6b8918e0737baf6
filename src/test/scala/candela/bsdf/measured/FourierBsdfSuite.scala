package candela.bsdf.measured

import candela.bsdf.{BsdfLaws, Directions}
import candela.bsdf.microfacet.{RoughDielectric, TrowbridgeReitz}
import candela.color.Rgb
import candela.math.*
import candela.testing.Draws

class FourierBsdfSuite extends BsdfLaws:
  private val cosines = FourierTables.cosines(32)
  private val colour = Rgb(1.2f, 0.7f, 0.3f)
  private val coloured = FourierTables(cosines, 2, 3, 1f)(FourierTables.cushion(colour))
  private val grey = FourierTables(cosines, 2, 1, 1.5f)(FourierTables.cushion(Rgb.White))

  // Splines are symmetric at their nodes alone
  obeysLaws("in colours", FourierBsdf(coloured.table), isReciprocal = false)
  obeysLaws("with an index", FourierBsdf(grey.table), isReciprocal = false)

  for (name, tables, color) <- Seq(
      ("in colours", coloured, colour),
      ("with an index", grey, Rgb.White)
    )
  do
    test(s"$name: the values are those that the table was made of"):
      val bsdf = FourierBsdf(tables.table)
      val draws = Draws(9)
      for _ <- 0 until 2000 do
        val (wo, wi) = (draws.direction(), draws.direction())
        // Near the horizon, what splines are off by is divided by next to nothing
        val isHigh = Math.abs(wi.z) > 0.05f
        val off = bsdf.f(wo, wi) - FourierTables.cushion(color)(wo, wi)
        assert(!isHigh || off.map(c => Math.abs(c)).max < 2e-3f, s"$off; $wo $wi"): Unit

  test("at nodes, rough glass is what it was, with its refraction"):
    val glass = RoughDielectric(TrowbridgeReitz(0.7f, 0.7f), 1.4f)
    val tables = FourierTables(FourierTables.cosines(8), 48, 1, 1.4f)(glass.f)
    val bsdf = FourierBsdf(tables.table)
    for o <- tables.cosines; i <- tables.cosines; phi <- Seq(10.0, 80.0, 170.0) do
      if Math.abs(o) < 1f && Math.abs(i) < 1f then
        val wo = Directions.at(Math.toDegrees(Math.acos(o)), 20)
        val wi = Directions.at(Math.toDegrees(Math.acos(-i)), 20 + phi)
        val (found, right) = (bsdf.f(wo, wi).g, glass.f(wo, wi).g)
        // The series ends; narrow lobes of grazing light ring a little
        assert(
          Math.abs(found - right) < 0.01f + 0.03f * right,
          s"$found, not $right; $wo $wi"
        ): Unit

  test("from straight above, light goes to all azimuths alike"):
    val bsdf = FourierBsdf(grey.table)
    val draws = Draws(10)
    val n = 20000
    var (x, y) = (0.0, 0.0)
    for _ <- 0 until n do
      val wi = bsdf.sample(Vec3.Z, 0f, draws.unit(), draws.unit()).wi
      x += wi.x
      y += wi.y
    // Four standard errors of a coordinate in [−1, 1]
    assert(Math.abs(x / n) < 4 * 0.6 / Math.sqrt(n) && Math.abs(y / n) < 4 * 0.6 / Math.sqrt(n))
