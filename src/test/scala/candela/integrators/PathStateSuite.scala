package candela.integrators

import candela.color.Rgb
import candela.math.Vec3

import org.scalatest.funsuite.AnyFunSuite

final class PathStateSuite extends AnyFunSuite:
  private val kinds = Seq[(String, () => PathState)](
    "between surfaces" -> (() => SurfacePath()),
    "in media" -> (() => VolumePath())
  )

  private def started(newPath: () => PathState): PathState =
    val path = newPath()
    path.start()
    path

  for (name, newPath) <- kinds do
    test(s"the weights of both ways to find light add up to one, $name"):
      for pdf <- Seq(1e-3f, 0.3f, 7f, 1e6f); choice <- Seq(0.1f, 1f); point <- Seq(0.02f, 4f) do
        val path = started(newPath)
        path.startSegment(Vec3.Zero, Vec3.Z, pdf)
        assert(!path.lightSamplingMisses)
        val byPath = path.emissionWeight(choice, point)
        val byLight = LightTransport.powerHeuristic(choice * point, pdf)
        // Rounding of a few operations
        assert(Math.abs(byPath + byLight - 1f) < 1e-6f, (pdf, choice, point))

    test(s"light sampling does not compete with the camera, nor with a specular direction, $name"):
      val path = started(newPath)
      assert(path.lightSamplingMisses)
      path.startSegment(Vec3.Zero, Vec3.Z, 1f)
      path.startSegment(Vec3.X, Vec3.Z, 0f)
      assert(path.lightSamplingMisses && path.lastP.x == 1f)

    test(
      s"a negative colour counts by its magnitude, so that roulette doesn't end all paths, $name"
    ):
      val path = started(newPath)
      path.scale(Rgb(-0.5f, 0f, 0f))
      assert(path.throughput.largest == 0.5f)

    test(s"a hero wavelength stands for all three, $name"):
      val path = started(newPath)
      path.scale(Rgb(0.5f, 0.2f, 0.1f))
      path.terminateSecondary()
      assert(path.isAlone && path.throughput == Rgb(1.5f, 0f, 0f))
      path.start()

    test(s"a copy carries what the path does, $name"):
      def seen(path: PathState) =
        val weight = path.emissionWeight(0.5f, 0.3f)
        val fields = Vector(path.depth, path.passed, path.etaScale, path.isAlone)
        val places = Vector(path.lastP.toVec3, path.lastN.toVec3)
        (fields, places, path.throughput, path.lightSamplingMisses, weight)
      val path = started(newPath)
      path.scale(Rgb(0.5f, 0.2f, 0.1f))
      path.startSegment(Vec3(1f, 2f, 3f), Vec3.Y, 0.7f)
      path.terminateSecondary()
      path.depth = 3
      path.passed = 2
      path.etaScale = 1.7f
      val copy = path.another()
      copy.set(path)
      val before = seen(path)
      assert(seen(copy) == before)
      path.absorb()
      path.startSegment(Vec3.Zero, Vec3.Z, 0.1f)
      assert(path.isBlack && !copy.isBlack && seen(copy) == before)

  test("behind an interface that stops light samples, the path alone finds light, or nobody does"):
    for (interfaces, isLost) <- Seq(Interfaces.Closed -> false, Interfaces.Lossy -> true) do
      val path = SurfacePath()
      path.start()
      path.startSegment(Vec3.Zero, Vec3.Z, 0.4f)
      path.pass(interfaces)
      assert(path.lightSamplingMisses != isLost)
      assert(!isLost || path.emissionWeight(1f, 1f) == 0f)
