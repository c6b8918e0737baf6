package candela.mitsuba

import candela.scenefile.SceneDescription

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

final class SkiesSuite extends AnyFunSuite:

  private val Sensor = "<sensor type=\"perspective\"/>"

  private def read(body: String): SceneDescription =
    val file = Files.createTempFile("candela-mitsuba", ".xml")
    Files.writeString(file, s"""<scene version="3.0.0">$body</scene>""")
    try MitsubaScene.readable(file, Map.empty, keepGoing = false)
    finally Files.delete(file)

  /** Place and message. */
  private def problems(body: String): Vector[String] =
    val scene = read(Sensor + body)
    (scene.errors ++ scene.warnings).map: p =>
      s"${p.pos.fold("")(at => s"${at.line}:${at.column}: ")}${p.message}"

  private def sky(inside: String, kind: String = "sunsky"): String =
    s"""\n<emitter type="$kind">$inside</emitter>"""
  private def number(name: String, x: Double) = s"""<float name="$name" value="$x"/>"""

  private def sun(inside: String, kind: String = "sunsky"): Array[Float] =
    read(Sensor + sky(inside, kind)).lights.head.light.param("sun").get.floats

  test("the sun stands where Mitsuba 3.9.1 places it"):
    // Default: Tokyo on 10 July 2010 at 3 p.m.
    assert(near(sun(""), Expected))

  test("minutes and seconds are parts of the hour"):
    val half = sun(number("hour", 10.5))
    assert(near(sun(number("hour", 10) + number("minute", 30)), half))
    assert(near(sun(number("hour", 10) + number("minute", 29) + number("second", 60)), half))
    assert(!near(sun(number("hour", 10)), half))

  test("a direction is the world's, and excludes a time"):
    val turned = """<transform name="to_world"><rotate x="1" angle="-90"/></transform>"""
    val up = """<vector name="sun_direction" x="0" y="3" z="0"/>"""
    assert(near(sun(up + turned), Array(0f, 0f, 1f)))
    assert(
      problems(sky(up + "\n" + number("hour", 3))).head ==
        "3:1: `sun_direction` and `hour` are mutually exclusive"
    )

  test("values out of range are errors with their place"):
    for
      (name, x, message) <- Seq(
        ("turbidity", 0.5, "must be from 1 to 10, found 0.5"),
        ("turbidity", 11.0, "must be from 1 to 10, found 11.0"),
        ("sun_aperture", 0.0, "must be between 0 and 180, found 0.0"),
        ("sky_scale", -1.0, "must be at least 0, found -1.0")
      )
    do assert(problems(sky("\n" + number(name, x))) == Vector(s"3:1: `$name` $message"))
    assert(
      problems(sky("\n" + """<rgb name="albedo" value="0, 2, 0"/>""")) ==
        Vector("3:1: `albedo` must be from 0 to 1")
    )

  test("a timed sky begins with its window, and its sun does not move"):
    val early = number("window_start_time", 9)
    assert(near(sun(early, "timed_sunsky"), sun("", "timed_sunsky")) == false)
    assert(
      problems(sky(number("window_start_time", 20), "timed_sunsky")).head
        .endsWith("`window_end_time` is before `window_start_time`")
    )

  private def near(a: Array[Float], b: Array[Float]): Boolean =
    a.lazyZip(b).forall((x, y) => Math.abs(x - y) < 1e-5f)

  private val Expected = Array(0.0513854f, 0.691748f, 0.720308f)
