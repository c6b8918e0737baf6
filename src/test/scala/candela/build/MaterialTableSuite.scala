package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.render.{Renderer, RenderPlan}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts

final class MaterialTableSuite extends AnyFunSuite:
  private val names = Vector("diffuse", "coateddiffuse", "conductor", "coatedconductor")

  private val head =
    """Film "rgb" "integer xresolution" 24 "integer yresolution" 16
      |Sampler "independent" "integer pixelsamples" 4
      |Integrator "path" "integer maxdepth" 3
      |LookAt 0 0 -6  0 0 0  0 1 0
      |Camera "perspective" "float fov" 50
      |WorldBegin
      |LightSource "infinite" "rgb L" [.9 .7 .3]
      |""".stripMargin

  /** Spheres whose materials are written in place, named, mixed, and textured. */
  private val text =
    def color(i: Int) = s"[${0.1 + 0.08 * (i % 10)} ${0.9 - 0.1 * (i % 7)} ${0.2 + 0.1 * (i % 5)}]"
    val spheres = (0 until 24).map: i =>
      val kind = names(i % 4)
      val own = s"\"$kind\" \"rgb reflectance\" ${color(i)}"
      val worn = i % 3 match
        case 0 => s"Material $own"
        case 1 => s"MakeNamedMaterial \"m$i\" \"string type\" $own\nNamedMaterial \"m$i\""
        case _ =>
          val colors = s"\"rgb tex1\" ${color(i)} \"rgb tex2\" ${color(i + 3)}"
          s"""Texture "t$i" "spectrum" "checkerboard" $colors
             |Material "diffuse" "texture reflectance" "t$i"""".stripMargin
      s"AttributeBegin\n$worn\nTranslate ${i % 6 - 2.5} ${i / 6 - 1.5} 0\n" +
        "Shape \"sphere\" \"float radius\" .4\nAttributeEnd"
    head + spheres.mkString("\n")

  private def image(mode: ColorMode, threads: Int): Vector[Float] =
    val plan = SceneTexts.plan(text, Dialect.V4, RenderSettings(color = mode))
    Renderer.render(plan, threads).image(plan.development).data.toVector

  for mode <- Vector(ColorMode.Rgb, ColorMode.Spectral) do
    test(s"materials that rays meet in any order make the same image, $mode"):
      val alone = image(mode, 1)
      assert(alone.exists(_ > 0f))
      for threads <- Vector(2, 5) do assert(image(mode, threads) == alone)

  /** Spheres of materials of one kind, each with a colour of its own; the last is the purest. */
  private def coloured(kind: String)(more: Int => String) =
    val spheres =
      for i <- 0 until 5
      yield s"AttributeBegin Material \"$kind\" \"rgb reflectance\" [ .9 ${0.8 - 0.2 * i} .1 ] " +
        s"${more(i)} Translate ${i - 2} 0 0 Shape \"sphere\" \"float radius\" .4 AttributeEnd\n"
    head + spheres.mkString

  for kind <- names; mode <- ColorMode.values do
    test(s"materials of a colour each are as those that say more, $kind, $mode"):
      def planned(more: Int => String) =
        SceneTexts.plan(coloured(kind)(more), Dialect.V4, RenderSettings(color = mode))
      def image(plan: RenderPlan) = Renderer.render(plan, 2).image(plan.development).data.toVector
      val alike = planned(_ => "")
      // What changes nothing, but makes another statement of each
      val each = planned(i => if i % 2 == 0 then "" else "\"float displacement\" 0")
      assert(alike.features.toMap.apply("color") == each.features.toMap.apply("color"))
      assert(image(alike) == image(each))
      assert(image(alike).distinct.sizeIs > 200)

  for kind <- Vector("coateddiffuse", "conductor") do
    test(s"materials of several families that take turns are as those that say more, $kind"):
      def image(more: Int => String) =
        val plan = SceneTexts.plan(coloured(kind)(more), Dialect.V4)
        Renderer.render(plan, 2).image(plan.development).data.toVector
      def rough(i: Int) = s"\"float roughness\" 0.${1 + i % 2}"
      val turns = image(rough)
      val flat = "\"float displacement\" 0"
      assert(turns == image(i => if i < 3 then rough(i) else s"${rough(i)} $flat"))
      assert(turns != image(_ => rough(0)))

  test("each material of a colour gets its own message"):
    val lines = SceneTexts.problems(coloured("diffuse")(_ => "\"float sheen\" 1"), Dialect.V4)
      .flatMap(_.pos).map(_.line)
    assert(lines.distinct.size == 5)
