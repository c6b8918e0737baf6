package packaging

import java.nio.file.Path
import java.util.Base64

/** Wheels: the program, and the Python module that runs it.
  *
  * Source: PyPA specifications, "Binary distribution format", 1.0.
  */
object Wheel {

  /** @param program files of the platform, with or without a Java runtime
    * @param module  files of the Python package, by their paths in it
    */
  def write(
      facts: Facts,
      platform: Platform,
      program: Seq[Entry],
      module: Seq[Entry],
      to: Path
  ): Unit = {
    val about = s"${facts.wheel.replace('-', '_')}-${facts.wheelVersion}"
    val (shared, rest) = program.partition(_.name.startsWith("share/"))
    val files = module.map(_.in("candela")) ++ rest.map(_.in("candela/program")) ++
      shared.map(_.in(s"$about.data/data")) ++
      Seq(
        // pip removes what it has installed: the class archives go to the user's cache
        Entry.text("candela/program/lib/archives", "The archives are in the user's cache.\n"),
        Entry.text(s"$about.dist-info/METADATA", metadata(facts)),
        Entry.text(s"$about.dist-info/WHEEL", wheel(platform)),
        Entry.text(
          s"$about.dist-info/entry_points.txt",
          s"[console_scripts]\n${facts.command} = candela.__main__:main\n"
        )
      )
    val name = s"$about.dist-info/RECORD"
    val record = files.sortBy(_.name).map(line).mkString + s"$name,,\n"
    ZipWriter.write(files :+ Entry.text(name, record), to)
  }

  private def line(entry: Entry): String = {
    val digest = ZipWriter.digest(entry.content.bytes)
    val sum = Base64.getUrlEncoder.withoutPadding.encodeToString(digest)
    val name = if (entry.name.contains(',')) "\"" + entry.name + "\"" else entry.name
    s"$name,sha256=$sum,${entry.content.bytes.length}\n"
  }

  private def metadata(facts: Facts): String =
    s"""Metadata-Version: 2.1
       |Name: ${facts.wheel}
       |Version: ${facts.wheelVersion}
       |Summary: ${facts.description}
       |Home-page: ${facts.homepage}
       |License: ${facts.licence}
       |Classifier: Programming Language :: Python :: 3
       |Classifier: Topic :: Multimedia :: Graphics :: 3D Rendering
       |Classifier: Typing :: Typed
       |Requires-Python: >=3.9
       |Provides-Extra: numpy
       |Requires-Dist: numpy>=1.20; extra == "numpy"
       |Description-Content-Type: text/markdown
       |
       |${facts.name} is a physically based renderer for pbrt-v2, v3, v4 and Mitsuba 3 scenes. This
       |package has the program `${facts.command}`, its Java runtime, and a module that returns
       |what it renders as arrays:
       |
       |```python
       |import candela
       |image = candela.render("scene.pbrt", spp=64, aov=["albedo", "depth"])
       |image.rgb        # height × width × 3, linear light
       |
       |scene = candela.load_dict({"type": "scene", "ball": {"type": "sphere"}, ...})
       |scene.parameters()["ball.radius"] = 2
       |scene.render(spp=64)
       |```
       |""".stripMargin

  private def wheel(platform: Platform): String =
    s"""Wheel-Version: 1.0
       |Generator: candela
       |Root-Is-Purelib: false
       |Tag: py3-none-${platform.wheelTag}
       |""".stripMargin
}
