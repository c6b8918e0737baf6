package candela.integrators

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.scenefile.Dialect
import candela.testing.SceneTexts

final class VolumeMarchSuite extends AnyFunSuite:

  /** From straight above, a plane that is lit from above, too, below a box of height 2. */
  private def text(volumeIntegrator: String, volume: String, surface: String): String =
    s"""LookAt 0 0 9  0 0 0  0 1 0
       |Camera "orthographic" "float screenwindow" [-.01 .01 -.01 .01]
       |Film "image" "integer xresolution" 4 "integer yresolution" 4
       |Sampler "random" "integer pixelsamples" 200
       |SurfaceIntegrator $surface
       |VolumeIntegrator $volumeIntegrator
       |WorldBegin
       |LightSource "distant" "point from" [0 0 1] "point to" [0 0 0] "color L" [1 1 1]
       |${LitPlane.matte()}
       |Shape "disk" "float radius" 1000
       |Volume $volume "point p0" [-5 -5 1] "point p1" [5 5 3]
       |WorldEnd
       |""".stripMargin

  private def seen(volumeIntegrator: String, volume: String, surface: String) =
    SceneTexts.mean(text(volumeIntegrator, volume, surface), Dialect.V2)

  private val plane = LitPlane.Albedo / Math.PI
  private val fine = "\"float stepsize\" .02"
  private val surfaces =
    Seq("\"directlighting\"", "\"whitted\"", "\"path\" \"integer maxdepth\" [1]")

  for surface <- surfaces do
    test(s"$surface: a volume dims light twice, and adds what it emits"):
      val volume =
        """"homogeneous" "color sigma_a" [.1 .3 0] "color Le" [.02 0 .05]"""
      val c = seen(s""""emission" $fine""", volume, surface)
      // ∫ Le exp(−σ s) ds over 2; the last step's transmittance is off by 1 % of it at most
      def expected(sigma: Double, le: Double) =
        plane * Math.exp(-4 * sigma) +
          le * (if sigma == 0 then 2 else (1 - Math.exp(-2 * sigma)) / sigma)
      val wanted = Seq(expected(0.1, 0.02), expected(0.3, 0), expected(0, 0.05))
      for (v, e) <- Seq(c.r, c.g, c.b).zip(wanted) do
        assert(Math.abs(v - e) < 0.01 * e, s"$c, expected $e")

    test(s"$surface: a volume scatters light once"):
      val volume = """"homogeneous" "color sigma_s" [.1 .3 0] "color sigma_a" [.2 0 0]"""
      val c = seen(s""""single" $fine""", volume, surface)
      // As in VolumePathTracerSuite: down and up again to each place
      def expected(s: Double, t: Double) =
        plane * Math.exp(-4 * t) +
          (if t == 0 then 0 else s / (4 * Math.PI) * (1 - Math.exp(-4 * t)) / (2 * t))
      val wanted = Seq(expected(0.1, 0.3), expected(0.3, 0.3), expected(0, 0))
      for (v, e) <- Seq(c.r, c.g, c.b).zip(wanted) do
        assert(Math.abs(v - e) < 0.015 * e, s"$c, expected $e")

  test("an exponential volume dims by the integral of its density"):
    val volume = """"exponential" "color sigma_a" [.5 .5 .5] "float b" [1] "vector updir" [0 0 1]"""
    val c = seen(s""""emission" $fine""", volume, "\"directlighting\"").g
    val depth = 0.5 * (1 - Math.exp(-2))
    // The last half step before the plane is left out: 0.01 of a σ of 0.5
    assert(Math.abs(c - plane * Math.exp(-2 * depth)) < 0.01 * c)

  test("the step is part of the picture: one step of the default size dims only up to its sample"):
    // E[exp(−σ·2u)] for u uniform, as count = 2 steps of 1: half of the last step is left out
    val volume = """"homogeneous" "color sigma_a" [1 1 1]"""
    val c = seen("\"emission\" \"float stepsize\" 2", volume, "\"directlighting\"").g
    val towardsCamera = (1 - Math.exp(-2)) / 2
    assert(Math.abs(c - plane * Math.exp(-2) * towardsCamera) < 0.05 * c, c)

  /** Straight down through a box of height 4 that holds a sphere of radius 1. */
  private def boxed(surface: String, volume: String, light: String, shapes: String): String =
    s"""LookAt 0 0 9  0 0 0  0 1 0
       |Camera "orthographic" "float screenwindow" [-.01 .01 -.01 .01]
       |Film "image" "integer xresolution" 4 "integer yresolution" 4
       |Sampler "random" "integer pixelsamples" 50
       |SurfaceIntegrator "$surface"
       |VolumeIntegrator "single" $fine
       |WorldBegin
       |LightSource $light
       |Volume $volume "point p0" [-5 -5 -2] "point p1" [5 5 2]
       |$shapes
       |WorldEnd
       |""".stripMargin

  for surface <- Seq("path", "directlighting", "igi", "photonmap") do
    test(s"$surface: a sphere of a material that pbrt-v2 doesn't know, such as none, is matte"):
      val volume = """"homogeneous" "color sigma_s" [.1 .3 0] "color sigma_a" [.2 0 0]"""
      val emitter = """"point" "point from" [0 .2 .5] "color I" [9 9 9]"""
      val floor = s"""${LitPlane.matte()} Shape "disk" "float radius" 5 "float height" -3"""
      def seen(shapes: String) =
        SceneTexts.mean(boxed(surface, volume, emitter, floor + shapes), Dialect.V2)
      val c = seen(""" Material "matte" Shape "sphere"""")
      assert(c != seen(""), c)
      for name <- Seq("none", "", "interface") do
        assert(c == seen(s""" Material "$name" Shape "sphere""""), name)

  test("steps without number are bounded, and a warning says how", Slow):
    val volume = "\"volumegrid\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 " +
      "\"float density\" [1 1] \"color sigma_s\" [.1 .1 .1] \"color Le\" [.02 .02 .02]"
    for method <- Vector("emission", "single") do
      val tiny = text(s"\"$method\" \"float stepsize\" 1e-9", volume, surfaces.head)
        .replace("\"integer pixelsamples\" 200", "\"integer pixelsamples\" 1")
      val usual = seen(s"\"$method\" \"float stepsize\" .01", volume, surfaces.head)
      val found = SceneTexts.mean(tiny, Dialect.V2)
      // The step itself is the error
      assert(Math.abs(found.g / usual.g - 1) < 0.01, s"$found, $usual")
      val why = SceneTexts.problems(tiny, Dialect.V2).map(_.message)
      assert(
        why.contains(
          "`stepsize` of 1.0E-9 needs more than 2048 steps through the volumes; using 0.0069740512"
        ),
        why
      )

  test("volumes far from the camera are crossed"):
    val volume = "\"volumegrid\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 1 " +
      "\"float density\" [1]"
    val far = text(s"\"emission\" $fine", volume, surfaces.head)
      .replace("LookAt 0 0 9", "LookAt 0 0 1e8")
      .replace("\"integer pixelsamples\" 200", "\"integer pixelsamples\" 1")
    assert(SceneTexts.mean(far, Dialect.V2).g >= 0)
