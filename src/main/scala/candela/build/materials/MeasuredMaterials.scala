package candela.build

import candela.bsdf.Material

/** pbrt-v2's tables of measured reflectance. */
object MeasuredTable extends MaterialRecipe("measured", "a measured BRDF, as a table", onlyV2):
  private val filename = string("filename", "a .brdf or .merl file", shown = "none")("")

  override def pending: Option[String] = Some(Materials.instead)

  protected def make()(using site: Site): Material =
    val given_ = site.declaration.param("filename").filter(_ => filename().nonEmpty)
    val standIn = StandIns.MagentaSurface
    if given_.forall(site.resources.file(_, site.declaration, site.problems, standIn).nonEmpty)
    then Materials.default
    else StandIns.material(site.resources.basis)

object MeasuredBsdf
    extends MaterialRecipe("measured", "a measured BRDF, by Dupuy and Jakob", onlyV4)
    with GreyInstead:
  declare(string("filename", "a .bsdf file", shown = "none")(""))

object Fourier
    extends MaterialRecipe("fourier", "a measured or computed BSDF, as Fourier series", onlyV3)
    with GreyInstead:
  declare(string("bsdffile", "a .bsdf file", shown = "none")(""))
