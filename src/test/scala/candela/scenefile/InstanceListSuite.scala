package candela.scenefile

import candela.diagnostics.SourcePos
import candela.build.ObjectSizes
import candela.math.{Still, Transform}
import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class InstanceListSuite extends AnyFunSuite:
  private val draws = Draws(3)

  private def placement: Transform =
    draws.translation(30) * draws.rotation() * draws.stretch()

  private val main = SourcePos("main.pbrt", 7, 3)
  private def still(name: String, line: Int) =
    InstanceDescription(
      name,
      SourcePos("a.pbrt", line, 2, Some(main)),
      GraphicsState.constant(placement)
    )

  private val moving = InstanceDescription("b", main, AnimatedTransform(placement, placement))
  private val flat =
    InstanceDescription("b", main, GraphicsState.constant(Transform.flat(Vector.fill(16)(0.5))))
  private val view = InstanceDescription(
    "c",
    main,
    GraphicsState.constant(
      Transform.fromRows(Vector[Double](1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.1, 1)).get
    )
  )

  private def listed(all: Seq[InstanceDescription]): InstanceList =
    (InstanceList.newBuilder ++= all).result()

  /** The inverse tells the map; see MotionRowsSuite. */
  private def bits(t: Transform) =
    val told = if t.isFlat then t.m else t.inverseM
    told.map(java.lang.Double.doubleToRawLongBits).toVector

  private def facts(i: InstanceDescription) =
    (i.name, i.pos, bits(i.instanceToWorld.start), bits(i.instanceToWorld.end))

  private val many = Vector.tabulate(1000)(i => still(if i % 3 == 0 then "a" else "b", i))

  test("instances are as they were added, to the last bit"):
    val all = many ++ Vector(moving, flat, view) ++ many.reverse
    val list = listed(all)
    assert(list.length == all.length && list.map(facts) == all.map(facts))
    assert(list.plain == 2 * many.length)

  test("the motion of an instance writes its two matrices"):
    val all = view +: many.take(500) :+ moving :++ many.drop(500) :+ flat
    val list = listed(all)
    assert(list.plain == many.length)
    val (found, expected) = (new Array[Double](24), new Array[Double](24))
    val made = Vector(view, moving, flat).map(_.instanceToWorld -> Still(Transform.Identity))
    val motions = list.motions(t => made.find(_._1 eq t).get._2)
    for i <- all.indices do
      made.find(_._1 eq all(i).instanceToWorld) match
        case Some((_, motion)) => assert(motions(i) eq motion)
        case None =>
          motions(i).write(0f, found, 0)
          Still(all(i).instanceToWorld.start).write(0f, expected, 0)
          assert(found.drop(12).sameElements(expected.drop(12)) && !motions(i).moves)
          for (x, y) <- found.zip(expected).take(12) do assert((x - y).abs < 1e-13)

  test("instances of each object, by name, are in their order"):
    val all = view +: many :+ moving
    val each = listed(all).ofEach
    assert(each.map(_._1) == Vector("a", "b", "c"))
    for (name, list) <- each do
      assert(list.map(facts) == all.filter(_.name == name).map(facts))
    assert(each.map((_, list) => list.plain == list.length) == Vector(true, false, false))
    assert(listed(Vector.empty).ofEach.isEmpty)

  test("lists that go on from one do not share what is added"):
    val one = listed(many)
    val (first, second) = (InstanceList.newBuilder ++= one, InstanceList.newBuilder ++= one)
    first += view
    second += moving
    second += flat
    first += many(0)
    assert(first.result().map(facts) == (many :+ view :+ many(0)).map(facts))
    assert(second.result().map(facts) == (many :+ moving :+ flat).map(facts))
    assert(one.map(facts) == many.map(facts))

  test("instances are parted in their order, also those of one object"):
    val all = view +: many :+ moving
    for list <- listed(all) +: listed(all).ofEach.map(_._2) do
      val (first, second) = list.partition(_.pos.line % 2 == 0)
      val (expected, others) = list.toVector.partition(_.pos.line % 2 == 0)
      assert(first.map(facts) == expected.map(facts) && second.map(facts) == others.map(facts))

  test("lists of ten thousand objects take few bytes each"):
    val list = listed(Vector.tabulate(10_000)(i => many(0).copy(name = s"o$i")))
    val sizes = ObjectSizes()
    sizes.add(Vector(list)): Unit
    val bytes = sizes.add(list.ofEach.map(_._2))
    assert(bytes < 100L * list.length, s"$bytes")

  test("lists that go on from one have most of its memory, and add nothing to it"):
    val one = (InstanceList.newBuilder ++= Vector.fill(20)(many).flatten).result()
    val bytes = ObjectSizes().add(Vector(one))
    val frames = Vector.fill(50)((InstanceList.newBuilder ++= one += moving).result())
    assert(ObjectSizes().add(Vector(one)) == bytes)
    val all = ObjectSizes().add(one +: frames)
    assert(all < 2 * bytes, s"$all of 51 lists, $bytes of one")
    val last = frames.foldLeft(one)((before, _) =>
      (InstanceList.newBuilder ++= before += view).result()
    )
    assert(last.length == one.length + 50 && last.map(facts).endsWith(Vector.fill(50)(facts(view))))

  test("nothing is kept of what follows the empty list"):
    val before = ObjectSizes().add(Vector(InstanceList.Empty))
    val list = (InstanceList.newBuilder ++= InstanceList.Empty ++= many).result()
    assert(list.map(facts) == many.map(facts))
    assert(ObjectSizes().add(Vector(InstanceList.Empty)) == before)

  test("a builder that goes on leaves its earlier lists as they are"):
    val builder = InstanceList.newBuilder ++= many
    val one = builder.result()
    val bytes = ObjectSizes().add(Vector(one))
    builder ++= Vector.fill(5)(many).flatten += view
    assert(ObjectSizes().add(Vector(one)) == bytes)
    assert(builder.result().map(facts) == (Vector.fill(6)(many).flatten :+ view).map(facts))

  test("all instances can be changed"):
    val moved = listed(many :+ moving).changed(_.copy(name = "z"))
    assert(moved.map(facts) == (many :+ moving).map(i => facts(i.copy(name = "z"))))

  test("an instance takes at most 110 bytes, of which 96 are its matrix"):
    val count = 100_000
    val one = InstanceDescription("a", main, GraphicsState.constant(placement))
    val builder = InstanceList.newBuilder
    for _ <- 0 until count do builder += one
    val bytes = ObjectSizes().add(Vector(builder.result()))
    assert(bytes > 107L * count && bytes < 110L * count, s"$bytes")
