package candela.cli

import candela.aov.Layer
import candela.image.ImageFiles
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** From a scene's text over film files to images. */
class FilmFilesSuite extends AnyFunSuite:
  import FilmFilesSuite.*

  private def withScene[A](integrator: String = Paths, sampler: String = "independent")(
      body: Folder => A
  ): A =
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("s.pbrt"), text(integrator, sampler))
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\" \"float radius\" 3\n")
      body(Folder(folder, scene))

  private val methods = Map(
    "paths, splatted" -> Paths,
    "bidirectional paths" -> "\"bdpt\" \"integer maxdepth\" 3",
    "photons" -> "\"sppm\" \"integer maxdepth\" 3 \"float radius\" 0.3",
    "Markov chains" -> "\"mlt\" \"integer maxdepth\" 3 \"integer bootstrapsamples\" 500"
  )

  test("shards add up to the image of one machine, file for file, in any number and order", Slow):
    for
      (name, integrator) <- methods
      count <- Vector(2, 3, 13)
    do
      withScene(integrator): f =>
        f.render("--spp", "6", "--outfile", f("one.exr"))
        f.render("--spp", "6", "--outfile", f("one.film"))
        val shards = (0 until count).map(i => f(s"$i.film"))
        for i <- 0 until count do
          f.render("--spp", "6", "--shard", s"$i/$count", "--outfile", shards(i), "-j", "2")
        f.run(Vector("merge", "--outfile", f("all.exr")) ++ shards)
        assert(f.bytes("all.exr") == f.bytes("one.exr"), s"$name, $count shards")
        f.run(Vector("merge", "--outfile", f("all.film")) ++ shards.reverse)
        assert(f.bytes("all.film") == f.bytes("one.film"), s"$name, $count shards")

  test("all films that can't be merged are named, or left out on request"):
    withScene(): f =>
      for i <- 0 until 4 do
        f.render("--spp", "4", "--shard", s"$i/4", "--outfile", f(s"$i.film"))
      f.render("--spp", "4", "--shard", "2/4", "--seed", "5", "--outfile", f("foreign.film"))
      f.render("--spp", "4", "--shard", "0/4", "--outfile", f("double.film"))
      val bytes = Files.readAllBytes(Path.of(f("3.film")))
      val damaged = bytes.updated(bytes.length / 2, (bytes(bytes.length / 2) ^ 1).toByte)
      val _ = Files.write(Path.of(f("damaged.film")), damaged)
      val all = Vector("0", "1", "foreign", "double", "damaged", "missing").map(n => f(s"$n.film"))
      val why = f.fail(Vector("merge", "--outfile", f("x.exr")) ++ all)
      for name <- Vector("foreign", "double", "damaged", "missing") do
        assert(why.linesIterator.exists(l => l.startsWith("error") && l.contains(s"$name.film")))
      f.run(Vector("merge", "--partial", "--outfile", f("some.exr")) ++ all)
      f.run(Vector("merge", "--partial", f("0.film"), f("1.film"), "--outfile", f("two.exr")))
      assert(f.bytes("some.exr") == f.bytes("two.exr"))

  test("each frame has the number in its values of -D, and its films continue with it"):
    TempFolder.use: folder =>
      def f(name: String) = folder.resolve(name).toString
      val text = "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n" +
        "Sampler \"halton\" \"integer pixelsamples\" 1\nCamera \"perspective\"\nWorldBegin\n" +
        "LightSource \"infinite\" \"rgb L\" [ $x $x $x ]\n"
      val scene = Files.writeString(folder.resolve("s.pbrt"), text).toString
      val words = Vector(scene, "-Dx=%d", "--outfile", f("o%d.pfm"), "--checkpoint")
      val (code, said) = Captured.run((words :+ "--frames" :+ "2-6x2")*)
      assert(code == 0, said.err)
      for n <- Vector(2, 4, 6) do
        val data = ImageFiles.read(folder.resolve(s"o$n.pfm")).data
        assert(data.forall(x => Math.abs(x - n) < 1e-3 * n), n)
      assert(Files.notExists(folder.resolve("o3.pfm")))
      assert(Captured.run((words :+ "--frames" :+ "2-6x0")*)._1 == 2)

  test("more frames than can be listed are a wrong option"):
    withScene(): f =>
      for (first, size) <- Vector("1" -> "2147483647", "0" -> "2147483648") do
        val frames = s"$first-2147483647"
        val words = Vector(f("s%d.pbrt"), "--frames", frames, "--outfile", f("o%d.exr"))
        val (code, captured) = f.captured(words)
        assert(code == 2)
        assert(captured.err.contains(s"--frames must be at most 1000000 frames, found `$size`"))

  test("shards of millions that are missing are summed up"):
    withScene(): f =>
      f.render("--spp", "4", "--shard", "7/2147483647", "--outfile", f("7.film"))
      val why = f.fail(Vector("merge", "--outfile", f("x.exr"), f("7.film"))).linesIterator.next
      assert(why == "error: shards 0/2147483647 to 6/2147483647, " +
        "8/2147483647 to 2147483646/2147483647 are missing [E1005]")
      f.run(Vector("merge", "--partial", "--outfile", f("x.exr"), f("7.film")))

  test("a film without its scene says where it was"):
    withScene(): f =>
      f.render("--spp", "2", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      Files.delete(Path.of(f.scene))
      for command <- Vector(Vector("merge", "--outfile", f("b.exr")), Vector("resume")) do
        val why = f.fail(command :+ f("a.film")).linesIterator.toVector
        assert(
          why(0).startsWith("error: no such scene file: ") && why(0).contains("the scene of `")
        )
        assert(why(1) == " a film that is moved needs its scene in the same place beside it")

  test("layers are merged, too"):
    withScene(): f =>
      val layers = Vector("--spp", "5", "--aov", Layer.values.map(_.word).mkString(","))
      f.render(layers ++ Vector("--outfile", f("one.exr"))*)
      for i <- 0 until 3 do
        f.render(layers ++ Vector("--shard", s"$i/3", "--outfile", f(s"$i.film"))*)
      f.run(Vector("merge", f("2.film"), f("0.film"), f("1.film"), "--outfile", f("all.exr")))
      assert(f.bytes("all.exr") == f.bytes("one.exr"))
      assert(f.image("all.exr").channelNames.size > 20)

  test("brightness levels are merged and continued, too, and the image says that it is biased"):
    for integrator <- Vector(Paths, methods("bidirectional paths")) do
      withScene(integrator): f =>
        val mode = Vector("--fireflies", "reweight")
        f.render(mode ++ Vector("--spp", "6", "--outfile", f("one.exr"))*)
        for i <- 0 until 3 do
          val part = Vector("--spp", "6", "--shard", s"$i/3", "--outfile", f(s"$i.film"))
          f.render(mode ++ part*)
        f.run(Vector("merge", f("2.film"), f("0.film"), f("1.film"), "--outfile", f("all.exr")))
        assert(f.bytes("all.exr") == f.bytes("one.exr"))
        f.render(mode ++ Vector(
          "--spp", "2", "--checkpoint", f("a.film"), "--outfile", f("a.exr")
        )*)
        f.run(Vector("resume", f("a.film"), "--spp", "6"))
        assert(f.bytes("a.exr") == f.bytes("one.exr"))
        val about = new String(f.bytes("one.exr").toArray, "ISO-8859-1")
        assert(about.contains("Zirr, Hanika, Dachsbacher 2018") && about.contains("biased"))
        f.render("--spp", "6", "--outfile", f("plain.exr"))
        val plain = new String(f.bytes("plain.exr").toArray, "ISO-8859-1")
        assert(!plain.contains("biased") && !plain.contains("fireflies"))
        f.render("--spp", "6", "--shard", "0/3", "--outfile", f("x.film"))
        val why = f.fail(Vector("merge", f("x.film"), f("1.film"), "--outfile", f("x.exr")))
        assert(why.contains("--fireflies reweight"))

  test("missing, doubled and foreign shards are named, and fewer are merged on request"):
    withScene(): f =>
      for i <- 0 until 4 do f.render("--shard", s"$i/4", "--outfile", f(s"$i.film"))
      def merge(words: String*) =
        f.fail(Vector("merge", "--outfile", f("x.exr")) ++ words).linesIterator.next
      assert(merge(f("0.film"), f("2.film")) == "error: shards 1/4, 3/4 are missing [E1005]")
      val twice = merge((0 to 3).map(i => f(s"$i.film")) :+ f("1.film")*)
      assert(twice == s"error: shard 1/4 is given twice: `${f("1.film")}`, " +
        s"`${f("1.film")}` [E1005]")
      f.render("--shard", "3/4", "--seed", "5", "--outfile", f("seed.film"))
      val seeded = merge(f("0.film"), f("seed.film"))
      assert(seeded.endsWith("options `--seed 5` instead of none [E1002]"))
      f.render("--shard", "3/5", "--outfile", f("five.film"))
      val foreign = merge(f("0.film"), f("five.film"))
      assert(foreign.endsWith("number of shards 5 instead of 4 [E1002]"))
      assert(!Files.exists(Path.of(f("x.exr"))))
      val out =
        f.run(Vector("merge", "--partial", f("0.film"), f("2.film"), "--outfile", f("x.exr")))
      assert(out.startsWith(s"wrote ${f("x.exr")}  24x16, 2 spp"))
      assert(f.image("x.exr").data.exists(_ > 0.2f))

  test("more samples on a finished film are as many samples at once"):
    for sampler <- Vector("independent", "paddedsobol") do
      withScene(sampler = sampler): f =>
        f.render("--spp", "3", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
        f.render("--spp", "11", "--outfile", f("b.exr"))
        val short = f.bytes("a.exr")
        f.run(Vector("resume", f("a.film"), "--spp", "11"))
        assert(f.bytes("a.exr") != short)
        assert(f.bytes("a.exr") == f.bytes("b.exr"))
        f.run(Vector("resume", f("a.film"), "--time", "0.01s"))
        val reached = ImageSamples.of(f.bytes("a.exr"))
        assert(reached > 11)
        f.render("--spp", s"$reached", "--outfile", f("b.exr"))
        assert(f.bytes("a.exr") == f.bytes("b.exr"))
        val less = f.fail(Vector("resume", f("a.film"), "--spp", "5"))
        assert(less == s"error: `${f("a.film")}` has $reached samples per pixel already [E1004]\n")

  test("an error ends a rendering, and a lower one continues it"):
    withScene(): f =>
      val plain = Vector("--guiding", "off", "--sampler", "progressive", "--checkpoint")
      f.render(plain ++ Vector("--spp", "4096", "--error", "0.22", "--outfile", f("a.exr"))*)
      val few = ImageSamples.of(f.bytes("a.exr"))
      f.run(Vector("resume", f("a.film"), "--error", "0.04"))
      val many = ImageSamples.of(f.bytes("a.exr"))
      assert(few >= 8 && few < many && many < 4096, s"$few, $many")
      f.render("--spp", s"$many", "--sampler", "progressive", "--outfile", f("b.exr"))
      assert(f.bytes("a.exr") == f.bytes("b.exr"), many)

  test("samples that depend on their number can't be added, and the reason is given"):
    for (sampler, integrator) <-
        Vector("zsobol" -> Paths, "halton" -> Paths, "independent" -> methods("Markov chains"))
    do
      withScene(integrator, sampler): f =>
        f.render("--spp", "4", "--outfile", f("a.exr"), "--checkpoint", "--sampler", "scene")
        val why = f.fail(Vector("resume", f("a.film"), "--spp", "64"))
        assert(why.startsWith(s"error: can't change the 4 samples per pixel of `${f("a.film")}`: "))
        assert(why.endsWith("--checkpoint, N being the most you may want\n"))

  test("an existing film is continued, and one of another rendering is not overwritten"):
    withScene(): f =>
      f.render("--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val image = f.bytes("a.exr")
      assert(f.render("--checkpoint", f("a.film"), "--outfile", f("a.exr")).contains("continuing"))
      assert(f.bytes("a.exr") == image)
      val other =
        f.fail(Vector(f.scene, "--seed", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr")))
      assert(other.contains("belongs to another rendering: options none instead of `--seed 1`"))

  test("a scene that has changed is refused, by the name of the file"):
    withScene(): f =>
      f.render("--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val _ = Files.writeString(f.folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      for command <- Vector(Vector("resume"), Vector("merge", "--outfile", f("b.exr"))) do
        val why = f.fail(command :+ f("a.film"))
        assert(
          why.startsWith(s"error: the scene of `${f("a.film")}` has changed: `part.pbrt` differs")
        )

  test("comments, blanks and line breaks that are added to a scene's files change nothing"):
    withScene(): f =>
      f.render("--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      f.rewrite("s.pbrt")("# a comment\n\n" + _.replace("[ ", "[").replace(" ]", " # there\n]"))
      f.rewrite("part.pbrt")(_.replace("\" ", "\"\t\n") + "# the end")
      f.run(Vector("resume", f("a.film"), "--spp", "5"))
      f.rewrite("part.pbrt")(_.replace("3", "4"))
      val why = f.fail(Vector("resume", f("a.film"), "--spp", "6"))
      assert(why.contains("has changed: `part.pbrt` differs"), why)

  test("of an XML file, comments, blanks and the order of attributes change nothing"):
    val text = """<scene version="3.0.0"><default name="r" value="0.5"/>
                 |<include filename="part.xml"/>
                 |<sensor type="perspective"><film type="hdrfilm">
                 |<integer name="width" value="8"/><integer name="height" value="8"/></film>
                 |</sensor><emitter type="constant"/></scene>""".stripMargin
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("s.xml"), text)
      val part = """<scene version="3.0.0"><shape type="sphere"/></scene>"""
      val _ = Files.writeString(folder.resolve("part.xml"), part)
      val f = Folder(folder, scene)
      f.render("--spp", "2", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      f.rewrite("s.xml"):
        _.replace(
          "><",
          "> <!-- here -->\n\t<"
        ).replace("name=\"r\" value=\"0.5\"", "value='0.5' name='r'")
      f.rewrite("part.xml")(_.replace(" type", "\n type"))
      f.run(Vector("resume", f("a.film"), "--spp", "3"))
      f.rewrite("part.xml")(_.replace("sphere", "disk"))
      val why = f.fail(Vector("resume", f("a.film"), "--spp", "4"))
      assert(why.contains("has changed: `part.xml` differs"), why)

  test("where names with line numbers are saved, another line is another rendering"):
    for option <- Vector("--aov CryptoObject", "--aov CryptoMaterial", "--light-groups statement")
    do
      withScene(): f =>
        val words = option.split(" ").toVector ++
          Vector("--spp", "2", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
        f.render(words*)
        f.rewrite("s.pbrt")(_ + "# at the end, it moves nothing")
        f.run(Vector("resume", f("a.film"), "--spp", "3"))
        f.rewrite("s.pbrt")("# a line\n" + _)
        val why = f.fail(Vector("resume", f("a.film"), "--spp", "4"))
        assert(why.contains("has changed: `names with line numbers` differs"), why)

  test("a complete film that is run again has the error that it had"):
    withScene(): f =>
      val words = Vector("--spp", "16", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      def error(said: String) = "error [^\n]* %( \\([^)]*\\))?".r.findFirstIn(said)
      val first = error(f.render(words*))
      assert(first.nonEmpty)
      for _ <- 1 to 2 do
        assert(error(f.render(words*)) == first)
        assert(error(f.run(Vector("resume", f("a.film")))) == first)

  test("a damaged film is replaced by its previous copy; without one it is refused"):
    withScene(): f =>
      f.render("--spp", "3", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      f.run(Vector("resume", f("a.film"), "--spp", "9"))
      val image = f.bytes("a.exr")
      def damage(name: String) =
        val bytes = Files.readAllBytes(Path.of(f(name)))
        bytes(bytes.length / 2) = (bytes(bytes.length / 2) + 1).toByte
        val _ = Files.write(Path.of(f(name)), bytes)
      damage("a.film")
      val (code, captured) = f.captured(Vector("resume", f("a.film"), "--spp", "9"))
      assert(
        code == 0 && captured.err.contains("damaged: its checksum is wrong; using its previous")
      )
      assert(f.bytes("a.exr") == image)
      damage("a.film")
      damage("a.film.previous")
      assert(f.fail(Vector("resume", f("a.film"))).contains("nor its previous copy: it is damaged"))

  test("a film that can't be written is a warning and an exit code; the image is written"):
    withScene(): f =>
      val full = Path.of("/dev/full")
      assume(Files.exists(full), "needs a device that is always full")
      val _ = Files.createSymbolicLink(Path.of(f("a.film")), full)
      val (code, captured) = f.captured(Vector(f.scene, "--checkpoint", "--outfile", f("a.exr")))
      assert(code == 1 && captured.err.contains(s"can't write the film file `${f("a.film")}`"))
      assert(f.image("a.exr").width == 24)
      val (quietCode, quiet) =
        f.captured(Vector(f.scene, "--quiet", "--checkpoint", "--outfile", f("a.exr")))
      assert(quietCode == 1 && quiet.err.contains(s"error: can't write the film file"), quiet.err)

  test("options that contradict each other are refused"):
    withScene(): f =>
      def usage(words: String*) =
        val (code, captured) = f.captured(f.scene +: words)
        assert(code == 2, captured.err)
        captured.err.linesIterator.next
      assert(usage("--shard", "0/2").startsWith("error: --shard needs --outfile FILE.film"))
      assert(usage(
        "--shard",
        "2/2",
        "--outfile",
        "a.film"
      ).contains("must be i/n with 0 <= i < n"))
      assert(usage(
        "--frames",
        "1-2"
      ).startsWith("error: --frames needs %d, or %04d, for the number"))
      assert(usage("--checkpoint-every", "soon").contains("must be a duration, e.g. 90s"))
      assert(usage("--checkpoint", "--outfile", "a.film").contains("omit --checkpoint"))

private[cli] object FilmFilesSuite:
  val Paths = "\"path\" \"integer maxdepth\" 3"

  /** A scene of two files. */
  def text(integrator: String, sampler: String): String =
    s"""LookAt 0 0 -4  0 0 0  0 1 0
       |Camera "perspective" "float fov" 40
       |Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "sphere.exr"
       |Sampler "$sampler" ${if sampler == "stratified" then "" else "\"integer pixelsamples\" 4"}
       |Integrator $integrator
       |WorldBegin
       |LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
       |LightSource "point" "point3 from" [ 3 4 -5 ] "rgb I" [ 40 40 40 ]
       |Material "diffuse" "rgb reflectance" [ 0.8 0.4 0.2 ]
       |Shape "sphere" "float radius" 1
       |Translate 0 -1 0
       |Include "part.pbrt"
       |""".stripMargin

  /** A folder with a scene, and commands in it. */
  final class Folder(val folder: Path, file: Path):
    val scene: String = file.toString
    def apply(name: String): String = folder.resolve(name).toString
    def bytes(name: String): Vector[Byte] = Files.readAllBytes(folder.resolve(name)).toVector
    def image(name: String) = ImageFiles.read(folder.resolve(name))

    def captured(words: Seq[String]): (Int, Captured) =
      val captured = Captured()
      (Main.run(words, captured.terminal.out, captured.terminal.err), captured)

    /** Changes the text of a file. */
    def rewrite(name: String)(change: String => String): Unit =
      val file = folder.resolve(name)
      Files.writeString(file, change(Files.readString(file))): Unit

    /** Output and messages of a command that must succeed. */
    def run(words: Seq[String]): String =
      val (code, captured) = this.captured(words)
      assert(code == 0, captured.err)
      captured.err + captured.out

    def render(words: String*): String = run(scene +: words)

    /** Messages of a command that must fail because of its input. */
    def fail(words: Seq[String]): String =
      val (code, captured) = this.captured(words)
      assert(code == 1, captured.err)
      captured.err

/** The samples per pixel in an image's metadata. */
private object ImageSamples:
  def of(file: Vector[Byte]): Int =
    val text = String(file.toArray, "ISO-8859-1")
    "samplesPerPixel\u0000string\u0000....(\\d+)".r.findFirstMatchIn(text.replace('\n', '.')) match
      case Some(m) => m.group(1).toInt
      case None => throw AssertionError("no samplesPerPixel")
