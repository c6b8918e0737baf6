package candela.testing

import candela.io.CheckedFile
import candela.render.{Checkpointer, RenderState}

import java.nio.file.Path

/** Keeps the state of a rendering that is stopped in a file, and continues that of another. */
final class FileKeeper(from: Option[Path], to: Path) extends Checkpointer:
  def restore(state: RenderState): Unit = from.foreach(CheckedFile.read(_, "state")(state.load))
  def isDue: Boolean = false
  def save(state: RenderState): Unit = CheckedFile.write(to, "state")(state.save)
  def discard(): Unit = ()
  def finish(): Unit = ()
