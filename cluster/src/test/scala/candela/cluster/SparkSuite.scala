package candela.cluster

import candela.cli.Main
import candela.testing.TempFolder

import org.scalatest.BeforeAndAfterAll
import org.scalatest.funsuite.AnyFunSuite

import java.io.{ByteArrayOutputStream, PrintStream}
import java.nio.file.{Files, Path}

/** Renderings on a real master with two workers, as users submit them. */
class SparkSuite extends AnyFunSuite with BeforeAndAfterAll:
  private lazy val folder = Files.createTempDirectory("candela-spark")
  private lazy val spark = StandaloneSpark(StandaloneSpark.home.toOption.get, folder)

  override def afterAll(): Unit =
    if StandaloneSpark.home.isRight then
      spark.close()
      TempFolder.delete(folder)

  private def sparkTest(name: String)(body: Path => Any): Unit =
    test(name):
      StandaloneSpark.home match
        case Left(why) =>
          info(s"skipped: $why")
          cancel(why)
        case Right(_) =>
          TempFolder.use: scenes =>
            SparkSuite.write(scenes)
            body(scenes)

  private def local(words: String*): Unit =
    val out = ByteArrayOutputStream()
    val stream = PrintStream(out)
    assert(Main.run(words, stream, stream) == 0, out.toString): Unit

  /** Renders on Spark, with `during`, and here: image and film must be equal. */
  private def same(folder: Path, spp: Int, conf: (String, String)*)(
      during: spark.Submission => Unit
  ): String = sameBy(folder, "s.pbrt", spp, conf.toMap)(during)

  private def sameBy(
      folder: Path,
      name: String,
      spp: Int,
      conf: Map[String, String] = Map.empty,
      how: Vector[String] = Vector.empty
  )(during: spark.Submission => Unit): String =
    val scene = folder.resolve(s"scenes/$name").toString
    val files = Vector("exr", "film").map(suffix => folder.resolve(s"a.$suffix"))
    val words = Vector(scene, "--spp", spp.toString, "--shards", "12", "--verbose") ++ how
    val run = spark.submit(words ++ Vector("--outfile", files.mkString(",")), conf)
    during(run)
    val (code, text) = run.result
    assert(code == 0, text)
    val here = Vector("--spp", spp.toString, "--outfile", folder.resolve("b.exr").toString)
    local((scene +: how) ++ here*)
    assert(Files.mismatch(files.head, folder.resolve("b.exr")) == -1, text)
    local("merge", files(1).toString, "--outfile", folder.resolve("c.exr").toString)
    assert(Files.mismatch(files.head, folder.resolve("c.exr")) == -1, text)
    text

  sparkTest("two workers render the image of this machine, file for file"): folder =>
    val text = same(folder, spp = 24)(_ => ())
    assert(text.contains("Spark: 2 executors, 15 tasks (0 failed)"), text)

  for how <- Vector("auto", "on", "photons") do
    sparkTest(s"light paths and photons bring the same on two workers: --caustics $how"): folder =>
      val text =
        sameBy(folder, "glass.pbrt", spp = 24, how = Vector("--caustics", how, "--explain"))(_ =>
          ()
        )
      assert(text.contains("caustics"), text)

  sparkTest("an executor that is killed while it renders changes nothing"): folder =>
    val text = same(folder, spp = 2000): run =>
      val _ = run.executor().destroyForcibly()
    assert(text.contains("Lost executor"), text)

  sparkTest("a machine that stands still is not waited for"): folder =>
    val conf = Vector(
      "spark.network.timeout" -> "20s",
      "spark.network.timeoutInterval" -> "5s",
      "spark.executor.heartbeatInterval" -> "1s"
    )
    var stopped = Option.empty[ProcessHandle]
    try
      val text = same(folder, spp = 2000, conf*): run =>
        stopped = Some(run.executor())
        stopped.foreach(signal("STOP", _))
      assert(text.contains("Spark: "), text)
    finally stopped.foreach(signal("KILL", _))

  sparkTest("films that arrive damaged are rendered again"): folder =>
    val tests = classOf[DamagingSerializer].getProtectionDomain.getCodeSource.getLocation
    val classes = Path.of(tests.toURI).toString
    val text = same(
      folder,
      spp = 24,
      "spark.serializer" -> "candela.cluster.DamagingSerializer",
      "spark.executor.extraClassPath" -> classes,
      "spark.driver.extraClassPath" -> classes
    )(_ => ())
    assert(text.contains("arrived damaged; rendering them again"), text)

  sparkTest("frames are rendered in one submission, each written when it is finished"): folder =>
    val scenes = folder.resolve("scenes")
    for i <- 1 to 3 if i != 2 do
      val _ = Files.copy(scenes.resolve("s.pbrt"), scenes.resolve(s"f$i.pbrt"))
    val sequence = Vector(s"$scenes/f%d.pbrt", "--frames", "1-3", "--spp", "8", "--outfile")
    val (code, text) = spark.submit(sequence :+ s"$folder/a%d.exr").result
    assert(code == 1 && text.contains("3 scenes: 2 rendered, 1 failed"), text)
    for i <- Vector(1, 3) do
      local(s"$scenes/f$i.pbrt", "--skip-done", "--spp", "8", "--outfile", s"$folder/b$i.exr")
      assert(Files.mismatch(folder.resolve(s"a$i.exr"), folder.resolve(s"b$i.exr")) == -1)

  sparkTest("an interrupted rendering writes what is complete"): folder =>
    val scene = folder.resolve("scenes/s.pbrt").toString
    val words = Vector(scene, "--spp", "20000", "--shards", "200", "--outfile")
    val run = spark.submit(words :+ s"$folder/a.exr")
    run.awaitText("render ") // at least a tenth
    signal("INT", run.process.toHandle)
    val (code, text) = run.result
    assert(code == 130 && text.contains("stopping; Ctrl-C again quits"), text)
    val done =
      s"wrote $folder/a.exr with (\\d+) of 20000".r.findFirstMatchIn(text).map(_.group(1).toInt)
    assert(done.exists(n => n > 0 && n < 20000), text)
    assert(Files.size(folder.resolve("a.exr")) > 1000)

  private def signal(name: String, process: ProcessHandle): Unit =
    val _ = ProcessBuilder("kill", s"-$name", process.pid.toString).start().waitFor()

private object SparkSuite:

  /** A glass ball on a table, under a small emitter. */
  private val glass =
    """LookAt 0 -5 3  0 0 .5  0 0 1
      |Camera "perspective" "float fov" 40
      |Film "rgb" "integer xresolution" 64 "integer yresolution" 48
      |Sampler "sobol" "integer pixelsamples" 4
      |Integrator "path" "integer maxdepth" 6
      |WorldBegin
      |LightSource "infinite" "rgb L" [ 0.02 0.03 0.04 ]
      |AttributeBegin
      |AreaLightSource "diffuse" "rgb L" [ 300 300 300 ]
      |Translate 2 1 4
      |Shape "sphere" "float radius" .1
      |AttributeEnd
      |Material "diffuse"
      |Shape "disk" "float radius" 5
      |Translate 0 0 .8
      |Material "dielectric"
      |Shape "sphere" "float radius" .7
      |""".stripMargin

  /** A scene with a file in a folder beside it. */
  def write(folder: Path): Unit =
    val _ = Files.createDirectories(folder.resolve("scenes"))
    val _ = Files.createDirectories(folder.resolve("parts"))
    val _ =
      Files.writeString(folder.resolve("parts/disk.pbrt"), "Shape \"disk\" \"float radius\" 3\n")
    Files.writeString(folder.resolve("scenes/glass.pbrt"), glass): Unit
    val _ = Files.writeString(
      folder.resolve("scenes/s.pbrt"),
      """LookAt 0 0 -4  0 0 0  0 1 0
        |Camera "perspective" "float fov" 40
        |Film "image" "integer xresolution" 64 "integer yresolution" 48 "string filename" "s.exr"
        |Sampler "random" "integer pixelsamples" 4
        |Integrator "bdpt" "integer maxdepth" 4
        |WorldBegin
        |LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
        |LightSource "point" "point from" [ 3 4 -5 ] "rgb I" [ 40 40 40 ]
        |Material "matte" "rgb Kd" [ 0.8 0.4 0.2 ]
        |Shape "sphere" "float radius" 1
        |Translate 0 -1 0
        |Include "../parts/disk.pbrt"
        |WorldEnd
        |""".stripMargin
    )
