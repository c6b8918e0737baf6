package candela.cli.commands

import candela.cli.FilmFilesSuite
import candela.job.{Cluster, ClusterFailure, ClusterService}
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

/** `--spark` without Spark: what the program itself does with the films of a cluster. */
class ClusterCommandSuite extends AnyFunSuite:

  private def withScene[A](name: String)(body: FilmFilesSuite.Folder => A): A =
    TempFolder.use: folder =>
      val text = FilmFilesSuite.text(FilmFilesSuite.Paths, "independent")
      val scene = Files.writeString(folder.resolve(name), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      body(FilmFilesSuite.Folder(folder, scene))

  test("image and film of a cluster are those of this machine"):
    withScene("s.pbrt"): f =>
      f.render("--spp", "5", "--outfile", f("a.exr"))
      f.render("--spp", "5", "--outfile", f("a.film"))
      f.render("--spp", "5", "--spark", "fake", "--outfile", s"${f("b.exr")},${f("b.film")}")
      assert(f.bytes("b.exr") == f.bytes("a.exr"))
      f.run(Vector("merge", f("b.film"), "--outfile", f("c.exr")))
      assert(f.bytes("c.exr") == f.bytes("a.exr"))
      f.run(Vector("resume", f("b.film"), "--spp", "9"))
      f.render("--spp", "9", "--outfile", f("a.exr"))
      assert(f.bytes("b.exr") == f.bytes("a.exr"))

  test("an image of some of the shards says so"):
    withScene("partial.pbrt"): f =>
      val words = Vector(f.scene, "--spp", "8", "--spark", "fake", "--shards", "4")
      val (code, captured) = f.captured(words ++ Vector("--outfile", f("b.exr")))
      assert(code == 130)
      assert(captured.out == s"interrupted: wrote ${f("b.exr")} with 6 of 8 samples per pixel\n")

  test("a sequence goes on after a scene that can't be rendered, and skips what is done"):
    withScene("s1.pbrt"): f =>
      for name <- Vector("s3", "slost", "s4") do
        val _ = Files.copy(f.folder.resolve("s1.pbrt"), f.folder.resolve(s"$name.pbrt"))
      val words = Vector(f("s%d.pbrt"), "--frames", "1-4", "--outfile", f("o%d.exr"))
      val (code, captured) = f.captured(words ++ Vector("--spark", "fake"))
      assert(code == 1)
      assert(captured.out.endsWith(s"\n4 scenes: 3 rendered, 1 failed (${f("s2.pbrt")})\n"))
      val _ = Files.copy(f.folder.resolve("s1.pbrt"), f.folder.resolve("s2.pbrt"))
      val again = f.run(words ++ Vector("--spark", "fake"))
      assert(again.endsWith("\n4 scenes: 1 rendered, 3 skipped (done already)\n"))
      val image = f.bytes("o4.exr")
      f.run(words) // skips all: the digests are the same
      f.run(words ++ Vector("--spp", "4", "--outfile", f("p%d.exr")))
      assert(f.bytes("p4.exr").size == image.size)

  test("a cluster's failure is a message, not a bug"):
    withScene("lost.pbrt"): f =>
      val failed = f.fail(Vector(f.scene, "--spark", "fake", "--outfile", f("a.exr")))
      assert(failed == "error: all machines are gone [E1007]\n")
      val broken = f.fail(Vector(f.scene, "--spark", "broken", "--outfile", f("a.exr")))
      assert(broken == "error: can't reach `broken` [E1007]\n start it\n")

  test("without Spark, the message says what is missing"):
    def failure(services: Iterator[ClusterService], master: String, home: Option[String] = None) =
      val environment = home.map("SPARK_HOME" -> _).toMap
      intercept[ClusterFailure](Cluster.connect(master, _ => (), environment, services)).getMessage
    val jar = failure(Iterator.empty, "local")
    assert(jar.contains("needs candela-spark.jar") && jar.contains("`./sbt cluster/sparkJar`"))
    def missing(master: String, home: Option[String] = None) =
      failure(Iterator.single(NoSpark), master, home)
    assert(missing("spark://a:7077").contains("SPARK_HOME is not set\nset SPARK_HOME to"))
    assert(missing("local[2]", Some("/nowhere")).contains("none in SPARK_HOME: `/nowhere`\n"))
    for master <- Vector("sparc://a:7077", "locals", "") do
      val text = missing(master, Some("/nowhere"))
      assert(
        text.startsWith(s"`$master` is no master of Spark\nexpected spark://HOST:PORT, "),
        text
      )

  private object NoSpark extends ClusterService:
    def connect(master: String, note: String => Unit): Cluster =
      throw NoClassDefFoundError("org/apache/spark/SparkConf")

  test("what a cluster can't do is refused"):
    withScene("s.pbrt"): f =>
      def usage(words: String*) =
        val (code, captured) = f.captured(f.scene +: words)
        assert(code == 2, captured.err)
        captured.err.linesIterator.next
      assert(usage("--shards", "3") == "error: --shards needs --spark MASTER [E0005]")
      val local = Vector("--checkpoint", "--time 5s", "--error 0.1", "--watch", "--report a.html")
      for option <- local do
        val words = Vector("--spark", "fake") ++ option.split(' ')
        val name = option.split(' ').head
        assert(usage(words*) == s"error: --spark can't be combined with $name [E0005]")
