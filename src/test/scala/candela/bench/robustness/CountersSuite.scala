package candela.bench.robustness

import candela.accel.{Accelerator, Primitives}
import candela.accel.tracing.Hierarchies
import candela.bench.report.Robust
import candela.bench.suite.Commands
import candela.bsdf.{Bsdf, Lambert, Scaled}
import candela.color.Rgb
import candela.geometry.{Bounds3, Hit, Ray}
import candela.image.Image
import candela.math.*
import candela.shapes.TriangleSoup
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files
import java.nio.file.attribute.PosixFilePermissions

/** The counters of `candela robustness` find planted faults. */
class CountersSuite extends AnyFunSuite:
  private val mesh = ClosedMesh.all.head
  private val trials = Trials(3000, slice = 0)

  /** The ball without one of its triangles. */
  private def holed: TriangleSoup =
    val soup = mesh.soup
    def corner(i: Int)(k: Int) = soup.vertex(i, k)
    Solids.of((1 until soup.count).map(corner).map(c => (c(0), c(1), c(2))))

  test("a mesh with a hole leaks, about as often as its triangles are aimed at"):
    val tally = LeakingRays.tally(Hierarchies.scalar(Primitives(holed, Array.empty)), mesh, trials)
    // A 2,048th of the rays goes to the edge of the hole, and half of those through it
    assert(tally.trials == 3000 && tally.faults >= 1 && tally.faults < 30, tally)
    assert(tally.first.exists(_.startsWith("from ")))

  test("closed meshes of all kinds leak no ray, by each kernel"):
    for mesh <- ClosedMesh.all; kernel <- Kernel.all do
      val tally = LeakingRays.tally(mesh.accelerator(kernel.create), mesh, Trials(300, slice = 1))
      assert(tally == Tally(300, 0, None), s"${mesh.name}, ${kernel.title}")

  /** Finds hits where they are not, by a relative `error`. */
  private final class Beside(inner: Accelerator, error: Float) extends Accelerator:
    def closest(ray: Ray, hit: Hit): Boolean =
      val found = inner.closest(ray, hit)
      if found then ray.tMax *= 1f + error
      found
    def isOccluded(ray: Ray, hit: Hit): Boolean = inner.isOccluded(ray, hit)
    def bounds: Bounds3 = inner.bounds
    def describe: String = "beside"

  test("distances that are off by 1e-5 are counted, those of the kernels are not"):
    val planted = HitDistances.tally(p => Beside(Hierarchies.scalar(p), 1e-5f), trials)
    assert(planted.faults == planted.trials)
    for kernel <- Kernel.all do
      assert(HitDistances.tally(kernel.create, trials) == Tally(3000, 0, None), kernel.title)

  test("a shape that its own rays meet again is counted"):
    val inwards = Kind("sphere", Leaving.Anywhere)((_, toWorld, size, _) =>
      Target(Seq(Solids.sphere(toWorld, size)))
    )
    val tally = SpawnedRays(inwards, Place.Near, Trials(1000, slice = 0)).tally()
    // Half of them go into the sphere
    assert(tally.faults > tally.trials / 3 && tally.faults < tally.trials * 2 / 3, tally)

  test("BSDFs that are NaN, infinite or negative are counted"):
    val bad = Seq(Float.NaN, Float.PositiveInfinity, -1f)
    for value <- bad do
      val bsdf: Bsdf = Scaled(Lambert(Rgb.White), Rgb.gray(value))
      val tally = ExtremeInputs.tally(bsdf, trials)
      // Directions below the surface have no value, which is right
      assert(tally.faults > tally.trials / 3, s"$value: $tally")
    assert(ExtremeInputs.tally(Lambert(Rgb.White), trials) == Tally(3000, 0, None))

  test("trials in parts have different random numbers, and their sum"):
    val parts = Trials.divided(1000, 4)
    assert(parts.map(_.count).sum == 1000)
    assert(parts.map(_.draws(1).unit()).distinct.size == 4)

  private def gray(value: Float): Image =
    Image(128, 128, Image.RgbNames, Array.fill(3 * 128 * 128)(value))

  test("dark facets of a lit ball are counted, its lit ones are not"):
    val ball = SmoothBall(3)
    val lit = ball.artefacts(gray(1f))
    val dark = ball.artefacts(gray(0f))
    def faults(r: Robust) = r match
      case Robust.Counted(faults, trials, _) => (faults, trials)
      case other => fail(s"$other")
    assert(faults(lit)._1 == 0 && faults(lit)._2 > 3000)
    assert(faults(dark)._1 == faults(dark)._2)

  test("what Embree's script counts is read, for each of its modes"):
    TempFolder.use: folder =>
      // In place of Python: it counts the bytes of the rays, of 24 bytes each
      val python = folder.resolve("python")
      val text =
        """#!/bin/sh
          |size=$(wc -c < "$2/ball.rays")
          |[ -e "$2/ball.far" ] && exit 3
          |echo "ball $((size / 24)) 7" > "$3"
          |""".stripMargin
      val _ = Files.writeString(python, text)
      val _ = Files.setPosixFilePermissions(python, PosixFilePermissions.fromString("rwx------"))
      val embree = EmbreeRays(python.toString, folder, Commands(Vector.empty, folder))
      val found = embree.tally("ball", Solids.icosphere(0, Transform.Identity), 5): ray =>
        ray.set(Vec3.Zero, Vec3.X, Float.PositiveInfinity)
        Double.NaN
      assert(found("embree-fast") == Robust.Counted(5, 5))
      assert(found("embree-robust") == Robust.Counted(7, 5))
