package candela.growth

import candela.diagnostics.SceneError

import java.nio.file.Path
import java.util.function.BiFunction

/** Writes a scene and returns its use, by classes of the JDK: these are the same in all loaders. */
final class GrowthEntry extends BiFunction[Array[String], Integer, Runnable]:
  def apply(words: Array[String], count: Integer): Runnable =
    val Array(name, dialect, action, folder) = words: @unchecked
    val scene = Growing.rows.find(s => s.name == name && s.dialect.toString == dialect).get
    val file = scene.write(Path.of(folder), count)
    val run = GrowingUse.valueOf(action).prepare(scene, file, count)
    () =>
      run() match
        case e: SceneError if !scene.isFaulty => throw e
        case _ => ()
