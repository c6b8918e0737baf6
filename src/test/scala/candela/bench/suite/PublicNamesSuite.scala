package candela.bench.suite

import org.scalatest.funsuite.AnyFunSuite

class PublicNamesSuite extends AnyFunSuite:
  private val names = PublicNames(
    Map(
      "PBRT" -> "/opt/renderers/pbrt",
      "PBRT_OLD" -> "/opt/renderers/pbrt-v3",
      "SCENES" -> "/data/scenes",
      "PLAIN" -> "mitsuba",
      "SAME" -> "mitsuba",
      "EMPTY" -> ""
    ),
    Vector("/tmp/scratch-1/" -> "", "/home/me/" -> "~/")
  )

  test("what a variable says is called by its name, the longest first"):
    assert(names.of("/opt/renderers/pbrt --quiet {scene}") == "$PBRT --quiet {scene}")
    assert(names.of("/opt/renderers/pbrt-v3 {scene}") == "$PBRT_OLD {scene}")
    assert(names.of("there is no file /data/scenes/box/a.pbrt") ==
      "there is no file $SCENES/box/a.pbrt")

  test("parts of other names stay"):
    for text <- Vector("my/opt/renderers/pbrt", "/opt/renderers/pbrt2", "mitsubas", "x.mitsuba") do
      assert(names.of(text) == text)

  test("of two variables with the same value the program's own counts"):
    assert(names.of("mitsuba -m x", Vector("SAME")) == "$SAME -m x")
    assert(names.of("mitsuba -m x", Vector("PLAIN")) == "$PLAIN -m x")

  test("folders of this machine are not told"):
    assert(names.of("can't read /tmp/scratch-1/out.exr") == "can't read out.exr")
    assert(names.of("/home/me/pbrt {scene}") == "~/pbrt {scene}")
