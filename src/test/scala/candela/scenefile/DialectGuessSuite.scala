package candela.scenefile

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class DialectGuessSuite extends AnyFunSuite:

  private def dialectOf(text: String): Dialect = Parser.parseText("test", text, Path.of("")).dialect

  test("directives of one dialect settle it"):
    for directive <- List("SurfaceIntegrator", "VolumeIntegrator", "Renderer") do
      val text = s"$directive \"path\""
      assert(dialectOf(s"$text WorldBegin WorldEnd") == Dialect.V2)
    val attribute = "Attribute \"shape\" \"float a\" 1"
    for text <- List("ColorSpace \"srgb\"", "Option \"seed\" 1", attribute) do
      assert(dialectOf(s"$text WorldBegin WorldEnd") == Dialect.V4)

  test("a v4 file with a WorldEnd left over is v4"):
    assert(dialectOf("Film \"rgb\" WorldBegin Material \"diffuse\" WorldEnd") == Dialect.V4)

  test("a typical v2 file without an integrator is v2"):
    val text = "Film \"image\" WorldBegin AreaLightSource \"area\" \"color L\" [1 1 1] " +
      "Material \"measured\" WorldEnd"
    assert(dialectOf(text) == Dialect.V2)

  test("a typical v3 file is v3, also with v2's spellings of types"):
    val text = "Film \"image\" Sampler \"halton\" Integrator \"path\" WorldBegin " +
      "AreaLightSource \"area\" \"color L\" [1 1 1] Material \"matte\" WorldEnd"
    assert(dialectOf(text) == Dialect.V3)

  test("the same evidence twice counts once"):
    val once = "Integrator \"path\" Sampler \"lowdiscrepancy\" WorldBegin WorldEnd"
    assert(dialectOf(once) == dialectOf("Sampler \"lowdiscrepancy\" " * 9 + once))

  test("a file that says nothing is read as the newest dialect"):
    assert(dialectOf("WorldBegin") == Dialect.V4)

  test("a dialect that is given is not guessed"):
    val scene = Parser.parseText("test", "Film \"rgb\" WorldBegin", Path.of(""), Some(Dialect.V2))
    assert(scene.dialect == Dialect.V2)
