package candela.build

import candela.diagnostics.{Code, SourcePos}
import candela.io.SceneFolder
import org.scalatest.funsuite.AnyFunSuite

import candela.build.recipe.Findings
import candela.render.Renderer
import candela.scenefile.{Declaration, Dialect, Param, ParamType}
import candela.testing.SceneTexts

final class AlikeSuite extends AnyFunSuite:
  private def place(line: Int) = SourcePos("scene", line, 1)

  private def sphere(line: Int, params: Param*) =
    Declaration("Shape", "sphere", params.toVector, place(line), SceneFolder.Nowhere)

  private def radius(line: Int, r: Float) = sphere(line, Param.float("radius", place(line), r))

  private val head = "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32\n" +
    "Camera \"perspective\" WorldBegin LightSource \"infinite\"\n"

  /** How often a value was made for these statements. */
  private def made(all: Declaration*)(say: Findings => Unit): Int =
    val problems = Findings()
    val alike = Alike[Int](problems)
    var count = 0
    for d <- all do
      alike(d, _ => true) {
        count += 1
        say(problems)
        count
      }: Unit
    count

  test("statements of equal numbers are one, wherever they stand"):
    assert(made(radius(1, 2f), radius(2, 2f), radius(3, 2f))(_ => ()) == 1)

  test("other numbers, types, names and counts of parameters are others"):
    val plain = radius(1, 2f)
    assert(made(plain, radius(2, 3f))(_ => ()) == 2)
    assert(made(plain, sphere(2))(_ => ()) == 2)
    assert(made(plain, sphere(2, Param.int("radius", place(2), 2)))(_ => ()) == 2)
    assert(made(plain, sphere(2, Param.float("zmax", place(2), 2f)))(_ => ()) == 2)
    assert(made(plain, plain.copy(name = "disk"))(_ => ()) == 2)
    assert(made(plain, plain.copy(colorSpace = "aces2065-1"))(_ => ()) == 2)
    assert(made(plain, plain.copy(dialect = Some(Dialect.V4)))(_ => ()) == 2)

  test("names are read again: what they stand for may have changed"):
    def textured(line: Int) = sphere(line, Param.texture("alpha", place(line), "t"))
    assert(made(textured(1), textured(2))(_ => ()) == 2)

  test("statements that differ in the numbers of one parameter have one hash, others seldom"):
    def both(r: Float, z: Float) =
      sphere(1, Param.float("radius", place(1), r), Param.float("zmin", place(1), z))
    def hash(d: Declaration) = d.hashBut("radius")
    assert(hash(radius(1, 2f)) == hash(radius(2, 3f)))
    assert(hash(both(1f, -1f)) == hash(both(2f, -1f)))
    val others = Vector(both(1f, -1f), both(1f, -2f), radius(1, 1f), sphere(1)) :+
      both(1f, -1f).copy(name = "disk")
    assert(others.map(hash).distinct.size == others.size)

  test("each statement gets its own message"):
    def say(problems: Findings): Unit = problems.warn(Code.CorrectedValue, place(1), "odd")
    assert(made(radius(1, -2f), radius(2, -2f))(say) == 2)
    val world = "WorldBegin\nLightSource \"point\"\n" + "Shape \"sphere\" \"float radius\" -1\n" * 3
    val lines = SceneTexts.problems(world, Dialect.V4).flatMap(_.pos).map(_.line)
    assert(lines == Vector(3, 4, 5))

  test("where points alone are others, what was made of the others goes through them"):
    def points(line: Int, p: Array[Float], width: Float = 1f, at: String = "P") =
      val all = Vector(
        Param.floats(ParamType.Point3, at, place(line), p),
        Param.float("width", place(line), width)
      )
      Declaration("Shape", "curve", all, place(line), SceneFolder.Nowhere)
    val alike = Alike[String](Findings())
    def made(d: Declaration) =
      def through(p: Array[Float]) = Option.when(p.length == 2)(s"through ${p(0)}")
      alike(d, _ => false, _ => Some(through))("fresh")
    val (a, b, three) = (Array(1f, 2f), Array(3f, 4f), Array(1f, 2f, 3f))
    assert(made(points(1, a)) == "fresh")
    assert(made(points(2, b)) == "through 3.0")
    assert(made(points(3, three)) == "fresh")
    assert(made(points(4, b)) == "through 3.0")
    assert(made(points(5, b, width = 2f)) == "fresh")
    assert(made(points(6, b, width = 2f, at = "Q")) == "fresh")

  test("curves through other points are as each alone; what is wrong with them is said"):
    def hair(wave: Int, more: String = "") =
      val p = Seq(-1.0, wave * 0.1, 3, -0.3, 0.3, 3, 0.3, -0.3, 3, 1, wave * 0.1, 3).mkString(" ")
      s"Shape \"curve\" \"point3 P\" [ $p ] \"float width\" .1 $more\n"
    def image(more: Int => String) =
      val plan = SceneTexts.plan(head + (1 to 4).map(i => hair(i, more(i))).mkString, Dialect.V4)
      Renderer.render(plan, threads = 1).image(plan.development).data.toVector
    val alike = image(_ => "")
    // As many segments, but said otherwise
    assert(alike == image(i => if i % 2 == 0 then "" else "\"integer splitdepth\" 3"))
    assert(alike != image(i => if i % 2 == 0 then "" else "\"float width0\" 0.3"))
    val wrong = "Shape \"curve\" \"point3 P\" [ 0 0 0  1 1 1 ] \"float width\" 0.1\n"
    val world = "WorldBegin\nLightSource \"point\"\n" + hair(1) + wrong + hair(2)
    val problem = SceneTexts.problems(world, Dialect.V4).head
    assert(problem.pos.exists(_.line == 4) && problem.message.contains("at least 4 points"))

  test("shapes of alike statements are where each is placed"):
    def image(params: Int => String) =
      val spheres =
        for i <- 1 to 3
        yield s"AttributeBegin Translate ${i - 2} 0 3 " +
          s"Shape \"sphere\" \"float radius\" .4 ${params(i)} AttributeEnd\n"
      val plan = SceneTexts.plan(head + spheres.mkString, Dialect.V4)
      Renderer.render(plan, threads = 1).image(plan.development).data.toVector
    val alike = image(_ => "")
    // Whole spheres, too, but of other numbers
    assert(alike == image(i => s"\"float zmin\" -$i") && alike.distinct.sizeIs > 100)
