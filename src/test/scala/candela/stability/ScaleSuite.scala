package candela.stability

import org.scalatest.funsuite.AnyFunSuite

import candela.render.Renderer
import candela.testing.SceneTexts

/** One scene in many sizes and places. */
class ScaleSuite extends AnyFunSuite:
  private val Side = 16

  /** A lit sphere, a patch of triangles and a disk, each number in units of `s`, moved by `m`. */
  private def image(s: Double, m: Double = 0): Array[Float] =
    def n(x: Double) = (x * s + m).toString
    val text =
      s"""LookAt ${n(0)} ${n(1)} ${n(-4)}  ${n(0)} ${n(0.5)} ${n(0)}  0 1 0
         |Camera "perspective" "float fov" 40
         |Film "image" "integer xresolution" $Side "integer yresolution" $Side
         |Sampler "random" "integer pixelsamples" 4
         |Integrator "path"
         |WorldBegin
         |LightSource "infinite" "rgb L" [0.2 0.2 0.2]
         |Material "matte" "rgb Kd" [0.6 0.6 0.6]
         |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [
         |  ${n(-3)} ${n(0)} ${n(-3)}  ${n(3)} ${n(0)} ${n(-3)}
         |  ${n(3)} ${n(0)} ${n(3)}  ${n(-3)} ${n(0)} ${n(3)}]
         |AttributeBegin
         |Translate ${n(0.2)} ${n(0.5)} ${n(0.1)}
         |Material "plastic" "rgb Kd" [0.3 0.3 0.3]
         |Shape "sphere" "float radius" ${0.5 * s}
         |AttributeEnd
         |AttributeBegin
         |AreaLightSource "diffuse" "rgb L" [4 4 4]
         |Translate ${n(-1)} ${n(2)} ${n(-1)} Rotate 90 1 0 0
         |Shape "disk" "float radius" ${0.5 * s}
         |AttributeEnd
         |WorldEnd
         |""".stripMargin
    Renderer.render(SceneTexts.plan(text), threads = 1).film.toImage(1f).data

  /** The mean absolute difference, over the mean of the first. */
  private def apart(a: Array[Float], b: Array[Float]): Double =
    a.lazyZip(b).map((x, y) => Math.abs(x - y).toDouble).sum / a.map(_.toDouble).sum

  private val plain = image(1)

  test("scaling by a power of two changes no bit: no size is built in"):
    for e <- Seq(-20, -7, 5, 20) do
      val scaled = image(Math.pow(2, e))
      assert(scaled.sameElements(plain), s"2^$e: ${apart(plain, scaled)}")

  test("scaling by powers of ten changes what the rounding of coordinates does"):
    // Rounded to 6e-8, a few paths in a thousand take another turn; few pixels see that
    for e <- Seq(-6, -3, 3, 6) do
      val off = apart(plain, image(Math.pow(10, e)))
      assert(off < 0.02, s"10^$e: $off")

  test("moving by a thousand sizes changes what the rounding of coordinates does"):
    // Places are then rounded to 3e-5 of the size, a hundredth of a pixel
    for m <- Seq(10.0, 1000.0) do
      val off = apart(plain, image(1, m))
      assert(off < 0.05, s"$m: $off")

  test("moving a scene of a thousand units by a million changes no more than that"):
    val off = apart(plain, image(1e3, 1e6))
    // As above
    assert(off < 0.05, s"$off")
