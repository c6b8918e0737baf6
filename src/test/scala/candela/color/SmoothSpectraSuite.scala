package candela.color

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class SmoothSpectraSuite extends AnyFunSuite:
  private val spectra = SmoothSpectra()
  private val random = java.util.Random(7)

  /** Colour of the spectrum under D65. */
  private def seen(c: Rgb): Rgb =
    Colorimetry.rgb(nm => spectra.table.at(c.r, c.g, c.b, nm, nm, nm).r, Colorimetry.White.D65)

  private def errors(count: Int)(draw: => Rgb): Seq[Double] =
    Seq.fill(count)(draw).map: c =>
      val off = seen(c) - c
      off.largest.toDouble / c.max

  test("spectra have the colours that they were asked for", Slow):
    val muted = errors(2000)(Rgb(unit(0.05f, 0.95f), unit(0.05f, 0.95f), unit(0.05f, 0.95f)))
    info(f"muted: mean ${muted.sum / muted.size}%.6f, largest ${muted.max}%.6f")
    val deep = errors(2000)(Rgb(unit(0f, 1f), unit(0f, 1f), unit(0f, 1f)))
    info(f"all: mean ${deep.sum / deep.size}%.6f, largest ${deep.max}%.6f")
    assert(muted.sum / muted.size < 3e-3 && muted.max < 5e-2)
    assert(deep.sum / deep.size < 1e-3 && deep.max < 3e-2)

  private def unit(low: Float, high: Float): Float = low + (high - low) * random.nextFloat
