package candela.build.shapes

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** Shading tangents and bumps of placed shapes. The values are those of pbrt. */
class ReliefSuite extends AnyFunSuite:
  private def seen(world: String) = s"""
    Film "image" "integer xresolution" 24 "integer yresolution" 24
    Sampler "halton" "integer pixelsamples" 64
    PixelFilter "box"
    Integrator "directlighting"
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective" "float fov" 20
    WorldBegin
    $world"""

  private val sun =
    "LightSource \"distant\" \"point from\" [3 2 -2] \"point to\" [0 0 0] \"rgb L\" [3 3 3]\n"
  private val rising = """Texture "b" "float" "bilerp"
    "float v00" 0 "float v01" 0 "float v10" .5 "float v11" .5
    """
  private val bumpy = "Material \"matte\" \"rgb Kd\" [.5 .5 .5] \"texture bumpmap\" \"b\"\n"
  private val square = """Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
    "point P" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] "float uv" [0 0 1 0 1 1 0 1]
    """
  private val normals = "\"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]\n"
  private val obj = s"${rising}ObjectBegin \"o\" $bumpy $square $normals ObjectEnd\n"

  private def mean(world: String): Float = SceneTexts.mean(seen(world)).r

  /** Of 24² pixels in half floats; the scenes are flat. */
  private def assertNear(found: Float, expected: Float, share: Float): Unit =
    assert(Math.abs(found - expected) < share * expected, s"$found"): Unit

  test(
    "pbrt-v3's instances scale the unit tangents of meshes with normals, copied or shared",
    Slow
  ):
    val one = mean(s"$sun$obj Scale 3 3 3 ObjectInstance \"o\"")
    assertNear(one, 0.2856f, 0.001f)
    val shared = "AttributeBegin Scale 3 3 3 ObjectInstance \"o\" AttributeEnd\n" +
      "Translate 0 0 -50 ObjectInstance \"o\""
    assertNear(mean(s"$sun$obj$shared"), 0.2856f, 0.001f)

  test("pbrt-v2 makes them of unit length once they are placed, copied or shared", Slow):
    def v2(places: String) =
      val text = seen(s"$sun$obj$places")
        .replace("Integrator", "SurfaceIntegrator").replace("\"rgb ", "\"color ")
        .replace("\"halton\"", "\"lowdiscrepancy\"")
      SceneTexts.mean(text, Dialect.V2).r
    val one = v2("Scale 3 3 3 ObjectInstance \"o\"")
    val shared = v2("AttributeBegin Scale 3 3 3 ObjectInstance \"o\" AttributeEnd\n" +
      "Translate 0 0 -50 ObjectInstance \"o\"")
    assertNear(one, 0.3625f, 0.001f)
    assertNear(shared, 0.3625f, 0.001f)

  test("the normals of pbrt-v3's hyperboloids are those of their line"):
    val light = sun.replace("3 2 -2", "3 4 -3")
    val shape = "\"hyperboloid\" \"point p1\" [1.2 0 0] \"point p2\" [.4 1.1 .9]"
    val world = s"$light Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n" +
      s"Translate 0 -.3 0 Rotate -90 1 0 0 Shape $shape"
    val lit = SceneTexts.mean(seen(world).replace("\"float fov\" 20", "\"float fov\" 28")).r
    // A narrow lit band, whose edges cross pixels
    assertNear(lit, 0.00913f, 0.03f)

  test("hair on pbrt-v3's meshes with normals grows against u"):
    val light = sun.replace("3 2 -2", "3 3 -4")
    def hair(normals: String) = mean(light +
      "Material \"hair\" \"float beta_m\" .3 \"float beta_n\" .3 \"rgb color\" [.6 .4 .3]\n" +
      square + normals)
    // The noise of 64 samples of a smooth lobe
    assertNear(hair(normals), 0.0383f, 0.01f)
    assertNear(hair(""), 0.0198f, 0.01f)

  test("displacements bend with the normals of spheres as pbrt transforms these, unflipped"):
    val uneven = """Texture "b" "float" "bilerp"
      "float v00" .1 "float v01" .1 "float v10" .5 "float v11" .6
      """
    val found = mean(s"$sun$uneven$bumpy ReverseOrientation Scale 2 1.5 1 Shape \"sphere\"")
    assertNear(found, 0.21747f, 0.001f)
