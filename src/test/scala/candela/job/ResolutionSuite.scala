package candela.job

import candela.geometry.Ray
import candela.math.Vec3
import candela.render.RenderPlan
import candela.scenefile.Resolution
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

/** A scene of another resolution is rendered as if its film had that size. */
class ResolutionSuite extends AnyFunSuite:

  private def plan(name: String, text: String, settings: RenderSettings): RenderPlan =
    val file = Path.of(name)
    val control = BuildControl()
    val description = Render.readText(file, text, settings.reading, control)
    val prepared = Render.build(description, settings, control)
    try prepared.plan
    finally prepared.close()

  private def resized(name: String, text: String, resolution: Resolution): RenderPlan =
    plan(name, text, RenderSettings(reading = ReadSettings(resolution = Some(resolution))))

  /** Where corners and centre are seen, and what is rendered. */
  private def view(p: RenderPlan) =
    val ray = Ray()
    val rays =
      for x <- Seq(0f, 0.5f, 1f); y <- Seq(0f, 0.5f, 1f) yield
        p.camera.generate(x * p.width, y * p.height, 0.5f, 0.5f, ray)
        (ray.origin, ray.direction)
    (p.width, p.height, p.crop, rays.map((o, d) => (Vec3(o.x, o.y, o.z), Vec3(d.x, d.y, d.z))))

  private def pbrt(film: String, size: String, camera: String)(more: String) =
    s"""LookAt 0 0 -5  0 0 0  0 1 0
       |Camera "$camera" $more
       |Film "$film" $size
       |WorldBegin
       |LightSource "infinite"
       |Shape "sphere"
       |""".stripMargin

  private def sized(width: Int, height: Int) =
    s"\"integer xresolution\" $width \"integer yresolution\" $height"

  /** Scenes by the size of their films. */
  private val formats: Map[String, (String, (Int, Int) => String)] = Map(
    "v2 and v3" -> (
      "a.pbrt",
      (w, h) =>
        pbrt("image", sized(w, h), "perspective")("\"float fov\" 40") + "WorldEnd\n"
    ),
    "v4" -> ("a.pbrt", (w, h) => pbrt("rgb", sized(w, h), "perspective")("\"float fov\" 40")),
    "v4, orthographic" -> (
      "a.pbrt",
      (w, h) =>
        pbrt("rgb", sized(w, h), "orthographic")("")
    ),
    "Mitsuba, fov along x" -> ("a.xml", (w, h) => mitsuba(w, h, "perspective", "x")),
    "Mitsuba, fov along y" -> ("a.xml", (w, h) => mitsuba(w, h, "perspective", "y")),
    "Mitsuba, orthographic" -> ("a.xml", (w, h) => mitsuba(w, h, "orthographic", "x"))
  )

  private def mitsuba(width: Int, height: Int, sensor: String, axis: String) =
    val fov =
      if sensor == "orthographic" then ""
      else s"<float name=\"fov\" value=\"40\"/><string name=\"fov_axis\" value=\"$axis\"/>"
    s"""<scene version="3.0.0"><sensor type="$sensor">$fov
       |<float name="principal_point_offset_x" value="0.1"/>
       |<film type="hdrfilm"><integer name="width" value="$width"/>
       |<integer name="height" value="$height"/></film></sensor>
       |<emitter type="constant"/><shape type="sphere"/></scene>""".stripMargin

  test("a size gives the view that the file's own size gives, in each format"):
    for (format, (name, text)) <- formats; (width, height) <- Seq((32, 18), (20, 60)) do
      val asked = view(resized(name, text(48, 36), Resolution.Size(width, height)))
      val own = view(plan(name, text(width, height), RenderSettings()))
      assert(asked == own, format)

  test("a width keeps the aspect ratio, and so does a percentage"):
    for (format, (name, text)) <- formats do
      val narrow = resized(name, text(48, 36), Resolution.Width(20))
      assert((narrow.width, narrow.height) == (20, 15), format)
      val large = resized(name, text(48, 36), Resolution.Percent(250))
      assert((large.width, large.height) == (120, 90), format)

  test("crop windows show the same part"):
    val inPixels = sized(40, 20) + " \"integer pixelbounds\" [ 10 30 5 20 ]"
    val text = pbrt("rgb", inPixels, "perspective")("")
    val p = resized("a.pbrt", text, Resolution.Size(80, 60))
    assert((p.crop.x0, p.crop.x1, p.crop.y0, p.crop.y1) == (20, 60, 15, 60))

  test("a resolution takes the place of that of drafts and previews"):
    val text = pbrt("rgb", sized(1600, 800), "perspective")("")
    def size(s: RenderSettings) =
      val p = plan("a.pbrt", text, s)
      (p.width, p.height)
    val reading = ReadSettings(resolution = Some(Resolution.Width(60)))
    assert(size(RenderSettings(quick = true)) == (400, 200))
    assert(size(RenderSettings(quick = true, reading = reading)) == (60, 30))
    val (width, height) = size(RenderSettings(preview = true))
    assert(width * height <= 160_000 && width == 2 * height + width % 2)
    assert(size(RenderSettings(preview = true, reading = reading)) == (60, 30))
