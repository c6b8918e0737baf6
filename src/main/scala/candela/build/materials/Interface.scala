package candela.build.materials

import candela.bsdf.{InterfaceMaterial, Material}
import candela.build.recipe.*
import candela.scenefile.Dialect

/** The edge of a medium. */
final class InterfaceRecipe(name: String, dialects: Set[Dialect])
    extends MaterialRecipe(name, "no surface: light passes straight on", dialects, bumps = false):
  protected def make()(using Site): Material = InterfaceMaterial
