package candela.convert

import java.nio.file.Path

import candela.base.{Problem, SceneError}
import candela.scenefile.{Dialect, SceneDescription}

/** A scene in another dialect, and what was lost on the way. */
final case class Converted(scene: SceneDescription, warnings: Vector[Problem])

object Converter:

  /** @param folder where the scene will be written; files beside it are written at once
    * @param toPly  meshes of at least as many triangles go into files
    */
  def convert(
      scene: SceneDescription,
      to: Dialect,
      folder: Path,
      toPly: Option[Int] = None
  ): Converted =
    if toPly.nonEmpty && to == Dialect.V2 then
      throw SceneError(Problem.general("v2 has no meshes in PLY files: leave --to-ply out"))
    val files = SideFiles(folder)
    val moved = Declarations.map(scene)(FileNames(folder).moved)
    val start = Converted(moved, Vector.empty)
    val done = passes(scene.dialect, to).foldLeft(start): (before, pass) =>
      val run = PassRun(pass, before.scene, files)
      val result = run.result()
      Converted(result, before.warnings ++ run.warnings)
    done.copy(scene = toPly.fold(done.scene)(PlyWriter.extract(done.scene, _, files)))

  private def passes(from: Dialect, to: Dialect): Vector[Pass] = (from, to) match
    case (a, b) if a == b => Vector.empty
    case (Dialect.V2, Dialect.V3) => Vector(FromV2.pass)
    case (Dialect.V2, Dialect.V4) => Vector(FromV2.pass, ToV4View.pass)
    case (Dialect.V3, Dialect.V4) => Vector(ToV4View.pass)
    case (Dialect.V4, Dialect.V3) => Vector(ToV3View.pass)
    case _ =>
      val message = s"a ${from.toString.toLowerCase} scene can't be written as v2"
      throw SceneError(Problem.general(message, Some("--to v3 is the nearest")))
