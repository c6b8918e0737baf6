package candela.textures

import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

class WrapSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  private val (w, h) = (5, 3)
  private def index(wrap: Wrap, x: Int, y: Int) = wrap.index(x, y, w, h)

  test("inside, every mode gives the texel itself"):
    for wrap <- WrapSuite.All; x <- 0 until w; y <- 0 until h do
      assert(index(wrap, x, y) == y * w + x)

  test("repeat goes around, clamp stays at the edge, black is nowhere"):
    for x <- -12 to 12; y <- -12 to 12 do
      assert(index(Wrap.Repeat, x, y) == Math.floorMod(y, h) * w + Math.floorMod(x, w))
      val (cx, cy) = (Math.max(0, Math.min(w - 1, x)), Math.max(0, Math.min(h - 1, y)))
      assert(index(Wrap.Clamp, x, y) == cy * w + cx)
      val inside = x == cx && y == cy
      assert(index(Wrap.Black, x, y) == (if inside then y * w + x else -1))

  test("mirror turns every other copy around"):
    for y <- -7 to 7 do
      assert(index(Wrap.Mirror, -1, y) == index(Wrap.Mirror, 0, y))
      assert(index(Wrap.Mirror, w, y) == index(Wrap.Mirror, w - 1, y))
      assert(index(Wrap.Mirror, 2 * w + 1, y) == index(Wrap.Mirror, 1, y))
    assert(index(Wrap.Mirror, 2, -2) == w + 2 && index(Wrap.Mirror, 2, h) == (h - 1) * w + 2)

  test("modes of both axes are those of each, alike or not"):
    val plain = Vector(Wrap.Repeat, Wrap.Clamp, Wrap.Mirror)
    for across <- plain; down <- plain; x <- -12 to 12; y <- -12 to 12 do
      val wrap = Wrap.of(across, down)
      val (column, row) = (index(across, x, 0) % w, index(down, 0, y) / w)
      assert(index(wrap, x, y) == row * w + column)
      assert(wrap.repeatsDown == (down == Wrap.Repeat))

  test("octahedral: one step across an edge leads to the mirrored texel of the same edge"):
    val n = 4
    def cell(x: Int, y: Int) =
      val i = Wrap.OctahedralSphere.index(x, y, n, n)
      (i % n, i / n)
    for i <- 0 until n do
      assert(cell(-1, i) == (0, n - 1 - i))
      assert(cell(n, i) == (n - 1, n - 1 - i))
      assert(cell(i, -1) == (n - 1 - i, 0))
      assert(cell(i, n) == (n - 1 - i, n - 1))
    assert(cell(-1, -1) == (n - 1, n - 1))

  test("any integers give a texel, or black"):
    val any = Gen.chooseNum(Int.MinValue, Int.MaxValue)
    forAll(any, any, Gen.oneOf(WrapSuite.All)): (x, y, wrap) =>
      val i = index(wrap, x, y)
      assert(i < w * h && (i >= 0 || wrap == Wrap.Black && i == -1))

private[textures] object WrapSuite:
  val All: Vector[Wrap] = Vector(
    Wrap.Repeat,
    Wrap.Black,
    Wrap.Clamp,
    Wrap.Mirror,
    Wrap.OctahedralSphere,
    Wrap.Axes(Wrap.Clamp, Wrap.Repeat),
    Wrap.Axes(Wrap.Mirror, Wrap.Clamp)
  )
