package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.diagnostics.Severity
import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** Scenes that show a habit of one pbrt, with the means that it renders. */
final class PbrtValuesSuite extends AnyFunSuite:
  private val White = "LightSource \"infinite\" \"rgb L\" [1 1 1]"

  /** @param samples per pixel, of 16 × 16 */
  private def view(
      dialect: Dialect,
      place: String,
      fov: Int,
      body: String,
      depth: Int = 5,
      samples: Int = 64
  ): String =
    val film = if dialect == Dialect.V4 then "rgb" else "image"
    val integrator = if dialect == Dialect.V2 then "SurfaceIntegrator" else "Integrator"
    val sampler = if dialect == Dialect.V2 then "lowdiscrepancy" else "halton"
    s"""Film "$film" "integer xresolution" 16 "integer yresolution" 16
       |PixelFilter "box"
       |Sampler "$sampler" "integer pixelsamples" $samples
       |$integrator "path" "integer maxdepth" $depth
       |$place
       |Camera "perspective" "float fov" $fov
       |WorldBegin
       |$body
       |""".stripMargin

  /** @param tolerance relative: noise of a few thousand samples */
  private def assertMean(text: String, dialect: Dialect, expected: Rgb, tolerance: Float): Unit =
    val mean = SceneTexts.mean(text, dialect)
    def isNear(c: Rgb => Float) = Math.abs(c(mean) - c(expected)) <= tolerance * c(expected)
    assert(isNear(_.r) && isNear(_.g) && isNear(_.b), s"$mean, not $expected: $text"): Unit

  private def warnings(text: String, dialect: Dialect): Vector[String] =
    val found = SceneTexts.parse(text, dialect).warnings ++ SceneTexts.problems(text, dialect)
    assert(found.forall(_.severity == Severity.Warning), found)
    found.map(_.message)

  test("a camera in the plane of a surface looks along it, also if the surface is an instance"):
    val rounded =
      "ConcatTransform [0.866025403784 0.5 0 0  -0.5 0.866025403784 0 0  0 0 1 0  " +
        "0 8.5e-19 -0.0005 1]\n" +
        "ConcatTransform [0.52 0 0 0  0 6.12323399574e-17 -1 0  0 1 6.12323399574e-17 0  " +
        "-0.25 -1.4e-17 0.0005 1]\n"
    val turned = "Rotate 33 1 2 3 Translate .3 0 .2\n"
    val square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " +
      "\"point P\" [-.5 0 -.5  .5 0 -.5  .5 0 .5  -.5 0 .5]"
    val black = "Material \"matte\" \"rgb Kd\" [0 0 0]"
    for
      dialect <- Seq(Dialect.V3, Dialect.V4)
      transform <- Seq(rounded, "", turned)
      isInstance <- Seq(false, true)
    do
      val material =
        if dialect == Dialect.V3 then black
        else black.replace("matte", "diffuse").replace("Kd", "reflectance")
      val surface = s"$material\n$square"
      val shape =
        if isInstance then
          s"ObjectBegin \"o\"\n$surface\nObjectEnd\n$transform ObjectInstance \"o\""
        else transform + surface
      val body = s"$White\nAttributeBegin\n$shape\nAttributeEnd"
      // In the plane's own coordinates the camera stands at the origin
      val camera = if transform == turned then "Rotate -90 1 0 0 Rotate -33 1 2 3" else ""
      assertMean(view(dialect, camera, 30, body, samples = 4), dialect, Rgb.White, 1e-4f)

  test("an odd number of events between layers counts as one fewer for sampled directions"):
    def coated(material: String) = view(
      Dialect.V4,
      "LookAt 0 0 5 0 0 0 0 1 0",
      22,
      s"$White\nMaterial $material\nShape \"sphere\"",
      depth = 6
    )
    val diffuse = "\"coateddiffuse\" \"rgb reflectance\" [.9 .9 .9]"
    for (depth, mean) <- Seq(1 -> 0.2266f, 2 -> 0.5006f, 3 -> 0.5006f, 4 -> 0.6404f) do
      val text = coated(s"$diffuse \"integer maxdepth\" $depth")
      assertMean(text, Dialect.V4, Rgb.gray(mean), 0.015f)
    val scattering = s"$diffuse \"rgb albedo\" [.8 .8 .8] \"float thickness\" .5"
    for (depth, mean) <- Seq(1 -> 0.2262f, 2 -> 0.3405f, 3 -> 0.3788f) do
      val text = coated(s"$scattering \"integer maxdepth\" $depth")
      assertMean(text, Dialect.V4, Rgb.gray(mean), 0.015f)
    val conductor = coated("\"coatedconductor\" \"integer maxdepth\" 1")
    assertMean(conductor, Dialect.V4, Rgb.gray(0.2277f), 0.015f)

  private def lamp(dialect: Dialect, before: String, after: String, mesh: String): String =
    val square = "Shape \"trianglemesh\" \"point P\" [-5 -5 0 5 -5 0 5 5 0 -5 5 0] " +
      "\"integer indices\" [0 1 2 0 2 3]"
    view(
      dialect,
      "LookAt 0 -6 5 0 0 0 0 0 1",
      40,
      s"""AttributeBegin
         |Material "matte" "rgb Kd" [.6 .6 .6]
         |$square
         |Translate 0 0 6
         |$square
         |AttributeEnd
         |$before
         |AreaLightSource "diffuse" "rgb L" [10 10 10] $after
         |Shape "trianglemesh" "point P" [-1 -1 0 1 -1 0 1 1 0] "integer indices" [0 1 2] $mesh
         |""".stripMargin
    )

  private val reverse = "ReverseOrientation"
  private val up = "\"normal N\" [0 0 1 0 0 1 0 0 1]"
  private val down = "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]"
  private val plain = "Translate 0 0 3"
  private val mirrored = "Translate 0 0 3 Scale -1 1 1"

  test("pbrt-v3 samples a reversed mesh with normals on the side that rays do not see"):
    val two = s"\"bool twosided\" \"true\" $plain"
    for (before, after, normals, mean) <- Seq(
        ("", plain, "", 0.264f),
        ("", plain, down, 0.155f),
        ("", mirrored, down, 0.155f),
        (reverse, plain, "", 0.155f),
        (reverse, mirrored, "", 0.155f),
        (reverse, plain, down, 0.393f),
        (reverse, mirrored, down, 0.392f),
        (reverse, plain, up, 0.0243f),
        (reverse, two, down, 0.418f)
      )
    do
      val text = lamp(Dialect.V3, before, after, normals)
      assertMean(text, Dialect.V3, Rgb.gray(mean), 0.04f)

  test("pbrt-v2 samples a mirrored mesh, or one of mirrored uv, on the side that rays do not see"):
    val mirroredUv = "\"float uv\" [0 0 0 1 1 1]"
    val noUv = "\"float uv\" [0 0 0 0 0 0]"
    for (before, after, mesh, mean) <- Seq(
        ("", plain, "", 0.263f),
        ("", plain, down, 0.262f),
        ("", mirrored, "", 0.395f),
        ("", mirrored, down, 0.396f),
        (reverse, plain, "", 0.155f),
        (reverse, plain, up, 0.155f),
        (reverse, mirrored, up, 0.0243f),
        ("", plain, mirroredUv, 0.0243f),
        ("", plain, noUv, 0.0243f)
      )
    do
      val text = lamp(Dialect.V2, before, after, mesh)
      assertMean(text, Dialect.V2, Rgb.gray(mean), 0.04f)

  private def ball(material: String): String = view(
    Dialect.V3,
    "LookAt 0 0 -3 0 0 0 0 1 0",
    10,
    s"$White\n$material\nShape \"sphere\"",
    depth = 1
  )

  test("pbrt-v3's disney has colours above 1"):
    for (more, mean) <- Seq(
        "" -> Rgb(2.053f, 0.5412f, 0.5412f),
        "\"float metallic\" 1 \"float roughness\" .2" -> Rgb(2.003f, 0.5007f, 0.5007f)
      )
    do
      val text = ball(s"Material \"disney\" \"rgb color\" [2 .5 .5] $more")
      assertMean(text, Dialect.V3, mean, 0.02f)

  private def mix(amount: String): String = ball:
    s"""MakeNamedMaterial "a" "string type" "matte" "rgb Kd" [.6 .4 .2]
       |MakeNamedMaterial "b" "string type" "matte" "rgb Kd" [.2 .4 .6]
       |MakeNamedMaterial "m" "string type" "mix" "string namedmaterial1" "a"
       |  "string namedmaterial2" "b" $amount
       |NamedMaterial "m"""".stripMargin

  test("relief of a surface that lets light straight through reflects none from the other side"):
    val place = "LookAt 0 1 6 0 0 0 0 1 0"
    val relief = "Texture \"w\" \"float\" \"wrinkled\" Texture \"b\" \"float\" \"scale\" " +
      "\"texture tex1\" \"w\" \"float tex2\" .3\n"
    def uber(opacity: Double) = relief + "Material \"uber\" \"rgb Ks\" [0 0 0] " +
      s"\"rgb opacity\" [$opacity $opacity $opacity] \"texture bumpmap\" \"b\"\n"
    val ball = "LightSource \"point\" \"rgb I\" [8 6 4]\n" + uber(0.6) + "Shape \"sphere\""
    for dialect <- Seq(Dialect.V2, Dialect.V3) do
      // pbrt-v2 counts one fewer
      val depth = if dialect == Dialect.V2 then 0 else 1
      assertMean(view(dialect, place, 45, ball, depth), dialect, Rgb.Black, 0f)
      def bowl(opacity: Double) = "LightSource \"point\" \"rgb I\" [8 6 4]\n" + uber(opacity) +
        "Shape \"sphere\" \"float zmax\" .3"
      def mean(opacity: Double) = SceneTexts.mean(view(dialect, place, 45, bowl(opacity)), dialect)
      val (almost, whole) = (mean(0.999), mean(1))
      assert(Math.abs(almost.g / whole.g - 1) < 0.02f, s"$dialect: $almost, not $whole")

  test("gloss on relief has pbrt-v3's value where the shading normal separates the directions"):
    def ball(material: String) =
      "LightSource \"distant\" \"point from\" [4 2 -1] \"rgb L\" [8 6 4]\n" +
        "Texture \"b\" \"float\" \"bilerp\" \"float v01\" 3 \"float v10\" 4 \"float v11\" -2\n" +
        s"Material \"$material\" \"texture bumpmap\" \"b\" Shape \"sphere\""
    val place = "LookAt 0 1 6 0 0 0 0 1 0"
    for
      (material, expected) <- Vector(
        "uber" -> Rgb(0.010537f, 0.007903f, 0.005269f),
        "substrate" -> Rgb(0.028092f, 0.021067f, 0.014046f)
      )
    do
      val text = view(Dialect.V3, place, 45, ball(material), depth = 1, samples = 256)
      assertMean(text, Dialect.V3, expected, 0.02f)

  test("amounts above 1 of a mix scale its first material"):
    val text = mix("\"rgb amount\" [1.7 .5 .2]")
    assertMean(text, Dialect.V3, Rgb(1.0234f, 0.4013f, 0.5217f), 0.02f)

  test("a lone value of a sampled spectrum is black in pbrt-v3, with a warning"):
    val text = mix("\"spectrum amount\" [0]")
    assert(warnings(text, Dialect.V3).exists(_.contains("found 1 number; it is ignored")))
    assertMean(text, Dialect.V3, Rgb(0.2f, 0.4f, 0.6f), 0.02f)

  test("an unknown measured medium has the coefficients of the statement, with a warning"):
    val text = view(
      Dialect.V4,
      "LookAt 0 0 5 0 0 0 0 1 0",
      30,
      s"""$White
         |MakeNamedMedium "m" "string type" "homogeneous" "string preset" "Skim Milk"
         |  "float scale" .1
         |MediumInterface "m" ""
         |Material "interface"
         |Shape "sphere"""".stripMargin,
      depth = 20
    ).replace("\"path\"", "\"volpath\"")
    assert(warnings(text, Dialect.V4).exists(_.contains("unknown measured medium \"Skim Milk\"")))
    assertMean(text, Dialect.V4, Rgb.gray(0.945f), 0.01f)

  test("pbrt-v2's adaptive sampler takes two different powers of two, the larger at most"):
    for
      ((min, max), (few, all)) <- Seq(
        (4, 32) -> (4, 32),
        (3, 20) -> (4, 32),
        (16, 4) -> (4, 16),
        (8, 8) -> (8, 16),
        (1, 1) -> (2, 4)
      )
    do
      val sampler = s"Sampler \"adaptive\" \"integer minsamples\" $min \"integer maxsamples\" $max"
      val text = s"$sampler\nCamera \"perspective\"\nWorldBegin\nWorldEnd\n"
      val plan = SceneTexts.plan(text, Dialect.V2)
      assert(plan.sampler.samplesPerPixel == all, sampler)
      assert(plan.adaptive.exists(_.first.samplesPerPixel == few), sampler)
      val remarks = warnings(text, Dialect.V2).filter(_.contains("different powers of two"))
      assert(remarks.isEmpty == ((few, all) == (min, max)), sampler)
