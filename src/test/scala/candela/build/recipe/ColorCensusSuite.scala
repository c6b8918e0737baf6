package candela.build.recipe

import org.scalatest.funsuite.AnyFunSuite

import candela.color.{ColorBasis, Rgb}
import candela.testing.Draws

import scala.collection.mutable

class ColorCensusSuite extends AnyFunSuite:
  private val basis = ColorBasis.Sharp
  private val draws = Draws(1)

  private def color(low: Float, high: Float): Rgb =
    Rgb(draws.between(low, high), draws.between(low, high), draws.between(low, high))

  /** The components of the reflectances that are far apart. */
  private def chosen(colors: Seq[Rgb]): Vector[Rgb] =
    val census = ColorCensus(basis)
    for c <- colors do
      census.add(SpectralValue.Color(c), SpectrumRole.Reflectance, basis.fromSrgb(c))
    census.surfaces.map(_.components)

  test("of very many colours all that are far apart are found: one of each cell is looked at"):
    val first = Vector.fill(4096)(color(0.4f, 0.6f))
    val later = Vector.tabulate(2000)(i => if i % 9 == 0 then color(0f, 1.5f) else color(0f, 1f))
    val cells = mutable.HashSet.empty[(Int, Int, Int)]
    val ofCells = later.filter: c =>
      cells.add(((c.r * 16).toInt, (c.g * 16).toInt, (c.b * 16).toInt))
    assert(ofCells.size < 1900)
    val all = chosen(first ++ later ++ first)
    assert(all == chosen(first ++ ofCells))
    assert(all != chosen(first) && all.size == 24)
    assert(chosen(first ++ later.filter(_.max <= 1f)) != chosen(first))
