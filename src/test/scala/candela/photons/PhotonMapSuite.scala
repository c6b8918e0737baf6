package candela.photons

import candela.bdpt.PathVertex
import candela.concurrency.GivenUp
import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.lights.PointLight
import candela.math.*
import candela.scene.Scene
import candela.testing.{Draws, PlainScene}

final class PhotonMapSuite extends AnyFunSuite:
  private val albedo = 0.6f

  private def scene: Scene =
    val light = PointLight(Vec3.Zero, Rgb.White)
    PlainScene(Rgb.gray(albedo), light)

  test("all photons within the radius count, each once, and no other"):
    val draws = Draws(3)
    val (radius, paths) = (0.13f, 7)
    val places = Vector.fill(3000)((draws.vec(-1, 1), draws.direction(), draws.unit()))
    val parts = places.grouped(700).toArray.map: part =>
      val photons = Photons()
      for (p, from, light) <- part do photons.add(p, from, Rgb(light, 2 * light, 0))
      photons
    val map = PhotonMap(parts, paths, radius)
    assert(map.count == 3000)
    val vertex = PathVertex(scene)
    for _ <- 1 to 200 do
      vertex.point.p = draws.vec(-1.1f, 1.1f)
      vertex.scatterBy(scene.bsdf(vertex.point), Vec3.Z)
      // Matte surfaces scatter what comes from above alone
      val near = places.filter((p, from, _) => (p - vertex.point.p).length < radius && from.z > 0f)
      val expected = near.map(_._3.toDouble).sum * albedo / Math.PI /
        (Math.PI * radius * radius * paths)
      val found = map.gather(vertex, 1f)
      assert(Math.abs(found.r - expected) < 1e-4 * expected + 1e-6)
      assert(Math.abs(found.g - 2 * expected) < 2e-4 * expected + 1e-6 && found.b == 0f)

  test("directions that the path follows by itself are left out"):
    val photons = Photons()
    photons.add(Vec3.Zero, Vec3(0, 0, 1), Rgb.White)
    photons.add(Vec3.Zero, Vec3(sqrt(0.99f), 0, 0.1f), Rgb.White)
    val map = PhotonMap(Array(photons), 1, 1f)
    val vertex = PathVertex(scene)
    vertex.scatterBy(scene.bsdf(vertex.point), Vec3.Z)
    val all = map.gather(vertex, 1f).r
    assert(Math.abs(map.gather(vertex, 0.1f).r / all - 0.5f) < 1e-5f)

  test("a map without photons is dark"):
    val vertex = PathVertex(scene)
    vertex.scatterBy(scene.bsdf(vertex.point), Vec3.Z)
    assert(PhotonMap(Array(Photons()), 1, 1f).gather(vertex, 1f).isBlack)

  test("a map that nobody waits for any more is given up after the next part"):
    val photons = Photons()
    photons.add(Vec3.Zero, Vec3.Z, Rgb.White)
    val parts = Array.fill(1000)(photons)
    for last <- Vector(1, 7, 1007) do
      var asked = 0
      def isStopped() =
        asked += 1
        asked > last
      intercept[GivenUp](PhotonMap(parts, 1, 1f, isStopped = () => isStopped()))
      assert(asked == last + 1)
