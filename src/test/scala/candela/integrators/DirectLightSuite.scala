package candela.integrators

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Fresnel
import candela.math.*
import candela.testing.SceneTexts

/** All three integrators against irradiance that can be written down. */
final class DirectLightSuite extends AnyFunSuite:
  private val integrators = Seq(
    "\"whitted\"",
    "\"directlighting\" \"string strategy\" \"all\"",
    "\"directlighting\" \"string strategy\" \"one\"",
    "\"path\" \"integer maxdepth\" 1"
  )

  // One light that is a point or a direction has no noise: what is left is Float rounding, and the
  // 1e-3 of the plane that the camera spans
  private val Exact = 2e-3f

  private def assertRadiance(scene: String, expected: Float, tolerance: Float): Unit =
    val found = SceneTexts.mean(scene)
    for c <- Seq(found.r, found.g, found.b) do
      assert(Math.abs(c - expected) <= tolerance * expected, s"$found, expected $expected")

  for integrator <- integrators do
    test(s"$integrator: a point light at height h gives albedo / π · I / h²"):
      val scene = LitPlane.scene(
        integrator,
        spp = 1,
        """LightSource "point" "point from" [0 0 2] "rgb I" [8 8 8]"""
      )
      assertRadiance(scene, LitPlane.Albedo * InvPi * 8 / 4, Exact)

    test(s"$integrator: a distant light gives albedo / π · L · cos"):
      val scene = LitPlane.scene(
        integrator,
        spp = 1,
        """LightSource "distant" "point from" [0 1 1] "point to" [0 0 0] "rgb L" [3 3 3]"""
      )
      assertRadiance(scene, LitPlane.Albedo * InvPi * 3 * sqrt(0.5f), Exact)

    test(s"$integrator: a disk light of radius r at height h gives albedo · L · r² / (r² + h²)"):
      // The form factor of a disk above and parallel to a small patch. One area sample is off by
      // at most half of the mean, so 4096 of them by 0.8 %
      val scene = LitPlane.scene(
        integrator,
        spp = 256,
        """AttributeBegin
          |AreaLightSource "diffuse" "rgb L" [5 5 5]
          |ReverseOrientation
          |Shape "disk" "float height" 2 "float radius" 1
          |AttributeEnd""".stripMargin
      )
      assertRadiance(scene, LitPlane.Albedo * 5f / (1 + 4), 0.03f)

    test(s"$integrator: a constant environment and a point light add up"):
      // All but "path" and "one" have less noise than these, whose relative deviation is about 1:
      // of 16384 samples 0.8 %
      val scene = LitPlane.scene(
        integrator,
        spp = 1024,
        """LightSource "infinite" "rgb L" [1 1 1]
          |LightSource "point" "point from" [0 0 2] "rgb I" [8 8 8]""".stripMargin
      )
      assertRadiance(scene, LitPlane.Albedo * (1 + InvPi * 8 / 4), 0.03f)

    test(s"$integrator: something in the way casts a shadow"):
      val scene = LitPlane.scene(
        integrator,
        spp = 1,
        """LightSource "point" "point from" [0 0 2] "rgb I" [8 8 8]
          |Shape "disk" "float height" 1 "float radius" 0.5""".stripMargin
      )
      assert(SceneTexts.mean(scene).isBlack)

    test(s"$integrator: with no shapes the camera sees the environment"):
      val text = LitPlane.view(integrator, spp = 1) +
        "WorldBegin\nLightSource \"infinite\" \"rgb L\" [0.25 0.5 1]\nWorldEnd\n"
      val seen = SceneTexts.mean(text)
      assert(seen == candela.color.Rgb(0.25f, 0.5f, 1f))

    test(s"$integrator: an empty world, and one without lights, are black"):
      assert(SceneTexts.mean(LitPlane.view(integrator, 1) + "WorldBegin\nWorldEnd\n").isBlack)
      assert(SceneTexts.mean(LitPlane.scene(integrator, 1, lights = "")).isBlack)

  private val half = """"rgb Kd" [0.5 0.5 0.5] "rgb Ks" [0 0 0]"""
  private val glossy = s"""Material "uber" $half "rgb Kr" [1 1 1] "float index" 1.5"""
  private val sky = """LightSource "infinite" "rgb L" [1 1 1]"""
  private val mirrored = Fresnel.dielectric(sqrt(0.5f), 1.5f)

  for name <- Seq("whitted", "directlighting") do
    test(s"\"$name\" follows the mirror among other lobes"):
      // In a uniform environment the diffuse part shows its albedo: 1 % is 5 deviations of
      // Whitted's 65536 uniform samples of the sphere, and the mirror's part is 5 times that
      val scene = LitPlane.scene(s"\"$name\"", spp = 4096, sky, glossy)
      assertRadiance(scene, 0.5f + mirrored, 0.02f)

    test(s"\"$name\" of depth 1 follows no mirror"):
      val scene = LitPlane.scene(s"\"$name\" \"integer maxdepth\" 1", spp = 4096, sky, glossy)
      // As above: 1 % is 5 deviations
      assertRadiance(scene, 0.5f, 0.02f)

    test(s"\"$name\" sees lights in a plain mirror, and the light's shape itself"):
      val mirror = """Material "mirror" "rgb Kr" [0.8 0.8 0.8]"""
      assertRadiance(LitPlane.scene(s"\"$name\"", spp = 1, sky, mirror), 0.8f, Exact)
      val emitter = LitPlane.scene(
        s"\"$name\"",
        spp = 1,
        lights = "AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]",
        material = LitPlane.matte(0)
      )
      assertRadiance(emitter, 5f, Exact)
