package candela.build.materials

import candela.diagnostics.Severity
import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

class SubsurfaceSuite extends AnyFunSuite:

  private def said(material: String, dialect: Dialect): Vector[(Severity, String)] =
    SceneTexts
      .problems(s"WorldBegin\nLightSource \"point\"\n$material\nShape \"sphere\"\n", dialect)
      .map(p => (p.severity, p.message))

  private def feature(scene: String, dialect: Dialect): String =
    SceneTexts.plan(scene, dialect).features.toMap.apply("subsurface")

  test("what pbrt takes is taken without a word"):
    val all = Seq(
      Dialect.V2 -> """Material "subsurface" "string name" "Coke" "float scale" 3""",
      Dialect.V2 -> """Material "kdsubsurface" "color Kd" [.5 .4 .3] "float meanfreepath" .2""",
      Dialect.V3 -> """Material "subsurface" "string name" "Skin1" "float uroughness" .1""",
      Dialect.V3 -> """Material "kdsubsurface" "rgb mfp" [1 2 3] "float g" .9""",
      Dialect.V4 -> """Material "subsurface" "rgb reflectance" [.5 .4 .3] "float roughness" .2""",
      Dialect.V4 -> """Material "subsurface" "rgb sigma_a" [1 1 1] "rgb sigma_s" [.1 .1 .1]"""
    )
    for (dialect, material) <- all do assert(said(material, dialect).isEmpty, material)

  test("a name that was not measured is an error in v4; in v2 and v3 milk is used, as in pbrt"):
    val unknown = """Material "subsurface" "string name" "Skin3" """
    assert(
      said(unknown, Dialect.V4) ==
        Vector((Severity.Error, "unknown measured material \"Skin3\""))
    )
    for d <- Seq(Dialect.V2, Dialect.V3) do
      val Vector((severity, message)) = said(unknown, d): @unchecked
      assert(severity == Severity.Warning && message.contains("Wholemilk"))

  test("in v4, one coefficient needs the other"):
    val half = """Material "subsurface" "rgb sigma_a" [1 1 1]"""
    assert(
      said(half, Dialect.V4) == Vector(
        (
          Severity.Error,
          "`sigma_a` and `sigma_s` must be given together; `sigma_s` is missing"
        )
      )
    )

  test("a mixture shows the surface alone, and says so"):
    val mix =
      """MakeNamedMaterial "a" "string type" "subsurface"
        |MakeNamedMaterial "b" "string type" "diffuse"
        |Material "mix" "string materials" ["a" "b"]
        |""".stripMargin
    val Vector((severity, message)) = said(mix, Dialect.V4): @unchecked
    assert(severity == Severity.Warning && message.contains("\"mix\" does not support subsurface"))

  test("the plan says whether light travels beneath surfaces"):
    def scene(integrator: String, material: String) =
      s"Integrator \"$integrator\"\nWorldBegin\nLightSource \"point\"\n$material Shape \"sphere\"\n"
    val medium = "Material \"subsurface\""
    assert(feature(scene("path", "Material \"matte\""), Dialect.V3) == "none")
    assert(feature(scene("path", medium), Dialect.V3) == "subsurface scattering in 1 materials")
    for (i, d) <- Seq("whitted" -> Dialect.V3, "path" -> Dialect.V4, "bdpt" -> Dialect.V4) do
      assert(feature(scene(i, medium), d).contains("does not support it"), i)
