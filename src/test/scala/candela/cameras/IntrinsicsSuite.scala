package candela.cameras

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.build.SceneBuilder
import candela.mitsuba.MitsubaScene
import candela.render.{RenderPlan, Renderer}
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import java.nio.file.Files

/** The formulas of docs/INTRINSICS.md: emitters at known places appear in the right pixels. */
final class IntrinsicsSuite extends AnyFunSuite:
  private val (width, height) = (64, 48)
  private val (cx, cy) = (40.0, 18.0)

  /** Right, down and forward of the camera. */
  private val points = Seq((0.0, 0.0, 4.0), (1.0, 1.2, 5.0), (-2.0, 0.5, 6.0), (-1.2, -0.6, 4.0))

  private def window(fx: Double, fy: Double): String =
    s"${-cx / fx} ${(width - cx) / fx} ${(cy - height) / fy} ${cy / fy}"

  /** Mean place of the light, in pixels from the upper left corner. */
  private def centre(plan: RenderPlan): (Double, Double) =
    val image = Renderer.render(plan, threads = 1).image(plan.development)
    var (sum, x, y) = (0.0, 0.0, 0.0)
    for j <- 0 until image.height; i <- 0 until image.width do
      val light = image(i, j, 0).toDouble
      sum += light
      x += light * (i + 0.5)
      y += light * (j + 0.5)
    (x / sum, y / sum)

  private def near(found: (Double, Double), x: Double, y: Double): Assertion =
    // An emitter is a disk of 3 pixels, sampled at 16 places per pixel
    assert(Math.abs(found._1 - x) < 0.1 && Math.abs(found._2 - y) < 0.1, s"$found, not $x $y")

  for dialect <- Seq(Dialect.V2, Dialect.V3, Dialect.V4) do
    test(s"focal lengths and principal point in pixels are a screen window of $dialect"):
      val (fx, fy) = (60.0, 52.0)
      val isV4 = dialect == Dialect.V4
      for (x, y, z) <- points do
        val film = if isV4 then "rgb" else "image"
        val black =
          if dialect == Dialect.V2 then "\"matte\" \"color Kd\" [0 0 0]"
          else if isV4 then "\"diffuse\" \"rgb reflectance\" [0 0 0]"
          else "\"matte\" \"rgb Kd\" [0 0 0]"
        val text =
          s"""Camera "perspective" "float fov" 90 "float screenwindow" [${window(fx, fy)}]
             |Film "$film" "integer xresolution" $width "integer yresolution" $height
             |Sampler "halton" "integer pixelsamples" 16
             |PixelFilter "box"
             |WorldBegin
             |AreaLightSource "diffuse"
             |Material $black
             |Translate $x ${-y} $z
             |Shape "sphere" "float radius" .1
             |""".stripMargin
        near(centre(SceneTexts.plan(text, dialect)), fx * x / z + cx, fy * y / z + cy)

  test("a pose of computer vision is a transform with its second row turned"):
    val (fx, fy) = (60.0, 52.0)
    val (s, c) = (0.6, 0.8)
    val r = Seq(Seq(c, 0.0, s), Seq(s * s, c, -s * c), Seq(-s * c, s, c * c)) // about y, then x
    val t = Seq(0.3, -0.2, 1.0)
    val turned = Seq(1, -1, 1)
    val columns =
      (0 until 3).map(j => (0 until 3).map(i => turned(i) * r(i)(j)) :+ 0.0) :+
        ((0 until 3).map(i => turned(i) * t(i)) :+ 1.0)
    for (x, y, z) <- points do
      val d = Seq(x - t(0), y - t(1), z - t(2))
      val world = (0 until 3).map(j => (0 until 3).map(i => r(i)(j) * d(i)).sum)
      val text =
        s"""Transform [${columns.flatten.mkString(" ")}]
           |Camera "perspective" "float fov" 90
           |  "float screenwindow" [${window(fx, fy)}]
           |Film "rgb" "integer xresolution" $width "integer yresolution" $height
           |Sampler "halton" "integer pixelsamples" 16
           |PixelFilter "box"
           |WorldBegin
           |AreaLightSource "diffuse"
           |Material "diffuse" "rgb reflectance" [0 0 0]
           |Translate ${world.mkString(" ")}
           |Shape "sphere" "float radius" .1
           |""".stripMargin
      near(centre(SceneTexts.plan(text, Dialect.V4)), fx * x / z + cx, fy * y / z + cy)

  test("Mitsuba's field of view follows from the focal length, without an offset"):
    val f = 60.0
    val fov = Math.toDegrees(2 * Math.atan(width / (2 * f)))
    for (x, y, z) <- points do
      // Mitsuba's x points left
      val file = Files.createTempFile("candela-intrinsics", ".xml")
      Files.writeString(
        file,
        s"""<scene version="3.0.0"><integrator type="path"/><sensor type="perspective">
           |<string name="fov_axis" value="x"/><float name="fov" value="$fov"/>
           |<film type="hdrfilm"><integer name="width" value="$width"/>
           |<integer name="height" value="$height"/><rfilter type="box"/></film>
           |<sampler type="independent"><integer name="sample_count" value="16"/></sampler></sensor>
           |<shape type="sphere"><point name="center" x="${-x}" y="${-y}" z="$z"/>
           |<float name="radius" value="0.1"/>
           |<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
           |</scene>""".stripMargin
      )
      val scene =
        try MitsubaScene.readable(file, Map.empty, keepGoing = false)
        finally Files.delete(file)
      val plan = SceneBuilder.build(scene, RenderSettings())._1
      near(centre(plan), f * x / z + width / 2.0, f * y / z + height / 2.0)
