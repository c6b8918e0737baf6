package candela.bench.robustness

import candela.concurrency.Parallel
import candela.bench.report.{Robust, RobustProgram, RobustRow}
import candela.image.Image
import candela.render.Cancellation

import org.scalatest.funsuite.AnyFunSuite

/** Rows of `candela robustness` whose pictures are planted. */
class RowsSuite extends AnyFunSuite:

  /** Renders what `image` has for a scene. */
  private final class Planted(image: PeerInput => Either[Painter.Refusal, Image]) extends Painter:
    val program: RobustProgram = RobustProgram("planted", "Planted", isOurs = true)
    def paint(scene: PeerInput): Either[Painter.Refusal, Image] = image(scene)

  private def gray(value: Float): Image = Image(8, 8, Image.RgbNames, Array.fill(3 * 64)(value))

  private def equipment(painter: Painter): Equipment =
    Equipment(100, Parallel.Alone, Vector.empty, Vector(painter), None, () => false)

  private def rows(m: Measurement)(image: PeerInput => Image): Vector[RobustRow] =
    m.rows(equipment(Planted(scene => Right(image(scene))))).toVector

  private def isFaulty(row: RobustRow): Boolean = row.cells("planted").isFaulty

  test("pixels of the sky within a closed ball are leaks"):
    val image = gray(0f)
    for i <- 0 until 9 do image.data(i) = 1f
    val seen = rows(Leaks)(_ => image).filter(_.what.endsWith("seen from within"))
    assert(seen.size == 5)
    for row <- seen do
      assert(row.cells("planted") == Robust.Counted(3, 64, Some("pixel 0, 0: 1.0")))
      assert(row.pictures.map(_.name) == Vector("Planted"))

  test("pixels of a mirror that show no sky are self-hits"):
    val kinds = Kind.all.size
    val mirrors = SelfHits.rows(equipment(Planted(_ => Right(gray(0.25f))))).drop(kinds).toVector
    assert(mirrors.nonEmpty && mirrors.forall(_.cells("planted") match
      case Robust.Counted(64, 64, _) => true
      case _ => false))

  test("light that is lost before an area light, or leaks through a screen, is a fault"):
    assert(rows(NearLights)(_ => gray(0.45f)).forall(isFaulty))
    val right = rows(NearLights)(_ => gray(0.5f))
    assert(right.filter(_.what.startsWith("a floor")).forall(!isFaulty(_)))

  test("bidirectional path tracing that is darker than path tracing is a fault"):
    def image(scene: PeerInput, bdpt: Float) =
      gray(if scene.v3.contains("Integrator \"bdpt\"") then bdpt else 0.5f)
    assert(rows(Bumps)(image(_, 0.48f)).forall(isFaulty))
    assert(rows(Bumps)(image(_, 0.501f)).forall(!isFaulty(_)))

  test("scenes whose mean is not the known one are faults, with their pictures"):
    val wrong = rows(Extremes)(_ => gray(0.3f))
    assert(wrong.forall(isFaulty) && wrong.forall(_.pictures.nonEmpty))
    val grounds = rows(Extremes)(_ => gray(0.5f)).take(4)
    assert(grounds.forall(!isFaulty(_)) && grounds.forall(_.pictures.isEmpty))

  test("a program that fails has a fault, one that lacks the scene has none"):
    def row(isFailure: Boolean) =
      val refusal = Painter.Refusal("why", isFailure)
      Extremes.rows(equipment(Planted(_ => Left(refusal)))).next()
    assert(row(isFailure = true).cells("planted") == Robust.Failed("why"))
    assert(isFaulty(row(isFailure = true)) && !isFaulty(row(isFailure = false)))

  test("Candela's kernels and BSDFs have no fault in a short run"):
    val short = Equipment(200, Parallel.Alone, Kernel.all, Vector.empty, None, () => false)
    for m <- Vector(Distances, BadScattering); row <- m.rows(short); cell <- row.cells.values do
      assert(!cell.isFaulty, s"${row.what}: $cell")

  test("a ground sphere of the Earth's radius is rendered by Candela as the table has it"):
    val own = OwnPainter(1, Cancellation())
    val row = Extremes.rows(equipment(own)).next()
    assert(!row.cells("candela").isFaulty, row)

  test("scenes have the same shapes and lights in the language of Mitsuba"):
    val scene = PeerScene(
      View(Spot(0, 1, -4), Spot.Origin, Spot(0, 1, 0), 30),
      Vector(
        (Form.floor(1, 0), Surface.Matte(0.5)),
        (Form.Ball(Spot(0, 2, 0), 0.5), Surface.Light(3))
      ),
      sky = 1
    )
    val (xml, files) = PeerXml.of(scene)
    assert(files.keySet == Set("mesh-0.obj") && files("mesh-0.obj").contains("f 1 2 3"))
    val parts =
      Vector("sphere", "constant", "area", "mesh-0.obj", "lookat origin=\"0.0, 1.0, -4.0\"")
    for part <- parts do
      assert(xml.contains(part), xml)
    // Mitsuba counts the edges of a path, Candela its scattering events
    val depth = s"<integer name=\"max_depth\" value=\"${scene.depth + 1}\"/>"
    assert(xml.contains(depth), xml)
