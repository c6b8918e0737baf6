package candela.build.film

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.aov.Layer
import candela.build.SceneBuilder
import candela.diagnostics.Code
import candela.image.Image
import candela.render.{RenderPlan, Renderer}
import candela.scenefile.{Dialect, Parser}
import candela.settings.{ColorMode, LightGrouping, RenderSettings}
import candela.testing.{SceneTexts, TempFolder}

/** Layers of divided light, of whole scenes. */
final class LightLayersSuite extends AnyFunSuite:
  private val byWay = Vector(Layer.Emission, Layer.Background, Layer.Direct, Layer.Indirect)
  private val all = RenderSettings(layers = byWay :+ Layer.Lights)

  private def image(plan: RenderPlan): Image =
    Renderer.render(plan, threads = 2).image(plan.development)

  /** A box with emitters of four kinds; glass and glossy surfaces scatter their light. */
  private def box(integrator: String, more: String = "") = s"""$integrator
    LookAt 0 0 -4  0 0 0  0 1 0
    Camera "perspective" "float fov" 60
    Sampler "independent" "integer pixelsamples" 4
    PixelFilter "box"
    Film "rgb" "integer xresolution" 20 "integer yresolution" 20 "float iso" 150
    WorldBegin
    LightSource "infinite" "rgb L" [.2 .3 .5]
    LightSource "infinite" "rgb L" [.1 .1 0]
    LightSource "point" "point3 from" [-1 2 -2] "rgb I" [4 1 1]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [1 5 2]
      Translate 1.2 1 0
      Shape "sphere" "float radius" .3
    AttributeEnd
    AttributeBegin
      Translate 0 0 2
      Material "diffuse" "rgb reflectance" [.8 .6 .4]
      Shape "disk" "float radius" 1.8
    AttributeEnd
    AttributeBegin
      Translate -.8 -.6 0
      Material "dielectric"
      Shape "sphere" "float radius" .5
    AttributeEnd
    AttributeBegin
      Translate .6 -.6 0
      Material "coateddiffuse" "float roughness" .1
      Shape "sphere" "float radius" .5
    AttributeEnd
    $more"""

  private val path = "Integrator \"path\" \"integer maxdepth\" 8"

  /** Fog that emits light around everything. */
  private val fog = """MakeNamedMedium "fog" "string type" "homogeneous"
    "rgb sigma_s" [.1 .1 .2] "rgb sigma_a" [.1 .2 .1] "rgb Le" [.5 .2 .1]
    AttributeBegin
      Material "interface"
      MediumInterface "fog" ""
      Shape "sphere" "float radius" 2.5
    AttributeEnd"""

  private def channel(image: Image, name: String): Vector[Float] =
    val c = image.channelNames.indexOf(name)
    require(c >= 0, s"$name in ${image.channelNames}")
    Vector.tabulate(image.width * image.height)(i => image.data(i * image.channels + c))

  private def sum(image: Image, layers: Seq[String], c: String): Vector[Double] =
    layers.map(l => channel(image, s"$l.$c").map(_.toDouble)).transpose.map(_.sum).toVector

  private def groups(image: Image): Seq[String] =
    image.channelNames.collect { case s"Combined_$name.R" => s"Combined_$name" }

  private def assertDivided(image: Image, clue: String): Unit =
    for
      (layers, what) <- Seq(byWay.map(_.channels.head.stripSuffix(".R")) -> "ways") :+
        groups(image) -> "groups"
      c <- Seq("R", "G", "B")
    do
      val whole = channel(image, c)
      // Rounding of each event's light: far below a thousandth of the brightest
      val most = 1e-5f * whole.map(Math.abs).max
      val off = whole.lazyZip(sum(image, layers, c)).map((a, b) => Math.abs(a - b)).max
      assert(off <= most, s"$clue, $what, $c: $off of ${whole.max}")

  test("emission, background, direct and indirect light add up to the image; so do light groups"):
    val media = path.replace("\"path\"", "\"volpath\"")
    for
      (name, text) <- Seq("path" -> box(path), "volpath" -> box(media, fog))
      color <- Seq(ColorMode.Rgb, ColorMode.Spectral)
    do
      val found = image(SceneTexts.plan(text, Dialect.V4, all.copy(color = color)))
      assertDivided(found, s"$name, $color")
      for layer <- byWay do
        assert(channel(found, layer.channels.head).exists(_ > 0.01f), s"$name: $layer")

  test("so it is in scenes of all dialects"):
    for
      name <- Vector(
        "v2-volumes",
        "v3-subsurface",
        "v4-dispersion",
        "v4-media-emission",
        "v4-sensor",
        "v4-color-spaces"
      )
    do
      val read = Parser.parse(Path.of("scenes", s"$name.pbrt"))
      val isOld = read.dialect == Dialect.V2
      val integrator = read.integrator.map(d => if isOld then d.copy(name = "path") else d)
      val scene = read.copy(integrator = integrator)
      val options = all.copy(samples = Some(1), quick = true)
      assertDivided(image(SceneBuilder.build(scene, options)._1), name)

  test("divided light leaves the image as it is"):
    for integrator <- Seq(path, path.replace("\"path\"", "\"volpath\"")) do
      val plain = image(SceneTexts.plan(box(integrator, fog), Dialect.V4))
      val divided = image(SceneTexts.plan(box(integrator, fog), Dialect.V4, all))
      for c <- Seq("R", "G", "B") do assert(channel(plain, c) == channel(divided, c))

  test("direct light is that of paths with one scattering event"):
    val long = image(SceneTexts.plan(box(path), Dialect.V4, all))
    val short = image(SceneTexts.plan(box(path.replace("8", "1")), Dialect.V4))
    for c <- Seq("R", "G", "B") do
      val once = sum(long, Seq("Emission", "Background", "Direct"), c)
      val off = once.lazyZip(channel(short, c)).map((a, b) => Math.abs(a - b)).max
      assert(off < 1e-4, c)

  test("a light's group is the image of that light alone"):
    val found = image(SceneTexts.plan(box(path), Dialect.V4, all.copy(samples = Some(256))))
    val dark = box(path).replaceAll("LightSource \"infinite\".*", "")
      .replaceAll("AreaLightSource.*", "")
    val alone = image(SceneTexts.plan(dark, Dialect.V4, RenderSettings(samples = Some(256))))
    val point = groups(found).find(_.startsWith("Combined_point")).get
    for c <- Seq("R", "G", "B") do
      val (group, whole) = (channel(found, s"$point.$c").sum, channel(alone, c).sum)
      // Noise of the mean of 400 pixels with 256 samples
      assert(whole > 0.5f && Math.abs(group - whole) < 0.03f * whole, s"$c: $group, $whole")

  private def names(grouping: LightGrouping, text: String = box(path)): Vector[String] =
    val options = RenderSettings(layers = Vector(Layer.Lights), lightGroups = Some(grouping))
    SceneTexts.plan(text, Dialect.V4, options).layers.get.groups.get

  test("groups are statements by type and line, types, or as named; others are the default"):
    import LightGrouping.*
    assert(names(Statements) == Vector("diffuse_12", "infinite_8", "infinite_9", "point_10"))
    assert(names(Types) == Vector("diffuse", "infinite", "point"))
    val named = Named(Vector("sky" -> Vector("infinite"), "key" -> Vector("point_10")))
    assert(names(named) == Vector("default", "sky", "key"))
    val first = Named(Vector("sky" -> Vector("infinite"), "second" -> Vector("infinite_9")))
    assert(names(first) == Vector("default", "sky", "second"))

  test("two lights on a line are told apart by their columns, and media are a group"):
    val two = "LightSource \"point\" LightSource \"point\""
    val line = s"WorldBegin $two"
    assert(names(LightGrouping.Statements, line) == Vector("point_1_24", "point_1_44"))
    val foggy = s"Integrator \"volpath\" $line\n$fog"
    assert(names(LightGrouping.Types, foggy) == Vector("point", "media"))

  test("two lights at the same place of two files are told apart by their files"):
    TempFolder.use: folder =>
      for name <- Seq("lamps-1", "lamps-2") do
        val _ = Files.writeString(folder.resolve(s"$name.pbrt"), "LightSource \"point\"")
      val text = "WorldBegin Include \"lamps-1.pbrt\" Include \"lamps-2.pbrt\" " +
        "Include \"lamps-1.pbrt\""
      val scene = SceneTexts.parse(text, Dialect.V4, folder)
      val found = SceneBuilder.build(scene, RenderSettings(layers = Vector(Layer.Lights)))._1
      val names = found.layers.get.groups.get
      assert(names == Vector("point_lamps_1_1_13", "point_lamps_2_1_13"))

  test("unknown lights, too many groups and integrators that do not divide light are errors"):
    def problems(text: String, grouping: LightGrouping, layer: Layer = Layer.Lights) =
      val options = RenderSettings(layers = Vector(layer), lightGroups = Some(grouping))
      SceneTexts.problems(text, Dialect.V4, options = options)
        .filter(_.code != Code.UnlikePbrt)
        .map(p => p.message + p.help.fold("")(h => s" ($h)"))
    val wrong = LightGrouping.Named(Vector("key" -> Vector("point_11")))
    assert(problems(box(path), wrong) ==
      Vector("--light-groups: no light `point_11` (did you mean `point_10`?)"))
    val taken = LightGrouping.Named(Vector("a" -> Vector("point_10"), "b" -> Vector("point")))
    assert(problems(box(path), taken) ==
      Vector("--light-groups: `b` gets no light, as other groups name its lights"))
    val many = "WorldBegin\n" + "LightSource \"point\"\n" * 101
    assert(problems(many, LightGrouping.Statements).head.startsWith(
      "the scene has 101 light groups, more than 100 (--light-groups type"
    ))
    assert(problems(many, LightGrouping.Types).isEmpty)
    for integrator <- Vector("bdpt", "sppm", "ambientocclusion") do
      val text = box(s"Integrator \"$integrator\"")
      assert(
        problems(text, LightGrouping.Types, Layer.Direct) == Vector(
          "this integrator does not separate light: AOVs direct need \"path\" or \"volpath\""
        ),
        integrator
      )
      assert(problems(text, LightGrouping.Types, Layer.Emission).isEmpty)
