package candela.base

import org.scalatest.funsuite.AnyFunSuite

class NumberBufferSuite extends AnyFunSuite:

  test("numbers come back in their order, however many, and again after the buffer was emptied"):
    val (floats, ints) = (FloatBuffer(), IntBuffer())
    for count <- Seq(0, 1, 16, 17, 4095, 4096, 4097, 20000, 5) do
      for i <- 0 until count do
        floats += i * 0.5f
        ints += -i
      assert(floats.length == count && ints.length == count)
      assert(floats.drain().sameElements(Array.tabulate(count)(_ * 0.5f)))
      assert(ints.drain().sameElements(Array.tabulate(count)(-_)))

  test("a list is added as its numbers are"):
    for counts <- Seq(Seq(3, 16, 40), Seq(0, 16, 1), Seq(5000), Seq(4090, 20, 4096)) do
      val (some, each) = (FloatBuffer(), FloatBuffer())
      for count <- counts do
        some ++= Array.tabulate(count)(_.toFloat)
        for i <- 0 until count do each += i.toFloat
        some += -1f
        each += -1f
      assert(some.drain().sameElements(each.drain()))

  test("one number so many times is as each added"):
    val (some, each) = (IntBuffer(), IntBuffer())
    for (count, i) <- Seq(1, 0, 20, 4073, 1, 1, 8192, 5000, 3).zipWithIndex do
      some.add(i, count)
      for _ <- 0 until count do each += i
      some += -i
      each += -i
      assert(some.length == each.length)
    assert(some.drain().sameElements(each.drain()))

  test("a buffer that was cleared begins anew"):
    val ints = IntBuffer()
    for count <- Seq(4096, 10000, 5000) do
      for i <- 0 until count do ints += i + count
      ints.clear()
      assert(ints.length == 0)
    for i <- 0 until 7000 do ints += -i
    assert(ints.drain().sameElements(Array.tabulate(7000)(-_)))

  test("buffers that go on from one have its numbers, and it has none of theirs"):
    for count <- Seq(0, 5, 16, 4096, 10_000) do
      val ints = IntBuffer()
      for i <- 0 until count do ints += i
      val (first, second) = (ints.continued, ints.continued)
      for i <- 0 until 5000 do
        first += -i
        second += 7
      for _ <- 0 until 3 do ints += 1
      val known = Array.range(0, count)
      assert(first.drain().sameElements(known ++ Array.tabulate(5000)(-_)))
      assert(second.drain().sameElements(known ++ Array.fill(5000)(7)))
      assert(ints.drain().sameElements(known ++ Array.fill(3)(1)))

  test("numbers can be replaced, and copied to a place of a larger array"):
    val floats = FloatBuffer()
    for _ <- 0 until 10000 do floats += 1f
    for i <- Seq(0, 4095, 4096, 9999) do floats(i) = i.toFloat
    val all = new Array[Float](10002)
    floats.copyTo(all, 1)
    assert(all.zipWithIndex.filter(_._1 != 1f).toSeq ==
      Seq((0f, 0), (0f, 1), (4095f, 4096), (4096f, 4097), (9999f, 10000), (0f, 10001)))
