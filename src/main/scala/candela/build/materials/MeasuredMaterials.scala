package candela.build

import candela.bsdf.{ConstantMaterial, FourierBsdf, Material}

/** pbrt-v2's measured reflectance. */
object MeasuredTable extends MaterialRecipe("measured", "a measured BRDF, as a table", onlyV2):
  private val filename = string("filename", "a .brdf or .merl file", shown = "none")("")

  protected def make()(using site: Site): Material =
    site.declaration.param("filename").filter(_ => filename().nonEmpty) match
      case None => MeasuredTable.unnamed
      case Some(p) =>
        val made =
          for
            path <-
              site.resources.file(p, site.declaration, site.problems, StandIns.MagentaSurface)
            bsdf <- BrdfFile.read(
              path,
              s =>
                site.resources.basis.fromSrgb(
                  Spectra.toRgb(s, SpectrumRole.Reflectance, site.dialect)
                )
            ) match
              case Right(b) => Some(b)
              case Left(why) =>
                val message = s"`${filename()}`: $why"
                site.problems.missing(p.valuesAt, message, StandIns.MagentaSurface)
                None
          yield ConstantMaterial(bsdf)
        made.getOrElse(StandIns.material(site.resources.basis))

  private[build] def unnamed(using site: Site): Material =
    site.error("\"measured\" needs a `filename`")
    Materials.default

object MeasuredBsdf
    extends MaterialRecipe("measured", "a measured BRDF, by Dupuy and Jakob", onlyV4):
  private val filename = string("filename", "a .bsdf file", shown = "none")("")
  override def pending: Option[String] = Some(Materials.instead)
  protected def make()(using Site): Material =
    if filename().isEmpty then MeasuredTable.unnamed else Materials.default

object Fourier
    extends MaterialRecipe("fourier", "a measured or computed BSDF, as Fourier series", onlyV3):
  private val bsdffile = string("bsdffile", "a .bsdf file", shown = "none")("")

  protected def make()(using site: Site): Material =
    site.declaration.param("bsdffile").filter(_ => bsdffile().nonEmpty) match
      case None =>
        site.error("\"fourier\" needs a `bsdffile`")
        Materials.default
      case Some(p) =>
        val made =
          for
            path <-
              site.resources.file(p, site.declaration, site.problems, StandIns.MagentaSurface)
            table <- BsdfFile.read(path) match
              case Right(t) => Some(t)
              case Left(why) =>
                val message = s"`${bsdffile()}`: $why"
                site.problems.missing(p.valuesAt, message, StandIns.MagentaSurface)
                None
          yield ConstantMaterial(FourierBsdf(table))
        made.getOrElse(StandIns.material(site.resources.basis))
