package candela.render

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import candela.guiding.GuidingMode
import candela.image.{Image, ImageFiles}
import candela.integrators.CausticsMode
import candela.io.SceneFolder
import candela.job.SceneFormat
import candela.mitsuba.MitsubaScene
import candela.scenefile.{Parser, Resolution, SceneDescription}
import candela.settings.{ModelLight, ModelSettings, ReadSettings, RenderSettings}

/** A scene of the `scenes` folder with the image that the program of its dialect makes of it: pbrt,
  * Mitsuba, or Cycles of models.
  *
  * @param noise     variance of the reference's pixels, measured between two independent halves
  * @param allowance relative systematic difference that is known, measured and explained
  * @param guiding   whether its paths are guided
  */
final case class ReferenceScene(
    name: String,
    noise: Double,
    allowance: Double,
    guiding: GuidingMode = GuidingMode.Off
):
  /** The name, and what differs from the scene as its file has it. */
  def title: String = if guiding == GuidingMode.Off then name else s"$name, guided"

  def settings(samplesPerPixel: Int, seed: Int): RenderSettings =
    RenderSettings(
      Some(samplesPerPixel),
      seed,
      guiding = Some(guiding),
      caustics = Some(caustics),
      reading = reading
    )

  /** Meshes have neither a camera nor light. */
  def reading: ReadSettings =
    if !isModel then ReadSettings()
    else
      val size = ReadSettings(resolution = Some(Resolution.Size(image.width, image.height)))
      if !SceneFormat.of(file).isMesh then size
      else
        val light = ModelLight.Surroundings(s"${ReferenceScenes.Sky}")
        size.copy(
          camera = Some(s"${ReferenceScenes.MeshCamera}"),
          model = ModelSettings(light = Some(light))
        )

  /** That of its file, if it is one. */
  def text: String = if isModel then "" else Files.readString(file)

  def description(text: String): SceneDescription =
    if isMitsubas then
      Parser.validated(MitsubaScene.readable(file, Map.empty, keepGoing = false))
    else if isModel then
      Parser.validated(SceneFormat.of(file).read(file, SceneFolder.of(file), reading, None))
    else Parser.parseText(file.toString, text, ReferenceScenes.Scenes)

  def isMitsubas: Boolean = name.startsWith("mi-")
  def isModel: Boolean = ReferenceScenes.models.contains(name)
  def file: Path =
    if isModel then ReferenceScenes.models(name)
    else if isMitsubas then ReferenceScenes.OfMitsuba.resolve(s"$name.xml")
    else ReferenceScenes.Scenes.resolve(s"$name.pbrt")

  /** Scenes of caustics show how these are looked for. Under water, and in mist behind glass, few
    * samples of paths lack what rare ones bring.
    */
  def caustics: CausticsMode =
    if !name.startsWith("v4-caustics-") then CausticsMode.Off
    else if name.endsWith("-pool") || name.endsWith("-mist") then CausticsMode.Photons
    else CausticsMode.Auto

  def image: Image =
    val folder =
      if isModel then ReferenceScenes.ReferencesOfModels else ReferenceScenes.References
    ImageFiles.read(folder.resolve(s"$name.exr"))

/** Finds the scenes that have a reference. */
object ReferenceScenes:
  val Scenes: Path = Path.of("scenes")
  val OfMitsuba: Path = Scenes.resolve("mitsuba")
  val References: Path = Path.of("reference-images")
  val ReferencesOfModels: Path = References.resolve("models")

  private val OfModels = Scenes.resolve("models")
  val MeshCamera: Path = OfModels.resolve("shapes-camera.pbrt")
  val Sky: Path = Scenes.resolve("textures").resolve("sky-latlong.exr")

  /** Names without their ending. */
  def names(folder: Path, ending: String): Vector[String] =
    Using.resource(Files.list(folder)): files =>
      val all = files.iterator.asScala.map(_.getFileName.toString).filter(_.endsWith(ending))
      all.map(_.stripSuffix(ending)).toVector.sorted

  /** Files of models, by their names. */
  lazy val models: Map[String, Path] =
    Using.resource(Files.list(OfModels)): files =>
      val models = files.iterator.asScala.filter(SceneFormat.named(_).exists(_.isModel))
      models.map(file => SceneFormat.stem(file) -> file).toMap

  /** Rows of `manifest.csv`, by the names of the columns. */
  lazy val manifest: Vector[Map[String, String]] =
    val lines = Files.readAllLines(References.resolve("manifest.csv")).asScala.toVector
    val columns = lines.head.split(',').toVector
    lines.tail.filter(_.nonEmpty).map(line => columns.zip(line.split(",", columns.size)).toMap)

  lazy val all: Vector[ReferenceScene] =
    val rows = manifest.map(row => row("scene") -> row).toMap
    val all = models.keys.toVector.sorted ++ names(OfMitsuba, ".xml") ++ names(Scenes, ".pbrt")
    for name <- all if rows.contains(name) yield
      val row = rows(name)
      ReferenceScene(name, row("noise_variance").toDouble, row("allowance").toDouble)

  /** Scenes that are rendered in another way, too, with the same mean. */
  lazy val variants: Vector[ReferenceScene] =
    Vector("v4-fog-gap", "v4-depth-of-field", "v3-lights")
      .map(named(_).copy(guiding = GuidingMode.On))

  /** All that is compared with a reference. */
  def compared: Vector[ReferenceScene] = all ++ variants

  def named(name: String): ReferenceScene = all.find(_.name == name).get
