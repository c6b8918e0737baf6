package candela.scene

import java.util.concurrent.atomic.AtomicInteger

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.{ConstantMaterial, InterfaceMaterial, Lambert, Material}
import candela.color.Rgb

final class SceneMaterialsSuite extends AnyFunSuite:
  private def grey(i: Int): Material = ConstantMaterial(Lambert(Rgb.gray(i / 1000f)))
  private val all = Array.tabulate(200)(i => if i == 7 then InterfaceMaterial else grey(i))
  private val plain = SceneMaterials(all)

  test("materials of a set are made when they are first asked for, once"):
    val makers, made = AtomicInteger()
    val materials = plain.inBasis(isDispersive = false, maxCached = 1000): () =>
      makers.incrementAndGet()
      i =>
        made.incrementAndGet()
        grey(i)
    assert(materials.interfaces.indices.filter(materials.interfaces(_)) == Vector(7))
    assert(!materials.panes.contains(true) && makers.get == 0 && made.get == 0)
    val first = materials(3)
    for _ <- 1 to 3 do assert(materials(3) eq first)
    assert(materials(199) ne first)
    assert(makers.get == 1 && made.get == 2)

  test("no more of them are kept than asked for, and those forgotten are made again"):
    val makers, made = AtomicInteger()
    val materials = plain.inBasis(isDispersive = false, maxCached = 10): () =>
      makers.incrementAndGet()
      i =>
        made.incrementAndGet()
        grey(i)
    for i <- 0 until 200 do materials(i): Unit
    assert(made.get == 200 && makers.get == 20)
    materials(199): Unit
    assert(made.get == 200)
    materials(0): Unit
    assert(made.get == 201 && makers.get == 21)

  test("threads that ask for the same material are given the same"):
    val made = AtomicInteger()
    val materials = plain.inBasis(isDispersive = false, maxCached = 1000): () =>
      i =>
        made.incrementAndGet()
        grey(i)
    val found = Array.ofDim[Material](4, 200)
    val threads = (0 until 4).map: t =>
      Thread(() => for i <- 0 until 200 do found(t)(i) = materials(i))
    threads.foreach(_.start())
    threads.foreach(_.join())
    assert(made.get == 200)
    for t <- 1 until 4; i <- 0 until 200 do assert(found(t)(i) eq found(0)(i))

  test("indices of one material are known whatever the set"):
    val one = grey(5)
    val twice = SceneMaterials(Array(one, grey(5), one))
    val set = twice.inBasis(isDispersive = true, maxCached = 1)(() => grey)
    assert(set.isSame(0, 2) && !set.isSame(0, 1) && set.isDispersive && !twice.isDispersive)
