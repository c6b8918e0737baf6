package candela.build

import candela.bsdf.{Material, MaterialFactory as Make}
import candela.color.Rgb

/** pbrt-v2's tables of measured reflectance. Where the file is missing pbrt-v2 says so and
  * renders a surface that reflects nothing; so do we.
  */
object Measured extends MaterialRecipe("measured", "a measured BRDF", onlyV2):
  private val filename = string("filename", "a .brdf file")("")
  protected def make()(using site: Site): Material =
    val path = site.declaration.folder.resolve(filename().replace('\\', '/'))
    if java.nio.file.Files.isRegularFile(path) then
      site.warn(s"material \"measured\" is not supported yet: ${Materials.instead}")
      Materials.default
    else
      site.warn(s"no file `${filename()}`: the surface is black, as pbrt-v2 renders it")
      Make.diffuse(candela.textures.ConstantRgb(Rgb.Black))
