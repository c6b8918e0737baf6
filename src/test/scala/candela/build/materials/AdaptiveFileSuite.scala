package candela.build.materials

import candela.io.InputFile
import java.nio.file.{Files, Path}

import candela.bsdf.{Bsdf, BsdfLaws, Directions}
import candela.color.{Colorimetry, Rgb, Spectrum}

class AdaptiveFileSuite extends BsdfLaws:
  private val folder = Path.of("scenes/measured")
  private def toRgb(s: Spectrum): Rgb = Colorimetry.rgb(s, Colorimetry.White.D65)
  private def read(name: String): Bsdf =
    AdaptiveFile.read(InputFile.named(folder.resolve(name))).fold(why => fail(why), _.make(toRgb))

  obeysLaws("the same all around", read("glossy.bsdf"), isReciprocal = false)
  obeysLaws("brushed", read("brushed.bsdf"), isReciprocal = false)

  test("what is the same all around stays when turned, what is brushed does not"):
    def apart(bsdf: Bsdf): Float =
      val (a, b) = (
        bsdf.f(Directions.at(40, 0), Directions.at(30, 130)),
        bsdf.f(Directions.at(40, 90), Directions.at(30, 220))
      )
      Math.abs(a.g / b.g - 1)
    assert(apart(read("glossy.bsdf")) < 1e-4f) // rounding
    assert(apart(read("brushed.bsdf")) > 0.1f)

  test("hostile files are refused with a reason"):
    val whole = Files.readAllBytes(folder.resolve("glossy.bsdf"))
    def problem(bytes: Array[Byte]): String =
      val file = Files.createTempFile("hostile", ".bsdf")
      try
        val _ = Files.write(file, bytes)
        AdaptiveFile.read(InputFile.named(file)).fold(identity, _ => "")
      finally Files.delete(file)
    assert(problem(Array.empty) == "unexpected end of file")
    assert(problem("tensor_fool!".getBytes ++ whole.drop(12)) == "not a tensor file")
    assert(problem(whole.take(200)).contains("the end of the file"))
    val other = whole.clone
    other(12) = 7
    assert(problem(other) == "version must be 1.0, found 7.0")
    for at <- 14 until 250 do
      val broken = whole.clone
      broken(at) = (broken(at) ^ 0x55).toByte
      val _ = problem(broken) // a reason or a file, no exception
