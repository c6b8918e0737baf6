package candela.aov

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Lambert
import candela.color.{ColorSpace, Rgb}
import candela.film.{Development, PixelBounds}
import candela.geometry.{Frame, Ray}
import candela.image.Image
import candela.math.Vec3
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

object LayerFilmSuite:

  /** The camera's space is the world's, and colours are in linear sRGB. */
  def nothing: VisibleSurface =
    val text = """Camera "perspective" WorldBegin LightSource "infinite" Shape "sphere" """
    val asked = RenderSettings(layers = Layer.values.toVector)
    SceneTexts.plan(text, Dialect.V3, asked).layers.get.surface

final class LayerFilmSuite extends AnyFunSuite:
  import LayerFilmSuite.nothing

  /** Seen from the origin. */
  private def surface(p: Vec3, n: Vec3, albedo: Float): VisibleSurface =
    val seen = nothing
    seen.point.p = p
    seen.point.geometricNormal = n
    seen.point.frame.set(Frame.fromZ(n))
    seen.point.dpdx = Vec3(0, 0, -2)
    seen.point.u = 0.25f
    val ray = Ray()
    ray.set(Vec3.Zero, -n, 1f)
    seen.record(ray, Lambert(Rgb(albedo, 0f, 1f)))
    seen

  private def value(image: Image, name: String, x: Int = 0): Float =
    image(x, 0, image.channelNames.indexOf(name))

  private def filled(layers: Vector[Layer], scale: Float = 1f): Image =
    val film = LayerFilm(PixelBounds(3, 5, 5, 6), layers)
    film.add(3, 5, Rgb(1f, 2f, 3f), 1f, surface(Vec3(1, 0, 0), Vec3(1, 0, 0), 0.5f))
    film.add(3, 5, Rgb(3f, 2f, 7f), 3f, surface(Vec3(3, 4, 0), Vec3(0, 1, 0), 0.9f))
    film.add(3, 5, Rgb(9f, 9f, 9f), 1f, nothing)
    film.miss(3, 5, 1f)
    film.appendTo(Image.rgb(2, 1), Development(scale))

  test("channels have pbrt-v4's names, behind the image's own"):
    val names = filled(Layer.gbuffer).channelNames
    assert(names.mkString(" ") == "R G B Albedo.R Albedo.G Albedo.B P.X P.Y P.Z dzdx dzdy " +
      "N.X N.Y N.Z Ns.X Ns.Y Ns.Z u v Variance.R Variance.G Variance.B " +
      "RelativeVariance.R RelativeVariance.G RelativeVariance.B")

  test("albedos are in the image's colour space, where white is 1"):
    val space = ColorSpace.named("aces2065-1").get
    val film = LayerFilm(PixelBounds(0, 0, 1, 1), Vector(Layer.Albedo))
    film.add(0, 0, Rgb.Black, 1f, surface(Vec3(1, 0, 0), Vec3(1, 0, 0), 0.5f))
    val empty = Image(1, 1, Image.RgbNames, Array(0f, 0f, 0f), colorSpace = space)
    val image = film.appendTo(empty, Development())
    val wanted = space.ofSrgbAdapted * Rgb(0.5f, 0f, 1f)
    assert(image.colorSpace eq space)
    assert(value(image, "Albedo.R") == wanted.r && value(image, "Albedo.G") == wanted.g)

  test("means are weighted: of places over what was met, of albedos over all samples"):
    val image = filled(Layer.values.toVector)
    assert(Math.abs(value(image, "P.X") - 2.5f) < 1e-6f)
    assert(Math.abs(value(image, "P.Y") - 3f) < 1e-6f)
    assert(Math.abs(value(image, "Albedo.R") - (0.5f + 2.7f) / 6) < 1e-6f)
    assert(Math.abs(value(image, "Z") - (1f + 15f) / 4) < 1e-6f)
    assert(value(image, "u") == 0.25f && value(image, "dzdx") == 2f)
    assert(value(image, "samples") == 4f)

  test("normals are unit vectors again"):
    val image = filled(Vector(Layer.Normal))
    assert(Math.abs(value(image, "N.X") - 1 / Math.sqrt(10)) < 1e-6)
    assert(Math.abs(value(image, "N.Y") - 3 / Math.sqrt(10)) < 1e-6)

  test("the variance is that of the samples that met something, scaled as the image is"):
    for layers <- Seq(Vector(Layer.Variance), Vector(Layer.RelativeVariance, Layer.Variance)) do
      val image = filled(layers, scale = 10f)
      assert(Math.abs(value(image, "Variance.R") - 200f) < 1e-4f)
      assert(value(image, "Variance.G") == 0f)
      assert(Math.abs(value(image, "Variance.B") - 800f) < 1e-3f)
    val relative = filled(Vector(Layer.RelativeVariance), scale = 10f)
    assert(Math.abs(value(relative, "RelativeVariance.B") - 10 * 8f / 5) < 1e-4f)

  test("the variance is that of samples that vary as the inverse of their weights"):
    val film = LayerFilm(PixelBounds(3, 5, 5, 6), Vector(Layer.Variance, Layer.RelativeVariance))
    // Weighted, 1, 5 and 2 are 1, 5, 2, 2, 2, 2; the mean is 14 / 6, the mean of squares 42 / 6
    for (light, weight) <- Vector((1f, 1f), (5f, 1f), (2f, 4f)) do
      val seen = surface(Vec3(1, 0, 0), Vec3(1, 0, 0), 0.5f)
      seen.weight = weight
      film.add(3, 5, Rgb(light, 2f, 0f), weight, seen)
    val image = film.appendTo(Image.rgb(2, 1), Development())
    val expected = (42.0 / 6 - (14.0 / 6) * (14.0 / 6)) * 3 / 2
    assert(Math.abs(value(image, "Variance.R") - expected) < 1e-6)
    assert(Math.abs(value(image, "RelativeVariance.R") - expected / (14.0 / 6)) < 1e-6)
    assert(value(image, "Variance.G") == 0f)

  test("a pixel without samples is 0 in every layer"):
    val image = filled(Layer.values.toVector)
    assert(image.channelNames.forall(value(image, _, x = 1) == 0f))
