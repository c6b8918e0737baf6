package candela.build.materials

import candela.diagnostics.Code
import candela.bsdf.{
  BumpMaterial, DiffuseMaterial, Material, NormalMapMaterial, SlopeBumpMaterial,
  SoftTerminatorMaterial
}
import candela.bsdf.composite.Edition
import candela.bsdf.microfacet.{Roughness, RoughnessModel}
import candela.build.recipe.*
import candela.build.textures.WrapModes
import candela.color.{Encoding, Rgb}
import candela.image.ImageBands
import candela.scenefile.{Declaration, Dialect, Param}
import candela.textures.{
  AffineUvMapping, FloatTexture, MadeTexels, Mapping2D, MipLevel, Texels, Wrap
}

import java.util.Locale
import scala.annotation.unused

/** Recipes of materials. */
object Materials:
  val all: Recipes[Material] = Recipes(
    "material",
    Vector(
      MatteRecipe,
      TranslucentRecipe,
      DiffuseRecipe,
      DiffuseTransmissionRecipe,
      PlasticRecipe,
      SubstrateRecipe,
      UberRecipe,
      DisneyRecipe,
      PrincipledRecipe,
      CoatedDiffuseRecipe,
      CoatedConductorRecipe,
      RoughPlasticRecipe,
      CoatingRecipe,
      ScatteringLayerRecipe,
      PhongRecipe,
      WardRecipe,
      RoughDiffuseRecipe,
      GlassRecipe,
      DielectricRecipe,
      ThinDielectricRecipe,
      MirrorRecipe,
      MetalRecipe,
      ShinyMetalRecipe,
      ConductorRecipe,
      SubsurfaceRecipe,
      KdSubsurfaceRecipe,
      HairRecipe,
      MeasuredTableRecipe,
      MeasuredBsdfRecipe,
      FourierRecipe,
      MixRecipe,
      TwoSidedRecipe,
      NestedRecipe,
      InterfaceRecipe("", sinceV3),
      InterfaceRecipe("none", sinceV3),
      InterfaceRecipe("interface", onlyV4),
      GltfRecipe
    )
  )

  /** Material of shapes without one, or with an unsupported one. */
  val default: Material =
    DiffuseMaterial(candela.textures.ConstantRgb(Rgb.gray(0.5f))).folded

  /** Names of the materials that a material may refer to. */
  def nestedNames(d: Declaration): Vector[String] =
    val references = Set("namedmaterial1", "namedmaterial2", "materials", "material")
    if !Set(MixRecipe, TwoSidedRecipe, NestedRecipe, CoatingRecipe).exists(_.name == d.name) then
      Vector.empty
    else d.params.filter(p => references(p.name)).flatMap(_.strings)

  def build(site: Site): Material =
    all
      .build(site)
      .orElse(Option.when(site.dialect != Dialect.V4)(site.of(MatteRecipe.name)).flatMap(all.build))
      .getOrElse(StandIns.material(site.resources.basis))

/** Base of material recipes.
  *
  * @param bumps whether the material supports bump mapping
  */
abstract class MaterialRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect],
    bumps: Boolean = true
) extends Recipe[Material](name, meaning, dialects):
  private val heights: Option[Field[FloatTexture]] = Option.when(bumps):
    floatTexture("bumpmap", "bump map height", untilV3, "scene units", "none")(0f)
  private val displacements: Option[Field[FloatTexture]] = Option.when(bumps):
    floatTexture("displacement", "bump map height", onlyV4, "scene units", "none")(0f)
  private val normals: Option[NormalMapFields] =
    Option.when(bumps)(NormalMapFields("", "normal map", onlyV4))
  private val edges: Option[Field[Boolean]] = Option.when(bumps):
    bool("softedges", "soften the terminator on bumps", onlyOthers)(true)
  private val turns: Option[Field[Boolean]] = Option.when(bumps):
    bool("turnednormals", "flip normals that face away", onlyOthers)(true)

  override protected def assemble(site: Site): Material =
    given Site = site
    val smooth = create().folded
    covered(relieved(smooth, normals).getOrElse:
      val height = if site.dialect == Dialect.V4 then displacements else heights
      height.fold(smooth)(field => bumped(smooth, field())))

  /** The material with what is above its bumps. */
  protected def covered(surface: Material)(using @unused site: Site): Material = surface

  /** The material with a normal map, if there is one. */
  protected final def relieved(smooth: Material, fields: Option[NormalMapFields])(using
      site: Site
  ): Option[Material] =
    for f <- fields; picture <- f() yield
      site.resources.askForRelief("normal maps")
      // What faces away is turned for each viewer, or at once
      val faces = site.rules.bumps == Bumps.Displaced
      val sides = Dialect.Gltf == site.rules.dialect
      raised(smooth, NormalMapMaterial(_, picture, f.mapping, faces, f.scale, sides))

  /** A constant height has no effect on normals. */
  private def bumped(smooth: Material, height: FloatTexture)(using site: Site): Material =
    if height.constant.isDefined then smooth
    else
      site.resources.askForRelief("bumps")
      // pbrt's finite differences
      val smallest = if site.dialect == Dialect.V2 then 0.01f else 0.0005f
      if site.rules.bumps == Bumps.Sloped then
        raised(smooth, SlopeBumpMaterial(_, height, smallest))
      else raised(smooth, BumpMaterial(_, height, smallest))

  private def raised(smooth: Material, relief: Material => Material)(using site: Site): Material =
    if site.rules.bumps == Bumps.Displaced then relief(smooth)
    else
      SoftTerminatorMaterial(
        smooth,
        relief,
        shadows = edges.forall(_()),
        turns = turns.forall(_())
      )

  /** Parameters of a normal map.
    *
    * @param prefix of their names
    * @param whose  what it is, in words
    */
  protected final class NormalMapFields(prefix: String, whose: String, dialects: Set[Dialect]):
    private val file = string(s"${prefix}normalmap", s"$whose image", dialects, shown = "none")("")
    private val uv = numbers(
      s"${prefix}normalmapuv",
      "float[6]",
      s"s and t of the $whose, by u, v and 1",
      if prefix.isEmpty then onlyOthers else dialects
    )
    private val strength =
      float(s"${prefix}normalscale", s"scale of the $whose's tangential components", onlyGltf)(1f)
    private val second =
      bool(s"${prefix}normaluv2", s"use the second set of u and v for the $whose", onlyGltf)(false)
    private val wrap =
      oneOf(s"${prefix}normalwrap", s"wrap mode of the $whose", WrapModes.Names, onlyGltf)("repeat")
    private val wrapDown = oneOf(
      s"${prefix}normalwrapt",
      "that along t, if it differs",
      WrapModes.Names,
      onlyGltf,
      shown = s"`${prefix}normalwrap`"
    )("")
    private val pyramid = Once[MipLevel]()

    def scale(using Site): Float = strength()
    def mapping(using Site): Mapping2D = AffineUvMapping.of(uv(), second())
    private def wrapping(using Site): Wrap = WrapModes.of(wrap(), wrapDown())

    /** The parameter, if it names an image. */
    def given_()(using site: Site): Option[Param] =
      file.given_().filter(_.nonEmpty).flatMap(_ => site.declaration.param(file.name))

    def apply()(using site: Site): Option[MipLevel] =
      for p <- given_(); map <- image(p) yield map

    private def image(p: Param)(using site: Site): Option[MipLevel] =
      // pbrt-v4 decodes 8-bit files, except for PNG
      val isPng = file().toLowerCase(Locale.ROOT).endsWith(".png")
      def decodes(encoding: Encoding) =
        val isDecoded = site.rules.decodesNormals && encoding != Encoding.Linear && !isPng
        if isDecoded then
          site.problems.warn(
            Code.AsInPbrt,
            p.pos,
            "pbrt-v4 decodes this normal map as sRGB; it reads PNG and EXR as they are"
          )
        isDecoded
      def texels(image: ImageBands) =
        Texels.color(image, if decodes(image.encoding) then Encoding.Srgb.decode(_) else identity)
      site.resources.textures.tiles match
        case Some(tiles) =>
          val ways = s"normals ${site.rules.decodesNormals && !isPng} $wrapping"
          for
            image <- site.resources.tiled(tiles, p, site, StandIns.Magentas, ways, wrapping):
              bands =>
                MadeTexels(texels(bands), None, bands.encoding, None)
          yield
            val _ = decodes(image.encoding)
            pyramid(image.levels(0))
        case None =>
          for stored <- site.resources.image(p, site.declaration, site.problems) yield
            val _ = decodes(stored.encoding)
            pyramid(MipLevel(texels(ImageBands.of(stored)).inMemory, wrapping))

/** Base of materials with the common roughness parameters.
  *
  * @param across dialects with separate roughness along u and v
  */
abstract class RoughRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect],
    default: Float,
    across: Set[Dialect] = sinceV3
) extends MaterialRecipe(name, meaning, dialects):
  private val isotropic =
    floatTexture("roughness", "surface roughness; 0: smooth", range = Range.nonNegative)(default)
  private val u = alongAxis("u")
  private val v = alongAxis("v")
  private val distribution =
    oneOf("distribution", "microfacets", Seq("ggx", "beckmann", "phong"), onlyMitsuba)("ggx")
  private val remap =
    bool("remaproughness", "remap roughness from [0, 1] to microfacet alpha", sinceV3)(true)

  private def alongAxis(axis: String) = Option.when(dialects.exists(d => across(d.base))):
    floatTexture(
      s"${axis}roughness",
      s"roughness along $axis",
      across,
      shown = "roughness",
      range = Range.nonNegative
    )(default)

  protected def roughness(smoothAtZero: Boolean = false)(using site: Site): Roughness =
    val model = site.dialect match
      case Dialect.V2 => RoughnessModel.BlinnExponent
      case Dialect.V3 =>
        if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf =>
        if site.rules.separates then
          distribution() match
            case "ggx" => RoughnessModel.SeparableGgx
            case "phong" => RoughnessModel.CosineAlpha
            case _ => RoughnessModel.Gaussian
        else if remap() then RoughnessModel.SquareRootAlpha
        else RoughnessModel.PlainAlpha
    val along = u.flatMap(_.given_()).getOrElse(isotropic())
    val sideways = v.flatMap(_.given_()).getOrElse(isotropic())
    Roughness(along, sideways, model, smoothAtZero)

/** Selects the formulas of pbrt-v2 or v3, which differ for some materials of the same name. */
private[build] def edition(dialect: Dialect): Edition =
  if dialect == Dialect.V2 then Edition.Second else Edition.Third
