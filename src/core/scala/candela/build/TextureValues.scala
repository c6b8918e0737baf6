package candela.build

import candela.diagnostics.SourcePos
import candela.build.recipe.Resources
import candela.build.textures.Textures
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.Vec3
import candela.scenefile.{Param, ParamType, SceneDescription}
import candela.settings.{ColorMode, RenderSettings}
import candela.textures.{GrayTexture, RgbTexture}

/** Textures of a description, by themselves: not filtered, as three numbers. */
object TextureValues:

  /** The last texture in linear sRGB, by u, v and the point in world space; None if it can't be
    * built.
    */
  def last(description: SceneDescription): Option[(Float, Float, Vec3) => Rgb] =
    val context = BuildContext(description, RenderSettings(color = ColorMode.Rgb))
    for t <- description.textures do
      Textures.define(t, context.stillSite(t.texture, t.textureToWorld, "a texture"))
    for
      t <- description.textures.lastOption if !context.problems.hasErrors
      texture <- named(t.name, t.valueType, context)
    yield
      val point = ShadingPoint()
      val basis = context.resources.basis
      (u, v, p) =>
        point.u = u
        point.v = v
        point.p = p
        val value = texture(point)
        if t.valueType == "float" then value else basis.toSrgb(value)

  private def named(name: String, kind: String, context: BuildContext): Option[RgbTexture] =
    val p = Param(
      ParamType.Texture,
      "",
      SourcePos.Nowhere,
      SourcePos.Nowhere,
      strings = Vector(name)
    )
    val resources: Resources = context.resources
    if kind == "float" then resources.floatTexture(p, context.problems).map(GrayTexture(_))
    else resources.rgbTexture(p, context.problems)
