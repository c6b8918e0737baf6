package candela.api

import candela.accel.tracing.Hierarchies
import candela.base.{SceneFolder, Version}
import candela.job.{SceneFormat, SceneLoader}

import java.nio.file.Path

/** Renders scenes of pbrt and Mitsuba. This is where to begin:
  * {{{
  * val scene = Candela.read(Path.of("scene.pbrt"))
  * Using.resource(scene.prepare(RenderSettings(samples = 64))): job =>
  *   job.render(threads = 8).image.save(Path.of("image.exr"))
  * }}}
  *
  * Nothing here prints, exits, changes properties of the JVM, or keeps state that callers share:
  * scenes and settings are immutable, and any number of jobs may be prepared and rendered at the
  * same time.
  */
object Candela:

  /** Reads a scene: `.pbrt` of any version, `.xml` of Mitsuba, or either packed as `.gz`.
    *
    * What is wrong with it is among [[Scene.problems]]; nothing is thrown.
    */
  def read(file: Path): Scene = read(file, ReadSettings())

  /** Reads a scene in another way than the usual one. */
  def read(file: Path, how: ReadSettings): Scene =
    Scenes.read(file.toString, how):
      SceneLoader.refusing(SceneLoader.readable(SceneLoader.existing(file.toString), how.of))

  /** Reads a scene of pbrt's format from a text; file names in it are relative to the current
    * folder.
    */
  def parse(text: String): Scene = parse(text, Path.of("scene.pbrt"), ReadSettings())

  /** Reads a scene from a text.
    *
    * @param name stands for the text in messages; no such file need exist. Its suffix tells the
    *             format (`.xml` is Mitsuba's), and names of files in the text are relative to its
    *             folder
    */
  def parse(text: String, name: Path, how: ReadSettings): Scene =
    Scenes.read(name.toString, how):
      val folder = how.of.limits.folder(name)
      val read = SceneLoader.refusing(SceneFormat.of(name).readText(name, text, folder, how.of))
      read.copy(unfiled = Vector(s"$name, a text" -> candela.base.Sha256.of(text)))

  /** Begins a scene in code, statement by statement; file names in it are relative to the current
    * folder.
    */
  def build(): SceneBuilder = build(Path.of(""))

  /** Begins a scene in code.
    *
    * @param folder that file names in it are relative to
    */
  def build(folder: Path): SceneBuilder = SceneBuilder("scene", SceneFolder(folder), None)

  /** The version, as `0.1.0`. */
  def version: String = Version.current

  /** Whether rays are traced by SIMD instructions, four or eight at a time; loads the JDK's Vector
    * API if it can. Images are the same without, and take up to twice as long.
    *
    * The API is there if the JVM is started by `--add-modules=jdk.incubator.vector`, or, which
    * prints no warning, by `--add-exports=java.base/jdk.internal.module=ALL-UNNAMED`.
    */
  def isVectorized: Boolean = Hierarchies.hasVectors
