package candela.cli

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** Scenes of one command line whose images have one name. */
class SeveralScenesSuite extends AnyFunSuite:

  private val world = "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n"
  private def film(name: String) =
    s"Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 $name\n" +
      "Sampler \"independent\" \"integer pixelsamples\" 1\n"

  /** Writes scenes, and fails to render them; returns the message. */
  private def refused(scenes: (String, String)*)(words: String*): String =
    TempFolder.use: folder =>
      for (name, text) <- scenes do
        val file = folder.resolve(name)
        val _ = Files.createDirectories(file.getParent)
        val _ = Files.writeString(file, text)
      val before = TempFolder.names(folder)
      val (code, captured) =
        Captured.run((scenes.map((name, _) => folder.resolve(name).toString) ++ words)*)
      assert(code == 1, captured.out)
      assert(TempFolder.names(folder) == before && captured.out.isEmpty)
      captured.err.replace(s"$folder/", "")

  test("scenes of one image are refused before the first is rendered"):
    TempFolder.use: folder =>
      val image = s"\"string filename\" \"$folder/x.exr\""
      val why = refused(
        "a.pbrt" -> (film(image) + world),
        "b.pbrt" -> (film("") + world),
        "c.pbrt" -> (film(image) + world)
      )()
      assert(why.contains("the image of `c.pbrt` would overwrite that of `a.pbrt`"), why)

  test("so are scenes that name none and have one name"):
    val text = film("") + world
    val why = refused("a/x.pbrt" -> text, "b/x.pbrt" -> text)()
    assert(why.contains("the image of `b/x.pbrt` would overwrite that of `a/x.pbrt`: x.exr"), why)

  test("previews that would overwrite one another are refused, too"):
    TempFolder.use: folder =>
      for name <- Vector("a", "b") do
        val _ = Files.createDirectory(folder.resolve(name))
        val _ = Files.writeString(folder.resolve(name).resolve("x.pbrt"), film("") + world)
      val (code, captured) = Captured.run("preview", s"$folder/a/x.pbrt", s"$folder/b/x.pbrt")
      assert(code == 1 && captured.err.contains("would overwrite that of"), captured.err)
      assert(!Files.exists(Path.of("x-preview.png")))

  test("a warning of all frames of a scene is printed once"):
    TempFolder.use: folder =>
      val odd = film("") + "WorldBegin\nShape \"sphere\" \"float odd\" [ $x ]\n" +
        "LightSource \"infinite\"\n"
      val scene = Files.writeString(folder.resolve("s.pbrt"), odd).toString
      val words = Seq(scene, "--frames", "1-3", "-Dx=%d", "--outfile", s"$folder/%d.pfm")
      val (code, captured) = Captured.run(words*)
      assert(code == 0 && captured.err.split("`odd`", -1).length == 2, captured.err)

  test("frames whose films name one image are refused before the first is rendered"):
    TempFolder.use: folder =>
      for n <- 1 to 3 do
        val name = s"\"string filename\" \"$folder/${if n == 2 then 2 else 1}.exr\""
        val _ = Files.writeString(folder.resolve(s"s$n.pbrt"), film(name) + world)
      val (code, captured) = Captured.run(s"$folder/s%d.pbrt", "--frames", "1-3")
      assert(code == 1 && captured.err.contains("would overwrite that of"), captured.err)
      assert(!Files.exists(folder.resolve("1.exr")))

  test("a scene that can't be read does not hide this, nor stop the others"):
    TempFolder.use: folder =>
      val good = Files.writeString(
        folder.resolve("a.pbrt"),
        film(s"\"string filename\" \"$folder/a.exr\"") + world
      )
      val (code, captured) = Captured.run(s"$folder/none.pbrt", good.toString)
      assert(code == 1 && captured.err.contains("no such scene file"), captured.err)
      assert(Files.exists(folder.resolve("a.exr")))

  test("missing scenes are told of before the first is rendered"):
    TempFolder.use: folder =>
      def scene(name: String, text: String) = Files.writeString(folder.resolve(name), text).toString
      val faulty = scene("a.pbrt", film("") + "WorldBegin\nShape \"spere\"\n")
      val (code, captured) = Captured.run(faulty, s"$folder/none.pbrt")
      assert(code == 1)
      val places = Vector("none.pbrt", "spere").map(captured.err.indexOf)
      assert(places.head >= 0 && places.head < places.last, captured.err)
      assert(captured.out.contains("2 failed"), captured.out)

  test("a checkpoint without its suffix is no scene, unless there is one by its name"):
    TempFolder.use: folder =>
      def scene(name: String) =
        val text = film(s"\"string filename\" \"$folder/$name.exr\"") + world
        Files.writeString(folder.resolve(name), text).toString
      val (code, captured) = Captured.run(scene("a.pbrt"), "--checkpoint", s"$folder/state.chk")
      assert(code == 2 && captured.err.contains(
        s"--checkpoint needs a name that ends with .film, found `$folder/state.chk`"
      ))
      assert(!Files.exists(folder.resolve("a.pbrt.exr")))
      assert(Captured.run("--checkpoint", scene("state"))._1 == 0)
      val (missing, named) = Captured.run("--checkpoint", s"$folder/b.pbrt")
      assert(missing == 1 && named.err.contains("no such scene file"), named.err)
