package candela.api

import candela.base.Version
import candela.io.SceneFolder
import candela.accel.tracing.Hierarchies
import candela.job.{Render, SceneFormat, SceneName}

import java.nio.file.Path
import java.util.Objects

/** Renders scenes of pbrt and Mitsuba. Entry point of the library:
  * {{{
  * val scene = Candela.read(Path.of("scene.pbrt"))
  * Using.resource(scene.prepare(RenderSettings(samples = 64))): job =>
  *   job.render(threads = 8).image.save(Path.of("image.exr"))
  * }}}
  *
  * The library never prints or exits, and changes no JVM properties but those that LWJGL and
  * `java.desktop` set for themselves. Scenes and settings are immutable;
  * any number of jobs can be prepared and rendered at the same time.
  */
object Candela:

  /** Reads a scene: `.pbrt` of any version, `.xml` of Mitsuba, or either compressed as `.gz`.
    *
    * Errors are not thrown: [[Scene.problems]] lists all errors and warnings.
    *
    * @throws java.util.concurrent.CancellationException if the calling thread is interrupted
    */
  def read(file: Path): Scene = read(file, ReadSettings())

  /** Reads a scene with non-default settings. */
  def read(file: Path, how: ReadSettings): Scene =
    Objects.requireNonNull(file, "file")
    Scenes.read(file.toString, how): how =>
      Render.read(SceneName.existing(Problems.onDisk(file).toString), how.core, how.control)

  /** Reads a scene from a text, of pbrt's format or Mitsuba's XML; file names in it are relative to
    * the current folder.
    */
  def parse(text: String): Scene =
    Objects.requireNonNull(text, "text")
    val suffix = SceneFormat.of(Path.of("scene"), text).suffixes.head
    parse(text, Path.of(s"scene.$suffix"), ReadSettings())

  /** Reads a scene from a text.
    *
    * @param name name of the text in messages; the file need not exist. Its suffix determines the
    *             format (`.xml`: Mitsuba), unless the text is XML; file names in the text are
    *             relative to its folder
    */
  def parse(text: String, name: Path, how: ReadSettings): Scene =
    Objects.requireNonNull(text, "text")
    Scenes.read(name.toString, how): how =>
      Render.readText(Problems.onDisk(name), text, how.core, how.control)

  /** Builds a scene in code; file names in it are relative to the current folder. */
  def build(): SceneBuilder = build(Path.of(""))

  /** Builds a scene in code.
    *
    * @param folder base of relative file names
    */
  def build(folder: Path): SceneBuilder = SceneBuilder("scene", SceneFolder(folder), None)

  /** The version, as `0.1.0`. */
  def version: String = Version.current

  /** Whether rays are traced with SIMD instructions; loads the JDK's Vector API if possible.
    * Without it, images are the same and take up to twice as long.
    *
    * It needs the JVM option `--add-modules=jdk.incubator.vector`, or, without the JDK's warning,
    * `--add-exports=java.base/jdk.internal.module=ALL-UNNAMED`.
    */
  def isVectorized: Boolean = Hierarchies.hasVectors
