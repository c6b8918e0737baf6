package candela.lights

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.image.ImageFiles
import candela.math.*
import candela.scenefile.Dialect
import candela.testing.SceneTexts

import java.nio.file.{Files, Path}

/** Photometric files: what they say of directions, what bad ones are told, and lights made from
  * them beside those of images.
  */
final class IesSuite extends AnyFunSuite:

  private def file(
      angles: (String, String),
      candelas: String,
      kind: Int = 1,
      head: String = "IESNA:LM-63-2002\n[TEST] lamp\nTILT=NONE",
      factors: String = "1",
      more: String = "1 1 50"
  ): String =
    def count(words: String) = words.split(" ").length
    s"""$head
       |1 1000 $factors ${count(angles._1)} ${count(angles._2)} $kind 2 0 0 0
       |$more
       |${angles._1}
       |${angles._2}
       |$candelas
       |""".stripMargin

  private def read(text: String): Photometry = IesFile.parse("lamp.ies", text).photometry

  private def polar(v: Double, h: Double): Vec3 =
    val (a, b) = (Math.toRadians(v), Math.toRadians(h))
    Vec3(
      (Math.sin(a) * Math.cos(b)).toFloat,
      -Math.cos(a).toFloat,
      (Math.sin(a) * Math.sin(b)).toFloat
    )

  private def near(found: Float, expected: Double): Assertion =
    assert(Math.abs(found - expected) < 0.01 * Math.abs(expected) + 0.01, s"$found, not $expected")

  test("type C counts from the nadir, interpolates, and is dark beyond its angles"):
    val light = read(file("0 30 90" -> "0", "100, 80\n0"))
    for (v, cd) <- Seq(0.0 -> 100.0, 15.0 -> 90.0, 30.0 -> 80.0, 60.0 -> 40.0, 91.0 -> 0.0) do
      for h <- Seq(0, 77, 200) do near(light(polar(v, h)), cd)
    val uplight = read(file("90 180" -> "0", "0 50"))
    near(uplight(Vec3(0, 1, 0)), 50)
    near(uplight(polar(135, 10)), 25)
    near(uplight(polar(80, 10)), 0)

  test("half, a quarter, and all of the planes are complete lights"):
    def around(planes: String, values: String) =
      val light =
        read(file("0 90 180" -> planes, values.split(" ").map(v => s"5 $v 5").mkString(" ")))
      (h: Double) => light(polar(90, h))
    val quarter = around("0 45 90", "10 20 30")
    for (h, cd) <- Seq(0 -> 10, 90 -> 30, 135 -> 20, 180 -> 10, 225 -> 20, 270 -> 30, 315 -> 20) do
      near(quarter(h), cd)
    val half = around("0 90 180", "10 20 40")
    for (h, cd) <- Seq(45 -> 15, 180 -> 40, 225 -> 30, 270 -> 20, 315 -> 15) do near(half(h), cd)
    val across = around("90 180 270", "10 20 40")
    for (h, cd) <- Seq(90 -> 10, 0 -> 20, 45 -> 15, 270 -> 40, 315 -> 30) do near(across(h), cd)
    val full = around("0 90 180 270 360", "10 20 30 40 10")
    for (h, cd) <- Seq(45 -> 15, 225 -> 35, 315 -> 25) do near(full(h), cd)
    val open = around("0 90 180 270", "10 20 30 40")
    for (h, cd) <- Seq(315 -> 25, 270 -> 40, 45 -> 15) do near(open(h), cd)

  test("types A and B look along +z; elevations turn the beam about other axes"):
    def dir(x: Double, y: Double, z: Double) = Vec3(x.toFloat, y.toFloat, z.toFloat).normalized
    val angles = "-90 0 90" -> "-90 0 90"
    // By plane, from below: −90°, 0°, 90°
    val values = "0 10 0  0 100 40  0 20 0"
    val a = read(file(angles, values, kind = 3))
    near(a(dir(0, 0, 1)), 100)
    near(a(dir(1, 0, 0)), 20)
    near(a(dir(-1, 0, 0)), 10)
    near(a(dir(0, 1, 1)), 70) // elevation 45°
    near(a(dir(0, 0, -1)), 0)
    val b = read(file(angles, values, kind = 2))
    near(b(dir(0, 0, 1)), 100)
    near(b(dir(0, 1, 1)), 70)
    near(b(dir(1, 0, 1)), 60)
    // Between planes: of type B, elevation 0 and 45° turn about x; of type A, azimuths about y
    val edge = dir(1, 1, Math.sqrt(2)) // elevations 30° (A) and 35.3° (B), across 35.3° and 30°
    near(b(edge), (1 - 30 / 90.0) * (100 - 60 * 35.26 / 90) + 30 / 90.0 * 20 * (1 - 35.26 / 90))
    near(a(edge), (1 - 35.26 / 90) * (100 - 60 * 30 / 90.0) + 35.26 / 90 * 20 * (1 - 30 / 90.0))
    val mirrored = read(file("0 90" -> "0 90", "100 0 20 0", kind = 2))
    near(mirrored(dir(-1, -1, Math.sqrt(2))), mirrored(dir(1, 1, Math.sqrt(2))))

  test("multiplier and ballast scale candelas; the factor behind counts in old files alone"):
    def straight(head: String) =
      read(file("0 90" -> "0", "100 0", head = head, factors = "2", more = "0.5 0.7 50"))(
        Vec3(0, -1, 0)
      )
    for head <- Seq("IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019") do
      near(straight(s"$head\nTILT=NONE"), 100)
    for head <- Seq("IESNA91\n[TEST] x", "A lamp of 1986") do
      near(straight(s"$head\nTILT=NONE"), 70)

  test("a table of tilts is skipped, with a word; negative candelas are dark"):
    val tilted = "IESNA:LM-63-2002\nTILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8"
    val light = IesFile.parse("lamp.ies", file("0 90" -> "0", "100 -1", head = tilted))
    near(light.photometry(Vec3(0, -1, 0)), 100)
    assert(
      light.notes == Vector(
        "lamp.ies:2: `TILT=INCLUDE` is ignored: the lamp is not tilted",
        "lamp.ies:11: negative candelas are read as 0"
      )
    )

  test("bad files are told line, expectation and finding"):
    def error(text: String) = intercept[IesError](IesFile.parse("lamp.ies", text)).getMessage
    val good = file("0 45 90" -> "0", "100 50 0")
    assert(error("IESNA:LM-63-2002\n1 2 3").startsWith("lamp.ies: expected a line `TILT=NONE`"))
    assert(
      error(good.replace("100 50 0", "100 fifty 0")) ==
        "lamp.ies:8: expected candela 2 of 3 in plane 1 of 1, found `fifty`"
    )
    assert(
      error(good.replace("100 50 0", "100 50")) ==
        "lamp.ies:8: expected candela 3 of 3 in plane 1 of 1, found the end of the file"
    )
    assert(error(good.replace("0 45 90", "0 95 90")).contains("lamp.ies:6: expected ascending"))
    assert(error(good.replace(
      " 1 2 0 0 0",
      " 7 2 0 0 0"
    )).contains("lamp.ies:4: expected the photo"))
    assert(error(good.replace(" 3 1 1 2", " -3 1 1 2")).contains("the number of vertical angles"))
    assert(error("").contains("TILT=NONE"))

  /** A floor below the light. */
  private def scene(isV4: Boolean, light: String): String =
    val matte = if isV4 then "\"diffuse\" \"rgb reflectance\"" else "\"matte\" \"rgb Kd\""
    val p = if isV4 then "point3" else "point"
    s"""LookAt 0 5 -5  0 .5 0  0 1 0
       |Camera "perspective" "float fov" 40
       |Film "${if isV4 then "rgb" else "image"}" "integer xresolution" 16 "integer yresolution" 16
       |Sampler "halton" "integer pixelsamples" 16
       |Integrator "path" "integer maxdepth" 1
       |WorldBegin
       |AttributeBegin
       |Translate 0 2 0
       |LightSource "goniometric" $light
       |AttributeEnd
       |Material $matte [.5 .5 .5]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "$p P" [-5 0 -5  5 0 -5  5 0 5  -5 0 5]
       |""".stripMargin

  private def inFolder(use: Path => Assertion): Assertion =
    val folder = Files.createTempDirectory("candela-ies")
    try use(folder)
    finally
      Files.list(folder).forEach(Files.delete)
      Files.delete(folder)

  test("a file lights a room as goniometric images of its distribution do, and by its power"):
    inFolder: folder =>
      val text = file(
        "0 20 40 60 90" -> "0 45 90",
        "900 700 400 90 0  900 800 500 100 0  900 500 100 50 0"
      )
      val ies = folder.resolve("Lamp.IES")
      Files.writeString(ies, text)
      val light = read(text)
      val square = folder.resolve("lamp-square.exr")
      val side = 512
      val map = candela.image.Image.rgb(side, side)
      for y <- 0 until side; x <- 0 until side; c <- 0 until 3 do
        val d = EqualAreaMap.toDirection((x + 0.5f) / side, (y + 0.5f) / side)
        map.data((y * side + x) * 3 + c) = light(Vec3(d.x, d.z, d.y))
      ImageFiles.write(square, map)
      val flat = folder.resolve("lamp-flat.exr")
      ImageFiles.write(flat, light.image)
      def seen(isV4: Boolean, of: Path, more: String = "") =
        val name = if isV4 then "filename" else "mapname"
        SceneTexts.mean(
          scene(isV4, s"\"string $name\" \"$of\" $more"),
          if isV4 then Dialect.V4 else Dialect.V3
        ).g
      // Pixels of 0.4°, nearest, beside 720 interpolated rows
      for more <- Seq("", "\"float power\" 500", "\"float scale\" 2 \"rgb I\" [.5 .5 .5]") do
        near(seen(isV4 = true, ies, more), seen(isV4 = true, square, more))
      near(seen(isV4 = false, ies), seen(isV4 = false, flat))
      near(seen(isV4 = true, ies), seen(isV4 = false, ies))
      // Straight below, 900 cd at 2 m on an albedo of 0.5
      assert(seen(isV4 = true, ies) > 1f)

  test("a bad file is an error with the place of its name, and a tilt a warning"):
    inFolder: folder =>
      val bad = folder.resolve("bad.ies")
      Files.writeString(bad, "IESNA:LM-63-2002\nTILT=NONE\n1 x")
      val problems =
        SceneTexts.problems(scene(isV4 = true, s"\"string filename\" \"$bad\""), Dialect.V4)
      assert(problems.size == 1 && problems.head.pos.map(_.line).contains(9))
      assert(problems.head.message.endsWith("bad.ies:3: expected the lumens of a lamp, found `x`"))
      val tilted = folder.resolve("tilted.ies")
      Files.writeString(tilted, file("0 90" -> "0", "100 0", head = "IESNA91\nTILT=lamp.til"))
      val notes =
        SceneTexts.problems(scene(isV4 = true, s"\"string filename\" \"$tilted\""), Dialect.V4)
      assert(notes.size == 1 && notes.head.message.contains("`TILT=lamp.til` is ignored"))
