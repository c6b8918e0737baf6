package candela.scenefile

import java.nio.file.Path

/** The files that a scene consists of. */
object SceneFiles:

  /** The scene file, what it includes, and every file that a parameter names, except the image to
    * write; without duplicates.
    */
  def of(scene: SceneDescription): Vector[Path] =
    val texts =
      for
        declaration <- declarations(scene)
        param <- declaration.params
        text <- param.strings
      yield (declaration.folder, text)
    // Distinct, because thousands of shapes may have the same texture
    val named = texts.distinct.flatMap((folder, text) => folder.belonging(text))
    (scene.sources ++ named).distinctBy(_.toAbsolutePath.normalize)

  private def declarations(s: SceneDescription): Vector[Declaration] =
    val single = Vector(s.camera, s.sampler, s.filter, s.integrator, s.accelerator, s.renderer)
    val shapes = s.shapes ++ s.objects.values.flatten
    (single :+ s.volumeIntegrator).flatten ++
      s.textures.map(_.texture) ++
      s.namedMaterials.map(_._2) ++
      shapes.map(_.material).distinct.collect { case MaterialRef.Inline(d) => d } ++
      shapes.map(_.shape) ++
      shapes.flatMap(_.areaLight).distinct ++
      (s.lights ++ s.volumes).map(_.light) ++
      s.media.map(_.medium)
