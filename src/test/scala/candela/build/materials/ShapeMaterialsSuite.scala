package candela.build.materials

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.{Declaration, Dialect, MaterialRef}
import candela.testing.SceneTexts

final class ShapeMaterialsSuite extends AnyFunSuite:

  /** The first shape of a world, and its material. */
  private def split(world: String, dialect: Dialect): (Declaration, MaterialRef) =
    val scene = SceneTexts.parse(s"WorldBegin\n$world\n", dialect)
    val shape = scene.shapes.head
    ShapeMaterials(dialect, scene.namedMaterials.toMap).split(shape.shape, shape.material)

  private val shape = "Shape \"sphere\" \"float radius\" 2 \"rgb Kd\" [1 0 0]"
  private val inline = "Material \"matte\" \"rgb Kd\" [0 0 1] \"float sigma\" 20"
  private val named = "MakeNamedMaterial \"m\" \"string type\" \"matte\" NamedMaterial \"m\""

  private def red(material: MaterialRef): Boolean = material match
    case MaterialRef.Inline(d) => d.param("Kd").exists(_.floats.toSeq == Seq(1f, 0f, 0f))
    case _ => false

  test("a shape's parameter that is its material's replaces that one's, in v2 and v3"):
    for dialect <- Vector(Dialect.V2, Dialect.V3) do
      val (geometry, material) = split(s"$inline $shape", dialect)
      assert(geometry.params.map(_.name) == Vector("radius"))
      assert(red(material))
      val MaterialRef.Inline(d) = material: @unchecked
      assert(d.params.map(_.name) == Vector("sigma", "Kd"))

  test("the matte surface of shapes without a material takes parameters, too"):
    assert(red(split(shape, Dialect.V3)._2))

  test("named materials are reached in v3, not in v2"):
    assert(red(split(s"$named $shape", Dialect.V3)._2))
    assert(!red(split(s"$named $shape", Dialect.V2)._2))

  test("in v4 shapes have no parameters of materials"):
    val (geometry, material) = split(shape, Dialect.V4)
    assert(geometry.params.size == 2 && material == MaterialRef.Default)

  test("what is the shape's own stays there"):
    val hair = "Material \"hair\" \"float alpha\" 3"
    val mesh = "Shape \"plymesh\" \"string filename\" \"x.ply\" \"float alpha\" 0"
    assert(split(s"$hair $mesh", Dialect.V3)._1.param("alpha").nonEmpty)

  test("it changes the picture"):
    val view = "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 10\n" +
      "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2"
    val light = "LightSource \"infinite\""
    def seen(kd: String) =
      SceneTexts.mean(s"$view\nWorldBegin\n$light\n$inline\nShape \"sphere\" $kd\nWorldEnd")
    val (blue, red) = (seen(""), seen("\"rgb Kd\" [1 0 0]"))
    assert(blue.b > 0.5f && blue.r == 0f && red.r > 0.5f && red.b == 0f)
