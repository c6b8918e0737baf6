package candela.cli

import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** A confined scene reads and writes in its own folder, whatever it tries. */
class SandboxSuite extends AnyFunSuite:
  import SandboxSuite.*

  for reference <- SandboxReferences.all do
    test(s"${reference.name} reads in the scene's folder only"):
      inFolder: f =>
        for (how, name, expected) <- f.ways(reference.file) do
          val scene = f.scene(s"s.${reference.suffix}", reference.text.replace("FILE", name))
          val (code, captured) = Captured.run("check", "--sandbox", scene.toString)
          val said = captured.err + captured.out
          assert(code == 1, s"$how: $said")
          assert(said.contains(s"$scene:"), s"$how: $said")
          assert(said.contains(expected), s"$how: $said")
          assert(!said.contains("SECRET"), s"$how: $said")

  test("what exists outside is not told from what does not, and no names are suggested"):
    inFolder: f =>
      def said(name: String) =
        val text = s"WorldBegin\nInclude \"$name\"\n"
        Captured.run("check", "--sandbox", f.scene("s.pbrt", text).toString)._2.err
          .replace(name, "NAME")
      assert(said("../secret.pbrt") == said("../secrets.pbrt"))
      assert(said("/etc/passwd") == said("/etc/passwt"))
      assert(said("up/secret.pbrt") == said("up/secrets.pbrt"))

  test("a file outside hides no other error"):
    inFolder: f =>
      def errors(name: String, text: String, words: String*) =
        val all = Vector("check", "--sandbox", f.scene(name, text).toString) ++ words
        val (code, captured) = Captured.run(all*)
        assert(code == 1, captured.err)
        captured.err.linesIterator.filter(_.contains(": error")).toVector
      val pbrt =
        """WorldBegin
          |Texture "a" "spectrum" "imagemap" "string filename" "../a.png"
          |Texture "b" "spectrum" "imagemap" "string filename" "../b.png"
          |Material "diffuse" "texture reflectance" "a"
          |Shape "spere"
          |Shape "plymesh" "string filename" "../a.ply"
          |""".stripMargin
      for keeps <- Vector(Vector.empty, Vector("--keep-going")) do
        val told = errors("s.pbrt", pbrt, keeps*)
        for line <- Vector(2, 3, 6) ++ Option.when(keeps.isEmpty)(5) do
          assert(told.exists(_.contains(s"s.pbrt:$line:")), told)
      val included = errors("s.pbrt", s"WorldBegin\nInclude \"../a.pbrt\"\nShape \"spere\"\n")
      assert(included.exists(_.contains(":2:")) && included.exists(_.contains(":3:")), included)
      val xml =
        """<scene version="3.0.0">
          |<shape type="obj"><string name="filename" value="../a.obj"/></shape>
          |<shape type="serialized"><string name="filename" value="../a.serialized"/></shape>
          |<shape type="spere"/>
          |</scene>""".stripMargin
      val told = errors("s.xml", xml)
      for line <- 2 to 4 do assert(told.exists(_.contains(s"s.xml:$line:")), told)

  test("files within the folder are read by any name: absolute, through `..`, through links"):
    inFolder: f =>
      val _ = Files.writeString(f.home.resolve("part.pbrt"), "Shape \"sphere\"\n")
      val _ = Files.createSymbolicLink(f.home.resolve("inner.pbrt"), Path.of("part.pbrt"))
      for name <- Vector("part.pbrt", "../home/part.pbrt", s"${f.home}/part.pbrt", "inner.pbrt") do
        val scene = f.scene("s.pbrt", s"WorldBegin\nInclude \"$name\"\n")
        val (code, captured) = Captured.run("check", "--sandbox", scene.toString)
        assert(code == 0, s"$name: ${captured.err}")

  test("the scene itself must be a regular file of its folder"):
    inFolder: f =>
      val link = Files.createSymbolicLink(f.home.resolve("l.pbrt"), Path.of("../secret.pbrt"))
      f.fifo("p.pbrt")
      for name <- Vector(link.toString, f.home.resolve("p.pbrt").toString) do
        val (code, captured) = Captured.run("check", "--sandbox", name)
        assert(code == 1 && !captured.err.contains("SECRET"), captured.err)
        val told = Vector("expected a file in the scene's folder", "expected a regular file")
        assert(told.exists(captured.err.contains), captured.err)

  test("convert and preview are confined, too"):
    inFolder: f =>
      val text = SandboxReferences.all.find(_.name == "infinite of v3").get.text
      for (how, name, expected) <- f.ways("exr") do
        val scene = f.scene("s.pbrt", text.replace("FILE", name)).toString
        for command <- Vector(Vector("convert", "--to", "v4"), Vector("preview")) do
          val (code, captured) = Captured.run((command ++ Vector("--sandbox", scene))*)
          assert(code == 1 && captured.err.contains(expected), s"$how: ${captured.err}")

  test("rendering refuses a scene whose first statement names a file elsewhere"):
    inFolder: f =>
      for (how, name, expected) <- f.ways("pbrt") do
        val scene = f.scene("s.pbrt", s"Include \"$name\"\n${film("o.exr")}").toString
        val (code, captured) = Captured.run("--sandbox", scene)
        assert(code == 1 && captured.err.contains(expected), s"$how: ${captured.err}")
        assert(captured.err.contains(s"$scene:1:9"), s"$how: ${captured.err}")

  test("images of confined scenes go to the scene's folder, or to that of --outfile"):
    inFolder: f =>
      val scene = f.scene("s.pbrt", film("o.exr"))
      val (code, captured) = Captured.run("--sandbox", scene.toString)
      assert(code == 0, captured.err)
      assert(Files.exists(f.home.resolve("o.exr")) && Files.exists(f.home.resolve("o.png")))
      val other = Files.createDirectory(f.root.resolve("other"))
      val words = Vector("--sandbox", scene.toString, "--outfile", s"$other/x.exr")
      assert(Captured.run(words*)._1 == 0)
      assert(Files.exists(other.resolve("x.exr")))
      assert(Captured.run("preview", "--sandbox", scene.toString)._1 == 0)
      assert(Files.exists(f.home.resolve("s-preview.png")))

  test("no output of a confined scene leaves the folder of the image"):
    inFolder: f =>
      val before = f.outside
      def link(name: String, to: String) =
        Files.createSymbolicLink(f.home.resolve(name), Path.of(to)): Unit
      link("new.exr", "../new.exr")
      link("a.film", "../a.film")
      link("page.html", "../page.html")
      f.fifo("pipe.exr")
      val named = Vector(
        "../x.exr" -> "expected an image in the scene's folder, found a path through `..`",
        "a/../../x.exr" -> "expected an image in the scene's folder, found a path through `..`",
        s"${f.root}/x.exr" -> "expected an image in the scene's folder, found an absolute path",
        "/dev/null" -> "expected an image in the scene's folder, found an absolute path",
        "link.exr" -> "the image must be in the folder of the image",
        "new.exr" -> "the image must be in the folder of the image",
        "up/x.exr" -> "the image must be in the folder of the image",
        "pipe.exr" -> "the image must be in the folder of the image"
      )
      for (name, expected) <- named do
        val scene = f.scene("s.pbrt", film(name))
        val (code, captured) = Captured.run("--sandbox", scene.toString)
        assert(code == 1 && captured.err.contains(expected), s"$name: ${captured.err}")
        assert(captured.err.contains(s"$scene:1:"), s"$name: ${captured.err}")
      val scene = f.scene("s.pbrt", film("o.exr")).toString
      val options = Vector(
        Vector("--outfile", s"${f.home}/link.exr"),
        Vector("--outfile", s"${f.home}/new.exr"),
        Vector("--outfile", s"${f.home}/pipe.exr"),
        Vector("--outfile", s"${f.home}/o.exr", "--report", s"${f.root}/r.html"),
        Vector("--outfile", s"${f.home}/o.exr", "--report", s"${f.home}/page.html"),
        Vector("--outfile", s"${f.home}/o.exr", "--checkpoint", s"${f.root}/c.film"),
        Vector("--outfile", s"${f.home}/o.exr", "--checkpoint", s"${f.home}/a.film"),
        Vector("--report", s"${f.root}/r.json"),
        Vector("--shard", "0/2", "--outfile", s"${f.home}/a.film")
      )
      for words <- options do
        val (code, captured) = Captured.run(("--sandbox" +: scene +: words)*)
        assert(code == 1 && captured.err.contains("in the folder of the image"), captured.err)
      val errors = "Option \"string msereferenceimage\" \"r.exr\"" +
        s" Option \"string msereferenceout\" \"../errors.txt\"\n${film("o.exr")}"
      val _ = Files.copy(f.root.resolve("secret.exr"), f.home.resolve("r.exr"))
      val (code, captured) = Captured.run("--sandbox", f.scene("s.pbrt", errors).toString)
      assert(code == 1 && captured.err.contains("in the folder of the image"), captured.err)
      assert(captured.err.contains("s.pbrt:1:"), captured.err)
      assert(f.outside == before)

  test("a film names no scene, no image and no options beyond its folder"):
    inFolder: f =>
      val scene = f.scene("s.pbrt", film("o.exr")).toString
      val other = Files.createDirectory(f.root.resolve("other"))
      val saved = s"$other/x.film"
      assert(Captured.run(scene, "--shard", "0/1", "--outfile", saved)._1 == 0)
      for words <- Vector(
          Vector("resume", "--sandbox", saved, "--spp", "2"),
          Vector("merge", "--sandbox", saved, "--outfile", s"$other/y.exr")
        )
      do
        val (code, captured) = Captured.run(words*)
        assert(code == 1 && captured.err.contains("expected a file in the scene's folder"), words)
      val own = f.home.resolve("x.film").toString
      assert(Captured.run(scene, "--shard", "0/1", "--outfile", own)._1 == 0)
      val merged = Captured.run("merge", "--sandbox", own, "--outfile", s"${f.home}/y.exr")
      assert(merged._1 == 0, merged._2.err)

  test("without a sandbox, files outside of the folder are quoted only if they are scenes"):
    inFolder: f =>
      def said(name: String, text: String) =
        val (code, captured) = Captured.run("check", f.scene(name, text).toString)
        assert(code == 1, captured.err)
        captured.err + captured.out
      // Not read by `check`
      val others = Set("reference image", "Mitsuba's path")
      for reference <- SandboxReferences.all.filterNot(r => others(r.name)) do
        val name = s"../secret.${reference.file}"
        val err = said(s"s.${reference.suffix}", reference.text.replace("FILE", name))
        assert(!err.contains("SECRET"), s"${reference.name}: $err")
        assert(err.contains(s"s.${reference.suffix}:"), s"${reference.name}: $err")
      val _ = Files.writeString(f.root.resolve("good.pbrt"), "Identity\nShape \"sphere\" SECRET\n")
      assert(said("s.pbrt", "WorldBegin\nInclude \"../good.pbrt\"\n").contains("`SECRET`"))
      val _ = Files.writeString(f.home.resolve("own.pbrt"), "SECRET\n")
      assert(said("s.pbrt", "WorldBegin\nInclude \"own.pbrt\"\n").contains("`SECRET`"))

object SandboxSuite:
  def film(name: String): String =
    s"""Film "rgb" "string filename" "$name" "integer xresolution" 4 "integer yresolution" 4
       |Sampler "independent" "integer pixelsamples" 1
       |Camera "perspective"
       |WorldBegin
       |LightSource "infinite"
       |""".stripMargin

  /** What the files outside of the scene's folder hold. */
  private val Secret = "SECRET:x:0:0:root:/root:/bin/sh\n"

  private val Kinds = SandboxReferences.all.map(_.file).distinct.filter(_.nonEmpty)

  final class Folders(val root: Path):
    val home: Path = root.resolve("home")

    def scene(name: String, text: String): Path = Files.writeString(home.resolve(name), text)

    def fifo(name: String): Unit =
      val code = ProcessBuilder("mkfifo", home.resolve(name).toString).start().waitFor()
      assert(code == 0)

    /** Names of what a scene may not read, with the message. */
    def ways(kind: String): Vector[(String, String, String)] =
      val outside = "expected a file in the scene's folder, found"
      def name(stem: String) = if kind.isEmpty then stem else s"$stem.$kind"
      if !Files.exists(home.resolve(name("pipe"))) then fifo(name("pipe"))
      val all = Vector(
        ("a path through `..`", s"../${name("secret")}", outside),
        ("a path through folders that don't exist", s"no/../../${name("secret")}", outside),
        ("an absolute path", s"$root/${name("secret")}", outside),
        ("backslashes", s"..\\\\${name("secret")}", outside),
        ("what does not exist", s"../${name("missing")}", outside),
        ("a link", name("link"), outside),
        ("a link to nowhere", name("dangling"), outside),
        ("a link to a folder", s"up/${name("secret")}", outside),
        ("a device", "/dev/zero", outside),
        ("standard input", "/dev/stdin", outside),
        ("the process", "/proc/self/environ", outside),
        ("a pipe", name("pipe"), "expected a regular file, found a pipe or a device")
      )
      // XML has no escapes
      if kind.isEmpty then all.filterNot(_._1 == "backslashes") else all

    /** Files outside of the scene's folder. */
    def outside: Map[String, Long] =
      TempFolder.names(root).map(n => n -> Files.getLastModifiedTime(root.resolve(n)).toMillis)
        .filterNot(_._1 == "home").toMap

  def inFolder[A](body: Folders => A): A = TempFolder.use: folder =>
    val f = Folders(folder.toRealPath())
    val _ = Files.createDirectory(f.home)
    val _ = Files.createSymbolicLink(f.home.resolve("up"), Path.of(".."))
    val _ = Files.createDirectory(f.root.resolve("secret"))
    val _ = Files.createSymbolicLink(f.home.resolve("link"), Path.of("../secret"))
    val _ = Files.createSymbolicLink(f.home.resolve("dangling"), Path.of("../missing"))
    for kind <- Kinds do
      val _ = Files.writeString(f.root.resolve(s"secret.$kind"), Secret)
      val _ = Files.createSymbolicLink(f.home.resolve(s"link.$kind"), Path.of(s"../secret.$kind"))
      val _ =
        Files.createSymbolicLink(f.home.resolve(s"dangling.$kind"), Path.of(s"../missing.$kind"))
    val _ = Files.writeString(f.home.resolve("lens.dat"), "35 2 1.5 20\n0 2 0 10\n-35 50 1 20\n")
    body(f)
