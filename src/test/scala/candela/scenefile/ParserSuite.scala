package candela.scenefile

import candela.diagnostics.SceneError
import java.nio.file.Path

import candela.math.{Transform, Vec3}
import org.scalatest.funsuite.AnyFunSuite

class ParserSuite extends AnyFunSuite:

  private def parse(text: String, dialect: Option[Dialect] = None): SceneDescription =
    Parser.parseText("test.pbrt", text, Path.of("folder"), dialect)

  private def world(text: String, dialect: Dialect = Dialect.V3): SceneDescription =
    val scene = parse(s"WorldBegin\n$text\nWorldEnd", Some(dialect))
    assert(scene.warnings.isEmpty)
    scene

  private def errors(text: String): Vector[String] =
    intercept[SceneError](parse(text)).problems.map(_.message)

  private val x = Vec3.X

  test("the options are kept with their parameters, places and folder"):
    val scene = parse(
      """Camera "perspective" "float fov" 45 Film "image" Sampler "halton" PixelFilter "box"
        |SurfaceIntegrator "path" VolumeIntegrator "single" Renderer "sampler" Accelerator "grid"
        |TransformTimes 0.25 0.75 WorldBegin WorldEnd""".stripMargin
    )
    val all = Vector(
      scene.camera,
      scene.film,
      scene.sampler,
      scene.filter,
      scene.integrator,
      scene.volumeIntegrator,
      scene.renderer,
      scene.accelerator
    ).flatten
    val names = Vector("perspective", "image", "halton", "box", "path", "single", "sampler", "grid")
    assert(all.map(_.name) == names)
    assert(all.forall(_.folder.path == Path.of("folder")))
    assert(scene.camera.get.param("fov").get.floats.head == 45f)
    assert(scene.camera.get.pos.toString == "test.pbrt:1:8")
    assert(scene.transformTimes == (0.25f, 0.75f))
    assert(scene.dialect == Dialect.V2)

  test("of two statements of one option the last counts"):
    val scene = parse("""Camera "orthographic" Camera "perspective" WorldBegin""")
    assert(scene.camera.map(_.name).contains("perspective"))

  test("later transforms apply first"):
    val scene = world("Translate 1 0 0 Scale 2 2 2 Shape \"sphere\"")
    assert(scene.shapes.head.objectToWorld.start.point(x) == Vec3(3, 0, 0))

  test("matrices are written column by column, with or without brackets"):
    val numbers = "1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1"
    for text <- List(s"[$numbers]", numbers) do
      val statements = s"Transform $text Shape \"a\" ConcatTransform $text Shape \"b\""
      val scene = world(s"Scale 2 2 2 $statements")
      assert(scene.shapes(0).objectToWorld.start == Transform.translate(5, 6, 7))
      assert(scene.shapes(1).objectToWorld.start == Transform.translate(10, 12, 14))

  test("Identity undoes all transforms, WorldBegin as well"):
    assert(world("Scale 2 2 2 Identity Shape \"a\"").shapes.head.objectToWorld.start.isIdentity)
    val scene = parse("Scale 2 2 2 ActiveTransform EndTime WorldBegin Translate 1 0 0 Shape \"a\"")
    assert(scene.shapes.head.objectToWorld.start == Transform.translate(1, 0, 0))
    assert(!scene.shapes.head.objectToWorld.isAnimated)

  test("the camera keeps the transform at its statement, and names its inverse"):
    val scene = parse(
      """LookAt 0 0 5  0 0 0  0 1 0  Camera "perspective" Scale 9 9 9 WorldBegin
        |CoordSysTransform "camera" Shape "a" CoordSysTransform "world" Shape "b" """.stripMargin
    )
    val view = Transform.lookAt(Seq(0, 0, 5), Seq(0, 0, 0), Seq(0, 1, 0)).get
    assert(scene.worldToCamera == GraphicsState.constant(view))
    assert(scene.shapes(0).objectToWorld.start == view.inverse)
    assert(scene.shapes(1).objectToWorld.start.isIdentity)

  test("a coordinate system can be named and used again; an unknown one is warned of"):
    val text = "Scale 2 2 2 CoordinateSystem \"big\" Identity CoordSysTransform \"big\" Shape \"a\""
    assert(world(text).shapes.head.objectToWorld.start.point(x) == Vec3(2, 0, 0))
    val scene = parse(s"WorldBegin CoordinateSystem \"big\" CoordSysTransform \"bog\"")
    assert(scene.warnings.map(_.help) == Vector(Some("did you mean `big`?")))

  test("ActiveTransform says which of the two transforms change"):
    val scene = world(
      """ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 2 0 0
        |ActiveTransform All Scale 3 3 3 Shape "a" """.stripMargin
    )
    val AnimatedTransform(start, end) = scene.shapes.head.objectToWorld
    assert(start.point(x) == Vec3(4, 0, 0))
    assert(end.point(x) == Vec3(5, 0, 0))

  test("AttributeEnd brings back everything"):
    val scene = world(
      """AttributeBegin Translate 1 0 0 Material "matte" AreaLightSource "diffuse"
        |ReverseOrientation MediumInterface "in" "out" ActiveTransform EndTime Shape "a"
        |AttributeEnd Translate 0 1 0 Shape "b" """.stripMargin
    )
    val Vector(a, b) = scene.shapes: @unchecked
    assert(a.areaLight.map(_.name).contains("diffuse") && a.reverseOrientation)
    assert(a.insideMedium == "in" && a.outsideMedium == "out")
    assert(b.material == MaterialRef.Default && b.areaLight.isEmpty && !b.reverseOrientation)
    assert(b.insideMedium == "")
    assert(b.objectToWorld == GraphicsState.constant(Transform.translate(0, 1, 0)))

  test("TransformEnd brings back the transform alone in v2 and v3, everything in v4"):
    val text = "WorldBegin TransformBegin Scale 2 2 2 Material \"\" TransformEnd Shape \"a\""
    for dialect <- Dialect.ofPbrt do
      val shape = parse(text, Some(dialect)).shapes.head
      assert(shape.objectToWorld.start.isIdentity)
      assert((shape.material == MaterialRef.Default) == (dialect == Dialect.V4))
    val recognised = parse(s"Film \"rgb\" $text")
    assert(recognised.dialect == Dialect.V4)
    assert(recognised.shapes.head.material == MaterialRef.Default)

  test("lights, textures and volumes keep the transform"):
    val scene = world(
      """Translate 1 0 0 LightSource "point" Texture "t" "color" "checkerboard"
        |Volume "homogeneous" """.stripMargin
    )
    val moved = GraphicsState.constant(Transform.translate(1, 0, 0))
    assert(scene.lights.head.lightToWorld == moved)
    assert(scene.textures.head.textureToWorld == moved)
    assert(scene.volumes.head.lightToWorld == moved)

  test("`color` textures are spectrum textures"):
    val scene = world("Texture \"a\" \"color\" \"uv\" Texture \"b\" \"float\" \"dots\"")
    assert(scene.textures.map(t => (t.name, t.valueType, t.texture.name)) ==
      Vector(("a", "spectrum", "uv"), ("b", "float", "dots")))

  test("a named material has the class that its \"string type\" says, and no such parameter"):
    val scene = world(
      """MakeNamedMaterial "gold" "string type" "metal" "float roughness" 0.1 NamedMaterial "gold"
        |Shape "a" """.stripMargin
    )
    val (name, material) = scene.namedMaterials.head
    assert(name == "gold" && material.name == "metal" && material.category == "Material")
    assert(material.params.map(_.name) == Vector("roughness"))
    scene.shapes.head.material match
      case MaterialRef.Named("gold", at) => assert(at.line == 2)
      case other => fail(other.toString)

  test("what a name means is settled where it is used, and forgotten at AttributeEnd"):
    val scene = world(
      """Texture "t" "color" "uv"
        |AttributeBegin
        |  Texture "t" "color" "dots" "texture inside" "t"
        |  MakeNamedMaterial "m" "string type" "matte" "texture Kd" "t"
        |  NamedMaterial "m" Shape "a"
        |AttributeEnd
        |AttributeBegin
        |  MakeNamedMaterial "m" "string type" "matte" "texture Kd" "t"
        |  MakeNamedMaterial "x" "string type" "mix" "string namedmaterial1" "m"
        |  NamedMaterial "m" Shape "b"
        |AttributeEnd""".stripMargin
    )
    assert(scene.textures.map(_.name) == Vector("t", "t (2)"))
    assert(scene.textures(1).texture.param("inside").get.strings == Vector("t"))
    val used = scene.namedMaterials.map((name, m) => name -> m.params.map(_.strings.head))
    assert(used == Vector("m" -> Vector("t (2)"), "m (2)" -> Vector("t"), "x" -> Vector("m (2)")))
    val names = scene.shapes.map(_.material).collect { case MaterialRef.Named(name, _) => name }
    assert(names == Vector("m", "m (2)"))

  test("float and spectrum textures share no names; a renamed one takes its twin along"):
    val scene = world(
      """Texture "t" "color" "uv" Texture "t" "float" "dots" Texture "t" "color" "marble"
        |Material "matte" "texture Kd" "t" "texture bump" "t" Shape "a" """.stripMargin
    )
    val all = scene.textures.map(t => (t.name, t.valueType, t.texture.name)).toSet
    assert(all.contains(("t (2)", "spectrum", "marble")))
    assert(all.contains(("t (2)", "float", "dots")))
    val MaterialRef.Inline(material) = scene.shapes.head.material: @unchecked
    assert(material.params.map(_.strings) == Vector(Vector("t (2)"), Vector("t (2)")))

  test("v4 has each name once"):
    val start = "Film \"rgb\" WorldBegin "
    assert(errors(start + "Texture \"t\" \"float\" \"dots\" Texture \"t\" \"float\" \"dots\"") ==
      Vector("float texture \"t\" is already defined"))
    assert(errors(start + "ObjectBegin \"o\" ObjectEnd ObjectBegin \"o\" ObjectEnd") ==
      Vector("object \"o\" is already defined"))

  test("shapes between ObjectBegin and ObjectEnd belong to the object, and instances name it"):
    val scene = world(
      """Scale 2 2 2 ObjectBegin "o" Translate 1 0 0 Shape "a" Shape "b" ObjectEnd
        |Identity Translate 0 0 9 ObjectInstance "o" Shape "c"
        |ObjectBegin "o" Shape "d" ObjectEnd ObjectInstance "o" """.stripMargin
    )
    assert(scene.shapes.map(_.shape.name) == Vector("c"))
    assert(scene.objects.view.mapValues(_.map(_.shape.name)).toMap ==
      Map("o" -> Vector("a", "b"), "o (2)" -> Vector("d")))
    assert(scene.objects("o").head.objectToWorld.start.point(x) == Vec3(4, 0, 0))
    assert(scene.instances.map(_.name) == Vector("o", "o (2)"))
    assert(scene.instances.head.instanceToWorld.start == Transform.translate(0, 0, 9))

  test("Attribute gives parameters to later declarations, which may override them"):
    val scene = world(
      """Attribute "shape" "float radius" 3 "float zmax" 1
        |AttributeBegin Attribute "shape" "float radius" 4 Shape "a" AttributeEnd
        |Shape "b" "float zmax" 2 LightSource "point" """.stripMargin,
      Dialect.V4
    )
    def values(i: Int) =
      scene.shapes(i).shape.params.map(p => (p.name, p.floats.head, p.isDefault)).toSet
    assert(values(0) == Set(("radius", 4f, true), ("zmax", 1f, true)))
    assert(values(1) == Set(("radius", 3f, true), ("zmax", 2f, false)))
    assert(scene.lights.head.light.params.isEmpty)

  test("media and options are kept"):
    val scene = parse(
      """Option "disable-pixel-jitter" true Option "string rendercoordsys" "world"
        |MakeNamedMedium "fog" "string type" "homogeneous" "float scale" 2 WorldBegin""".stripMargin
    )
    assert(scene.options.map(_.name) == Vector("disablepixeljitter", "rendercoordsys"))
    assert(scene.media.map(m => (m.name, m.medium.name, m.medium.params.map(_.name))) ==
      Vector(("fog", "homogeneous", Vector("scale"))))

  test("MediumInterface with one name means it on both sides"):
    val shape = world("MediumInterface \"fog\" Shape \"a\"").shapes.head
    assert(shape.insideMedium == "fog" && shape.outsideMedium == "fog")

  test("an area light without name, and Material \"\", are kept as written"):
    val scene = world("AreaLightSource \"area\" AreaLightSource \"\" Material \"\" Shape \"a\"")
    assert(scene.shapes.head.areaLight.isEmpty)
    val MaterialRef.Inline(material) = scene.shapes.head.material: @unchecked
    assert(material.name == "")

  test("a statement on the wrong side of WorldBegin stops v4, and is ignored with a warning else"):
    val text = "Shape \"a\" WorldBegin Camera \"perspective\" Shape \"b\""
    val scene = parse(s"$text WorldEnd")
    assert(scene.shapes.map(_.shape.name) == Vector("b") && scene.camera.isEmpty)
    assert(scene.warnings.map(_.message.takeWhile(_ != ' ')) == Vector("Shape", "Camera"))
    assert(errors(s"Film \"rgb\" $text").size == 2)

  test("statements after WorldEnd are ignored with a warning"):
    val scene = parse("WorldBegin Shape \"a\" WorldEnd Film \"image\" AttributeEnd")
    assert(scene.shapes.size == 1 && !scene.isFollowed)
    assert(scene.warnings.map(_.message) == Vector("statements after WorldEnd are ignored"))

  test("another world after WorldEnd is another scene, with what v2 and v3 keep of the first"):
    val world = "WorldBegin Shape \"a\" WorldEnd\n"
    val text = "Film \"image\" Texture \"t\" \"float\" \"constant\"" + world +
      "Sampler \"random\" WorldBegin Shape \"b\" Shape \"c\" WorldEnd\n" + world
    def read(prefix: String, n: Int) =
      val folder = java.nio.file.Path.of("")
      Parser.parseText("test.pbrt", prefix + text, folder, None, keepGoing = false, world = n)
    for (prefix, keeps) <- Seq("Integrator \"path\"" -> false, "Renderer \"sampler\"" -> true) do
      val worlds = Vector.tabulate(3)(read(prefix, _))
      assert(worlds.map(_.shapes.size) == Vector(1, 2, 1))
      assert(worlds.map(_.isFollowed) == Vector(true, true, false))
      assert(worlds.map(_.film.isDefined) == Vector(true, keeps, keeps))
      assert(worlds.map(_.sampler.isDefined) == Vector(false, true, keeps))
      // Only the first has the misplaced texture
      assert(worlds.map(_.warnings.size) == Vector(1, 0, 0))
