package candela.build.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

class RectanglesSuite extends AnyFunSuite:
  private def lights(shape: String, light: String = "", dialect: Dialect = Dialect.V4): String =
    val text =
      s"""Camera "perspective" WorldBegin
         |AreaLightSource "diffuse" $light
         |$shape""".stripMargin
    SceneTexts.plan(text, dialect).features.toMap.apply("lights")

  private def mesh(points: String, indices: String = "0 1 2 0 2 3", more: String = "") =
    s"""Shape "trianglemesh" "point3 P" [ $points ] "integer indices" [ $indices ] $more"""

  private val square = "0 0 0  1 0 0  1 2 0  0 2 0"

  test("two triangles that form a rectangle are one light, turned and moved, too"):
    assert(lights(mesh(square)) == "one light")
    assert(lights(mesh(square, "2 3 0 1 2 0")) == "one light")
    val turned = "Translate 3 0.1 7 Rotate 33 1 2 3 Scale 0.3 0.3 0.3 " + mesh(square)
    assert(lights(turned) == "one light")
    val apart = "0 0 0  1 0 0  1 2 0  0 0 0  1 2 0  0 2 0"
    assert(lights(mesh(apart, "0 1 2 3 4 5")) == "one light")

  test("four triangles of two rectangles are two lights"):
    val points = square + "  5 0 0  6 0 0  6 2 0  5 2 0"
    assert(lights(mesh(points, "0 1 2 0 2 3 4 5 6 4 6 7")).startsWith("2 lights"))

  test("other triangles keep their own lights"):
    def areTwo(shape: String, light: String = "") =
      assert(lights(shape, light).startsWith("2 lights"), shape)
    areTwo(mesh("0 0 0  1 0 0  1.5 2 0  0.5 2 0")) // sheared
    areTwo(mesh("0 0 0  1 0 0  1 2 0  0 2 0.1")) // bent
    areTwo(mesh("0 0 0  1 0 0  1 2 0  0 1.9 0"))
    areTwo(mesh(square, "0 1 2 0 3 2")) // facing away from each other
    areTwo(mesh(square, more = "\"normal3 N\" [ 0 0 1  0 0 1  0 0 1  0 0 -9 ]"))
    areTwo(mesh(square, "0 1 2 1 2 3"))

  test("a rectangle is as bright as its triangles, and shines with the power of each"):
    def mean(shape: String, light: String): Double =
      SceneTexts
        .mean(
          s"""LookAt 0 0 4 0 0 0 0 1 0
             |Camera "perspective" "float fov" 40
             |Film "rgb" "integer xresolution" 16 "integer yresolution" 16
             |Sampler "zsobol" "integer pixelsamples" 64
             |Integrator "path" "integer maxdepth" 1
             |WorldBegin
             |Shape "disk" "float radius" 3
             |AreaLightSource "diffuse" $light
             |Translate 0 0 3
             |ReverseOrientation
             |$shape""".stripMargin,
          Dialect.V4
        )
        .g
        .toDouble
    val whole = mesh(square)
    // The third triangle has no area: none is left over of the rectangle
    val parts = mesh(square + "  9 9 9", "0 1 2 0 2 3 4 4 4")
    for light <- Seq("\"rgb L\" [ 1 2 3 ]", "\"float power\" 5") do
      val (a, b) = (mean(whole, light), mean(parts, light))
      assert(a > 0 && Math.abs(a / b - 1) < 0.02, s"$light: $a, $b")
