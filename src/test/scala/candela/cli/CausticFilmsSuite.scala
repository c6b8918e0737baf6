package candela.cli

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.nio.file.Files

/** Film files and goals of renderings that look for caustics. */
class CausticFilmsSuite extends AnyFunSuite:
  import CausticFilmsSuite.*

  private def withScene[A](film: String = "rgb")(body: FilmFilesSuite.Folder => A): A =
    TempFolder.use: folder =>
      val made = if film == mist then inMist else text(film)
      val scene = Files.writeString(folder.resolve("s.pbrt"), made)
      body(FilmFilesSuite.Folder(folder, scene))

  private val ways = Vector(
    ("rgb", "--caustics auto --light-groups type --aov direct,indirect"),
    ("rgb", "--caustics on --fireflies clamp:2"),
    ("spectral\" \"integer nbuckets\" 3 \"string sensor\" \"cie1931", "--caustics on"),
    ("rgb", "--caustics photons"),
    (mist, "--caustics photons")
  )

  for (film, options) <- ways do
    val words = options.split(' ').toSeq
    test(
      s"shards and resumed films add up to the image of one run: $options, ${film.take(8)}",
      Slow
    ):
      withScene(film): f =>
        def render(more: String*) = f.render(words ++ more*)
        render("--spp", "4", "--outfile", f("one.exr"))
        for i <- 0 to 1 do render("--spp", "4", "--shard", s"$i/2", "--outfile", f(s"$i.film"))
        f.run(Vector("merge", "--outfile", f("all.exr"), f("1.film"), f("0.film")))
        assert(f.bytes("all.exr") == f.bytes("one.exr"))
        render("--spp", "2", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
        f.run(Vector("resume", f("a.film"), "--spp", "4"))
        assert(f.bytes("a.exr") == f.bytes("one.exr"))

  test("an image with caustics that ended by an error is that of as many samples", Slow):
    withScene(): f =>
      val looked = Vector("--caustics", "auto", "--guiding", "off")
      f.render(looked ++ Vector("--error", "0.05", "--outfile", f("a.exr"))*)
      val reached = ImageSamples.of(f.bytes("a.exr"))
      assert(reached > 4)
      val words = looked ++ Vector("--sampler", "progressive", "--spp", s"$reached")
      f.render(words ++ Vector("--outfile", f("b.exr"))*)
      assert(f.bytes("a.exr") == f.bytes("b.exr"))

private object CausticFilmsSuite:
  private val mist = "mist"

  /** The ball in thick mist. */
  private def inMist: String =
    val fog = """MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_s" [.6 .5 .4]"""
    text("rgb")
      .replace("LookAt", s"$fog\nMediumInterface \"\" \"m\"\nLookAt")
      .replace("\"path\"", "\"volpath\"")

  /** A ball of glass under a small emitter. */
  def text(film: String): String =
    s"""LookAt 0 2 -4  0 .4 0  0 1 0
       |Camera "perspective" "float fov" 30
       |Film "$film" "integer xresolution" 24 "integer yresolution" 16
       |Sampler "independent" "integer pixelsamples" 4
       |Integrator "path" "integer maxdepth" 5
       |WorldBegin
       |LightSource "infinite" "rgb L" [.1 .1 .1]
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [560 560 560]
       |Translate 1 2.6 .5
       |Shape "sphere" "float radius" .08
       |AttributeEnd
       |Material "diffuse" "rgb reflectance" [.6 .6 .5]
       |Shape "bilinearmesh" "point3 P" [-5 0 -5  -5 0 5  5 0 -5  5 0 5]
       |Material "dielectric"
       |Translate 0 .7 0
       |Shape "sphere" "float radius" .5
       |""".stripMargin
