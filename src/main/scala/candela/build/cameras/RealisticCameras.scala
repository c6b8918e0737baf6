package candela.build.cameras

import java.io.IOException
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}

import candela.build.recipe.*
import candela.cameras.*
import candela.image.Image
import candela.math.Transform
import candela.scenefile.Dialect

object RealisticRecipe extends CameraRecipe("realistic", "lenses of glass, from a table", sinceV3):
  private val file =
    string("lensfile", "radius, thickness, index and diameter of each surface", shown = "none")("")
  private val diameter = float("aperturediameter", "of the stop", unit = "mm")(1f)
  private val distance =
    float("focusdistance", "from the film to the plane in focus", unit = "m")(10f)
  private val simple = bool(
    "simpleweighting",
    "is the middle about as bright as by other cameras? Else what the film gathers counts",
    onlyV3
  )(true)
  private val shape = string(
    "aperture",
    "shape of the stop: gaussian, square, pentagon, star, or an image",
    onlyV4,
    "round"
  )("")

  protected def make()(using site: Site): CameraPlan =
    val lenses = file.given_() match
      case None =>
        site.missing("camera \"realistic\" needs a `lensfile`", StandInCamera.words)
        None
      case Some(_) =>
        val p = site.declaration.param("lensfile").get
        site.resources.file(p, site.declaration, site.problems, StandInCamera.words).flatMap(read)
    val place: (Transform, FilmFrame) => Camera = lenses match
      case Some(lens) => camera(_, _, lens)
      case None => StandInCamera.make
    CameraPlan(place, shutter())

  private def read(path: Path)(using site: Site): Option[LensSystem] =
    val at = site.declaration.param("lensfile").get.valuesAt
    def refuse(why: String) =
      site.problems.missing(at, s"lens file `${path.getFileName}`: $why", StandInCamera.words)
      None
    LensFile.read(path) match
      case Left(why) => refuse(why)
      case Right(surfaces) =>
        val widest = surfaces.find(_.radius == 0.0).map(s => (s.aperture * 2000).toFloat)
        for most <- widest if diameter() > most do
          val least = DefaultText.number(most)
          site.warn(s"`aperturediameter` is more than the $least mm of the lens, which are used")
        val stopped = surfaces.map: s =>
          if s.radius == 0.0 then s.copy(aperture = Math.min(s.aperture, diameter() / 2000.0))
          else s
        Some(LensSystem(stopped, stop()))

  private def camera(toWorld: Transform, frame: FilmFrame, lens: LensSystem)(using
      site: Site
  ): Camera =
    LensFocus.focused(lens, distance(), frame.diagonal) match
      case Left(why) =>
        site.error(why)
        StandInCamera.make(toWorld, frame)
      case Right(focused) =>
        val pupil = ExitPupil.of(focused, frame.diagonal)
        if pupil.isDark(0) then site.warn("no light reaches the film: the image will be black")
        val gain =
          if site.dialect == Dialect.V4 then RealisticCamera.exposureGain(focused, 1.0)
          else if simple() then RealisticCamera.relativeGain(pupil)
          else RealisticCamera.exposureGain(focused, shutter().duration)
        RealisticCamera(toWorld, frame, focused, pupil, gain)

  /** None: a disc. */
  private def stop()(using site: Site): Option[StopShape] =
    val name = shape()
    if name.isEmpty then None
    else
      StopShapes.all
        .get(name)
        .map(_())
        .orElse:
          val p = site.declaration.param("aperture").get
          site.resources
            .image(p, site.declaration, site.problems, Round)
            .flatMap: stored =>
              val image = stored.toImage.linear
              val single = Option.when(image.channels == 1)(Vector(0))
              val channels = single.orElse(image.indicesOf(Image.RgbNames))
              if channels.isEmpty then
                val message = "an aperture's image has one channel, or R, G and B"
                site.problems.missing(p.valuesAt, message, Round)
              channels.map(ofImage(image, _))

  private val Round = "the aperture is round"

  /** Upright; colours count by their mean. */
  private def ofImage(image: Image, channels: Vector[Int]): StopShape =
    val values = Array.tabulate(image.width * image.height): i =>
      val (x, y) = (i % image.width, image.height - 1 - i / image.width)
      channels.map(image(x, y, _)).sum / channels.size
    StopShape.asBrightAsDisc(image.width, image.height, values)

/** Official pbrt-v2 has none, but some of its forks have. */
object ForkedRealisticRecipe extends CameraRecipe("realistic", "lenses of glass", onlyV2):
  override def pending: Option[String] =
    Some(s"pbrt-v2 has none, only some of its forks; ${StandInCamera.words}")
  protected def make()(using Site): CameraPlan = CameraPlan(StandInCamera.make, shutter())

/** Reads a table of lens surfaces, from the scene to the film: for each its radius of curvature in
  * mm (0: the aperture stop), its distance to the next in mm, the index of refraction up to there
  * (0 or 1: air), and its diameter in mm. `#` begins a comment.
  */
private[build] object LensFile:
  private val Columns = 4

  /** The surfaces, in metres, or what is wrong with the file. */
  def read(path: Path): Either[String, Vector[LensSurface]] =
    try surfaces(Files.readString(path, ISO_8859_1))
    catch case e: IOException => Left(s"cannot be read: ${e.getMessage}")

  private[build] def surfaces(text: String): Either[String, Vector[LensSurface]] =
    val lines = text.linesIterator.map(_.takeWhile(_ != '#').trim).zipWithIndex
    val words = lines.flatMap((l, i) => l.split("\\s+").filter(_.nonEmpty).map(_ -> (i + 1)))
    val all = words.toVector
    all.find((word, _) => !word.toDoubleOption.exists(java.lang.Double.isFinite)) match
      case Some((word, line)) => Left(s"`$word` in line $line is no number")
      case None if all.isEmpty => Left("it holds no surface")
      case None if all.size % Columns != 0 =>
        Left(s"${all.size} numbers are no whole surfaces of $Columns each")
      case None =>
        val rows = all.map(_._1.toDouble).grouped(Columns).toVector
        val read = rows.map: row =>
          LensSurface(row(0) / 1000, row(1) / 1000, row(2), row(3) / 2000)
        rows.indexWhere(row => row(3) <= 0 || row(2) < 0 || row(1) < 0) match
          case -1 => Right(read)
          case i =>
            Left(s"surface ${i + 1} has no positive diameter, or a thickness or index below 0")
