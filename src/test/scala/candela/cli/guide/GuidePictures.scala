package candela.cli.guide

import candela.cli.Main
import candela.testing.TempFolder

import java.nio.file.{Files, StandardCopyOption}

/** Makes the pictures of docs/guide by the commands in its pages:
  * `./sbt "Test/runMain candela.cli.guide.GuidePictures"`; with names, such as `first.jpg`, only
  * these.
  */
object GuidePictures:
  def main(names: Array[String]): Unit =
    TempFolder.use: folder =>
      val pages = GuidePage.all
      val room = GuideRoom(folder, pages, small = false)
      for
        (file, commands) <- pages.flatMap(_.pictures)
        if names.isEmpty || names.exists(file.endsWith)
      do
        for command <- commands do
          val code = Main.run(room.arguments(command), System.out, System.err)
          require(code == 0, command)
        val target = GuidePage.Folder.resolve(file)
        val _ = Files.createDirectories(target.getParent)
        val _ = Files.copy(
          room.path(target.getFileName.toString),
          target,
          StandardCopyOption.REPLACE_EXISTING
        )
        println(s"wrote $target")
