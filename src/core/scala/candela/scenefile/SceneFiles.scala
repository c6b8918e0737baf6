package candela.scenefile

import candela.io.SceneFolder
import java.nio.file.Path

import scala.collection.mutable

/** The files that a scene consists of. */
object SceneFiles:

  /** The scene file, what it includes, and every file that a parameter names, except the image to
    * write; without duplicates.
    */
  def of(scene: SceneDescription): Vector[Path] =
    // A set, because thousands of shapes may have the same texture
    val texts = mutable.LinkedHashSet.empty[(SceneFolder, String)]
    for
      declaration <- declarations(scene)
      param <- declaration.params
      text <- param.strings
    do texts += (declaration.folder -> text)
    val named = texts.toVector.flatMap((folder, text) => folder.belonging(text))
    (scene.sources ++ named).distinctBy(_.toAbsolutePath.normalize)

  /** Some of them several times: comparing millions takes longer than reading them again. */
  private def declarations(s: SceneDescription): Iterator[Declaration] =
    val single = Vector(s.camera, s.sampler, s.filter, s.integrator, s.accelerator, s.renderer)
    // Once: each object is looked up by its name
    val ofObjects = s.objects.valuesIterator.flatten.toVector
    def shapes = s.shapes.iterator ++ ofObjects
    (single :+ s.volumeIntegrator).flatten.iterator ++
      s.textures.iterator.map(_.texture) ++
      s.namedMaterials.iterator.map(_._2) ++
      changes(shapes.map(_.material)).collect { case MaterialRef.Inline(d) => d } ++
      shapes.map(_.shape) ++
      changes(shapes.map(_.areaLight)).flatten ++
      (s.lights.iterator ++ s.volumes).map(_.light) ++
      s.media.iterator.map(_.medium)

  /** Without those that are the one before. */
  private def changes[T <: AnyRef](elements: Iterator[T]): Iterator[T] =
    var previous = Option.empty[T]
    elements.filter: element =>
      val isNew = !previous.exists(_ eq element)
      if isNew then previous = Some(element)
      isNew
