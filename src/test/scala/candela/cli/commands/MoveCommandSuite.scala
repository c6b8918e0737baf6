package candela.cli.commands

import candela.cli.{Captured, MovedScene}
import candela.testing.{TempFolder, WebClient}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

@org.scalatest.tags.Slow
class MoveCommandSuite extends AnyFunSuite:

  test("the picture of a moved camera is what `render --camera` makes of the file it writes"):
    TempFolder.use: folder =>
      val moved = MovedScene(folder)
      assert(moved.statements.startsWith("Scale -1 1 1\nLookAt 0 -7 3  "))
      val moves = Vector(
        "move=orbit&x=0.1&y=0.05&begin=1", "move=pan&x=-0.05&y=0.1", "move=dolly&by=2",
        "move=fov&to=41.5", "move=focus&x=0.5&y=0.5", "move=lens&to=0.1"
      )
      for query <- moves do
        val before = moved.statements
        assert(moved.move(query).code == 200)
        assert(moved.statements != before, query)
      val picture = moved.refined()
      val saved = WebClient.post(s"${moved.link}save")
      assert(saved.code == 200 && moved.state("saved").str == s"${moved.file}")
      assert(Files.readString(moved.file).endsWith(moved.statements))
      assert(moved.rendered() == picture && picture.size == 3 * 40 * 30)
      assert(moved.end() == 0)

  test("a move is answered once its picture is there, which is small, and is refined then"):
    TempFolder.use: folder =>
      val moved = MovedScene(folder, samples = 1 << 20, args = Seq("--resolution", "1600x1200"))
      val version = moved.state("version").num
      assert(moved.move("move=orbit&x=0.1&y=0").code == 200)
      assert(moved.state("version").num > version && moved.state("samples").num < (1 << 20))
      // Moved again, while it is refined
      for _ <- 1 to 3 do assert(moved.move("move=orbit&x=0.02&y=0").code == 200)
      assert(moved.state("stage").str == "rendering" && moved.end() == 0)

  test("reset brings the scene's camera back; looking at a point keeps the eye"):
    TempFolder.use: folder =>
      val moved = MovedScene(folder)
      val first = moved.statements
      assert(moved.move("move=aim&x=0.6&y=0.45").code == 200)
      assert(
        moved.statements.startsWith("Scale -1 1 1\nLookAt 0 -7 3  ") && moved.statements != first
      )
      // The point is in the middle now
      val aimed = moved.statements
      assert(moved.move("move=aim&x=0.5&y=0.5").code == 200 && moved.statements == aimed)
      assert(moved.move("move=reset").code == 200 && moved.statements == first)
      assert(moved.end() == 0)

  test("what is no move is refused with a reason, and changes nothing"):
    TempFolder.use: folder =>
      val moved = MovedScene(folder)
      val first = moved.statements
      val wrong = Vector(
        "move=orbit&x=NaN&y=0" -> "`x` must be a number from -4.0 to 4.0",
        "move=orbit&x=1e9&y=0" -> "`x` must be a number from -4.0 to 4.0",
        "move=orbit&x=0" -> "`y` must be a number from -4.0 to 4.0",
        "move=pan&x=Infinity&y=0" -> "`x` must be a number from -4.0 to 4.0",
        "move=dolly&by=1e308" -> "`by` must be a number from -50.0 to 50.0",
        "move=fov&to=180" -> "`to` must be a number from 0.1 to 179.0",
        "move=lens&to=-1" -> "`to` must be a number from 0.0 to 1.0E9",
        "move=focus&x=1.5&y=0" -> "`x` must be a number from 0.0 to 1.0",
        "move=wander" -> "unknown move `wander`",
        "x=1" -> "`move` is missing"
      )
      for (query, why) <- wrong do
        val answer = moved.move(query)
        assert(answer.code == 400 && answer.text == why, query)
      val camera = s"${moved.link}camera?move=dolly&by=1"
      assert(WebClient.get(camera).code == 405)
      for origin <- Vector("http://example.org", "null", "http://127.0.0.1:1") do
        assert(WebClient.post(camera, "Origin" -> origin).code == 404, origin)
      val large = s"${moved.link}camera?move=dolly&by=1&x=${"1" * 10000}"
      assert(WebClient.post(large).code == 400)
      assert(moved.statements == first && moved.end() == 0)

  test("far moves end in a picture or a message, never without an answer"):
    TempFolder.use: folder =>
      val moved = MovedScene(folder, samples = 1)
      for _ <- 1 to 20 do assert(moved.move("move=dolly&by=50").code < 500)
      for _ <- 1 to 40 do assert(moved.move("move=dolly&by=-50").code < 500)
      assert(moved.move("move=orbit&x=0.1&y=0.1&begin=1").code < 500)
      assert(moved.move("move=reset").code == 200 && moved.end() == 0)

  test("elsewhere than on this machine, only those who have the link may move the camera"):
    TempFolder.use: folder =>
      val moved = MovedScene(folder, address = "0.0.0.0:0")
      val token = raw"http://[^/]+/([0-9a-f]{32})/".r
      val found = token.findFirstMatchIn(moved.link).map(_.group(1))
      assert(found.isDefined)
      val other = moved.link.replace(found.get, "0" * 32)
      assert(WebClient.post(s"${other}camera?move=dolly&by=1").code == 404)
      assert(moved.move("move=dolly&by=1").code == 200 && moved.end() == 0)

  test("the camera is not written over a file of the scene"):
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("a.pbrt"), MovedScene.Text)
      val (code, printed) = Captured.run("move", s"$scene", "--outfile", s"$scene", "--watch", "0")
      assert(code == 1)
      assert(printed.err.contains(s"the camera would be written over `$scene`"), printed.err)

  test("the camera is not written over an image"):
    val (code, printed) = Captured.run("move", "none.pbrt", "--outfile", "a.exr")
    assert(code == 1 && printed.err.startsWith("error: `a.exr` is the name of an image; "))
