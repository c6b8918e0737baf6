package candela.build

import candela.scenefile.Declaration

import java.nio.file.Path

import scala.util.Try

/** Names statements for legends: type and place, such as `sphere scene.pbrt:12:7`. */
private[build] object StatementName:

  /** Files are named relative to the scene's folder, so that the name does not depend on where it
    * is, or is rendered from.
    */
  def apply(d: Declaration): String = s"${d.name} ${file(d)}:${d.pos.line}:${d.pos.column}"

  def file(d: Declaration): String =
    val file = Path.of(d.pos.file)
    val relative = Try(d.folder.relativize(file)).getOrElse(file.getFileName)
    relative.toString.replace('\\', '/')
