package candela.io

import java.io.{EOFException, IOException}
import java.nio.charset.CharacterCodingException
import java.nio.file.*
import java.util.zip.ZipException

/** Why a file can't be read, in words and without its name. */
object IoReason:

  def apply(e: IOException): String = e match
    case w: WriteError => w.getMessage
    case _: EOFException => Early
    case z: ZipException => packed(Option(z.getMessage).getOrElse(""))
    case _: CharacterCodingException => "it is not valid text in its encoding"
    case _: NoSuchFileException => "no such file"
    case _: FileAlreadyExistsException => "there is a file of this name"
    case _: NotDirectoryException => "it is a file, not a folder"
    case _: AccessDeniedException => "no read permission"
    case _: FileSystemLoopException => "its symbolic links form a loop"
    case f: FileSystemException =>
      Option(f.getReason).map(folder).getOrElse("the file system rejects it")
    case other => Option(other.getMessage).filter(_.nonEmpty).fold("reading fails")(folder)

  /** In our words, if it is one. */
  private def folder(why: String): String =
    if why.endsWith("Is a directory") then "it is a folder" else why

  private val Early = "it ends too early"

  /** ZLIB's and Java's messages are rarely more specific. */
  private def packed(message: String): String =
    if message.contains("end of ZLIB") then Early else "its compression is damaged"
