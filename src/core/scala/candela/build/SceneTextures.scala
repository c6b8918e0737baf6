package candela.build

import candela.build.recipe.LaterTextures
import candela.build.textures.Textures
import candela.scenefile.TextureDescription

/** Defines the textures of a scene. */
private[build] final class SceneTextures(all: Vector[TextureDescription]):
  private lazy val indices: Map[(String, String), Int] =
    all.zipWithIndex.map((t, i) => (Textures.kind(t), t.name) -> i).toMap

  def define(context: BuildContext): Unit = all.indices.foreach(define(context, _))

  private def define(context: BuildContext, index: Int): Unit =
    val t = all(index)
    Textures.define(t, context.stillSite(t.texture, t.textureToWorld, "a texture"))

  /** In another context, each once it is asked for. */
  def in(context: BuildContext): LaterTextures = new LaterTextures:
    def indexOf(kind: String, name: String): Int = indices.getOrElse((kind, name), -1)
    def names(kind: String): Iterable[String] = indices.keys.collect { case (`kind`, name) => name }
    def define(index: Int): Unit = SceneTextures.this.define(context, index)
