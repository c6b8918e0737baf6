package candela.render

import java.nio.file.Files

import candela.image.Image
import candela.integrators.CausticsMode

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** What the comparisons of [[ReferenceSuite]] see, and what they leave out. */
class RenderSuite extends AnyFunSuite:
  import ReferenceComparison.Significance

  private def bits(image: Image): Seq[Int] =
    image.data.map(java.lang.Float.floatToRawIntBits).toSeq

  test("light paths bring the rainbow of a prism to path", Slow):
    val scene = ReferenceScenes.named("v4-prism")
    val text = Files.readString(scene.file)
    assert(text.contains("\"bdpt\""))
    val caustics = Some(CausticsMode.On)
    val asked = text.replace("\"bdpt\"", "\"path\"")
    // What is below is seen through the prism, where only bdpt connects what the rainbow lights
    val agreement = ReferenceComparison(scene, asked, caustics = caustics, rows = Some(30))
    assert(agreement.disagreements(Significance).isEmpty)

  test("every reference has its scene, its place in the manifest, its noise and its digest"):
    val folders = Vector(ReferenceScenes.ReferencesOfModels, ReferenceScenes.References)
    val images = folders.flatMap(ReferenceScenes.names(_, ".exr"))
    assert(images.sorted == ReferenceScenes.manifest.map(_("scene")).sorted)
    assert(images == ReferenceScenes.all.map(_.name))
    val titles = ReferenceScenes.compared.map(_.title).sorted
    assert(titles == ImageDigests.rows.map(_.scene), ImageDigests.Renewal)
    assert(ReferenceScenes.all.forall(s => s.noise > 0 && s.allowance >= 0))

  // The same comparison must see when something is wrong: (scene, what is broken, as written,
  // instead)
  private val broken = Vector(
    ("v3-matte-directlighting", "an albedo 5 % too high", "[.7 .3 .2]", "[.735 .315 .21]"),
    ("v3-matte-whitted", "a rough surface taken for a smooth one", "\"float sigma\" 60", ""),
    ("v3-glossy", "a roughness 40 % too high", "\"float roughness\" .1", "\"float roughness\" .14"),
    ("v3-meshes", "shading normals left out", "\"normal N\"", "\"normal Nothing\""),
    ("v3-textures", "a texture read upside down", "\"float vscale\" 1.2", "\"float vscale\" -1.2"),
    ("v3-environment-map", "a sky turned by 2 degrees", "Rotate 130", "Rotate 132"),
    ("v3-filter-mitchell", "another filter", "PixelFilter \"mitchell\"", "PixelFilter \"box\""),
    ("v4-conductor", "gold without its colour", "metal-Au-", "metal-Ag-"),
    (
      "v4-dielectric",
      "an index of refraction 0.05 too high",
      "\"float eta\" 1.3",
      "\"float eta\" 1.35"
    ),
    (
      "v4-depth-of-field",
      "a lens 40 % too wide",
      "\"float lensradius\" .18",
      "\"float lensradius\" .25"
    )
  )

  for (name, what, written, instead) <- broken do
    test(s"$what is seen in $name", Slow):
      val scene = ReferenceScenes.named(name)
      val text = Files.readString(scene.file)
      assert(text.contains(written))
      val agreement = ReferenceComparison(scene, text.replace(written, instead))
      assert(agreement.disagreements(Significance).nonEmpty)

  test("one thread and two make the same image, bit for bit"):
    for name <- Seq("v2-path-grid", "v3-lights", "v4-coated-diffuse") do
      val scene = ReferenceScenes.named(name)
      val text = Files.readString(scene.file)
      val one = ReferenceComparison.render(scene, text, seed = 5, spp = 4, threads = 1)
      val two = ReferenceComparison.render(scene, text, seed = 5, spp = 4, threads = 2)
      assert(bits(one) == bits(two), name)
      val other = ReferenceComparison.render(scene, text, seed = 6, spp = 4, threads = 2)
      assert(bits(one) != bits(other), s"$name: the seed is ignored")
