package candela.build

import candela.diagnostics.{Problem, SceneError, Severity}
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

import candela.image.{Image, ImageFiles, Samples}
import candela.mitsuba.MitsubaScene
import candela.scenefile.{Dialect, Parser}
import candela.settings.RenderSettings
import candela.testing.SceneTexts

/** What the builder says about scenes that ask for something that is not there. */
final class BuildErrorsSuite extends AnyFunSuite:
  private val sphere = "Shape \"sphere\""
  private val control =
    "\"point P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2] \"integer levels\" 1"

  /** The one problem of a world that holds the statement in its second line, with a light. */
  private def only(statement: String, dialect: Dialect = Dialect.V3): Problem =
    val text = s"WorldBegin\n$statement\nLightSource \"point\"\n"
    val found = SceneTexts.problems(text, dialect)
    assert(found.size == 1, found)
    assert(found.head.pos.map(_.line).contains(2), found.head)
    found.head

  private def assertError(p: Problem, message: String, help: String = ""): Unit =
    assert(p.severity == Severity.Error && p.message.contains(message), p)
    assert(help.isEmpty || p.help.exists(_.contains(help)), p): Unit

  private def assertWarning(p: Problem, message: String, help: String = ""): Unit =
    assert(p.severity == Severity.Warning && p.message.contains(message), p)
    assert(help.isEmpty || p.help.exists(_.contains(help)), p): Unit

  test("a misspelt parameter is a warning with the nearest name, at its place"):
    val p = only("Shape \"sphere\" \"float raduis\" 2")
    assertWarning(p, "`raduis` is not a parameter of \"sphere\"", "`radius`")
    assert(p.pos.map(_.column).contains(16))

  test("a missing mesh hides no error of another kind"):
    Samples.inFolder: folder =>
      Files.write(folder.resolve("bad.png"), Array[Byte](1, 2, 3)): Unit
      val mesh = "Shape \"plymesh\" \"string filename\" \"gone.ply\"\n"
      val texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"bad.png\"\n"
      val world = s"Accelerator \"octree\"\nWorldBegin\n$mesh$texture"
      def said(text: String) = SceneTexts.problems(text, Dialect.V4, folder).map(_.message)
      val expected = Seq("no file `gone.ply`", "not a valid .png file", "\"octree\"")
      for text <- expected do assert(said(world).exists(_.contains(text)), said(world))

  test("a missing mesh of Mitsuba's hides no broken image"):
    Samples.inFolder: folder =>
      Files.write(folder.resolve("bad.png"), Array[Byte](1, 2, 3)): Unit
      val image = """<bsdf type="diffuse"><texture type="bitmap" name="reflectance">
        <string name="filename" value="bad.png"/></texture></bsdf>"""
      val file = Files.writeString(
        folder.resolve("scene.xml"),
        s"""<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"/>
          <emitter type="envmap"><string name="filename" value="bad.png"/></emitter>
          <shape type="obj"><string name="filename" value="gone.obj"/></shape>
          <shape type="sphere">$image</shape></scene>"""
      )
      val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
      val told = intercept[SceneError](SceneBuilder.build(scene, RenderSettings())).problems
      assert(told.flatMap(_.pos.map(_.line)) == Vector(2, 3, 5), told)

  test("of a parameter of another dialect, this one's name is suggested"):
    val p = only("Material \"matte\" \"rgb reflectance\" [.5 .5 .5] Shape \"sphere\"")
    assertWarning(p, "`reflectance` is not a parameter of \"matte\"", "did you mean `Kd`?")

  test("a misspelt parameter of a substituted type is found, too"):
    val ptex = s"Texture \"t\" \"float\" \"ptex\" \"string filenam\" \"x\" $sphere"
    val found = SceneTexts.problems(s"WorldBegin\n$ptex\nLightSource \"point\"\n")
    assert(found.size == 2 && found.exists(_.message.contains("\"ptex\" is substituted")))
    val slip = found.find(_.message.contains("filenam`")).get
    assertWarning(slip, "`filenam` is not a parameter of \"ptex\"", "`filename`")

  test("a metal by its index and by its reflectance, or an interface in a mixture, is an error"):
    val both = "Material \"conductor\" \"rgb reflectance\" [.5 .5 .5] \"rgb k\" [1 1 1] "
    assert(SceneTexts.problems(s"WorldBegin\n$both$sphere\n", Dialect.V4).exists: p =>
      p.message == "`reflectance` and `eta` and `k` of \"conductor\" are mutually exclusive")
    val mixed = "MakeNamedMaterial \"air\" \"string type\" \"interface\"\n" +
      "Material \"mix\" \"string materials\" [\"air\" \"air\"] "
    assert(SceneTexts.problems(s"WorldBegin\n$mixed$sphere\n", Dialect.V4).exists: p =>
      p.message == "`materials` of \"mix\" must not name an interface, found `air`")

  test("a parameter of another dialect is a warning that says so"):
    assertWarning(
      only("LightSource \"point\" \"float power\" 5"),
      "`power` is a parameter of \"point\" in v4 only, not in v3; it is ignored"
    )

  test("a type of another dialect is made as that one makes it, with a warning"):
    val v4 = only(s"Material \"matte\" \"rgb Kd\" [1 0 0] $sphere", Dialect.V4)
    val message = "material \"matte\" exists only in v2 and v3; using v3's"
    assertWarning(v4, message, "in v4, write \"diffuse\"")
    val v3 = only(s"Material \"diffuse\" $sphere")
    assertWarning(v3, "\"diffuse\" exists only in v4", "in v3, write \"matte\"")

  test("parameters that have no effect have their types checked all the same"):
    val p = only(s"Shape \"loopsubdiv\" \"integer scheme\" 3 $control")
    val message = "`scheme` of \"loopsubdiv\" must be of type string, found integer"
    assertWarning(p, message, "write \"string scheme\"")

  test("unknown types are errors with the nearest name"):
    def v4(statement: String) = only(statement, Dialect.V4)
    assertError(v4("Shape \"shpere\""), "unknown shape \"shpere\"", "`sphere`")
    assertError(v4(s"Material \"difuse\" $sphere"), "unknown material \"difuse\"", "`diffuse`")
    val area = v4(s"AreaLightSource \"difuse\" $sphere")
    assertError(area, "unknown area light \"difuse\"", "`diffuse`")
    assertError(v4("LightSource \"piont\""), "unknown light \"piont\"", "`point`")
    val texture = "Texture \"t\" \"float\" \"constnat\""
    assertError(only(texture), "unknown float texture \"constnat\"", "`constant`")

  test("unknown types that pbrt-v2 and pbrt-v3 replace are replaced here, with a warning"):
    val skipped = "; skipped, as pbrt does"
    assertWarning(only("Shape \"shpere\""), s"unknown shape \"shpere\"$skipped", "`sphere`")
    val area = only(s"AreaLightSource \"portal\" $sphere")
    assertWarning(area, s"unknown area light \"portal\"$skipped")
    val light = only("LightSource \"piont\"")
    assertWarning(light, s"unknown light \"piont\"$skipped", "`point`")
    val volume = only("Volume \"rainbow\"", Dialect.V2)
    assertWarning(volume, s"unknown volume \"rainbow\"$skipped")
    val mate = only(s"Material \"mate\" $sphere")
    assertWarning(mate, "unknown material \"mate\"; using \"matte\", as pbrt does", "`matte`")
    val tree = s"Accelerator \"octree\" WorldBegin $sphere LightSource \"point\""
    val message = "unknown accelerator \"octree\"; using \"bvh\", as pbrt does"
    assert(SceneTexts.problems(tree).map(_.message) == Vector(message))
    def mean(material: String) =
      val film = "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 "
      val look = "Camera \"perspective\" WorldBegin LightSource \"infinite\" Translate 0 0 2 "
      SceneTexts.mean(s"$film$look Material \"$material\" \"color Kd\" [1 0 0] $sphere")
    assert(mean("iris") == mean("matte") && mean("iris") != mean("mirror"))

  test("what pbrt knows and Candela does not yet is a warning that says what happens instead"):
    assertWarning(only(s"Texture \"t\" \"float\" \"ptex\" $sphere"), "using the constant 0.5")

  test("lights that emit nothing are ignored, with a warning"):
    def light(rest: String) = only(s"LightSource $rest")
    assertWarning(light("\"point\" \"rgb I\" [0 0 0]"), "emits nothing; the light is ignored")
    assertWarning(light("\"spot\" \"point to\" [0 0 0]"), "the same point")
    assertWarning(light("\"spot\" \"float coneangle\" 0"), "`coneangle` must be above 0")
    assertWarning(
      light("\"distant\" \"point from\" [1 1 1] \"point to\" [1 1 1]"),
      "the same point"
    )
    assertWarning(light("\"infinite\" \"rgb scale\" [0 0 0]"), "emits nothing")
    assertWarning(light("\"projection\" \"float fov\" 180"), "must be between 0 and 180 degrees")
    val dark = only(s"AreaLightSource \"diffuse\" \"rgb L\" [0 0 0] $sphere")
    assertWarning(dark, "this area light emits nothing; it is ignored")
    val flat = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 1 1] " +
      "\"point P\" [0 0 0 1 0 0 0 1 0]"
    val emitter = only(s"AreaLightSource \"diffuse\" $flat")
    assertWarning(emitter, "1 of 2 triangles of this area light have no area")
    val huge = only("AreaLightSource \"diffuse\" Shape \"sphere\" \"float radius\" 1e30")
    assertWarning(huge, "the area of this area light is too large for a number; it is ignored")

  test("lights without what they need are errors"):
    def light(rest: String) = only(s"LightSource $rest", Dialect.V4)
    assertError(light("\"goniometric\""), "needs `filename`")
    assertError(light("\"projection\""), "needs `filename`")
    val portal = "\"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0 0 2 0]"
    assertError(light(portal), "four corners of a rectangle")

  test("values of the wrong type or number are errors in v4, and ignored with a warning before"):
    val radius = only("Shape \"sphere\" \"string radius\" \"big\"", Dialect.V4)
    assertError(radius, "must be of type float, found string", "\"float radius\"")
    val two = "Shape \"sphere\" \"float radius\" [1 2]"
    assertError(only(two, Dialect.V4), "must be one number, found 2 of type float")
    assertWarning(only(two), "found 2 of type float; it is ignored, as pbrt does")
    assertWarning(
      only("LightSource \"point\" \"point from\" [1 2 3 4 5 6]"),
      "must be 3 numbers"
    )
    val red = only("LightSource \"point\" \"string I\" \"red\"")
    assertWarning(red, "must be of type spectrum, found string", "\"rgb I\"")
    val sides = "AreaLightSource \"diffuse\" \"string twosided\" \"x\" " + sphere
    assertWarning(only(sides), "must be of type bool, found string")

  test("types that only Mitsuba's scenes have are unknown to pbrt's"):
    val sky = only("LightSource \"sunsky\" \"float turbidity\" 3")
    assertWarning(sky, "unknown light \"sunsky\"; skipped, as pbrt does")
    assert(sky.help.contains(
      "\"sunsky\" is a type of Mitsuba's scenes; pbrt's nearest is \"infinite\""
    ))
    val near = only("LightSource \"moon\"").help
    assert(near.exists(h => h.contains("infinite") && !h.contains("sunsky")))
    assertError(only("LightSource \"sunsky\"", Dialect.V4), "unknown light \"sunsky\"")
    for name <- Seq("principled", "roughplastic", "twosided", "phong", "coating") do
      val v3 = only(s"Material \"$name\" $sphere")
      assertWarning(v3, s"unknown material \"$name\"; using \"matte\", as pbrt does")
      assertError(only(s"Material \"$name\" $sphere", Dialect.V4), s"unknown material \"$name\"")

  test("parameters that only Mitsuba's scenes have are none of pbrt's"):
    val beckmann = s"Material \"conductor\" \"string distribution\" \"beckmann\" $sphere"
    val message = "`distribution` is a parameter of \"conductor\" in mitsuba only, not in v4"
    assertWarning(only(beckmann, Dialect.V4), message)
    val mirrored =
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" " +
        "\"scenes/textures/chart.png\" \"string wrap\" \"mirror\""
    val found = SceneTexts.problems(s"WorldBegin\n$mirrored\n$sphere", Dialect.V4)
    assert(found.exists(_.message.contains("`wrap` must be one of")), found)

  test("a misspelt type of another dialect is named as this one calls it"):
    val plastic = only(s"Material \"plastik\" $sphere", Dialect.V4)
    assertError(plastic, "unknown material \"plastik\"", "did you mean `plastic`?")
    assertError(plastic, "plastik", "in v4, write \"coateddiffuse\"")
    val near = only(s"Material \"dielektric\" $sphere", Dialect.V4)
    assertError(near, "unknown material \"dielektric\"", "did you mean `dielectric`?")

  test("values of a grid that are no density are limited with a warning"):
    val box = "\"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 "
    for value <- Seq("1e30", "-1") do
      val media = Seq(
        Dialect.V4 -> s"\"uniformgrid\" $box \"float density\" [1 $value]",
        Dialect.V4 -> s"\"rgbgrid\" $box \"rgb sigma_s\" [1 1 1 1 $value 1]",
        Dialect.V3 -> s"\"heterogeneous\" $box \"float density\" [1 $value]"
      )
      for (dialect, medium) <- media do
        val scene = "Camera \"perspective\" WorldBegin LightSource \"infinite\" " +
          s"MakeNamedMedium \"m\" \"string type\" $medium\n" +
          "Material \"interface\" MediumInterface \"m\" \"\"\nShape \"sphere\"\n"
        val told = SceneTexts.problems(scene, dialect).map(_.message)
        assert(told.exists(_.contains("must be from 0 to")), s"$medium $told")

  test("a scene whose media glow is not told that it will be dark"):
    val box = "Material \"interface\"\nMediumInterface \"m\" \"\"\nShape \"sphere\"\n"
    val grid = "\"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 1 \"float density\" 1 "
    def scene(medium: String) =
      s"Camera \"perspective\" WorldBegin MakeNamedMedium \"m\" \"string type\" $medium\n$box"
    val absorbs = "\"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [0 0 0] "
    for
      medium <- Seq(
        s"\"homogeneous\" $absorbs \"rgb Le\" [1 1 1]",
        s"\"uniformgrid\" $grid $absorbs \"rgb Le\" [1 1 1]",
        s"\"uniformgrid\" $grid $absorbs \"float temperature\" 3000",
        s"\"rgbgrid\" ${grid.replace("\"float density\" 1 ", "")} " +
          "\"rgb sigma_a\" [1 1 1] \"rgb Le\" [1 1 1]"
      )
    do assert(SceneTexts.problems(scene(medium), Dialect.V4).isEmpty, medium)
    assert(SceneTexts.problems(scene(s"\"homogeneous\" $absorbs"), Dialect.V4).nonEmpty)
    val fog = "Camera \"perspective\" WorldBegin Volume \"homogeneous\" " +
      "\"color sigma_a\" [1 1 1] \"color Le\" [1 1 1] WorldEnd"
    assert(!SceneTexts.problems(fog, Dialect.V2).exists(_.message.contains("no light")))

  test("a texture that no statement made is an error with the nearest name"):
    val made = "Texture \"wood\" \"spectrum\" \"constant\" "
    val p = only(s"$made Material \"matte\" \"texture Kd\" \"wodo\" $sphere")
    assertError(p, "spectrum texture `wodo` is not defined", "`wood`")

  test("a texture of the wrong kind is an error that names both"):
    val made = "Texture \"t\" \"float\" \"constant\" "
    val p = only(s"$made Material \"matte\" \"texture Kd\" \"t\" $sphere")
    assertError(p, "`Kd` must be a spectrum texture, but `t` is a float texture")

  test("files that are not there are errors, with the nearest name in their folder"):
    val folder = Files.createTempDirectory("candela-build")
    val near = Files.createFile(folder.resolve("bunny.ply"))
    try
      val text = "WorldBegin\nShape \"plymesh\" \"string filename\" \"buny.ply\"\n" +
        "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"nowhere.png\"\n"
      val found = SceneTexts.problems(text, Dialect.V3, folder)
      val mesh = found.find(_.message.contains("no file `buny.ply`")).get
      assertError(mesh, "no file", "`bunny.ply`")
      assert(mesh.pos.map(_.line).contains(2))
      val texture = found.find(_.message.contains("no file `nowhere.png`")).get
      assert(texture.severity == Severity.Error && texture.pos.map(_.line).contains(3))
    finally
      Files.delete(near)
      Files.delete(folder)

  test("all errors of a scene are named in one go, in the order of their places"):
    val text = "WorldBegin\nShape \"shpere\"\nLightSource \"piont\"\nShape \"dsik\"\n"
    val errors = SceneTexts.problems(text, Dialect.V4).filter(_.severity == Severity.Error)
    assert(errors.flatMap(_.pos).map(_.line) == Vector(2, 3, 4))

  test("a problem in a file shows the line that it is about"):
    val file = Files.createTempFile("shpere", ".pbrt")
    try
      Files.writeString(file, "WorldBegin\nLightSource \"piont\"\n"): Unit
      val error = intercept[SceneError](SceneBuilder.build(Parser.parse(file), RenderSettings()))
      assert(error.problems.flatMap(_.excerpt) == Vector("LightSource \"piont\""))
    finally Files.delete(file)

  test("an unknown film or integrator falls back with a message"):
    val text = "Film \"spectral\"\nIntegrator \"function\"\nWorldBegin\nLightSource \"point\"\n"
    val found = SceneTexts.problems(text)
    assert(found.map(_.severity).toSet == Set(Severity.Warning))
    assert(found.exists(_.message.contains("\"spectral\"")))
    assert(found.exists(_.message.contains("\"function\"")))

  test("gamma as a number in v3 is ignored with a warning, as in pbrt-v3"):
    val folder = Files.createTempDirectory("candela-build")
    val file = folder.resolve("a.png")
    try
      ImageFiles.write(file, Image(1, 1, Image.RgbNames, Array(1f, 1f, 1f)), Vector.empty)
      val text = "WorldBegin\nLightSource \"point\"\nTexture \"t\" \"float\" \"imagemap\" " +
        "\"string filename\" \"a.png\" \"float gamma\" 2.2"
      val found = SceneTexts.problems(text, Dialect.V3, folder)
      assert(found.exists(_.message.startsWith("`gamma` must be a bool in v3")), found)
      assert(found.forall(_.severity == Severity.Warning))
    finally
      Files.deleteIfExists(file): Unit
      Files.delete(folder)

  test("gamma of an image texture is a number in v2 and a flag in v3, and neither is a surprise"):
    val v2 = "Texture \"t\" \"float\" \"imagemap\" \"float gamma\" 2.2"
    val v3 = "Texture \"t\" \"float\" \"imagemap\" \"bool gamma\" \"true\""
    // The file is missing in both: that is the only problem
    assertError(only(v2, Dialect.V2), "needs `filename`")
    assertError(only(v3, Dialect.V3), "needs `filename`")

  test("names that no file can have are files that are not there"):
    val shape = "Shape \"plymesh\" \"string filename\" \"a\u0000\""
    val light = "LightSource \"point\" \"spectrum I\" \"a\u0000\""
    val found = SceneTexts.problems(s"WorldBegin $shape $light WorldEnd").map(_.message)
    assert(found.exists(_.contains("no file `a")))
    assert(found.exists(_.contains("is neither a named spectrum")))

  test("after a thousand errors, or ten thousand warnings, a build says no more"):
    def world(count: Int)(line: Int => String) =
      (1 to count).map(line).mkString("WorldBegin\nLightSource \"point\"\n", "\n", "\n")
    val missing = world(1200)(i => s"NamedMaterial \"m$i\" $sphere")
    val errors = SceneTexts.problems(missing, Dialect.V4)
    assert(errors.size == 1001 && errors.last.message == "building stopped after 1000 errors")
    assert(errors.head.message == "material `m1` is not defined")
    val warnings =
      SceneTexts.problems(world(10_200)(_ => "LightSource \"point\" \"float x\" 1"), Dialect.V4)
    assert(warnings.size == 10_001 && warnings.last.message == "more warnings are omitted")
