package candela.cli.options

import candela.cli.terminal.ExitCode

/** What holds for all commands, for the pages of commands: Markdown whose links start at `docs`. */
private[cli] object Manual:

  /** Part of a page. */
  enum Part:
    case Paragraph(text: String)
    case Table(head: Vector[String], rows: Vector[Vector[String]])

  final case class Section(title: String, parts: Vector[Part])
  import Part.*

  /** What Candela is, in one sentence. */
  val Purpose: String = "physically based renderer for scenes of pbrt-v2, v3, v4 and Mitsuba 3"

  private def paragraphs(text: String): Vector[Part] =
    text.stripMargin.trim.split("\n\n").toVector.map(p => Paragraph(p.replace('\n', ' ')))

  private val output = paragraphs(
    """Without `--outfile` the scene's `Film` names the image, or else the scene file does, and a
      |`.png` preview is written next to each `.exr`. `--outfile` writes exactly the files that it
      |names: `x.exr,x.png` for both.
      |
      |Images are deterministic: they depend on the scene, the seed and the sample count, not on the
      |number of threads, and equal images are equal files, byte for byte, but for the entry
      |`rendering` of `--frames` and `--skip-done`: the digest that tells a second run what is done.
      |
      |Every file is replaced when its next version is complete, and never by an image without
      |samples: a full disk or a killed run leaves what was there. Links are followed; pipes and
      |devices are written to. No command writes to a file that it has read, and outputs that can't
      |be written are found before the rendering. Failing to write to standard output is an error,
      |too.
      |
      |Ctrl-C stops rendering and writes the partial image; a second Ctrl-C quits immediately.
      |
      |Pictures (`.png`, `.jpg`, `.qoi`, `.tga`) show the light by a
      |[tone curve](PICTURES.md); `.exr` and `.pfm` files always keep it linear."""
  )

  private val messages = paragraphs(
    """Error messages give the location (file, line, column and include chain), the source line, the
      |expected and the actual input, and the nearest known name. One run reports all errors of a
      |scene, the first twenty in full. Warnings with the same text are printed once, with the
      |number of places; `--verbose` prints all. Each message ends with its number, as `[E0201]`:
      |`candela explain E0201` says what it means and how it is cured, and
      |[PROBLEMS](PROBLEMS.md) has all.
      |
      |Missing files, types and objects are errors unless `--keep-going` is given, which replaces
      |them with placeholders; `convert` keeps the names of missing files, with a warning. Unknown
      |shapes, materials, area lights, volumes and accelerators of v2 and v3 scenes, many of them
      |from forks of pbrt, are always warnings, and replaced as in pbrt. Unsupported features are
      |always reported: a warning names the feature, its location in the file and the fallback.
      |Options without effect cause a warning.
      |
      |Messages are coloured on terminals only, and not if `NO_COLOR` is set. Control characters in
      |scenes, metadata and names of files are shown (`␛`, `<U+202E>`) instead of obeyed; a scene
      |that `convert` prints for another program is exact."""
  )

  private val codes = Vector(
    Table(
      Vector("exit code", "meaning"),
      ExitCode.values.toVector.map(c => Vector(c.number.toString, c.meaning))
    ),
    Paragraph("These are the exit codes of `candela`; `./sbt` exits with 1 on any failure.")
  )

  private val environment = Vector(
    Table(
      Vector("variable", "meaning"),
      Vector(
        Vector(
          "`CANDELA_JAVA`",
          "JDK that the launcher uses, its folder or its `java`, instead of the newest it finds"
        ),
        Vector("`JAVA_OPTS`", "more options of the JVM, such as `-Xmx8g`"),
        Vector(
          "`CANDELA_ARCHIVE`",
          "class archive for a fast start, written after the first run; `make`: write it now " +
            "and exit; `none`: neither write nor use it: [how start-up " +
            "works](decisions/0014-start-up.md)"
        ),
        Vector(
          "`CANDELA_OIDN`",
          "[Open Image Denoise](DENOISING.md), its library or the library's folder"
        ),
        Vector("`CANDELA_OPENEXR`", "OpenEXR's library, which reads rare kinds of EXR files"),
        Vector(
          "`PBRT_V3`, `PBRT_V4`, `MITSUBA`",
          "commands of other renderers, for `robustness` and the suites of `bench`"
        ),
        Vector(
          "`CANDELA_PROGRESS`",
          "`lines`: print progress four times a second, for programs that display it"
        ),
        Vector(
          "`CANDELA_PARENT`",
          "`stdin`: the program quits when standard input ends, as it does when the program that " +
            "started it is killed"
        ),
        Vector("`SPARK_HOME`", "[Apache Spark](CLUSTERS.md) for `--spark`"),
        Vector("`NO_COLOR`", "if it is not empty, messages and thumbnails have no colours"),
        Vector("`COLUMNS`", "width of the help and of tables, instead of the terminal's"),
        Vector("`https_proxy`", "proxy for the downloads of `./sbt`"),
        Vector("`JAVA_HOME`", "JDK of `./sbt`")
      )
    )
  )

  val sections: Vector[Section] = Vector(
    Section("Output files", output),
    Section("Messages", messages),
    Section("Exit codes", codes),
    Section("Environment variables", environment)
  )
