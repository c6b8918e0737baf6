package candela.mitsuba

import candela.color.Rgb

import java.nio.file.{Files, Path}

/** Where images lie on shapes and emitters, against Mitsuba 3.9.1. */
final class ImagesSuite extends MitsubaPictures:
  private val chart = Path.of("scenes/textures/chart.png").toAbsolutePath

  private def image(use: String, more: String = "") =
    s"<texture type=\"bitmap\" name=\"$use\">" +
      s"<string name=\"filename\" value=\"$chart\"/>$more</texture>"
  private def emitter(more: String = "") =
    s"<emitter type=\"area\">${image("radiance", more)}</emitter>"
  private def shape(kind: String, within: String) = s"<shape type=\"$kind\">$within</shape>"

  private def agrees(body: String, mitsubas: Rgb): Unit =
    val found = mean(body)
    val off = found - mitsubas
    // Pixels hold edges of the image
    assert(Seq(off.r, off.g, off.b).forall(Math.abs(_) < 0.004f), s"$found, not $mitsubas"): Unit

  test("an image that emits repeats, interpolates across its border, and lies as to_uv places it"):
    val turned = "<transform name=\"to_uv\"><rotate z=\"1\" angle=\"20\"/>" +
      "<scale x=\"2.3\" y=\"-1.5\"/></transform>"
    def seen(more: String) = view(8, 256) + shape("rectangle", emitter(more))
    def word(name: String, value: String) = s"<string name=\"$name\" value=\"$value\"/>"
    agrees(seen(""), Rgb(0.41379f, 0.39466f, 0.42864f))
    agrees(seen("<boolean name=\"raw\" value=\"true\"/>"), Rgb(0.64315f, 0.63115f, 0.65332f))
    agrees(seen(turned), Rgb(0.57024f, 0.493f, 0.54209f))
    agrees(seen(turned + word("wrap_mode", "mirror")), Rgb(0.6058f, 0.69737f, 0.3769f))
    agrees(seen(turned + word("wrap_mode", "clamp")), Rgb(0.60818f, 0.25818f, 0.6446f))
    agrees(seen(turned + word("filter_type", "nearest")), Rgb(0.57038f, 0.49281f, 0.54185f))
    val seam = view(6, 256, from = "5,0,0") + shape("sphere", emitter())
    agrees(seam, Rgb(0.49975f, 0.50012f, 0.53661f))

  test("an image on a mesh without coordinates lies on each of its triangles"):
    val mesh = Files.createTempFile("candela", ".obj")
    try
      val _ = Files.writeString(
        mesh,
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n"
      )
      val within = s"<string name=\"filename\" value=\"$mesh\"/>" +
        s"<bsdf type=\"diffuse\">${image("reflectance")}</bsdf>"
      val white = "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>"
      agrees(view(15, 1024) + shape("obj", within) + white, Rgb(0.31189f, 0.31929f, 0.48209f))
    finally Files.delete(mesh)
