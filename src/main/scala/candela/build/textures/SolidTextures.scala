package candela.build.textures

import candela.build.recipe.*
import candela.scenefile.Dialect
import candela.textures.Mapping3D

/** What textures through space have in common. */
private[build] object Solid:
  /** pbrt-v2 and v3 take the statement's transform itself from world to texture, not its
    * inverse.
    */
  def mapping(using site: Site): Mapping3D =
    Mapping3D(if site.dialect == Dialect.V4 then site.toWorld.inverse else site.toWorld)

  /** Asks for the footprint, by which octaves are left out. */
  def filtered(using site: Site): Mapping3D =
    site.resources.askForFootprints("solid textures")
    mapping
