package candela.growth

import candela.build.SceneBuilder
import candela.concurrency.Parallel
import candela.convert.{Converter, SceneText}
import candela.diagnostics.SceneError
import candela.job.Render
import candela.scenefile.{Dialect, Parser}
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import java.io.Writer
import java.nio.file.{Files, Path}

/** What is done to a scene. */
enum GrowingUse:
  /** Parsed and built. */
  case Build

  /** Parsed, converted and written as text. */
  case Convert

  /** What it does to a file. */
  def prepare(scene: Growing, file: Path, count: Int): () => AnyRef =
    val reading = ReadSettings(
      Option.when(Dialect.ofPbrt.contains(scene.dialect))(scene.dialect),
      defines = scene.defines(count)
    )
    def read() = Render.read(file, reading, BuildControl())
    this match
      case Build =>
        () =>
          // What is wrong with many statements takes time, too
          try
            val description = read()
            (SceneBuilder.build(description, RenderSettings(), pool = Parallel.Alone), description)
          catch case e: SceneError => e
      case Convert =>
        val to = if scene.dialect == Dialect.V4 then Dialect.V3 else Dialect.V4
        () =>
          try
            val folder = Files.createDirectories(file.resolveSibling("converted"))
            val converted = Converter.convert(Parser.validated(read()), to, folder)
            SceneText.write(converted.scene, Writer.nullWriter)
            converted
          catch case e: SceneError => e
