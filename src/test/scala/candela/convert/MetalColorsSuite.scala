package candela.convert

import java.nio.file.Path

import candela.scenefile.Dialect
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class MetalColorsSuite extends AnyFunSuite:

  private val gold = "\"rgb eta\" [.143036 .375307 1.44205] \"rgb k\" [3.983 2.38556 1.60336]"
  private val potassium = "\"rgb eta\" [.0640 .0491 .0418] \"rgb k\" [2.101 1.594 1.098]"

  private def scene(dialect: Dialect, metal: String, light: String) =
    val isV4 = dialect == Dialect.V4
    val (film, name, end) =
      if isV4 then ("rgb", "conductor", "") else ("image", "metal", "\nWorldEnd")
    s"LookAt 0 0 -9 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 10 Film \"$film\" " +
      "\"integer xresolution\" 16 \"integer yresolution\" 16 PixelFilter \"box\" " +
      "Sampler \"halton\" \"integer pixelsamples\" 64 Integrator \"path\" \"integer maxdepth\" 1 " +
      s"WorldBegin LightSource \"infinite\" \"rgb L\" $light\nMaterial \"$name\" $metal " +
      s"\"float roughness\" 0 Shape \"sphere\"$end"

  /** The difference in per cent of the brightest channel, and those that warnings name. */
  private def shift(metal: String, from: Dialect, light: String = "[1 1 1]") =
    val to = if from == Dialect.V3 then Dialect.V4 else Dialect.V3
    val text = scene(from, metal, light)
    val made = Converter.convert(SceneTexts.parse(text, from, Path.of("")), to, Path.of(""))
    val (before, after) = (SceneTexts.mean(text, from), SceneTexts.mean(made.scene))
    val inV4 = if from == Dialect.V4 then before else after
    val warned = made.warnings.filter(_.message.contains("multiplies spectra")).map: w =>
      assert(w.pos.exists(_.line == 2), w)
      "(\\d+) % of".r.findFirstMatchIn(w.message).get.group(1).toInt
    (100 * (before - after).largest / inV4.max, warned)

  private def named(metal: String) =
    s"\"spectrum eta\" \"metal-$metal-eta\" \"spectrum k\" \"metal-$metal-k\""

  test("metals in white light look as before, from three numbers to spectra and back"):
    for metal <- Vector(gold, potassium, "") do
      val (percent, warned) = shift(metal, Dialect.V3)
      assert(percent < 0.5f && warned.isEmpty, s"$metal: $percent, $warned")
    for metal <- Vector(named("CuZn"), named("Ag"), "", potassium) do
      val (percent, warned) = shift(metal, Dialect.V4)
      assert(percent < 0.5f && warned.isEmpty, s"$metal: $percent, $warned")

  test("no metal of three numbers is as red as gold"):
    val (percent, warned) = shift(named("Au"), Dialect.V4)
    assert(percent > 1f && percent < 2f && warned.isEmpty, s"$percent, $warned")

  test("in coloured light, a warning has the difference of the images"):
    for
      from <- Vector(Dialect.V3, Dialect.V4)
      light <- Vector("[1 .1 .1]", "[.1 .2 .9]", "[.2 1 .1]")
    do
      val (percent, warned) = shift(if from == Dialect.V3 then gold else named("Au"), from, light)
      if warned.isEmpty then assert(percent < 2.5f, s"$from, $light: $percent")
      else assert(Math.abs(warned.head - percent) < 1f, s"$from, $light: $percent, $warned")
