package candela.models

import candela.diagnostics.{Problem, SceneError, Severity}
import candela.io.SceneFolder
import candela.job.SceneFormat
import candela.scenefile.{Declaration, SceneDescription}
import candela.settings.{ModelSettings, ReadSettings, UpAxis}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

/** Reads models of a folder that has these files, the first of which is the model. */
private[models] object MeshFormats:
  def read(
      files: Seq[(String, Array[Byte])],
      reading: ReadSettings = ReadSettings(),
      isConfined: Boolean = false,
      world: Option[Int] = None
  ): SceneDescription =
    TempFolder.use: folder =>
      for (name, content) <- files do
        val file = folder.resolve(name)
        Files.createDirectories(file.getParent): Unit
        Files.write(file, content): Unit
      val file = folder.resolve(files.head._1)
      SceneFormat.named(file).get.read(file, SceneFolder.of(file, isConfined), reading, world)

  def bytes(text: String): Array[Byte] = text.getBytes("UTF-8")

  def up(axis: UpAxis): ReadSettings = ReadSettings(model = ModelSettings(up = Some(axis)))

  def floats(d: Declaration, name: String): Vector[Float] =
    d.param(name).fold(Vector.empty)(_.floats.toVector)

  def ints(d: Declaration, name: String): Vector[Int] =
    d.param(name).fold(Vector.empty)(_.ints.toVector)

  /** Place in its file, and message. */
  def told(p: Problem): String =
    val place = p.pos.fold("")(at => s"${Path.of(at.file).getFileName}:${at.line}:${at.column}: ")
    place + p.message

  def error(body: => SceneDescription): String =
    val problems =
      try body.errors
      catch case e: SceneError => e.problems
    told(problems.find(_.severity == Severity.Error).get)

  /** The material of a shape, as it is declared. */
  def material(scene: SceneDescription, shape: Int): Declaration =
    scene.shapes(shape).material.declared(scene.namedMaterials.toMap).get

  def number(d: Declaration, name: String): Option[Float] = d.param(name).map(_.floats.head)
