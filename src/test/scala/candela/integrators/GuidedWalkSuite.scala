package candela.integrators

import candela.film.Fireflies
import candela.guiding.GuidingMode
import candela.image.Image
import candela.render.{RenderControl, Cancellation, Renderer, RenderListener, RenderPlan}
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.{Blocks, FileKeeper, SceneTexts}

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

@org.scalatest.tags.Slow
final class GuidedWalkSuite extends AnyFunSuite:
  import GuidedWalkSuite.*

  private def plan(
      text: String,
      dialect: Dialect,
      mode: GuidingMode,
      spp: Int,
      seed: Int = 0,
      fireflies: Fireflies = Fireflies.Kept
  ): RenderPlan =
    val options =
      RenderSettings(Some(spp), seed, guiding = Some(mode), fireflies = fireflies)
    SceneTexts.plan(text, dialect, options)

  private def image(plan: RenderPlan, threads: Int = 1): Image =
    Renderer.render(plan, threads).image(plan.development)

  for
    dialect <- Vector(Dialect.V3, Dialect.V4)
    fog <- Vector("", Fog)
  do
    val where = s"in $dialect" + (if fog.isEmpty then "" else ", in fog")
    test(s"guided images have the mean of unguided ones in every 8 × 8 block, $where"):
      def blocks(mode: GuidingMode): Vector[Vector[Double]] =
        Vector.tabulate(Seeds)(seed =>
          Blocks.ofEight(image(plan(rooms(dialect, fog), dialect, mode, 16, seed)))
        )
      val (guided, unguided) = (blocks(GuidingMode.On), blocks(GuidingMode.Off))
      val scores = guided.transpose.zip(unguided.transpose).map(Blocks.score)
      // Of 48 normal numbers one is beyond 4.5 in 3000 runs; the root of their mean square has a
      // deviation of 0.1
      assert(scores.forall(_.abs < 4.5), scores)
      assert(Math.sqrt(scores.map(z => z * z).sum / scores.size) < 1.4, scores)

  /** The mean of some renderings. */
  private def mean(text: String, mode: GuidingMode): Double =
    val all = Vector.tabulate(4): seed =>
      val data = image(plan(text, Dialect.V4, mode, 128, seed), threads = 2).data
      data.map(_.toDouble).sum / data.length
    all.sum / all.size

  test("paths that divide in fog find as much light as unguided ones"):
    // More samples than above: with few, the field knows too little of the fog for paths to divide
    val text = rooms(Dialect.V4, Fog)
    val ratio = mean(text, GuidingMode.On) / mean(text, GuidingMode.Off)
    // 4 · 128 · 1024 paths, that deviate by up to five times the mean: 0.7 % each
    assert(Math.abs(ratio - 1.0) < 0.02, ratio)

  test("inside a glowing sphere guided paths see the light of all bounces"):
    val made = plan(Oven, Dialect.V4, GuidingMode.On, 256)
    val data = image(made).data
    val seen = data.map(_.toDouble).sum / data.length
    // 1 / (1 − 0.7), without what is left after 30 bounces
    assert(Math.abs(seen - 1.0 / 0.3) < 0.02 / 0.3)

  test("fog inside a glowing sphere can't be seen by guided paths"):
    val medium = Fog.replace("sigma_a\" [.05 .05 .1]", "sigma_a\" [0 0 0]")
    val oven = Oven.replace(".7 .7 .7", "0 0 0")
    assert(medium != Fog && oven != Oven)
    val made = plan(inFog(oven, medium).replace("30", "300"), Dialect.V4, GuidingMode.On, 256)
    val data = image(made).data
    val seen = data.map(_.toDouble).sum / data.length
    // 16,384 paths, whose weights deviate by less than 1: below 0.8 %
    assert(Math.abs(seen - 1.0) < 0.01)

  test("guided images are the same for any number of threads"):
    for (mode, fog) <- Vector((GuidingMode.On, ""), (GuidingMode.Auto, ""), (GuidingMode.Auto, Fog))
    do
      def pixels(threads: Int) =
        // As many paths as may learn
        val made = plan(rooms(Dialect.V4, fog), Dialect.V4, mode, 128)
        val rendering = Renderer.render(made, threads)
        val data = rendering.film.toImage(1f).data.toVector
        (data, rendering.learned)
      val one = pixels(1)
      assert(one._2.exists(_.guided > 0))
      assert(pixels(3) == one)

  test("guiding that pays goes on, and that which does not is given up"):
    def learned(text: String, spp: Int, fireflies: Fireflies = Fireflies.Kept) =
      val made = plan(text, Dialect.V4, GuidingMode.Auto, spp, fireflies = fireflies)
      Renderer.render(made, threads = 2).learned.get
    val rooms = learned(GuidedWalkSuite.rooms(Dialect.V4), 256)
    assert(!rooms.gaveUp && rooms.samples == 64)
    assert(rooms.varianceRatio.exists(_ < 0.8), rooms)
    assert(rooms.share > 0.2 && rooms.share < 1.0, rooms)
    assert(rooms.weight > 1f, rooms)
    assert(rooms.regions > 4 && rooms.lobes > rooms.regions)
    // Which counts samples: all must count the same
    val counted = learned(GuidedWalkSuite.rooms(Dialect.V4), 256, Fireflies.Reweighted)
    assert(!counted.gaveUp && counted.weight == 1f, counted)
    // In the sphere all directions are equal
    val oven = learned(Oven, 2048)
    assert(oven.gaveUp && oven.regions == 0, oven)
    assert(oven.share < 0.3 && oven.weight == 1f, oven)

  test("a guided rendering that is interrupted is continued to the same bytes"):
    val All = 48
    val folder = Files.createTempDirectory("candela-guided")
    val (whole, parts) = (folder.resolve("whole"), folder.resolve("parts"))
    def render(from: Option[Path], to: Path, cancels: Boolean): Int =
      val cancellation = Cancellation()
      Renderer
        .render(
          plan(rooms(Dialect.V4), Dialect.V4, GuidingMode.On, All),
          RenderControl(
            threads = 2,
            cancellation,
            RenderListener.onProgress(_ => if cancels then cancellation.request()),
            checkpointer = Some(FileKeeper(from, to))
          )
        )
        .samplesDone
    assert(render(None, whole, cancels = false) == All)
    var runs = 0
    var done = 0
    while done < All do
      done = render(Option.when(runs > 0)(parts), parts, cancels = true)
      runs += 1
      // Each run takes a sample of a tile at least, also where it first learns for long
      require(runs < All * 4, s"$done samples after $runs runs")
    assert(runs > 2)
    assert(Files.readAllBytes(parts).sameElements(Files.readAllBytes(whole)))
    for file <- Vector(whole, parts, folder) do Files.delete(file)

private object GuidedWalkSuite:
  val Seeds = 64

  /** A box divided by a wall with a gap; the emitter is behind it. Spheres are matte,
    * rough metal, coated and of glass.
    */
  def rooms(dialect: Dialect, fog: String = ""): String =
    val isV4 = dialect == Dialect.V4
    def material(v4: String, v3: String) = s"Material ${if isV4 then v4 else v3}"
    val white = material(
      """"diffuse" "rgb reflectance" [.7 .7 .7]""",
      """"matte" "rgb Kd" [.7 .7 .7]"""
    )
    val point = if isV4 then "point3" else "point"
    def quad(points: String) =
      s"""Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "$point P" [$points]"""
    val text = s"""LookAt 0 -.9 .5  .1 0 .4  0 0 1
       |Camera "perspective" "float fov" 70
       |Film "${if isV4 then "rgb" else "image"}" "integer xresolution" 32 "integer yresolution" 32
       |PixelFilter "box"
       |Sampler "${if isV4 then "independent" else "random"}" "integer pixelsamples" 16
       |Integrator "path" "integer maxdepth" 8
       |WorldBegin
       |$white
       |${quad("-1 -1 0  1 -1 0  1 2 0  -1 2 0")}
       |${quad("-1 -1 1  1 -1 1  1 2 1  -1 2 1")}
       |${quad("-1 -1 0  1 -1 0  1 -1 1  -1 -1 1")}
       |${quad("-1 2 0  1 2 0  1 2 1  -1 2 1")}
       |${quad("-1 -1 0  -1 2 0  -1 2 1  -1 -1 1")}
       |${quad("1 -1 0  1 2 0  1 2 1  1 -1 1")}
       |${quad("-.5 1 0  1 1 0  1 1 1  -.5 1 1")}
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [9 8 7]
       |Translate .4 1.5 .6
       |Shape "sphere" "float radius" .25
       |AttributeEnd
       |AttributeBegin
       |${material(
        """"conductor" "float roughness" .2""",
        """"metal" "float roughness" .2 "bool remaproughness" "false""""
      )}
       |Translate -.4 .2 .25
       |Shape "sphere" "float radius" .25
       |AttributeEnd
       |AttributeBegin
       |${material(
        """"coateddiffuse" "rgb reflectance" [.2 .6 .3] "float roughness" .1""",
        """"plastic" "rgb Kd" [.2 .6 .3] "float roughness" .1"""
      )}
       |Translate .2 .2 .25
       |Shape "sphere" "float radius" .25
       |AttributeEnd
       |AttributeBegin
       |${material(""""dielectric" "float roughness" .2""", """"glass"""")}
       |Translate .7 .3 .25
       |Shape "sphere" "float radius" .2
       |AttributeEnd
       |${if isV4 then "" else "WorldEnd"}
       |""".stripMargin
    if fog.isEmpty then text else inFog(text, fog)

  /** Grey but for what it absorbs. */
  val Fog: String =
    """"string type" "homogeneous" "rgb sigma_s" [.6 .6 .6] "rgb sigma_a" [.05 .05 .1]
      | "float g" .5""".stripMargin.replace("\n", "")

  /** The scene with a medium around the camera. */
  def inFog(text: String, fog: String): String =
    val medium = s"""MakeNamedMedium "fog" $fog\nMediumInterface "" "fog"\nCamera"""
    text.replace("Camera", medium).replace("\"path\"", "\"volpath\"")

  /** From inside, a sphere that emits radiance 1 inwards. */
  val Oven: String =
    s"""Camera "perspective"
       |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "independent" "integer pixelsamples" 256
       |Integrator "path" "integer maxdepth" 30
       |WorldBegin
       |Material "diffuse" "rgb reflectance" [.7 .7 .7]
       |AreaLightSource "diffuse" "rgb L" [1 1 1]
       |ReverseOrientation
       |Shape "sphere"
       |""".stripMargin
