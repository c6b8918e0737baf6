package candela.stability

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.SceneTexts

/** Long paths against sums that can be written down. */
class PathsSuite extends AnyFunSuite:

  private def inside(integrator: String, spp: Int, world: String): Float =
    SceneTexts.mean(
      s"""LookAt 0 0 0  0 0 1  0 1 0
         |Camera "perspective" "float fov" 60
         |Film "image" "integer xresolution" 4 "integer yresolution" 4
         |Sampler "random" "integer pixelsamples" $spp
         |Integrator $integrator
         |WorldBegin
         |$world
         |WorldEnd
         |""".stripMargin
    ).g

  private def path(depth: Int) = s"""\"path\" \"integer maxdepth\" $depth"""

  test("a thousand bounces between mirrors that glow add up as a geometric series"):
    // Σ rᵏ for k to 1000 = (1 − r¹⁰⁰¹) / (1 − r), for r = 0.999: 632.67; no roulette above 0.25
    // of throughput, which 0.999¹⁰⁰⁰ = 0.37 never is below
    val found = inside(
      "\"path\" \"integer maxdepth\" 1000 \"float rrthreshold\" 0.25",
      spp = 1,
      """Material "mirror" "rgb Kr" [0.999 0.999 0.999]
        |AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" "true"
        |Translate 0 0 2 Shape "disk" "float radius" 1e6
        |Translate 0 0 -5 Shape "disk" "float radius" 1e6""".stripMargin
    )
    val expected = (1 - Math.pow(0.999, 1001)) / (1 - 0.999)
    // The rounding of a thousand products; oblique paths stay between disks this wide
    assert(Math.abs(found - expected) < 1e-3 * expected, s"$found, not $expected")

  test("paths end where they must in a closed white room, where roulette never ends them"):
    // Each of the depth + 1 surfaces of a path adds the emission 1
    val world =
      """Material "matte" "rgb Kd" [1 1 1]
        |AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" "true"
        |Shape "sphere" "float radius" 3""".stripMargin
    for depth <- Seq(0, 1, 10, 200) do
      val found = inside(path(depth), spp = 4, world)
      assert(Math.abs(found - (depth + 1)) <= 2e-3f * (depth + 1), s"$found at depth $depth")

  test("glass within glass, under an even sky, is as bright as the sky"):
    // Lossless, so that the furnace shows nothing; paths beyond depth 200 are lost
    val world =
      """LightSource "infinite" "rgb L" [1 1 1]
        |Translate 0 0 6
        |Material "glass" "float eta" 1.5 Shape "sphere" "float radius" 2
        |Material "glass" "float eta" 1.2 Shape "sphere" "float radius" 1
        |Material "glass" "float eta" 0.7 Shape "sphere" "float radius" 0.5
        |Material "glass" "float eta" 1.0000001 Shape "sphere" "float radius" 0.25""".stripMargin
    val found = inside(path(200), spp = 256, world)
    // 4096 samples; what is trapped by total reflection within spheres is less than a hundredth
    assert(Math.abs(found - 1f) < 0.01f, s"$found")

  test("where shading normals disagree with the surface, an even sky still shows its albedo"):
    // As in pbrt-v3, geometry decides on the side and the shading normal on the cosine, whose sign
    // doesn't count: ∫ |cos| over any half space is π
    for degrees <- Seq(0.0, 30.0, 60.0, 85.0) do
      val (s, c) = (Math.sin(degrees.toRadians), Math.cos(degrees.toRadians))
      val n = s"$s 0 ${-c}"
      val found = inside(
        path(5),
        spp = 1024,
        s"""LightSource "infinite" "rgb L" [1 1 1]
           |Material "matte" "rgb Kd" [.8 .8 .8]
           |Shape "trianglemesh" "integer indices" [0 1 2] "normal N" [$n $n $n]
           |  "point P" [-90 -90 9  90 -90 9  0 90 9]""".stripMargin
      )
      // 16,384 samples, each between 0 and twice the mean
      assert(Math.abs(found - 0.8) < 0.015, s"$found at $degrees degrees")
