package candela.settings

import candela.io.CacheFolder
import java.nio.file.Path

/** How image textures are cached; the image is the same.
  *
  * @param memory    for image textures, in bytes, if not a share of the heap
  * @param folder    of the files of tiles, if not the user's
  * @param folderSize bytes that these may take
  * @param isShared  whether the user's folder may be used
  */
final case class TextureControl(
    memory: Option[Long] = None,
    folder: Option[Path] = None,
    folderSize: Long = CacheFolder.UsualSize,
    isShared: Boolean = true
):
  /** The folder of files, if there is one. */
  def cache: Option[Path] = folder.orElse(if isShared then CacheFolder.userFolder() else None)
