package candela.stability

import candela.bsdf.Fresnel
import candela.math.*
import candela.testing.Draws
import Checks.assert

/** Fresnel's equations with 60 digits: at grazing angles, around the critical one, and between
  * media that are nearly the same, where all but a few digits of Floats cancel.
  */
private object Interfaces:
  import Exact.*

  val cases: Seq[Case] = Seq(
    Case("dielectric reflectance has the digits of Floats", 3000, 1_000_000L)(dielectric),
    Case(
      "light just before the critical angle is refracted, just past it reflected",
      2000,
      1_000_000L
    )(
      critical
    ),
    Case("reflectance of metals has the digits of Floats", 1000, 1_000_000L)(metal),
    Case("refracted directions obey Snell's law", 3000, 1_000_000L)(snell)
  )

  private def index(draws: Draws): Float = draws.below(4) match
    case 0 => if draws.coin() then Math.nextUp(1f) else Math.nextDown(1f)
    case 1 => 1f + draws.magnitude(1e-6, 1e-2) * (if draws.coin() then 1f else -1f)
    case 2 => draws.magnitude(1e-2, 1)
    case _ => draws.magnitude(1, 1e2)

  private def cosine(draws: Draws): Float =
    if draws.coin() then draws.magnitude(1e-12, 1) else 1f - draws.magnitude(1e-7, 1)

  private val one = of(1f)

  /** 1 − sin² of the refracted angle. */
  private def cos2Refracted(c: Float, eta: Float) =
    one -~ ((one -~ (of(c) *~ of(c))) /~ (of(eta) *~ of(eta)))

  private def dielectric(count: Long): Unit =
    val draws = Draws(1)
    var i = 0L
    while i < count do
      val (c, eta) = (cosine(draws), index(draws))
      val cos2T = cos2Refracted(c, eta)
      val found = Fresnel.dielectric(c, eta)
      if cos2T.signum <= 0 then assert(found == 1f, s"$c $eta"): Unit
      else
        val (n, cosI, cosT) = (of(eta), of(c), cos2T.root)
        val parallel = ((n *~ cosI) -~ cosT) /~ ((n *~ cosI) +~ cosT)
        val across = (cosI -~ (n *~ cosT)) /~ (cosI +~ (n *~ cosT))
        val exact = ((parallel *~ parallel) +~ (across *~ across)).doubleValue / 2
        // Between like media 1e-7 of the index is all there is: Doubles keep eight digits of its
        // square. At the critical angle the root magnifies what Doubles round to 1e-8
        assert(
          Math.abs(found - exact) <= 1e-6 * exact + 1e-30 + 4e-8 * exact,
          s"$c $eta $exact"
        ): Unit
      i += 1

  /** Born and Wolf, "Principles of Optics", §13.4, for a complex index against 1. */
  private def metal(count: Long): Unit =
    val draws = Draws(4)
    val (two, four) = (of(2f), of(4f))
    var i = 0L
    while i < count do
      val (c, eta, k) = (cosine(draws), draws.magnitude(1e-3, 1e3), draws.magnitude(1e-6, 1e3))
      val (cos, n, kk) = (of(c), of(eta), of(k))
      val cos2 = cos *~ cos
      val sin2 = one -~ cos2
      val real = (n *~ n) -~ (kk *~ kk) -~ sin2
      val modulus = ((real *~ real) +~ (four *~ n *~ n *~ kk *~ kk)).root
      val twiceA = two *~ ((modulus +~ real) /~ two).root *~ cos
      val across = (modulus +~ cos2 -~ twiceA) /~ (modulus +~ cos2 +~ twiceA)
      val (sum, part) = ((modulus *~ cos2) +~ (sin2 *~ sin2), twiceA *~ sin2)
      val along = across *~ (sum -~ part) /~ (sum +~ part)
      val exact = ((across +~ along) /~ two).doubleValue
      val found = Fresnel.conductor(c, eta, k)
      // Where nearly all passes, the difference of Doubles is all that is left
      assert(Math.abs(found - exact) <= 1e-6 * exact + 1e-13, s"$found, not $exact: $c $eta $k")
      i += 1

  private def critical(count: Long): Unit =
    val draws = Draws(2)
    var i = 0L
    while i < count do
      val eta = draws.between(0.05f, 0.999f)
      val edge = (one -~ (of(eta) *~ of(eta))).root.floatValue
      var c = edge
      for _ <- 0 until 4 do c = Math.nextDown(c)
      for _ <- 0 until 9 do
        val passes = cos2Refracted(c, eta).signum > 0
        val reflected = Fresnel.dielectric(c, eta)
        val cosT = Fresnel.cosRefracted(c, eta)
        // Within the last digit of a Double both answers are right
        val margin = Math.abs(cos2Refracted(c, eta).doubleValue)
        if margin > 1e-14 then
          assert((reflected < 1f) == passes || reflected > 0.9999f, s"$c $eta: $reflected")
          assert((cosT > 0f) == passes, s"$c $eta: $cosT"): Unit
        assert(reflected >= 0f && reflected <= 1f && cosT >= -1f && cosT <= 1f)
        c = Math.nextUp(c)
      i += 1

  private def snell(count: Long): Unit =
    val draws = Draws(3)
    var i = 0L
    while i < count do
      val (c, eta) = (Math.max(1e-6f, cosine(draws)), index(draws))
      val cosT = Fresnel.cosRefracted(c, eta)
      if cosT > 0f then
        val sine = sqrt(1f - c * c)
        val w = Fresnel.refracted(Vec3(sine, 0f, c), Vec3.Z, c, cosT, eta)
        val expected = cos2Refracted(c, eta).root.doubleValue
        // Where the index falls, what the Float sine is off grows by it
        val slack = 2e-6f * Math.max(1f, 1f / eta)
        assert(Math.abs(w.length - 1f) < 1e-6f, s"$w $c $eta")
        assert(Math.abs(w.x + sine / eta) <= slack, s"$w $c $eta")
        assert(Math.abs(-w.z - expected) <= slack, s"$w $c $eta"): Unit
      i += 1
