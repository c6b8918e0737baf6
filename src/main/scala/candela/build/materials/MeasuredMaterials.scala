package candela.build

import java.nio.file.Files

import candela.bsdf.{Material, MaterialFactory}
import candela.color.Rgb
import candela.textures.ConstantRgb

/** pbrt-v2's tables of measured reflectance. Where the file is missing pbrt-v2 says so and renders
  * a surface that reflects nothing; so do we.
  */
object MeasuredTable extends MaterialRecipe("measured", "a measured BRDF, as a table", onlyV2):
  private val filename = string("filename", "a .brdf or .merl file", shown = "none")("")

  override def pending: Option[String] = Some(Materials.instead)
  override def pendingAt(site: Site): Option[String] =
    given Site = site
    if exists then pending else Some(s"no file `${filename()}`, so the surface is black")

  private def exists(using site: Site): Boolean =
    Files.isRegularFile(site.declaration.folder.resolve(filename().replace('\\', '/')))

  protected def make()(using site: Site): Material =
    if exists then Materials.default else MaterialFactory.diffuse(ConstantRgb(Rgb.Black))

object MeasuredBsdf
    extends MaterialRecipe("measured", "a measured BRDF, by Dupuy and Jakob", onlyV4)
    with GreyInstead:
  declare(string("filename", "a .bsdf file", shown = "none")(""))

object Fourier
    extends MaterialRecipe("fourier", "a measured or computed BSDF, as Fourier series", onlyV3)
    with GreyInstead:
  declare(string("bsdffile", "a .bsdf file", shown = "none")(""))
