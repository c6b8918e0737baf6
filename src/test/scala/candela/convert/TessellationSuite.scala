package candela.convert

import candela.scenefile.Dialect
import candela.testing.{SceneTexts, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

/** Quadrics that v4 lacks look as before as triangles, from all sides. */
class TessellationSuite extends AnyFunSuite:

  private val view = "LookAt 3 4 3 0 0 0 0 0 1 Camera \"perspective\" \"float fov\" 45 " +
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 PixelFilter \"box\" " +
    "Sampler \"halton\" \"integer pixelsamples\" 64 Integrator \"path\" \"integer maxdepth\" 0\n" +
    "WorldBegin AreaLightSource \"diffuse\" "

  private val shapes = Vector(
    "\"cone\" \"float radius\" .9 \"float height\" 1.4 \"float phimax\" 230",
    "\"cone\" \"float alpha\" 0", // v3's quadrics have none
    "\"paraboloid\" \"float radius\" .9 \"float zmin\" .2 \"float zmax\" 1.2",
    "\"paraboloid\" \"float zmin\" -.5 \"float zmax\" 1.2 \"float phimax\" 250",
    "\"hyperboloid\"",
    "\"hyperboloid\" \"point p1\" [.7 -.5 -1] \"point p2\" [.7 .5 1]",
    // Narrowest elsewhere than at z = 0; the last with a gap
    "\"hyperboloid\" \"point p1\" [1 0 -.5] \"point p2\" [1 1 1]",
    "\"hyperboloid\" \"point p1\" [.5 0 .2] \"point p2\" [1 .3 1] \"float phimax\" 250",
    "\"hyperboloid\" \"point p1\" [.9 0 -1] \"point p2\" [.1 0 .3]",
    "\"heightfield\" \"integer nu\" 2 \"integer nv\" 2 \"float Pz\" [0 .3 0 .4]"
  )

  private val turns = Vector(
    "",
    "Scale -1 1 1",
    "Rotate 40 1 1 0 Scale 1 1.2 -1",
    "ReverseOrientation",
    "ReverseOrientation Scale 1 -1 1",
    "ActiveTransform StartTime Scale 1 -1 1 ActiveTransform EndTime Scale 1 -1 1 Translate 0 0 .1"
  )

  for shape <- shapes do
    test(s"$shape, turned, mirrored and reversed"):
      for turn <- turns; isTwoSided <- Seq(false, true) do
        val text = view + s"\"bool twosided\" \"$isTwoSided\"\n$turn Shape $shape\nWorldEnd"
        val scene = SceneTexts.parse(text, Dialect.V3)
        val made = TempFolder.use(Converter.convert(scene, Dialect.V4, _))
        val (before, after) = (SceneTexts.mean(scene).g, SceneTexts.mean(made.scene).g)
        // Chords of 1/32 of its height; 16,384 samples of an edge
        assert(Math.abs(before - after) < 4e-3f, s"$turn, $isTwoSided: $before, $after")

  test("what is seen of a mirrored lamp, and lights the other side in v3 alone, is named"):
    def named(turn: String, shape: String) =
      val text = s"$view\n$turn Shape \"$shape\"\nWorldEnd"
      val scene = SceneTexts.parse(text, Dialect.V3)
      val made = TempFolder.use(Converter.convert(scene, Dialect.V4, _))
      made.warnings.filter(_.message.contains("lights the side that is seen"))
    assert(named("Scale 1 -1 1", "cone").flatMap(_.pos).map(_.line) == Vector(3))
    assert(named("", "cone").isEmpty && named("Scale 1 -1 1", "heightfield").isEmpty)
