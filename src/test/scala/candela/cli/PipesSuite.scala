package candela.cli

import candela.fuzz.{FilmValue, FilmValues}
import candela.image.{Image, ImageFiles}
import candela.testing.{Pipes, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** No pipe or device is opened that the user has not named as a stream: it might never end. */
class PipesSuite extends AnyFunSuite:
  private val Irregular = "it is no regular file, but a pipe or a device"

  private def withScene(body: FilmFilesSuite.Folder => Any): Any =
    TempFolder.use: folder =>
      assume(Pipes.make(folder.resolve("pipe")), "needs mkfifo")
      val text = FilmFilesSuite.text(FilmFilesSuite.Paths, "independent")
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      body(FilmFilesSuite.Folder(folder, scene))

  private def refused(f: FilmFilesSuite.Folder)(words: String*): String =
    Pipes.unblocked(f.fail(words))

  test("a pipe is no film, and no previous copy of one"):
    withScene: f =>
      f.render("--spp", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val _ = Files.write(Path.of(f("a.film")), Array[Byte](1, 2, 3))
      assert(Pipes.make(Path.of(f("a.film.previous"))))
      for
        words <- Vector(
          Vector("merge", f("a.film"), "--outfile", f("b.exr")),
          Vector("merge", "--partial", f("a.film"), "--outfile", f("b.exr")),
          Vector("resume", f("a.film")),
          Vector(f.scene, "--spp", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
        )
      do
        val why = refused(f)(words*)
        val ofReader = s"nor its previous copy: $Irregular"
        val ofWriter = s"found a pipe or a device: `${f("a.film.previous")}`"
        assert(why.contains(if words.head == "merge" then ofReader else ofWriter), why)
      val _ = f.render("--spp", "1", "--outfile", f("c.film"))
      assert(Pipes.make(Path.of(f("new.film"))))
      for
        words <- Vector(
          Vector(f.scene, "--outfile", f("new.exr"), "--checkpoint"),
          Vector(f.scene, "--outfile", f("new.exr"), "--checkpoint", f("new.film")),
          Vector(f.scene, "--outfile", f("new.film")),
          Vector("merge", f("c.film"), "--outfile", f("new.film")),
          Vector("resume", f("new.film"))
        )
      do
        val why = refused(f)(words*)
        assert(why.contains("expected a regular file for the film, found a pipe"), why)
      val why = refused(f)("merge", f("pipe"), "--outfile", f("b.exr"))
      assert(why == s"error: can't read `${f("pipe")}`: $Irregular [E1001]\n")

  test("the scene of a film is a regular file"):
    withScene: f =>
      f.render("--spp", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val values = FilmValues.of(Files.readAllBytes(Path.of(f("a.film"))))
      for scene <- Vector(f("pipe"), "/dev/zero") if Files.exists(Path.of(scene)) do
        // After the mark and the version
        val forged = FilmValues.bytes(values.updated(2, FilmValue.Text(scene)))
        val _ = Files.write(Path.of(f("forged.film")), forged)
        for words <- Vector(Vector("resume"), Vector("merge", "--outfile", f("b.exr"))) do
          val why = refused(f)(words :+ f("forged.film")*)
          assert(why.contains(s"`$scene`, the scene of `${f("forged.film")}`: $Irregular"), why)

  test("a pipe in a folder of images is none of them"):
    withScene: f =>
      val images = Files.createDirectory(f.folder.resolve("images"))
      ImageFiles.write(images.resolve("a.png"), Image.rgb(4, 4))
      assert(Pipes.make(images.resolve("b.png")))
      val said = Pipes.unblocked(f.run(Vector("compare", s"$images", s"$images")))
      assert(said.contains("a.png") && !said.contains("b.png"))

  private val header = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 "

  private def sceneOf(f: FilmFilesSuite.Folder, text: String, film: String = ""): String =
    val options = Vector("Sampler \"independent\" \"integer pixelsamples\" 1", header + film)
    val lines = options ++ Vector("WorldBegin", "LightSource \"infinite\"", text)
    Files.writeString(f.folder.resolve("t.pbrt"), lines.mkString("\n")).toString

  test("what a scene names is no device, no pipe and nothing that the kernel makes"):
    withScene: f =>
      val made = "no regular file, but made by the kernel as it is read"
      val other = "no regular file, but a pipe or a device"
      for
        (name, what) <- Vector("/dev/zero" -> other, "/dev/null" -> other, "pipe" -> other) ++
          Vector("." -> "a folder", "/proc/self/stat" -> made, "/proc/kmsg" -> made)
        if Files.exists(f.folder.resolve(name))
        text <- Vector(
          s"Shape \"plymesh\" \"string filename\" \"$name\"",
          s"Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"$name\"",
          s"LightSource \"infinite\" \"string filename\" \"$name\"",
          s"Include \"$name\""
        )
      do
        val why = Pipes.unblocked(f.fail(Vector("check", sceneOf(f, text))))
        assert(why.contains(what) && !why.contains("did you mean"), s"$text: $why")
        assert(why.linesIterator.next.contains("t.pbrt:5:"), why)

  test("a scene's image and its preview go to no pipe; one that the user names does"):
    withScene: f =>
      val film = s"\"string filename\" \"${f("pipe.exr")}\""
      assert(Pipes.make(Path.of(f("pipe.exr"))))
      val why = refused(f)(sceneOf(f, "", film))
      assert(why.contains("t.pbrt:2:") && why.contains("expected a regular file for the image"))
      assert(Pipes.make(Path.of(f("new.png"))))
      val preview = s"\"string filename\" \"${f("new.exr")}\""
      val said = Pipes.unblocked(f.run(Vector(sceneOf(f, "", preview))))
      assert(said.contains(s"no preview is written: `${f("new.png")}` is no regular file"))
      assert(f.image("new.exr").width == 4)
      val out = s"\"string msereferenceout\" \"${f("pipe")}\""
      val errors = s"Option \"string msereferenceimage\" \"${f("new.exr")}\"\nOption $out\n"
      val scene = sceneOf(f, "")
      val _ = Files.writeString(Path.of(scene), errors + Files.readString(Path.of(scene)))
      val lines = refused(f)(scene, "--outfile", f("b.exr"))
      assert(lines.contains("t.pbrt:2:") && lines.contains("regular file for the list of errors"))

  test("a reference image is a regular file, as it may be read more than once"):
    withScene: f =>
      val words = Vector(f.scene, "--outfile", f("a.exr"), "--report", f("r.csv"))
      val why = refused(f)(words ++ Vector("--reference", f("pipe"))*)
      assert(why == s"error: can't read the reference `${f("pipe")}`: $Irregular [E0103]\n")

  test("a scene that comes through a pipe is rendered, but not saved: it can be read once"):
    withScene: f =>
      val text = Files.readString(Path.of(sceneOf(f, "")))
      val v3 = text.replace("independent", "random").replace("rgb", "image") + "\nWorldEnd\n"
      val worlds = v3 + v3.substring(v3.indexOf("WorldBegin"))
      def rendered(text: String, words: String*) =
        val writer = Thread(() => Files.writeString(Path.of(f("pipe")), text): Unit)
        writer.setDaemon(true)
        writer.start()
        Pipes.unblocked(f.captured(f("pipe") +: words))
      assert(rendered(text, "--outfile", f("a.exr"))._1 == 0)
      for words <- Vector(Vector("--checkpoint"), Vector("--skip-done")) do
        val (code, captured) = rendered(text, Vector("--outfile", f("b.exr")) ++ words*)
        assert(code == 1 && captured.err.contains("write the scene to a file first"), captured.err)
      val (code, captured) = rendered(worlds, "--outfile", f("w%d.exr"))
      assert(code == 1 && captured.err.contains(s"can't read world 2 of `${f("pipe")}`"))
      assert(f.image("w1.exr").width == 4)
