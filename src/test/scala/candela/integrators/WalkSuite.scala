package candela.integrators

import candela.base.Assertions
import candela.color.Rgb
import candela.geometry.Ray
import candela.lights.PointLight
import candela.math.Vec3
import candela.media.{MediumBorder, SceneMedia}
import candela.sampling.IndependentSampler
import candela.testing.PlainScene

import org.scalatest.funsuite.AnyFunSuite

final class WalkSuite extends AnyFunSuite:
  import WalkSuite.*

  /** A triangle in the plane z = 0, and an emitter above it. */
  private val scene =
    val light = PointLight(Vec3(0f, 0f, 1f), Rgb.White)
    val triangle = (Vec3(-2f, -1f, 0f), Vec3(2f, -1f, 0f), Vec3(0f, 2f, 0f))
    PlainScene(Rgb.White, light, triangle)
  private val media =
    val borders = Array(MediumBorder(-1, -1))
    SceneMedia(Array.empty, borders, camera = -1, lights = Array(-1), eye = Vec3.Zero, reach = 9f)

  private val sampler = IndependentSampler(1, 1)
  sampler.start(0, 0, 0)

  /** At the beginning of a path to the triangle. */
  private def begun(walk: Walk): Walk =
    val ray = Ray()
    ray.set(Vec3(0f, 0f, 2f), Vec3(0f, 0f, -1f), Float.PositiveInfinity)
    walk.begin(ray, sampler)
    walk

  private val walks = Seq[(String, () => Walk)](
    "over surfaces" -> (() => SurfaceWalk(scene)),
    "through media" -> (() => VolumeWalk(scene, media, WalkOptions()))
  )

  private val steps = Map[String, Walk => Unit](
    "trace" -> (_.trace(): Unit),
    "meetSurface" -> (_.meetSurface()),
    "addEnvironment" -> (_.addEnvironment()),
    "addEmission" -> (_.addEmission()),
    "passThrough" -> (_.passThrough()),
    "evaluate" -> (_.evaluate()),
    "sampleLight" -> (_.sampleLight(sampler): Unit),
    "connect" -> (_.connect(isBoundary = false)),
    "scatter" -> (_.scatter(sampler)),
    "leave" -> (_.leave()),
    "roulette" -> (_.roulette(1f, sampler))
  )

  test("assertions are on in tests"):
    assert(Assertions.areOn)

  for (name, newWalk) <- walks do
    test(s"a path $name takes its steps in the one order in which its estimate is right"):
      for done <- Path.indices do
        def walk =
          val path = begun(newWalk())
          for step <- Path.take(done) do steps(step)(path)
          path
        val accepted = steps.keySet.filter: step =>
          val path = walk
          try
            steps(step)(path)
            true
          catch case _: AssertionError => false
        assert(accepted == Following(Path.take(done).lastOption.getOrElse("begin")))

    test(s"roulette does not end all paths $name that carry one negative colour"):
      // A wavelength may have a negative part of a colour; of a half of its magnitude 50 of 100
      // survive, with a deviation of 5
      val survived = (0 until 100).count: _ =>
        val walk = begun(newWalk())
        walk.path.scale(Rgb(-0.5f, 0f, 0f))
        walk.roulette(1f, sampler)
        walk.goesOn
      assert(Math.abs(survived - 50) < 25, survived)

private object WalkSuite:
  val Path: Vector[String] = Vector(
    "trace",
    "meetSurface",
    "addEmission",
    "evaluate",
    "sampleLight",
    "connect",
    "scatter",
    "leave",
    "roulette"
  )

  /** What may follow each step. */
  val Following: Map[String, Set[String]] = Map(
    "begin" -> Set("trace", "roulette"),
    "trace" -> Set("meetSurface"),
    "meetSurface" -> Set("addEmission", "passThrough", "evaluate"),
    "addEmission" -> Set("addEmission", "passThrough", "evaluate"),
    "evaluate" -> Set("sampleLight", "scatter"),
    "sampleLight" -> Set("connect", "scatter"),
    "connect" -> Set("sampleLight", "scatter"),
    "scatter" -> Set("leave"),
    "leave" -> Set("trace", "roulette")
  )
