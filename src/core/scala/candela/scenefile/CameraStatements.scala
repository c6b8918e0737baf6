package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, Severity, SourcePos}
import candela.io.SceneFolder

/** Reads statements that place and describe a camera, in the dialect of a scene. */
object CameraStatements:

  /** The scene with the camera of a text. If that has no transforms, the camera is where the scene
    * has it; if it has no `Camera`, the scene's moves. What the scene places by its camera stays.
    *
    * @param folder that names of files are relative to
    * @param placed  finds the medium around the camera, if the text doesn't say it
    * @throws SceneError if the text has errors
    */
  def applied(
      scene: SceneDescription,
      source: Source,
      folder: SceneFolder,
      placed: SceneDescription => SceneDescription
  ): SceneDescription =
    val run = ParserRun(
      source,
      folder,
      file = None,
      scene.dialect.base,
      keepGoing = false,
      world = 0,
      Defines.Nothing,
      cameraOf = Some(scene)
    )
    run.read()
    val viewed = run.view
    val (errors, warnings) = viewed.warnings.partition(_.severity == Severity.Error)
    if errors.nonEmpty then throw SceneError(errors)
    val names = run.cameraDirectives.map(_._1)
    if !names.exists(Transforms + "Camera") then
      val message = "expected `LookAt` or another transform, `Camera`, or both; found neither"
      throw SceneError(Problem.error(Code.MissingParameter, SourcePos(source.name, 1, 1), message))
    val idle = run.cameraDirectives.drop(names.lastIndexOf("Camera") + 1).find: (name, _) =>
      names.contains("Camera") && Transforms(name)
    val framed = scene.copy(
      camera = viewed.camera,
      worldToCamera = viewed.worldToCamera,
      warnings = scene.warnings ++ warnings ++ idle.map: (name, at) =>
        val help = Some("write it before `Camera`")
        Problem.warning(Code.WrongPlace, at, s"$name after `Camera` has no effect", help)
    )
    if names.contains("MediumInterface") then framed.copy(cameraMedium = viewed.cameraMedium)
    else placed(framed)

  private[scenefile] val Transforms: Set[String] =
    Set("LookAt", "Identity", "Translate", "Scale", "Rotate", "Transform", "ConcatTransform")

  /** Directives of such a text. */
  private[scenefile] val Allowed: Set[String] =
    Transforms ++ Set("Camera", "ActiveTransform", "MediumInterface")

  private[scenefile] def unexpected(directive: String, at: SourcePos): Problem =
    val help = s"it may have ${Allowed.toVector.sorted.mkString(", ")}"
    Problem.error(Code.WrongPlace, at, s"$directive is no statement of a camera file", Some(help))
