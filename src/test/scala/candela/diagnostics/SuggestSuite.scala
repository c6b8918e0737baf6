package candela.diagnostics

import org.scalatest.funsuite.AnyFunSuite

class SuggestSuite extends AnyFunSuite:
  private val materials = Seq("matte", "plastic", "metal", "glass", "mirror", "uber", "substrate")

  test("one slip finds the name: a letter too many, too few, another, or two swapped"):
    for slip <- Seq("mattee", "mate", "mattw", "amtte", "matet") do
      assert(Suggest.nearest(slip, materials).contains("matte"), slip)

  test("upper and lower case count as equal"):
    assert(Suggest.nearest("GLASS", materials).contains("glass"))
    assert(Suggest.nearest("kd", Seq("Kd", "Ks")).contains("Kd"))

  test("a word that resembles none gets no suggestion but the list"):
    assert(Suggest.nearest("velvet", materials).isEmpty)
    assert(
      Suggest.help("velvet", materials)
        .contains("known: glass, matte, metal, mirror, plastic, substrate, uber")
    )
    assert(Suggest.help("velvet", Nil).isEmpty)

  test("a file with another number is no near miss, one with more zeros is"):
    def near(name: String, existing: String*) =
      Suggest.file(java.nio.file.Path.of("models", name), existing)
    assert(near("Mesh090.obj", "Mesh000.obj", "Mesh091.obj").isEmpty)
    assert(near(
      "Mesh090.obj",
      "mesh000.obj",
      "Mesj090.obj"
    ).contains("did you mean `Mesj090.obj`?"))
    assert(near("Mesh1.obj", "Mesh01.obj").contains("did you mean `Mesh01.obj`?"))
    assert(near("Mesh.obj", "Mesh1.obj").contains("did you mean `Mesh1.obj`?"))

  test("a near miss is worded as a question"):
    assert(Suggest.help("mirorr", materials).contains("did you mean `mirror`?"))

  test("the nearest wins; of two as near the first by alphabet"):
    assert(Suggest.nearest("metals", Seq("metallic", "metal")).contains("metal"))
    assert(Suggest.nearest("bat", Seq("rat", "cat")).contains("cat"))

  test("edits are counted: insert, delete, replace and swap are one each"):
    assert(Suggest.distance("", "abc") == 3)
    assert(Suggest.distance("abc", "") == 3)
    assert(Suggest.distance("kitten", "sitting") == 3)
    assert(Suggest.distance("ab", "ba") == 1)
    assert(Suggest.distance("ca", "abc") == 3) // 2 only if a swapped pair could be edited again
    assert(Suggest.distance("same", "same") == 0)

  test("a distance is exact up to the one that is asked for, and more beyond"):
    val random = scala.util.Random(3)
    def word() = String(Array.fill(random.nextInt(8))("abc".charAt(random.nextInt(3))))
    for _ <- 0 until 2000 do
      val (a, b, most) = (word(), word(), random.nextInt(5))
      val whole = Suggest.distance(a, b)
      val found = Suggest.distance(a, b, most)
      assert(if whole <= most then found == whole else found > most, s"$a $b $most")

  test("of very many names, a few are listed, and some are compared"):
    val many = (1 to 1_000_000).view.map(i => s"texture-$i")
    assert(Suggest.help("velvet", many.take(1000).toVector).get.endsWith(" and 995 more"))
    // Each a million times as many comparisons, were all compared
    for i <- 1 to 300 do
      assert(Suggest.help(s"TEXTURE-$i", many).contains(s"did you mean `texture-$i`?"))
