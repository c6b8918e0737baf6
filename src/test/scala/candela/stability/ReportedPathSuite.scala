package candela.stability

import java.nio.file.{Files, Path}

import scala.collection.mutable.ArrayBuffer

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.integrators.LitPlane
import candela.render.{Renderer, TinyPlan}
import candela.scene.PathReport
import candela.scenefile.Dialect
import candela.scenefile.Dialect.{V3, V4}
import candela.settings.{RenderRegion, RenderSettings}
import candela.testing.SceneTexts

/** What is no number never reaches the film, and one can see where it is from. */
class ReportedPathSuite extends AnyFunSuite:
  private val emitter = """LightSource "point" "point from" [0 0 2] "rgb I" [8 8 8]"""

  private val ball = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [8 8 8]
    Translate 0 0 2
    Shape "sphere" "float radius" .8
    AttributeEnd"""

  test("the path of one sample is told, and is the one that is rendered"):
    for integrator <- Seq("\"path\"", "\"whitted\"", "\"directlighting\"", "\"volpath\"") do
      val plan = SceneTexts.plan(LitPlane.scene(integrator, spp = 1, emitter))
      val lines = ArrayBuffer.empty[String]
      val light = Renderer.trace(plan, 2, 1, 0, PathReport(line => lines += line))
      val image = Renderer.render(plan, threads = 1).film.toImage(1f)
      val at = 3 * (1 * plan.width + 2)
      assert(light.contains(Rgb(image.data(at), image.data(at + 1), image.data(at + 2))))
      val told = lines.mkString("\n")
      for words <- Seq("1: point (", "Lambert", "light 0 is sampled", "f rgb(", "pdf") do
        assert(told.contains(words), s"$integrator: $told"): Unit

  test("where glass splits light, all samples told are those that are rendered", Slow):
    val file = Path.of("scenes/v4-dispersion.pbrt")
    for regularize <- Seq(false, true) do
      val text = Files.readString(file).replace("pixelsamples\" 16", "pixelsamples\" 1")
        .replace("\"path\"", s"\"path\" \"bool regularize\" $regularize")
      val plan = SceneTexts.plan(text, Dialect.V4)
      val image = Renderer.render(plan, threads = 1).film.toImage(1f)
      val different =
        for
          y <- 0 until plan.height
          x <- 0 until plan.width
          at = 3 * (y * plan.width + x)
          rendered = Rgb(image.data(at), image.data(at + 1), image.data(at + 2))
          if !Renderer.trace(plan, x, y, 0, PathReport(_ => ())).contains(rendered)
        yield (x, y)
      assert(different.isEmpty)

  test("so it is where light paths are joined to it"):
    // A pixel by itself: few splats come to it
    val pixels = for y <- 0 until 4; x <- 0 until 4 yield (x, y)
    val same = pixels.count: (x, y) =>
      val window = RenderRegion.Window(x / 4f, (x + 1) / 4f, y / 4f, (y + 1) / 4f)
      val text = LitPlane.scene("\"bdpt\"", spp = 1, ball)
      val plan = SceneTexts.plan(text, options = RenderSettings(region = window))
      val image = Renderer.render(plan, threads = 1).film.toImage(1f)
      Renderer.trace(plan, x, y, 0, PathReport(_ => ())).contains(
        Rgb(image.data(0), image.data(1), image.data(2))
      )
    assert(same > 10, s"$same of ${pixels.size}")

  /** A ball on a floor, in few pixels. */
  private def onFloor(dialect: Dialect, integrator: String, material: String): String =
    val (film, p, floor) =
      if dialect == Dialect.V4 then ("rgb", "point3", "diffuse") else ("image", "point", "matte")
    s"""LookAt 0 -4 1.5  0 0 0  0 0 1
       |Camera "perspective" "float fov" 35
       |Film "$film" "integer xresolution" 8 "integer yresolution" 8
       |PixelFilter "box"
       |Sampler "halton" "integer pixelsamples" 1
       |Integrator $integrator
       |WorldBegin
       |LightSource "infinite" "rgb L" [.4 .5 .6]
       |LightSource "point" "$p from" [2 -2 3] "rgb I" [9 8 7]
       |Material "$floor"
       |Shape "disk" "float height" -1 "float radius" 9
       |$material
       |Shape "sphere"
       |""".stripMargin

  private val mixed = Seq(
    """MakeNamedMaterial "a" "string type" "dielectric" "spectrum eta" "glass-F11"""",
    """MakeNamedMaterial "b" "string type" "conductor"""",
    """Material "mix" "string materials" ["a" "b"]"""
  ).mkString("\n")

  /** Scenes, and what the report of their paths must name. */
  private val reports: Seq[(Dialect, String, String, String)] = Seq(
    (V3, "\"path\"", "Material \"glass\" \"float uroughness\" .2", "RoughDielectric"),
    (V3, "\"path\"", "Material \"uber\" \"rgb opacity\" [.5 .6 .7]", "Lobes"),
    (V3, "\"path\"", "Material \"subsurface\" \"float scale\" 9", "SmoothDielectric"),
    (V3, "\"directlighting\"", "Material \"mirror\"", "Mirror"),
    (V3, "\"volpath\"", "Material \"plastic\"", "Lobes"),
    (V4, "\"path\"", "Material \"dielectric\" \"spectrum eta\" \"glass-F11\"", " nm: "),
    (V4, "\"path\"", mixed, " nm: "),
    (V4, "\"path\" \"bool regularize\" true", "Material \"coatedconductor\"", "regularized: "),
    (V4, "\"volpath\" \"bool regularize\" true", "Material \"conductor\"", "regularized: "),
    (V4, "\"volpath\"", "Material \"interface\"", "Lambert")
  )

  for (dialect, integrator, material, words) <- reports do
    val last = material.linesIterator.toVector.last
    test(s"each path is told as it is rendered: $integrator of $dialect, $last"):
      val plan = SceneTexts.plan(onFloor(dialect, integrator, material), dialect)
      val image = Renderer.render(plan, threads = 1).film.toImage(1f)
      val lines = ArrayBuffer.empty[String]
      for y <- 0 until plan.height; x <- 0 until plan.width do
        val light = Renderer.trace(plan, x, y, 0, PathReport(line => lines += line))
        val rendered = Rgb(image(x, y, 0), image(x, y, 1), image(x, y, 2))
        assert(light.contains(rendered), s"at $x, $y")
      assert(lines.exists(_.contains(words)), lines.mkString("\n"))

  test("so it is through panes, which Mitsuba's light passes"):
    val floor = onFloor(V4, "\"volpath\" \"integer maxdepth\" 3", "Material \"thindielectric\"")
      .replace("Shape \"sphere\"", "Translate 0 0 1 Shape \"disk\" \"float radius\" 2")
    val scene = SceneTexts.parse(floor, V4).copy(dialect = Dialect.Mitsuba)
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    val image = Renderer.render(plan, threads = 1).film.toImage(1f)
    val lines = ArrayBuffer.empty[String]
    for y <- 0 until plan.height; x <- 0 until plan.width do
      val light = Renderer.trace(plan, x, y, 0, PathReport(line => lines += line))
      assert(light.contains(Rgb(image(x, y, 0), image(x, y, 1), image(x, y, 2))), s"at $x, $y")
    assert(lines.exists(_.contains("thin dielectric at")), lines.mkString("\n"))

  test("a sample that is no number is none, and the first one is named with its material"):
    val bad = Seq(Float.NaN, Float.PositiveInfinity, Float.NegativeInfinity)
    for value <- bad do
      val plan = TinyPlan(width = 8, height = 8, spp = 4): (where, _) =>
        if where.x == 5 && where.y == 2 && where.sample == 3 then Rgb(1f, value, 1f) else Rgb.White
      assert(Renderer.trace(plan, 5, 2, 3, PathReport(_ => ())).isEmpty)
      assert(Renderer.trace(plan, 5, 2, 2, PathReport(_ => ())).contains(Rgb.White))
      val rendering = Renderer.render(plan, threads = 2)
      assert(rendering.discarded.exists(r => (r.count, r.x, r.y, r.sample) == (1L, 5, 2, 3)))
      assert(rendering.film.toImage(1f).data.forall(_ == 1f))
