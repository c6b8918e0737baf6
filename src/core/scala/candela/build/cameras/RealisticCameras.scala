package candela.build.cameras

import candela.base.Decimal
import candela.diagnostics.Code
import candela.io.{InputFile, IoReason}
import java.io.IOException

import candela.build.recipe.*
import candela.cameras.*
import candela.image.Image
import candela.math.Transform
import candela.scenefile.Dialect

object RealisticRecipe
    extends CameraRecipe("realistic", "lens system from a table of surfaces", sinceV3):
  private val file =
    string(
      "lensfile",
      "file with radius, thickness, index and diameter of each surface",
      shown = "none"
    )("")
  private val diameter = float(
    "aperturediameter",
    "diameter of the aperture stop",
    unit = "mm",
    range = Range.above(0f)
  )(1f)
  private val distance =
    float(
      "focusdistance",
      "distance from the film to the plane in focus",
      unit = "m",
      range = Range.above(0f)
    )(10f)
  private val simple = bool(
    "simpleweighting",
    "normalise the brightness of the centre; otherwise use absolute irradiance on the film",
    onlyV3
  )(true)
  private val shape = string(
    "aperture",
    "shape of the aperture: gaussian, square, pentagon, star, or an image",
    onlyV4,
    shown = "round"
  )("")

  protected def create()(using site: Site): CameraPlan =
    val lenses = file.given_() match
      case None =>
        site.missing(
          Code.MissingParameter,
          "camera \"realistic\" needs `lensfile`",
          StandInCamera.words
        )
        None
      case Some(_) =>
        val p = site.declaration.param("lensfile").get
        site.resources.file(p, site.declaration, site.problems, StandInCamera.words).flatMap(read)
    val cameraOf: (Transform, FilmFrame) => Camera = lenses match
      case Some(lens) => camera(_, _, lens)
      case None => StandInCamera.create
    CameraPlan(cameraOf, shutter())

  private def read(file: InputFile)(using site: Site): Option[LensSystem] =
    val pos = site.declaration.param("lensfile").get.valuesAt
    def refuse(why: String) =
      val message = s"can't read the lens file `${file.path.getFileName}`: $why"
      site.problems.missing(Code.MeasuredFile, pos, message, StandInCamera.words)
      None
    LensFile.read(file) match
      case Left(why) => refuse(why)
      case Right(surfaces) =>
        val widest = surfaces.find(_.radius == 0.0).map(s => (s.aperture * 2000).toFloat)
        for most <- widest if diameter() > most do
          val limit = DefaultText.number(most)
          site.warn(
            Code.CorrectedValue,
            s"`aperturediameter` must be at most $limit mm for this lens; using $limit mm"
          )
        val stopped = surfaces.map: s =>
          if s.radius == 0.0 then s.copy(aperture = Math.min(s.aperture, diameter() / 2000.0))
          else s
        Some(LensSystem(stopped, stop()))

  private def camera(toWorld: Transform, frame: FilmFrame, lens: LensSystem)(using
      site: Site
  ): Camera =
    LensFocus.focused(lens, distance(), frame.diagonal) match
      case Left(why) =>
        site.error(Code.ParameterValue, why)
        StandInCamera.create(toWorld, frame)
      case Right(focused) =>
        val pupil = ExitPupil.of(focused, frame.diagonal)
        if pupil.isDark(0) then
          site.warn(Code.DarkScene, "no light reaches the film; the image will be black")
        val gain =
          if site.dialect == Dialect.V4 then RealisticCamera.exposureGain(focused, 1.0)
          else if simple() then RealisticCamera.relativeGain(pupil)
          else RealisticCamera.exposureGain(focused, shutter().duration)
        RealisticCamera(toWorld, frame, focused, pupil, gain)

  /** Shape of the aperture; None: a disc. */
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
                val message = "the image of an aperture must have one channel, or R, G and B"
                site.problems.missing(Code.MeasuredFile, p.valuesAt, message, Round)
              channels.map(ofImage(image, _))

  private val Round = "using a round aperture"

  /** Aperture from an upright image, whose channels are averaged. */
  private def ofImage(image: Image, channels: Vector[Int]): StopShape =
    val values = Array.tabulate(image.width * image.height): i =>
      val (x, y) = (i % image.width, image.height - 1 - i / image.width)
      channels.map(image(x, y, _)).sum / channels.size
    StopShape.asBrightAsDisc(image.width, image.height, values)

/** Exists only in forks of pbrt-v2. */
object ForkedRealisticRecipe extends CameraRecipe("realistic", "lens system", onlyV2):
  override def substitute: Option[String] =
    Some(s"only forks of pbrt-v2 have it; ${StandInCamera.words}")
  protected def create()(using Site): CameraPlan = CameraPlan(StandInCamera.create, shutter())

/** Reads a table of lens surfaces, from the scene to the film. Each row holds the radius of
  * curvature in mm (0: aperture stop), the distance to the next surface in mm, the index of
  * refraction in between (0 or 1: air), and the diameter in mm. `#` begins a comment.
  */
private[build] object LensFile:
  private val Columns = 4

  /** Returns the surfaces, in metres, or an error message. */
  def read(file: InputFile): Either[String, Vector[LensSurface]] =
    try surfaces(file.text(), file.quoted)
    catch case e: IOException => Left(IoReason(e))

  private[build] def surfaces(
      text: String,
      quoted: String => String = w => s"`$w`"
  ): Either[String, Vector[LensSurface]] =
    val lines = text.linesIterator.map(_.takeWhile(_ != '#').trim).zipWithIndex
    val words = lines.flatMap((l, i) => l.split("\\s+").filter(_.nonEmpty).map(_ -> (i + 1)))
    val numbers = words.toVector
    numbers.find((word, _) => !Decimal.double(word).exists(java.lang.Double.isFinite)) match
      case Some((word, line)) => Left(s"${quoted(word)} in line $line is not a number")
      case None if numbers.isEmpty => Left("the file has no surfaces")
      case None if numbers.size % Columns != 0 =>
        Left(s"${numbers.size} numbers don't form complete surfaces of $Columns each")
      case None =>
        val rows = numbers.map(_._1.toDouble).grouped(Columns).toVector
        val read = rows.map: row =>
          LensSurface(row(0) / 1000, row(1) / 1000, row(2), row(3) / 2000)
        rows.indexWhere(row => row(3) <= 0 || row(2) < 0 || row(1) < 0) match
          case -1 => Right(read)
          case i =>
            Left(s"surface ${i + 1} must have a diameter above 0 and no thickness or index below 0")
