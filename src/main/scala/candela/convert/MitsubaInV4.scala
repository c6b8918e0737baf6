package candela.convert

import candela.diagnostics.{Code, Problem}
import candela.io.SceneFolder
import scala.collection.mutable

import candela.scenefile.{
  Declaration, MaterialRef, Param, ParamType, SceneDescription, ShapeDescription
}

/** What only pbrt-v4, not v3, does otherwise than Mitsuba. */
private[convert] object MitsubaInV4:

  def converted(scene: SceneDescription): Converted =
    val lit = areaLights(MetalColors.inSpectra(scene))
    lit.copy(warnings = lit.warnings ++ SpectralColors.warning(lit.scene, "Mitsuba"))

  /** pbrt-v4 takes no light from shapes without a material. Glass of index 1 looks the same: rays
    * pass it unscattered.
    */
  private def areaLights(scene: SceneDescription): Converted =
    val named = scene.namedMaterials.toMap
    def isNull(s: ShapeDescription) =
      s.areaLight.isDefined && s.material.declared(named).exists(_.name == "interface")
    def clear(shapes: Vector[ShapeDescription]) = shapes.map: s =>
      if !isNull(s) then s
      else
        val position = s.shape.pos
        val index = Vector(Param.float("eta", position, 1f))
        val glass = Declaration("Material", "dielectric", index, position, s.shape.folder)
        s.copy(material = MaterialRef.Inline(glass))
    val shaded = scene.lights.find(l => Points(l.light.name))
    val warning = (scene.shapes ++ scene.objects.values.flatten).find(isNull).zip(shaded).map:
      (shape, point) =>
        Problem.warning(
          Code.Inexpressible,
          shape.shape.pos,
          "pbrt-v4 has no transparent area lights; this one casts shadows",
          Some(s"of the light at ${point.light.pos}")
        )
    Converted(
      scene.copy(
        shapes = clear(scene.shapes),
        objects = scene.objects.map((name, shapes) => name -> clear(shapes))
      ),
      warning.toVector
    )

  /** Lights that no ray hits by chance. */
  private val Points = Set("point", "spot", "distant", "projection", "goniometric")

  /** Numbers of coloured images are luminances in Mitsuba, means of channels in pbrt-v4. */
  def luminances(scene: SceneDescription, files: SideFiles): SceneDescription =
    scene.copy(textures = scene.textures.map: t =>
      val file = t.texture.param("filename")
        .filter(_ => t.valueType == "float" && t.texture.name == "imagemap")
      file.filter(RewrittenImages.isColored(t.texture, _)).fold(t): p =>
        val isRaw = t.texture.param("encoding").exists(_.strings.contains("linear"))
        val name = RewrittenImages.luminances(t.texture, p, isRaw, files)
        val params = t.texture.params.filterNot(_.name == "encoding")
          .map(q => if q eq p then p.withStrings(Vector(name)) else q)
        t.copy(texture = t.texture.copy(params = params)))

  /** pbrt-v4 decodes all 8-bit files but PNG as sRGB. */
  def images(scene: SceneDescription, files: SideFiles): Converted =
    val problems = Vector.newBuilder[Problem]
    val rewritten = mutable.HashMap.empty[(SceneFolder, String), String]
    def isMisread(d: Declaration, p: Param) =
      val isRaw = p.name == "normalmap" || p.name == "filename" && d.category == "Texture" &&
        d.param("encoding").exists(_.strings.contains("linear"))
      p.paramType == ParamType.String && isRaw
    def linear(d: Declaration, p: Param): Param =
      val name = rewritten.getOrElseUpdate(
        (d.folder, p.strings.head),
        RewrittenImages.raw(d.folder, p, files) match
          case Right(name) => name
          case Left(reason) =>
            problems += Problem.warning(
              Code.UnconvertedImage,
              p.pos,
              s"can't read the image, leaving it unchanged: $reason"
            )
            p.strings.head
      )
      p.withStrings(Vector(name))
    val result = Declarations.map(scene): d =>
      if !d.params.exists(isMisread(d, _)) then d
      else d.copy(params = d.params.map(p => if isMisread(d, p) then linear(d, p) else p))
    Converted(result, problems.result())
