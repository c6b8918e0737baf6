package candela.cli

import java.nio.file.{Files, Path}
import scala.jdk.StreamConverters.*

import candela.cli.terminal.ExitCode
import candela.image.ImageFiles
import candela.testing.TempFolder
import org.scalatest.funsuite.AnyFunSuite

/** All that `candela check` prints of `errors/missing/NAME.pbrt` is in `NAME.txt`, and what it
  * prints with `--keep-going` in `NAME.keep-going.txt`, if that helps.
  */
class MissingThingsSuite extends AnyFunSuite:

  private val folder = Path.of("src/test/resources/errors/missing")

  private def check(scene: Path, options: String*): (Int, String) =
    val captured = Captured()
    val code = Main.run(Seq("check") ++ options :+ scene.toString, captured.terminal)
    val separator = java.io.File.separator
    val text = (captured.err + captured.out).replace(s"$folder$separator", "missing/")
    (code, text.replace(s"files$separator", "files/").replace(s"`$folder`", "`missing`"))

  private val scenes =
    val all = Files.list(folder)
    try all.toScala(Vector).filter(_.toString.endsWith(".pbrt")).sorted
    finally all.close()

  private def expected(file: Path): String = Files.readString(file).replace("\r\n", "\n")

  test("there are scenes with all kinds of missing things"):
    assert(scenes.size >= 12)

  for scene <- scenes do
    val name = scene.getFileName.toString.stripSuffix(".pbrt")
    test(s"$name.pbrt is refused, with the message of $name.txt"):
      val (code, text) = check(scene)
      assert(text == expected(folder.resolve(s"$name.txt")))
      assert(code == ExitCode.BadInput.number)
    val kept = folder.resolve(s"$name.keep-going.txt")
    val outcome = if Files.exists(kept) then "accepted" else "refused"
    test(s"$name.pbrt with --keep-going is $outcome"):
      val (code, text) = check(scene, "--keep-going")
      if Files.exists(kept) then
        assert(text == expected(kept))
        assert(code == ExitCode.Done.number)
      else assert(code == ExitCode.BadInput.number)

  test("with --keep-going a sphere without its picture is magenta, and the summary says so"):
    TempFolder.use: folder =>
      val scene = folder.resolve("a.pbrt")
      val image = folder.resolve("a.exr")
      Files.writeString(
        scene,
        """Film "image" "integer xresolution" 4 "integer yresolution" 4
          |LookAt 0 0 3  0 0 0  0 1 0
          |Camera "perspective" "float fov" 20
          |WorldBegin
          |LightSource "infinite"
          |Texture "t" "spectrum" "imagemap" "string filename" "no.png"
          |Material "matte" "texture Kd" "t"
          |Shape "sphere"
          |WorldEnd
          |""".stripMargin
      ): Unit
      val captured = Captured()
      val args = Seq("--keep-going", "--spp", "1", "--outfile", image.toString, scene.toString)
      assert(Main.run(args, captured.terminal) == 0, captured.err)
      assert(captured.out.contains(", 1 placeholder\n"), captured.out)
      assert(captured.err.contains("no file `no.png`; using magenta"), captured.err)
      val pixels = ImageFiles.read(image)
      val middle = (0 until 3).map(c => pixels(2, 2, c))
      assert(middle(0) > 0.4f && middle(1) == 0f && middle(2) == middle(0), middle)
