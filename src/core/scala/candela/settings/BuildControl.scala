package candela.settings

import candela.diagnostics.Limit
import candela.io.Keep

/** How a scene is read and built: none of it is an image's identity.
  *
  * @param limits     what the scene may do
  * @param threads    that build it
  * @param isRendered whether it is rendered, for which a thread prepares
  * @param samples    per pixel to take, if not as many as the points are made for
  * @param footprint  size of a sample's footprint, in pixels, if not that of their number
  * @param world      which of the file's worlds, from 0; none: the first, with a warning if there
  *                   are others
  * @param textures   how image textures are cached
  * @param cache      has the meshes, textures and tables of other scenes
  * @param stages     is told of long stages
  */
final case class BuildControl(
    limits: SceneLimits = SceneLimits(),
    threads: Int = 1,
    isRendered: Boolean = true,
    samples: Option[Int] = None,
    footprint: Option[Float] = None,
    world: Option[Int] = Some(0),
    textures: TextureControl = TextureControl(),
    cache: Keep = Keep.Nothing,
    stages: BuildStages = BuildStages.Silent
):
  /** As the limits allow. */
  def limited: BuildControl = copy(
    // Untrusted scenes write nothing that their user did not ask for
    textures = textures.copy(isShared = !limits.sandbox),
    // What a limited scene may use is counted as it is made
    cache = if (limits.effective - Limit.Time).isEmpty then cache else Keep.Nothing
  )

/** Told of the stages before rendering that may take long. */
abstract class BuildStages:
  /** Runs a stage. */
  def during[A](stage: String)(body: => A): A

object BuildStages:
  object Silent extends BuildStages:
    def during[A](stage: String)(body: => A): A = body
