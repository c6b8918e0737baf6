package candela.color

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.color.Colorimetry.White
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts

final class PbrtColorsSuite extends AnyFunSuite:

  /** The noise of pbrt-v4's values, and a hundredth of what it interpolates in its table. */
  private val Tolerance = 0.025f

  private def compare(what: String, found: Vector[Rgb], wanted: Vector[Rgb], tolerance: Float) =
    val off =
      for
        (c, (a, b)) <- PbrtColors.colors.zip(found.zip(wanted))
        if !((a - b).map(Math.abs).max <= tolerance * Math.max(1f, b.max))
      yield s"$c: $a, wanted $b"
    assert(off.isEmpty, s"\n$what\n${off.mkString("\n")}")

  test("reflectances, light and coefficients of any space have the colours of pbrt-v4"):
    for (name, wanted) <- PbrtColors.bySpace do
      val space = ColorSpace.named(name).get
      val colors = PbrtColors.colors
      compare(s"$name reflects", colors.map(space.reflectance), wanted.reflections, Tolerance)
      val emitted = colors.map(c => space.emission(c * 2.5f))
      compare(s"$name emits", emitted, wanted.emissions, Tolerance)
      val through = colors.map: c =>
        val s = Upsampling.unbounded(c, space)
        Colorimetry.rgb(nm => Math.exp(-s(nm).toDouble).toFloat, White.D65)
      compare(s"$name transmits", through, wanted.transmissions, Tolerance)

  private def quad(i: Int): String =
    s"""Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |"point3 P" [$i 0 0 ${i + 1} 0 0 ${i + 1} 1 0 $i 1 0]""".stripMargin

  /** A row of squares, one for each colour. */
  private def row(world: String)(square: (String, Int) => String): String =
    val squares = PbrtColors.colors.zipWithIndex.map: (c, i) =>
      s"AttributeBegin\n${square(s"[${c.r} ${c.g} ${c.b}]", i)}\n${quad(i)}\nAttributeEnd"
    s"""Film "rgb" "integer xresolution" 16 "integer yresolution" 1 "string sensor" "cie1931"
       |PixelFilter "box" "float xradius" .5 "float yradius" .5
       |Sampler "zsobol" "integer pixelsamples" 1024
       |Integrator "path" "integer maxdepth" 1
       |LookAt 0 0 -5  0 0 0  0 1 0
       |Camera "orthographic" "float screenwindow" [0 16 0 1]
       |WorldBegin
       |$world
       |${squares.mkString("\n")}
       |""".stripMargin

  private def image(text: String, mode: ColorMode): Vector[Rgb] =
    val plan = SceneTexts.plan(text, Dialect.V4, RenderSettings(color = mode))
    val data = Renderer.render(plan, threads = 1).image(plan.development).data
    data.grouped(3).map(p => Rgb(p(0), p(1), p(2))).toVector

  /** Of 1024 samples of three wavelengths, besides. */
  private val Noise = 0.03f

  test("they have them in images, too", Slow):
    val sun = "LightSource \"distant\" \"point3 from\" [0 0 -1] \"point3 to\" [0 0 0] \"rgb L\" " +
      s"[${Math.PI} ${Math.PI} ${Math.PI}]"
    for (name, wanted) <- PbrtColors.bySpace do
      val space = s"ColorSpace \"$name\""
      val lit = row(sun)((c, _) => s"$space\nMaterial \"diffuse\" \"rgb reflectance\" $c")
      val emitters = row("")((c, _) =>
        s"$space\nAreaLightSource \"diffuse\" \"rgb L\" $c \"float scale\" 2.5 " +
          "\"bool twosided\" true"
      )
      for mode <- Vector(ColorMode.Auto, ColorMode.Spectral) do
        compare(s"$name reflects, $mode", image(lit, mode), wanted.reflections, Tolerance + Noise)
      // Light of three numbers may be negative, reflectances may not
      for mode <- ColorMode.values do
        compare(s"$name emits, $mode", image(emitters, mode), wanted.emissions, Tolerance + Noise)
