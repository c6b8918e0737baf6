package candela.build.cameras

import candela.diagnostics.Severity
import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

import candela.cameras.LensSurface
import candela.scenefile.Dialect
import candela.testing.SceneTexts

final class LensFileSuite extends AnyFunSuite:
  private val world = "WorldBegin\nShape \"sphere\""

  private def said(camera: String, dialect: Dialect = Dialect.V4, film: String = "") =
    val resolution = "\"integer xresolution\" 8 \"integer yresolution\" 8"
    val kind = if dialect == Dialect.V4 then "rgb" else "image"
    val text = s"Camera \"realistic\" $camera\nFilm \"$kind\" $resolution $film\n$world"
    SceneTexts.problems(text, dialect, Path.of("scenes"))

  private val lens = "\"string lensfile\" \"lenses/double-gauss-50mm.dat\""

  test("a row is a surface, in millimetres and diameters"):
    val read = LensFile.surfaces("# two\n10 2 1.5 8 # glass\n\n0 1 0 4").toOption.get
    assert(read == Vector(LensSurface(0.01, 0.002, 1.5, 0.004), LensSurface(0, 0.001, 0, 0.002)))

  test("what is no table of surfaces is refused, with its line"):
    val incomplete = "7 numbers don't form complete surfaces of 4 each"
    assert(LensFile.surfaces("1 2 3 4\n5 6 7") == Left(incomplete))
    assert(LensFile.surfaces("1 2\nx 4") == Left("`x` in line 2 is not a number"))
    assert(LensFile.surfaces("1 2 3 nan").isLeft && LensFile.surfaces("").isLeft)
    assert(LensFile.surfaces("1 2 1.5 0").left.exists(_.contains("surface 1")))

  test("a lens file is needed, and must be there"):
    for dialect <- Seq(Dialect.V3, Dialect.V4) do
      val errors = said("", dialect).filter(_.severity == Severity.Error)
      assert(errors.exists(_.message.contains("needs `lensfile`")))
      val missing = said("\"string lensfile\" \"lenses/double-gauss.dat\"", dialect)
      assert(missing.exists(p => p.message.contains("no file") && p.severity == Severity.Error))

  test("a stop can't be opened wider than it is"):
    assert(said(s"$lens \"float aperturediameter\" 20").exists(_.message.contains("17.1 mm")))
    assert(said(s"$lens \"float aperturediameter\" 10").forall(_.severity != Severity.Error))

  test("what can't be focused is an error"):
    val near = said(s"$lens \"float aperturediameter\" 10 \"float focusdistance\" .1")
    assert(near.exists(p => p.message.contains("at least") && p.severity == Severity.Error))
    val none = said(s"$lens \"float aperturediameter\" 0")
    assert(none.exists(p => p.message.contains("must be above 0") && p.severity == Severity.Error))

  test("of pbrt-v2 only forks have lenses"):
    assert(said("", Dialect.V2).exists(_.message.contains("only forks of pbrt-v2")))

  test("a stop's shape is one of four names, or an image"):
    for name <- Seq("gaussian", "square", "pentagon", "star", "textures/chart.png") do
      val shaped = said(s"$lens \"float aperturediameter\" 10 \"string aperture\" \"$name\"")
      assert(shaped.forall(_.severity != Severity.Error), s"$name: $shaped")
    val unknown = said(s"$lens \"string aperture\" \"hexagon\"")
    assert(unknown.exists(_.message.contains("no file `hexagon`")))

  test("simpleweighting divides by the pupil that pbrt-v3 finds, also of small stops"):
    // pbrt-v3's means at 256 samples; the smallest stop is a hundredth off with any weighting
    for (stop, expected) <- Seq(1 -> 0.5307f, 4 -> 0.6743f, 20 -> 0.4855f) do
      val found = candela.testing.SceneTexts.mean(s"""
        Film "image" "integer xresolution" 24 "integer yresolution" 24 "float diagonal" 35
        Sampler "halton" "integer pixelsamples" 64
        PixelFilter "box"
        Integrator "path" "integer maxdepth" 1
        Camera "realistic" "string lensfile" "scenes/lenses/double-gauss-50mm.dat"
          "float aperturediameter" $stop "float focusdistance" 10
        WorldBegin
        LightSource "infinite" "rgb L" [1 1 1]""").r
      assert(Math.abs(found / expected - 1f) < 0.015f, s"stop of $stop mm: $found")
