package candela.build

import candela.scenefile.Dialect
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Materials and textures that are composed of others, in long chains and with shared parts. */
class CompositionSuite extends AnyFunSuite:
  private val head =
    """Film "image" "integer xresolution" 2 "integer yresolution" 2
      |Camera "perspective"
      |Sampler "halton" "integer pixelsamples" 1
      |WorldBegin
      |LightSource "infinite"
      |Texture "spots" "spectrum" "checkerboard" "rgb tex1" [1 0 0] "rgb tex2" [0 1 0]
      |Texture "grey" "float" "checkerboard" "float tex1" 0.2 "float tex2" 0.8
      |""".stripMargin
  private val ball = "Translate 0 0 3 Shape \"sphere\"\n"
  private val bases =
    """MakeNamedMaterial "m0" "string type" "matte" "texture Kd" "spots"
      |MakeNamedMaterial "m1" "string type" "plastic" "texture Kd" "spots"
      |""".stripMargin

  /** Materials from m2 on, each a blend of two former ones, a number of steps before. */
  private def mixes(count: Int, first: Int, second: Int): String =
    val all =
      for i <- 2 until count
      yield s"MakeNamedMaterial \"m$i\" \"string type\" \"mix\" " +
        s"\"string namedmaterial1\" \"m${i - first}\" " +
        s"\"string namedmaterial2\" \"m${i - second}\"\n"
    head + bases + all.mkString + s"NamedMaterial \"m${count - 1}\"\n" + ball

  /** Likewise of textures. */
  private def textures(kind: String, how: String, count: Int)(
      first: Int,
      second: Int
  ): String =
    val base = if kind == "float" then "grey" else "spots"
    def name(i: Int) = if i < 2 then base else s"t$i"
    val all =
      for i <- 2 until count yield
        def former(step: Int) = s"\"${name(i - step)}\""
        s"Texture \"t$i\" \"$kind\" $how \"texture tex1\" ${former(first)} " +
          s"\"texture tex2\" ${former(second)}\n"
    val use =
      if kind == "float" then s"Material \"matte\" \"texture sigma\" \"t${count - 1}\"\n"
      else s"Material \"matte\" \"texture Kd\" \"t${count - 1}\"\n"
    head + all.mkString + use + ball

  private def errors(text: String) =
    SceneTexts.problems(text, Dialect.V3).filter(_.severity == candela.diagnostics.Severity.Error)
      .map(_.message)

  test("blends of a blend with itself take no more time than one"):
    assert(SceneTexts.mean(mixes(60, 1, 1)).g > 0f)

  test("blends whose number doubles with each are rendered"):
    assert(SceneTexts.mean(mixes(10, 1, 2)).g > 0f)
    assert(SceneTexts.mean(mixes(60, 1, 2)).g > 0f)

  test("a chain of thousands of blends is rendered", Slow):
    val chain = mixes(5000, 1, 1).replaceAll(
      "\"string namedmaterial2\" \"m[0-9]+\"",
      "\"string namedmaterial2\" \"m0\""
    )
    // Nearly all of it is the matte base
    val alone =
      chain.replace("NamedMaterial \"m4999\"\nTranslate", "NamedMaterial \"m0\"\nTranslate")
    val (found, expected) = (SceneTexts.mean(chain), SceneTexts.mean(alone))
    assert(Math.abs(found.g / expected.g - 1) < 1e-3f, s"$found, $expected")

  test("blends that refer to each other in a circle are errors, however long it is"):
    val circle = mixes(3000, 1, 1).replace(
      "\"m1\" \"string type\" \"plastic\"",
      "\"m1\" \"string type\" \"mix\" \"string namedmaterial1\" \"m2999\""
    )
    assert(errors(circle).exists(_.contains("refers to itself")))

  for
    kind <- Vector("float", "spectrum")
    how <- Vector("\"scale\"", "\"mix\"", "\"checkerboard\"")
  do
    test(s"$kind textures, $how, of the former one twice take no more time than one"):
      val _ = SceneTexts.mean(textures(kind, how, 60)(1, 1))
    test(s"$kind textures, $how, whose number doubles with each are refused from some number on"):
      assert(errors(textures(kind, how, 60)(1, 2)).exists(_.contains("the maximum is 16384")))
    test(s"long chains of $kind textures, $how, are rendered or refused, not an overflow"):
      val _ = SceneTexts.mean(textures(kind, how, 5000)(1, 3000000))
      val long = errors(textures(kind, how, 20000)(1, 3000000))
      assert(long.exists(_.contains("the maximum is 16384")))
