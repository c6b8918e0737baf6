package candela.caustics

import candela.film.Fireflies
import candela.guiding.GuidingMode
import candela.image.{Image, ImageFiles}
import candela.integrators.CausticsMode
import candela.render.{RenderControl, Cancellation, Renderer, RenderPlan}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{FileKeeper, SceneTexts, TempFolder, WatchedSampler}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

final class CausticPhotonsSuite extends AnyFunSuite:

  /** A ball over a floor, and another of brushed metal, beneath a large emitter. */
  private def room(ball: String, depth: Int = 8, size: Int = 20, light: String = large): String =
    s"""LookAt 0 -5 3  0 0 .3  0 0 1
       |Camera "perspective" "float fov" 40
       |Film "rgb" "integer xresolution" $size "integer yresolution" $size
       |Sampler "independent" "integer pixelsamples" 64
       |PixelFilter "box"
       |Integrator "path" "integer maxdepth" $depth
       |WorldBegin
       |LightSource "infinite" "rgb L" [.1 .1 .15]
       |$light
       |Material "diffuse" "rgb reflectance" [.6 .5 .4]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point3 P" [-3 -3 0  3 -3 0  3 3 0  -3 3 0]
       |AttributeBegin
       |Material "conductor" "float roughness" .02
       |Translate -1.1 .3 .4
       |Shape "sphere" "float radius" .4
       |AttributeEnd
       |$ball
       |Translate .4 0 .7
       |Shape "sphere" "float radius" .6
       |""".stripMargin

  private lazy val large = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [8 6 4]
    Translate -1 1 3.5
    Shape "sphere" "float radius" .6
    AttributeEnd"""
  private val glass = """Material "dielectric" "float eta" 1.5"""

  private def plan(
      text: String,
      mode: CausticsMode,
      spp: Int,
      color: ColorMode = ColorMode.Rgb
  ): RenderPlan =
    val settings = RenderSettings(Some(spp), color = color, caustics = Some(mode))
    SceneTexts.plan(text, Dialect.V4, settings)

  private def pixels(plan: RenderPlan, threads: Int = 1): Array[Float] =
    Renderer.render(plan, threads).image(plan.development).data

  private def mean(plan: RenderPlan): Double =
    val all = pixels(plan)
    all.map(_.toDouble).sum / all.length

  for
    (what, ball, depth) <- Seq(
      ("glass", glass, 8),
      // Light that glass sends needs two events within it
      ("glass, short paths", glass, 4),
      ("glass, the shortest paths", glass, 3),
      ("a mirror", """Material "conductor" "float roughness" 0""", 8),
      ("rough glass", """Material "dielectric" "float roughness" .01""", 8),
      ("coated wood", """Material "coateddiffuse" "float roughness" 0""", 8),
      ("thin glass", """Material "thindielectric"""", 8)
    )
  do
    // One of them is quick to compare
    val tags = if depth == 3 then Vector.empty else Vector(Slow)
    test(s"photons bring what paths leave out, once: $what", tags*):
      val text = room(ball, depth)
      val expected = mean(plan(text, CausticsMode.Off, 200))
      val found = mean(plan(text, CausticsMode.Photons, 40))
      // Noise of some 0.5 % in either; a little light is lost beyond edges within the radius
      assert(Math.abs(found / expected - 1) < 0.02, s"$found, expected $expected")

  /** A sky with a bright patch; the rest is darker than the mean: light samples leave it out. */
  private def withSky[A](use: String => A): A = TempFolder.use: folder =>
    val sky = Image.rgb(16, 16)
    for y <- 0 until 16; x <- 0 until 16; c <- 0 until 3 do
      sky.data(3 * (16 * y + x) + c) = if x > 7 && x < 11 && y > 5 && y < 9 then 12f else 0.6f
    val file = folder.resolve("sky.pfm")
    ImageFiles.write(file, sky)
    use(s"""LightSource "infinite" "string filename" "$file"""")

  test("photons bring the dim parts of a sky, too", Slow):
    withSky: sky =>
      val text = room(glass, light = sky).replaceFirst("(?m)^LightSource \"infinite\" \"rgb.*$", "")
      val expected = mean(plan(text, CausticsMode.Off, 200))
      val found = mean(plan(text, CausticsMode.Photons, 40))
      // 0.97 without them
      assert(Math.abs(found / expected - 1) < 0.01, s"$found, expected $expected")

  test("light of a point within glass is seen in a mirror", Slow):
    def text(ball: String) =
      s"""LookAt -3 0 1  0 0 8  0 1 0
         |Camera "orthographic" "float screenwindow" [-.25 .25 -.25 .25]
         |Film "rgb" "integer xresolution" 32 "integer yresolution" 32
         |Sampler "independent"
         |Integrator "path" "integer maxdepth" 8
         |WorldBegin
         |LightSource "point" "point3 from" [0 0 1] "rgb I" [4 4 4]
         |AttributeBegin
         |Material "conductor" "rgb reflectance" [1 1 1] "float roughness" 0
         |Translate -1.71 0 4
         |Shape "disk" "float radius" .8
         |AttributeEnd
         |Material "diffuse" "rgb reflectance" [.5 .5 .5]
         |Shape "disk" "float radius" 1
         |Translate 0 0 1
         |$ball
         |""".stripMargin
    val inside = text(s"$glass Shape \"sphere\" \"float radius\" .08")
    // Rays through the centre go straight on, and what is reflected gets out in the end
    val expected = mean(plan(text(""), CausticsMode.Off, 16))
    val found = mean(plan(inside, CausticsMode.Photons, 60))
    assert(expected > 0.1 && mean(plan(inside, CausticsMode.Off, 16)) == 0.0)
    // Some thousand photons arrive there
    assert(Math.abs(found / expected - 1) < 0.1, s"$found, expected $expected")

  test("the image is the same bit for bit by one thread and by three, and if it is resumed", Slow):
    val made = plan(room(glass, light = s"$large\n$point"), CausticsMode.Photons, 5)
    val alone = pixels(made).toVector
    assert(pixels(made, threads = 3).toVector == alone)
    TempFolder.use: folder =>
      val file = folder.resolve("state")
      val stop = Cancellation()
      val stopped = Renderer.render(
        WatchedSampler.watched(made)((_, _, sample) => if sample == 2 then stop.request()),
        RenderControl(
          threads = 2,
          stop,
          checkpointer = Some(FileKeeper(None, file))
        )
      )
      assert(stopped.samplesDone < 5)
      val resumed =
        Renderer.render(
          made,
          RenderControl(threads = 2, checkpointer = Some(FileKeeper(Some(file), file)))
        )
      assert(resumed.samplesDone == 5)
      assert(resumed.image(made.development).data.toVector == alone)

  /** A ball of glass in a medium, within a ball, and a camera that may be in it, too.
    *
    * @param fog     what is in the medium's own statement
    * @param inGlass the medium within the glass
    */
  private def smoke(fog: String, light: String, inGlass: String, inside: Boolean = false): String =
    val from = if inside then ".3 -.9 .9" else "0 -5 2"
    s"""LookAt $from  0 0 .6  0 0 1
       |${if inside then "MediumInterface \"\" \"m\"" else ""}
       |Camera "perspective" "float fov" 30
       |Film "rgb" "integer xresolution" 16 "integer yresolution" 16
       |Sampler "independent"
       |PixelFilter "box"
       |Integrator "volpath" "integer maxdepth" 7
       |WorldBegin
       |MakeNamedMedium "m" "string type" $fog "float g" .3
       |$light
       |MediumInterface "" ""
       |Material "diffuse" "rgb reflectance" [.6 .5 .4]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point3 P" [-3 -3 -1  3 -3 -1  3 3 -1  -3 3 -1]
       |AttributeBegin
       |MediumInterface "m" ""
       |Material "interface"
       |Translate 0 0 .6
       |Shape "sphere" "float radius" 1.6
       |AttributeEnd
       |MediumInterface "$inGlass" "m"
       |$glass
       |Translate 0 0 .7
       |Shape "sphere" "float radius" .5
       |""".stripMargin

  private val mist = """"homogeneous" "rgb sigma_s" [.5 .5 .5] "rgb sigma_a" [.05 .05 .05]"""
  private val coloured = """"homogeneous" "rgb sigma_s" [.7 .4 .2] "rgb sigma_a" [.1 .2 .3]"""
  private val thick = mist.replace(".5", "2")
  private val thickColoured =
    """"homogeneous" "rgb sigma_s" [3 2 1.2] "rgb sigma_a" [.1 .2 .3]"""
  private val cells = (1 to 8).map(i => f"${(i % 3) * 0.5}%.1f").mkString(" ")
  private val cloudy = s""""uniformgrid" "integer nx" 2 "integer ny" 2 "integer nz" 2
    "float density" [$cells] "rgb sigma_s" [.9 .8 .7] "rgb sigma_a" [.1 .2 .3]
    "point3 p0" [-2 -2 -1] "point3 p1" [2 2 2.2]"""
  private val rough = """Material "dielectric" "float roughness" .02"""
  private def behindPane(text: String) =
    text.replace(
      "AttributeBegin\nMediumInterface",
      s"""AttributeBegin
         |$glass
         |Shape "bilinearmesh" "point3 P" [-2 -3 -.5  2 -3 -.5  -2 -3 3  2 -3 3]
         |Shape "bilinearmesh" "point3 P" [-2 -2.9 -.5  -2 -2.9 3  2 -2.9 -.5  2 -2.9 3]
         |AttributeEnd
         |AttributeBegin
         |MediumInterface""".stripMargin
    )
  private lazy val above = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [8 6 4]
    Translate -.5 .5 3.2
    Shape "sphere" "float radius" .6
    AttributeEnd"""
  private lazy val within = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [40 30 20]
    MediumInterface "" "m"
    Translate -.6 .3 1.5
    Shape "sphere" "float radius" .25
    AttributeEnd"""

  for
    (what, text) <- Seq(
      ("thin mist", smoke(mist.replace(".5", ".08"), above, "")),
      ("mist", smoke(mist, above, "")),
      ("coloured mist", smoke(coloured, above, "")),
      ("a cloud of cells", smoke(cloudy, above, "")),
      ("mist that absorbs only", smoke(mist.replace(".5", "0"), above, "")),
      ("mist that glows", smoke(s"$mist \"rgb Le\" [.2 .1 .1]", above, "")),
      ("the emitter in the mist", smoke(mist, within, "")),
      ("mist in the glass", smoke(coloured, above, "m")),
      ("the camera in the mist", smoke(mist, within, "", inside = true)),
      ("thick mist", smoke(thick, within, "")),
      ("thick coloured mist, in the glass, too", smoke(thickColoured, within, "m")),
      ("a thick cloud of cells", smoke(cloudy.replace("[.9 .8 .7]", "[3 2.5 2]"), within, "")),
      ("the camera in thick mist", smoke(thickColoured, within, "", inside = true)),
      ("rough glass in mist", smoke(mist, above, "").replace(glass, rough)),
      ("rough glass in thick mist", smoke(thick, within, "").replace(glass, rough)),
      ("mist behind a pane of glass", behindPane(smoke(mist, above, ""))),
      ("thick mist behind a pane of glass", behindPane(smoke(thickColoured, within, "")))
    )
  do
    test(s"photons bring what paths leave out in media, once: $what", Slow):
      compare(text)

  private def compare(text: String, color: ColorMode = ColorMode.Rgb, side: Int = 64): Unit =
    // With the pixels the radius is smaller, and so is the blur at borders
    val finer = text.replace("resolution\" 16", s"resolution\" $side")
    val found = means(plan(finer, CausticsMode.Photons, 12 * 64 / side, color))
    val expected = means(plan(text, CausticsMode.Off, 1500, color))
    for (f, e) <- found.lazyZip(expected) do
      // Noise of a percent in either: few paths scatter all colours alike
      assert(Math.abs(f / e - 1) < 0.04, s"$found, expected $expected")

  test("photons bring what skies send through media and glass, once", Slow):
    withSky: image =>
      for sky <- Seq(image, """LightSource "infinite" "rgb L" [.9 .8 .7]""") do
        val text = hazy(s"$bright\n$sky").replace("resolution\" 64", "resolution\" 16")
        assert(told(plan(text, CausticsMode.Photons, 1)).contains(all))
        // All borders of this fog are bright
        compare(text, side = 256)
        compare(smoke(mist.replace(".5", ".08"), sky, ""))

  private val dispersive = """Material "dielectric" "spectrum eta" "glass-F11""""

  test("of each wavelength photons in media bring as much as paths", Slow):
    for fog <- Seq(coloured, thickColoured) do
      val text = smoke(fog, within, "")
      compare(text, ColorMode.Spectral)
      compare(text.replace(glass, dispersive), ColorMode.Spectral)

  /** A floor in a ball of mist, with a small ball of glass on it. */
  private def hazy(emitters: String): String =
    s"""LookAt 0 -5 .6  0 0 .3  0 0 1
       |Camera "perspective" "float fov" 46
       |Film "rgb" "integer xresolution" 64 "integer yresolution" 64
       |Sampler "independent"
       |PixelFilter "box"
       |Integrator "volpath" "integer maxdepth" 5
       |WorldBegin
       |MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_s" [1.2 1.2 1.2]
       |  "rgb sigma_a" [.05 .05 .05]
       |AttributeBegin
       |MediumInterface "m" ""
       |Material "interface"
       |Shape "sphere" "float radius" 2
       |AttributeEnd
       |$emitters
       |MediumInterface "" "m"
       |Material "diffuse" "rgb reflectance" [.9 .9 .9]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point3 P" [-1.2 -1.2 0  1.2 -1.2 0  1.2 1.2 0  -1.2 1.2 0]
       |$glass
       |Translate 0 .4 .3
       |Shape "sphere" "float radius" .3
       |""".stripMargin

  private val near = """AttributeBegin
    MediumInterface "" "m"
    AreaLightSource "diffuse" "rgb L" [1 1 1]
    Shape "trianglemesh" "integer indices" [0 2 1 0 3 2]
      "point3 P" [-1.2 -1.2 1  1.2 -1.2 1  1.2 1.2 1  -1.2 1.2 1]
    AttributeEnd"""

  private lazy val bright = near.replace("[1 1 1]", "[25 25 25]")

  private def told(plan: RenderPlan) = plan.features.toMap.apply("caustics")
  private val all = "and all light that media scatter"

  test("in media photons bring all light only where enough of them are seen", Slow):
    def of(fog: String) = told(plan(smoke(fog, within, ""), CausticsMode.Photons, 1))
    assert(of(thick).contains(all))
    assert(of(mist.replace(
      ".5",
      ".02"
    )).contains("photon maps, which bring caustics at surfaces and in media"))
    assert(!of(s"$thick \"rgb Le\" [.2 .1 .1]").contains(all))

  test("nor where a sky is behind a portal, or light from infinity begins in fog", Slow):
    def of(text: String) = told(plan(text, CausticsMode.Photons, 1))
    val sun =
      """LightSource "distant" "rgb L" [.1 .1 .1] "point3 from" [0 -1 1] "point3 to" [0 0 0]"""
    val sky = """LightSource "infinite" "rgb L" [.1 .1 .1]"""
    val behind = sky + """ "point3 portal" [-1 -1 3  1 -1 3  1 1 3  -1 1 3]"""
    assert(of(hazy(s"$near\n$sun")).contains(all))
    assert(of(hazy(s"$bright\n$sky")).contains(all))
    assert(!of(hazy(s"$bright\n$behind")).contains(all))
    assert(!of(hazy(s"$near\nMediumInterface \"\" \"m\"\n$sun")).contains(all))

  test("in media, too, the image has the same bits for any number of threads", Slow):
    val made = plan(smoke(cloudy, within, ""), CausticsMode.Photons, 3)
    assert(pixels(made, threads = 3).toVector == pixels(made).toVector)

  /** Of the red, the green and the blue. */
  private def means(plan: RenderPlan): Vector[Double] =
    val all = pixels(plan, threads = 2)
    Vector.tabulate(3)(c => all.indices.filter(_ % 3 == c).map(all(_).toDouble).sum / all.length)

  private lazy val point = """LightSource "point" "point3 from" [1 -1 3] "rgb I" [3 3 3]"""

  test("the image is said to be biased, and one without casters has no photons", Slow):
    def feature(plan: RenderPlan) = plan.features.collectFirst { case ("caustics", told) => told }
    val made = plan(room(glass), CausticsMode.Photons, 1)
    assert(feature(made).exists(_.contains("biased")))
    assert(made.method.bias.isDefined)
    val matte = room("").replace("\"conductor\" \"float roughness\" .02", "\"diffuse\"")
    val plain = plan(matte, CausticsMode.Photons, 2)
    assert(feature(plain).exists(_.startsWith("none")))
    assert(pixels(plain).toVector == pixels(plan(matte, CausticsMode.Off, 2)).toVector)

  test("what photons can't be combined with is refused by name", Slow):
    def told(text: String, change: RenderSettings => RenderSettings = identity) =
      SceneTexts
        .problems(
          text,
          Dialect.V4,
          options = change(RenderSettings(caustics = Some(CausticsMode.Photons)))
        )
        .map(_.message)
        .mkString("\n")
    val regularized = room(glass).replace("\"path\"", "\"path\" \"bool regularize\" true")
    val why = "\"regularize\" roughens the surfaces that cast caustics"
    assert(told(regularized).contains(s"--caustics photons: $why"))
    assert(told(
      room(glass),
      _.copy(fireflies = Fireflies.Clamped(2f))
    ).contains("--caustics photons: photons do not separate light, as --fireflies clamp"))
    assert(
      told(room(glass), _.copy(guiding = Some(GuidingMode.On)))
        .contains("paths that take caustics from photons are not guided")
    )
    assert(told(room(glass)).isEmpty)
