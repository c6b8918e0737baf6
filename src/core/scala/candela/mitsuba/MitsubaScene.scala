package candela.mitsuba

import candela.diagnostics.{Code, Problem, SceneError, Severity, SourcePos}
import candela.io.{FileName, SceneFolder}
import candela.scenefile.{
  Declaration, Dialect, Param, Excerpts, InstanceList, NamedText, Resolution, SceneDescription
}

import java.nio.file.Path

/** Reads scenes of Mitsuba 3: XML files. */
object MitsubaScene:

  /** The scene, in statements of pbrt-v4 and more; types that only v3 has are declared as such.
    *
    * @param defines   values of `$name` in the file
    * @param keepGoing if true, replaces missing files
    * @param within    the scene's folder, if it is confined or has limits
    * @param text      what is read instead of the file
    * @param sensor    index of the sensor that sees the scene; none: the first, and a warning of
    *                  others
    * @param resolution of the image; none: that of the film
    * @param usedElsewhere names of `defines` that need no use here
    * @throws SceneError if the file contains no scene at all
    */
  def readable(
      file: Path,
      defines: Map[String, String],
      keepGoing: Boolean,
      within: Option[SceneFolder] = None,
      text: Option[String] = None,
      sensor: Option[Int] = None,
      resolution: Option[Resolution] = None,
      usedElsewhere: Set[String] = Set.empty
  ): SceneDescription =
    val folder = within.getOrElse(SceneFolder.of(file))
    val expanded = withExcerpts(file, text):
      val root = text.map(XmlFile.ofText(file.toString, _))
      Expansion(file, folder, defines, root, usedElsewhere).result()
    val session = Session(expanded, folder, keepGoing, sensor, resolution)
    translated(expanded, session, file, folder, text)

  /** Adds the lines of the text to the problems of `body`. */
  private[mitsuba] def withExcerpts[A](file: Path, text: Option[String])(body: => A): A =
    try body
    catch case e: SceneError => throw SceneError(excerpted(e.problems, file, text))

  private def excerpted(problems: Vector[Problem], file: Path, text: Option[String]) =
    Excerpts.fill(problems, Excerpts.sources(text.map(NamedText(file.toString, _))))

  private[mitsuba] def translated(
      expanded: Expanded,
      session: Session,
      file: Path,
      folder: SceneFolder,
      text: Option[String]
  ): SceneDescription =
    val scene = Translation(session, file).result()
    val (errors, warnings) =
      excerpted(expanded.problems ++ session.problems, file, text)
        .partition(_.severity == Severity.Error)
    scene.copy(
      warnings = warnings,
      errors = errors,
      sources = expanded.sources ++ session.filesRead,
      folder = folder
    )

  /** Reads a text for what it asks of its objects. */
  private[mitsuba] def observe(file: Path, folder: SceneFolder, text: String)(
      observe: Properties => Unit
  ): Unit =
    val expanded =
      Expansion(file, folder, Map.empty, Some(XmlFile.ofText(file.toString, text))).result()
    val session = Session(expanded, folder, keepGoing = true, observe = observe)
    val _ = Translation(session, file).result()

private final class Translation(session: Session, file: Path):
  import session.{sensor, sensors}

  private val colors = Colors(session)
  private val textures = Textures(session, colors)
  private val surfaces = Surfaces(session, colors, textures)
  private val media = Media(session, colors)
  private val emitters =
    Emitters(session, colors, textures, Skies(session, colors), media(_))
  private val shapes = Shapes(session, surfaces, emitters, media)

  private val objects = session.objects.map(_.value).collect { case Value.Nested(p) => p }
  private def objectsOf(kind: String) = objects.filter(_.kind == kind)

  def result(): SceneDescription =
    objectsOf("shape").foreach(shapes.add)
    // Errors of BSDFs that no shape uses are errors, too
    // Those that need a mesh are translated with it
    objectsOf("bsdf").filterNot(surfaces.textureTypes(_).exists(MeshAttributes.Types))
      .foreach(p => session.attempt(surfaces(p)))
    Properties.warnOfSurplus(objectsOf("integrator"), "integrator", "a scene", session)
    for
      surplus <- objectsOf("emitter").filter(p => Emitters.Surroundings(p.name) && !p.isOld).drop(1)
    do
      val message = "Mitsuba takes one light from everywhere; this one is added to the others"
      session.warn(Code.Nesting, surplus.pos, message)
    val lights = objectsOf("emitter").flatMap(emitters(_)) ++ emitters.ofNoSurface
    val (open, close) = session.shutter
    val start = SourcePos(file.toString, 1, 1)
    val times = if close > open then (open.toFloat, close.toFloat) else (0f, 1f)
    val framed = framedBy(SceneDescription(Dialect.Mitsuba, transformTimes = times), start)
    def sampleCount = framed.sampler.fold(1)(Views.sampleCount)
    val integrator = objectsOf("integrator").headOption
      .flatMap(p => session.attempt(Integrators(session, sampleCount)(p)))
    val pictured = sensors.lift(sensor.getOrElse(0))
      .flatMap(Properties(_, session).nested("film").headOption)
    val aovs = objectsOf("integrator").headOption.fold(Vector.empty)(Aovs(session, pictured)(_))
    val tracer = integrator.getOrElse(Integrators.default(session, start))
    val complete = framed.copy(
      integrator = Some(tracer),
      film = framed.film.map: film =>
        layered(if tracer.name == "lightpath" then opaque(film) else film, aovs),
      textures = textures.result(),
      namedMaterials = surfaces.result(),
      lights = lights,
      shapes = shapes.shapes,
      objects = shapes.objects,
      instances = shapes.instances,
      media = media.result()
    )
    if !objectsOf("integrator").headOption.exists(Integrators.isBlack) then complete
    else
      complete.copy(
        lights = Vector.empty,
        shapes = Vector.empty,
        objects = Map.empty,
        instances = InstanceList.Empty
      )

  /** The scene as the sensor sees it. */
  private def framedBy(scene: SceneDescription, start: SourcePos): SceneDescription =
    if sensors.isEmpty then
      val help = Some("add <sensor type=\"perspective\">")
      session.error(Code.Nesting, start, "the scene has no sensor", help)
    else if sensor.exists(_ >= sensors.size) then
      val last = sensors.size - 1
      val message = s"there is no sensor ${sensor.get}"
      val help = if last == 0 then "the only one is 0" else s"they are 0 to $last"
      session.error(Code.OptionMisfit, start, message, Some(help))
    if sensor.isEmpty then
      for surplus <- sensors.drop(1) do
        session.warn(
          Code.Unsupported,
          surplus.pos,
          "only the first sensor is rendered; this one is ignored",
          Some("--sensor all renders each, --sensor 1 the second")
        )
    val index = sensor.getOrElse(0)
    val stem = FileName.stem(file)
    val image = if sensor.isEmpty || sensors.size == 1 then stem else s"$stem-$index"
    sensors.lift(index)
      .flatMap(p => session.attempt(Views(session, media, image).addSensor(p, scene)))
      .getOrElse(scene)
      .copy(isFollowed = index + 1 < sensors.size)

  private def layered(film: Declaration, aovs: Vector[String]): Declaration =
    if aovs.isEmpty then film
    else film.copy(params = film.params :+ Param.string("aovs", film.pos, aovs*))

  /** Paths from lights find no coverage. */
  private def opaque(film: Declaration): Declaration =
    for p <- film.param("alpha") do
      session.warn(Code.Unsupported, p.pos, "\"ptracer\" does not support alpha")
    film.copy(params = film.params.filterNot(_.name == "alpha"))
