package candela.api

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

class SceneBuilderSuite extends AnyFunSuite:
  private def image(scene: Scene, settings: RenderSettings = RenderSettings()): Vector[Float] =
    Using.resource(scene.prepare(settings, 2))(_.render(2).image.values.toVector)

  private def texts(problems: java.util.List[Problem]): Vector[String] =
    problems.asScala.map(_.message).toVector

  test("a scene made in code is that of the same file, byte for byte"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("scene.pbrt"), LibraryScenes.text())
      val scenes = Vector(
        Candela.read(file),
        Candela.parse(LibraryScenes.text(), file, ReadSettings()),
        LibraryScenes.built().called(file.toString).scene()
      )
      val files = scenes.zipWithIndex.map: (scene, i) =>
        assert(scene.problems.isEmpty && scene.dialect == "v4", scene.problems)
        val image = folder.resolve(s"$i.exr")
        Using.resource(scene.prepare(RenderSettings(), 2))(_.render(2).image.save(image))
        Files.readAllBytes(image).toVector
      assert(files(1) == files(0) && files(2) == files(0))

  test("what is wrong in code has the message that it has in a file, and the line of the call"):
    val text = LibraryScenes.text()
    val mistakes = Vector[(String, String, SceneBuilder => SceneBuilder)](
      ("", "Shape \"spher\"", _.shape("spher", Parameters())),
      (
        "",
        "Shape \"sphere\" \"float radiu\" 1",
        _.shape("sphere", Parameters().number("radiu", 1))
      ),
      (
        "",
        "Shape \"sphere\" \"integer radius\" 1",
        _.shape("sphere", Parameters().integer("radius", 1))
      ),
      (
        "",
        "Material \"matt\" Shape \"sphere\"",
        _.material("matt", Parameters()).shape("sphere", Parameters())
      ),
      (
        "",
        "NamedMaterial \"coa\" Shape \"sphere\"",
        _.useMaterial("coa").shape("sphere", Parameters())
      ),
      (
        "",
        "LightSource \"infinite\" \"rgb L\" [1 2]",
        _.light("infinite", Parameters().rgbs("L", Array[Float](1, 2)))
      ),
      ("", "ObjectInstance \"ston\"", _.instance("ston")),
      ("", "Film \"rgb\"", _.film("rgb", Parameters())),
      (
        "",
        "Rotate 10 0 0 0 Shape \"sphere\"",
        _.rotate(10, 0, 0, 0).shape("sphere", Parameters())
      ),
      ("", "ColorSpace \"rec202\"", _.colorSpace("rec202")),
      ("", "Attribute \"shap\"", _.defaults("shap", Parameters())),
      (
        "",
        "Texture \"checks\" \"spectrum\" \"constant\"",
        _.texture("checks", TextureValues.Spectrum, "constant", Parameters())
      ),
      (
        "ObjectBegin \"o\" ObjectEnd\n",
        "ObjectBegin \"o\" ObjectEnd",
        _.define("o", identity(_)).define("o", identity(_))
      )
    )
    def plain(message: String) = message.replaceAll(raw"[\w./]+:\d+:\d+", "PLACE")
    for (before, written, call) <- mistakes do
      val inFile = Candela.parse(s"$text$before$written\n").check(RenderSettings()).asScala.toVector
      val inCode = call(LibraryScenes.built()).scene().check(RenderSettings()).asScala.toVector
      def shown(p: Problem) = (p.severity, plain(p.message), p.help.toString)
      assert(inFile.nonEmpty, written)
      assert(inCode.map(shown) == inFile.map(shown), written)
      assert(inCode.forall(_.file.get == "SceneBuilderSuite.scala"), written)
      assert(inCode.forall(_.line > 20) && inFile.forall(
        _.line == s"$text$before".linesIterator.size + 1
      ))

  test("a body that returns another builder is refused, since its shapes would be lost"):
    val lost = LibraryScenes.built().shape("sphere", Parameters())
    intercept[IllegalArgumentException](LibraryScenes.built().attributes(_ => lost))
    intercept[IllegalArgumentException](LibraryScenes.built().define("ball", _ => null))

  test("arrays that change later change no scene"):
    val points = Array[Float](0, 0, 0, 1, 0, 0, 0, 1, 0)
    val indices = Array(0, 1, 2)
    val mesh = Parameters().points("P", points).integers("indices", indices)
    points(3) = Float.NaN
    indices(0) = 77
    val scene = LibraryScenes.built().shape("trianglemesh", mesh).scene()
    assert(scene.problems.isEmpty, scene.problems)

  test("numbers that a file can't contain are problems"):
    val found = LibraryScenes.built().translate(Double.NaN, 0, 0)
      .shape("sphere", Parameters().number("radius", Double.PositiveInfinity)).scene()
    assert(found.hasErrors)
    assert(texts(found.problems) == Vector(
      "Translate expects 3 numbers; number 1 is NaN",
      "values of `radius` must be numbers, found Infinity"
    ))
    val twice = LibraryScenes.built()
      .shape("sphere", Parameters().number("radius", 1).number("radius", 2)).scene()
    assert(!twice.hasErrors && texts(twice.problems).head.startsWith("`radius` is repeated"))

  test("a scene without a world, and one that can't be prepared, say so"):
    val none = Candela.build().film("rgb", Parameters()).scene()
    assert(texts(none.problems).exists(_.contains("no WorldBegin")))
    val thrown = intercept[SceneException](none.prepare(RenderSettings(samples = 1)))
    assert(texts(thrown.problems) == texts(none.problems))

  test("a changed scene is that of the changed file"):
    for version <- Vector("v4", "v3") do
      val start = if version == "v4" then LibraryScenes.text() else SceneBuilderSuite.old
      val read = Candela.parse(start)
      assert(read.dialect == version)
      val changed = read.edit()
        .change(SceneSetting.Film, Parameters().integer("xresolution", 12))
        .changeTexture("checks", Parameters().rgb("tex1", 0.1, 0.9, 0.1))
        .attributes:
          _.translate(0, -1, 0).material("diffuse", Parameters().rgb("reflectance", 0.9, 0.9, 0.9))
            .shape("sphere", Parameters().number("radius", 0.5))
        .scene()
      val white =
        if version == "v4" then "\"diffuse\" \"rgb reflectance\"" else "\"matte\" \"rgb Kd\""
      val world = s"AttributeBegin Translate 0 -1 0 Material $white [.9 .9 .9]\n" +
        "Shape \"sphere\" \"float radius\" .5 AttributeEnd\n"
      val end = if version == "v4" then "" else "WorldEnd\n"
      val edited = start.replace("\"integer xresolution\" 24", "\"integer xresolution\" 12")
        .replace(
          "\"rgb tex1\" [.8 .2 .1]",
          "\"rgb tex1\" [.1 .9 .1]"
        ).stripSuffix(end) + world + end
      assert(changed.problems.isEmpty, changed.problems)
      assert(image(changed) == image(Candela.parse(edited)), version)
      assert(image(read) == image(Candela.parse(start)), version)

  test("changes of what is not there are problems, with what may be meant"):
    val scene = Candela.parse(LibraryScenes.text()).edit()
      .changeMaterial("coa", Parameters().number("roughness", 1))
      .changeTexture("check", Parameters().number("scale", 1)).scene()
    val all = scene.problems.asScala.toVector
    assert(all.map(_.message) == Vector("unknown material `coa`", "unknown texture `check`"))
    assert(all.forall(p => p.help.isPresent && p.line > 0))

  test("a camera is placed anew, lights and shapes are removed"):
    val start = Candela.parse(LibraryScenes.text())
    val there = start.edit()
      .attributes(_.identity().lookAt(0, 2, -7, 0, 0, 0, 0, 1, 0).placeCamera()).scene()
    val moved = LibraryScenes.text().replace("LookAt 0 1 -6", "LookAt 0 2 -7")
    assert(image(there) == image(Candela.parse(moved)))
    val empty = start.edit().removeLights().removeShapes().scene()
    assert(image(empty).forall(_ == 0f))

  test("a camera that is placed in a scene of Mitsuba or a model sees what theirs sees"):
    val eye = "1 2 5  0 0 0  0 1 0"
    def placed(start: Scene) = start.edit().lookAt(1, 2, 5, 0, 0, 0, 0, 1, 0)
    for sensor <- Vector("perspective", "orthographic", "spherical") do
      val start = Candela.parse(SceneBuilderSuite.mitsuba(sensor))
      assert(start.dialect == "mitsuba" && !start.hasErrors, start.problems)
      assert(image(placed(start).placeCamera().scene()) == image(start), sensor)
      val anew = placed(start).camera(sensor, Parameters()).scene()
      val there = start.edit().camera(sensor, Parameters()).scene()
      assert(image(anew) == image(there), sensor)
    TempFolder.use: folder =>
      val model = Path.of("scenes/models/gl-shapes.gltf")
      val camera = Files.writeString(folder.resolve("a.pbrt"), s"Scale -1 1 1 LookAt $eye\n")
      def read(settings: ReadSettings) =
        Candela.read(model, settings.withOption("resolution", "24x16"))
      val viewed = read(ReadSettings().withOption("camera", camera.toString))
      val once = RenderSettings(samples = 1)
      val edited = placed(read(ReadSettings())).placeCamera().scene()
      assert(viewed.dialect == "gltf" && image(edited, once) == image(viewed, once))
      // Statements of a file say themselves what they mirror
      val text = Candela.parse(LibraryScenes.text())
      val plain = LibraryScenes.text().replace("LookAt 0 1 -6  0 0 0  0 1 0", s"LookAt $eye")
      assert(image(placed(text).placeCamera().scene()) == image(Candela.parse(plain)))

  test("a new camera without a transform is where the scene's is"):
    val start = Candela.parse(LibraryScenes.text())
    val wide = Parameters().number("fov", 70)
    val there = start.edit().camera("perspective", wide).scene()
    val text = LibraryScenes.text().replace("\"float fov\" 40", "\"float fov\" 70")
    assert(there.problems.isEmpty && image(there) == image(Candela.parse(text)))
    val moved = start.edit().lookAt(0, 2, -7, 0, 0, 0, 0, 1, 0).camera("perspective", wide).scene()
    val movedText = text.replace("LookAt 0 1 -6", "LookAt 0 2 -7")
    assert(moved.problems.isEmpty && image(moved) == image(Candela.parse(movedText)))
    val atOrigin = start.edit().identity().camera("perspective", wide).scene()
    assert(image(atOrigin) == image(Candela.parse(text.replace("LookAt 0 1 -6  0 0 0  0 1 0", ""))))

  test("a film of another size is a warning if the scene was read with a resolution"):
    val reading = ReadSettings().withOption("resolution", "50%")
    def told(settings: ReadSettings) =
      val start = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), settings)
      val wide = Parameters().integer("xresolution", 12)
      texts(start.edit().change(SceneSetting.Film, wide).scene().problems)
    assert(told(reading).exists(_.contains("read with `resolution`")), told(reading))
    assert(told(ReadSettings()).isEmpty)

  test("a new setting says which values of the scene's it drops"):
    val start = Candela.parse(LibraryScenes.text())
    val edited = start.edit()
      .film("rgb", Parameters().integer("xresolution", 12))
      .camera("orthographic", Parameters())
      .sampler("independent", Parameters().integer("pixelsamples", 2)).scene()
    val told = texts(edited.problems)
    assert(told.size == 2 && told(0).contains("`yresolution` has its default"), told)
    assert(told(1).contains("the new camera replaces the scene's: `fov`"), told)
    assert(edited.problems.get(0).help.get.contains("change(SceneSetting.Film, …)"))

  test("a scene made in code has all its problems"):
    val scene = Candela.build()
      .film("rgbb", Parameters())
      .sampler("halton", Parameters().integer("pixelsample", 4))
      .world()
      .light("infinit", Parameters())
      .material("diffuse", Parameters().number("reflectance", 1))
      .shape("spher", Parameters())
      .shape("sphere", Parameters().number("radius", -1))
      .scene()
    assert(scene.hasErrors)
    val told = texts(scene.problems)
    for word <- Vector("rgbb", "pixelsample", "infinit", "reflectance", "spher") do
      assert(told.exists(_.contains(s"`$word`")) || told.exists(_.contains(s"\"$word\"")), told)
    assert(told == texts(scene.check(RenderSettings())))
    assert(LibraryScenes.built().shape("spher", Parameters()).scene().edit().scene().hasErrors)

  test("calls that change nothing say so, with the call that does"):
    val start = Candela.parse(LibraryScenes.text())
    val edited = start.edit().lookAt(0, 2, -7, 0, 0, 0, 0, 1, 0)
      .material("conductor", Parameters()).areaLight("diffuse", Parameters()).scene()
    def told(scene: Scene) =
      scene.problems.asScala.map(p => (p.message, p.help.orElse(""))).toVector
    assert(!edited.hasErrors)
    val Vector(lookAt, material, light) = told(edited): @unchecked
    assert(lookAt._1 == "LookAt has no effect here" && lookAt._2.contains("placeCamera()"))
    assert(material._1 == "Material has no effect here" && material._2.contains("changeMaterialOf"))
    assert(light._1 == "AreaLightSource has no effect here" && light._2.contains("changeAreaLight"))
    assert(edited.problems.asScala.forall(_.file.get == "SceneBuilderSuite.scala"))
    val built = LibraryScenes.built()
    val inBlock = built.attributes(_.translate(1, 0, 0).useMaterial("coat")).shape(
      "sphere",
      Parameters().number("radius", 1)
    ).scene()
    assert(told(inBlock).map(_._1) == Vector(
      "Translate",
      "NamedMaterial"
    ).map(_ + " has no effect here"))
    val late =
      Candela.build().camera("perspective", Parameters()).lookAt(0, 1, -6, 0, 0, 0, 0, 1, 0)
        .world().shape("sphere", Parameters()).light("infinite", Parameters()).scene()
    // The camera stays inside the sphere, which is told, too
    assert(told(late).map(_._1).head == "LookAt has no effect here")

  test("calls that change something say nothing"):
    val start = Candela.parse(LibraryScenes.text())
    val edited = start.edit()
      .attributes(_.identity().lookAt(0, 2, -7, 0, 0, 0, 0, 1, 0).placeCamera())
      .attributes(_.translate(1, 0, 0).coordinateSystem("here"))
      .material("diffuse", Parameters())
      .attributes(_.translate(0, 2, 0).shape("sphere", Parameters()))
      .scene()
    assert(edited.problems.isEmpty, edited.problems)

  test("materials without a name, shapes and lights are changed by their indices"):
    val text = LibraryScenes.text() +
      "Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3] Shape \"sphere\" \"float radius\" .4\n" +
      "NamedMaterial \"coat\" Shape \"sphere\" \"float radius\" .2\n"
    val scene = Candela.parse(text)
    val names = scene.shapes.asScala.toVector
    assert(names.map(_.takeWhile(_ != ' ')) == Vector("sphere", "disk", "sphere", "sphere"))
    assert(names(1).endsWith("area light") && names(2).endsWith("material of type diffuse"))
    assert(names(3).endsWith("material coat") && scene.lights.size == 1)
    def edited(edit: SceneBuilder => SceneBuilder): Scene =
      val changed = edit(scene.edit()).scene()
      assert(changed.problems.isEmpty, changed.problems)
      changed
    def replaced(a: String, b: String): Scene =
      assert(text.contains(a))
      Candela.parse(text.replace(a, b))
    val red = Parameters().rgb("reflectance", 0.9, 0.1, 0.1)
    val pairs = Vector(
      edited(_.changeMaterialOf(2, red)) -> replaced(".1 .2 .3", ".9 .1 .1"),
      edited(_.changeShape(2, Parameters().number("radius", 0.6))) ->
        replaced("\"float radius\" .4", "\"float radius\" .6"),
      edited(_.changeAreaLightOf(1, Parameters().rgb("L", 1, 2, 3))) -> replaced("4 4 3", "1 2 3"),
      edited(_.changeLight(0, Parameters().rgb("L", 1, 2, 3))) -> replaced(".3 .4 .6", "1 2 3")
    )
    for ((a, b), i) <- pairs.zipWithIndex do assert(image(a) == image(b), i)
    // The other shape of that material keeps it
    val one = edited(_.changeMaterialOf(3, Parameters().rgb("reflectance", 0.9, 0.1, 0.1)))
    assert(one.shapes.get(0).endsWith("material coat"))
    assert(one.shapes.get(3).endsWith("material of type coateddiffuse"))
    val wrong = scene.edit().changeShape(4, Parameters().number("radius", 1))
      .changeLight(-1, Parameters()).changeAreaLightOf(0, Parameters()).scene()
    assert(texts(wrong.problems) == Vector(
      "the scene has no shape 4",
      "the scene has no light -1",
      "shape 0 has no area light to change"
    ))

  test("objects of the library show what they are"):
    val scene = Candela.parse(LibraryScenes.text())
    assert(s"$scene" == "Scene(scene.pbrt, 3 shapes, 2 instances, 2 lights)")
    assert(s"${LibraryScenes.built()}" == "SceneBuilder(scene, 3 shapes, 2 instances, 2 lights)")
    assert(s"${Candela.read(java.nio.file.Path.of("none.pbrt"))}" == "Scene(none.pbrt, unreadable)")
    Using.resource(scene.prepare(RenderSettings(samples = 1), 2)): job =>
      assert(s"$job" == "Job(scene.pbrt, 24x16, 1 sample per pixel)")
      val result = job.render(2)
      assert(s"$result".startsWith("RenderResult(24x16, 1 sample per pixel, "))
      assert(s"${result.image}" == "RenderedImage(24x16, R, G, B)")
    // Whatever the class, no hash codes
    val folder = java.nio.file.Path.of(classOf[Scene].getResource("Scene.class").toURI).getParent
    val classes = Using.resource(Files.list(folder)): files =>
      files.iterator.asScala.map(_.getFileName.toString).filter(_.matches(raw"\w+\.class")).toVector
    val shown =
      for
        name <- classes
        c = Class.forName(s"candela.api.${name.stripSuffix(".class")}")
        if !c.isInterface && !c.isEnum && !classOf[Throwable].isAssignableFrom(c)
        if c.getDeclaredConstructors.exists(_.getParameterCount > 0)
        if !Set("IdleStatements", "Followed")(c.getSimpleName)
      yield
        assert(c.getDeclaredMethods.exists(_.getName == "toString"), name)
        name
    assert(shown.size > 10, shown)

object SceneBuilderSuite:
  private def mitsuba(sensor: String) =
    s"""<scene version="3.0.0">
      |  <integrator type="path"/>
      |  <sensor type="$sensor">
      |    <transform name="to_world"><lookat origin="1,2,5" target="0,0,0" up="0,1,0"/></transform>
      |    <film type="hdrfilm"><integer name="width" value="24"/>
      |      <integer name="height" value="16"/></film>
      |    <sampler type="independent"><integer name="sample_count" value="2"/></sampler>
      |  </sensor>
      |  <emitter type="constant"><rgb name="radiance" value="0.2 0.3 0.4"/></emitter>
      |  <shape type="sphere"><float name="radius" value="0.5"/>
      |    <bsdf type="diffuse"><rgb name="reflectance" value="0.9 0.1 0.1"/></bsdf></shape>
      |  <shape type="sphere"><point name="center" x="0.7" y="0.2" z="0"/>
      |    <float name="radius" value="0.3"/></shape>
      |</scene>
      |""".stripMargin

  private val old =
    """Film "image" "integer xresolution" 24 "integer yresolution" 16
      |LookAt 0 1 -6  0 0 0  0 1 0
      |Camera "perspective" "float fov" 40
      |Sampler "halton" "integer pixelsamples" 4
      |Integrator "path" "integer maxdepth" 3
      |WorldBegin
      |LightSource "infinite" "rgb L" [.3 .4 .6]
      |Texture "checks" "color" "checkerboard" "rgb tex1" [.8 .2 .1] "rgb tex2" [.1 .2 .8]
      |Material "matte" "texture Kd" "checks"
      |Shape "sphere" "float radius" 1.1
      |WorldEnd
      |""".stripMargin
