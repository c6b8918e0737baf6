package candela.build.shapes

import candela.diagnostics.SourcePos
import candela.io.SceneFolder
import org.scalatest.funsuite.AnyFunSuite

import candela.build.recipe.{Findings, Resources, Site}
import candela.color.ColorBasis
import candela.math.Transform
import candela.scenefile.{Declaration, Dialect}
import candela.shapes.Sphere
import candela.testing.SceneTexts

class ShapeRecipeSuite extends AnyFunSuite:

  private val light = "LightSource \"infinite\"\n"
  private val mesh =
    """Shape "trianglemesh" "integer indices" [0 1 2] "point P" [-9 -9 3 9 -9 3 0 18 3] """

  private def masks(shape: String, dialect: Dialect): String =
    SceneTexts.plan(s"WorldBegin\n$light$shape\n", dialect).features.toMap.apply("masks")

  test("a mesh has holes in every dialect, a sphere in v4"):
    for dialect <- Dialect.ofPbrt do
      assert(masks(mesh + "\"float alpha\" 0", dialect) == "on 1 meshes and 0 other shapes")
    val sphere = "Shape \"sphere\" \"float alpha\" 0"
    assert(masks(sphere, Dialect.V4) == "on 0 meshes and 1 other shapes")
    assert(masks(sphere, Dialect.V3) == "none")

  test("alpha on a sphere of v3, which pbrt-v3 ignores, is named"):
    val text = s"WorldBegin\n${light}Shape \"sphere\" \"float alpha\" 0\n"
    assert(SceneTexts.problems(text, Dialect.V3).exists(_.message.contains("`alpha`")))

  test("half transparent is a hole in v4 only, and opaque nowhere"):
    assert(masks(mesh + "\"float alpha\" .5", Dialect.V3) == "none")
    assert(masks(mesh + "\"float alpha\" .5", Dialect.V4) != "none")
    for dialect <- Dialect.ofPbrt do assert(masks(mesh + "\"float alpha\" 1", dialect) == "none")

  test("shadowalpha is v3's alone"):
    assert(masks(mesh + "\"float shadowalpha\" 0", Dialect.V3) != "none")
    assert(masks(mesh + "\"float shadowalpha\" 0", Dialect.V4) == "none")

  test("the spheres that a plan places share what does not depend on the place"):
    val statement =
      Declaration("Shape", "sphere", Vector.empty, SourcePos.Nowhere, SceneFolder.Nowhere)
    val site = Site(statement, Dialect.V4, Resources(ColorBasis.Srgb), Findings())
    val made = Shapes.all.build(site).flatten.map(_.geometry) match
      case Some(ShapeGeometry.Solid(make, _)) =>
        for x <- Vector(1, 2); shape <- Some(make(Transform.translate(x, 0, 0), false))
        yield shape.asInstanceOf[Sphere]
      case other => fail(s"$other")
    assert(made(0).form eq made(1).form)
    assert(made.map(_.bounds.center.x) == Vector(1f, 2f))

  private val floor =
    "Material \"diffuse\" \"rgb reflectance\" [1 1 1]\nShape \"disk\" \"float radius\" 100\n"

  private def lit(emitter: String): Float =
    val text = "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 10\n" +
      "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n" +
      "Sampler \"zsobol\" \"integer pixelsamples\" 256\n" +
      "Integrator \"path\" \"integer maxdepth\" 1\n" +
      s"WorldBegin\n$floor" +
      "AttributeBegin\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 0]\nTranslate 0 0 3\n" +
      s"AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n" +
      s"Shape \"disk\" \"float radius\" 2 \"float innerradius\" .5 $emitter\nAttributeEnd\n"
    SceneTexts.mean(text, Dialect.V4).g

  test("a v4 light with alpha 0 lights as if it were there, a half transparent one half as much"):
    val full = lit("")
    // 16,384 light samples that deviate by up to the mean: 0.8 %; chances of alpha add as much
    assert(Math.abs(lit("\"float alpha\" 0") / full - 1f) < 0.02f)
    assert(Math.abs(lit("\"float alpha\" .5") / full - 0.5f) < 0.03f)
