package candela.guiding

import candela.base.Parallel
import candela.math.*
import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class PhotonFieldSuite extends AnyFunSuite:
  import PhotonFieldSuite.*

  test("the density of directions is that of its samples, and all of it is one"):
    val draws = Draws(1)
    val photons = FieldPhotons()
    // From all sides: no photon foretells another, and all lobes are wide
    for _ <- 0 until 200 do
      val p = place(draws)
      photons.add(p, p + draws.above(Up), Side, draws.between(0.1f, 1f))
    val mixture = PhotonMixture()
    assert(mixture.locate(PhotonFieldBuilder(photons, Parallel.Alone).result(), Vec3.Zero, Side))
    MixtureDensity.check(mixture.pdf, mixture.sample)

  for (what, light) <- Vector(
      "an emitter at the surface that photons left last" -> Vec3(0.2f, 1f, -0.1f),
      "an emitter behind that surface" -> Vec3(0.2f, 3f, -0.1f),
      "a sun" -> Vec3(2e4f, 1e5f, -1e4f)
    )
  do
    test(s"photons guide to where they came from, at all places around them: $what"):
      val field = lit(light, knowsChange = true)
      val densities = densitiesTo(light, field)
      // Lobes of 0.003 are as dense as 17,700
      assert(densities.min > 2000f, densities)

  test("without neighbours of their paths, photons know no emitter behind the surface"):
    val emitter = Vec3(0.2f, 3f, -0.1f)
    def typical(knows: Boolean) = densitiesTo(emitter, lit(emitter, knows)).sorted.apply(32)
    assert(typical(true) > 4 * typical(false))

  test("where no photon arrives, no direction is aimed at"):
    val field = lit(Vec3(0f, 3f, 0f), knowsChange = true)
    val mixture = PhotonMixture()
    assert(mixture.locate(field, Vec3(0.5f, 0f, 0.5f), Side))
    assert(!mixture.locate(field, Vec3(4f, 0f, 0.5f), Side))
    assert(!mixture.locate(field, Vec3(0.5f, 0f, 0.5f), GuideField.side(-Up)))

  test("photons in one place are a region of their own"):
    val photons = FieldPhotons()
    val p = Vec3(3f, 0f, 2f)
    for i <- 0 until 100 do photons.add(p, p + Vec3(0.01f * i, 1f, 0f), Side, 1f)
    val field = PhotonFieldBuilder(photons, Parallel.Alone).result()
    val mixture = PhotonMixture()
    assert(field.count <= 16 && field.regions == 1 && mixture.locate(field, p, Side))
    assert(mixture.pdf(Vec3(0.05f, 1f, 0f).normalized) > 1f)

private object PhotonFieldSuite:
  val Up: Vec3 = Vec3(0f, 1f, 0f)
  val Side: Int = GuideField.side(Up)

  def place(draws: Draws): Vec3 = Vec3(draws.between(-1f, 1f), 0f, draws.between(-1f, 1f))

  /** Photons of a point light on the ground, which they reach by way of the plane y = 1. */
  def lit(light: Vec3, knowsChange: Boolean): PhotonField =
    val draws = Draws(2)
    val photons = FieldPhotons()
    for _ <- 0 until 4000 do
      val p = place(draws)
      photons.add(p, p + (light - p) * (1f / light.y), Side, 1f)
      if knowsChange then
        val (p1, p2) = (p + Vec3(0.01f, 0f, 0f), p + Vec3(0f, 0f, 0.01f))
        photons.bend(p1, (light - p1).normalized, p2, (light - p2).normalized)
    PhotonFieldBuilder(photons, Parallel.Alone).result()

  def densitiesTo(light: Vec3, field: PhotonField): Vector[Float] =
    val draws = Draws(3)
    val mixture = PhotonMixture()
    Vector.fill(64):
      val p = place(draws) * 0.9f
      mixture.locate(field, p, Side)
      mixture.pdf((light - p).normalized)
