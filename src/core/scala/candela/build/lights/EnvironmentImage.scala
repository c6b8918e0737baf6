package candela.build.lights

import candela.io.Keep
import candela.build.recipe.*
import candela.color.Rgb
import candela.image.Image
import candela.lights.{ImageEnvironment, SphereImage, SphereMap, TiledSphereImage}
import candela.sampling.Distribution2D
import candela.textures.MipLevel

/** The image of an environment: red, green and blue, in memory or in tiles.
  *
  * @param content tells it from others; None: what is made of it is not kept
  */
private[build] abstract class EnvironmentImage(
    val width: Int,
    val height: Int,
    content: Option[String]
):

  /** See [[SphereImage]]. */
  def onSphere(layout: SphereMap, factor: Rgb, smooth: Boolean)(using Site): SphereImage

  /** With a row between those at the poles, which alone have no area. */
  def withEquator: EnvironmentImage = this

  /** Its sampling table, which is kept.
    *
    * @param image    this one on the sphere, by the mapping and the colours that `way` tells
    * @param complete see [[ImageEnvironment.distribution]]
    */
  def distribution(image: SphereImage, way: String, complete: Boolean)(using
      site: Site
  ): Distribution2D =
    def table = ImageEnvironment.distribution(image, complete)
    content.fold(table)(content => cached(s"$content $way ${image.smooth} $complete")(table))

  /** The table of this key, which `build` builds. */
  protected def cached(key: String)(build: => Distribution2D)(using site: Site): Distribution2D =
    site.resources.cache(EnvironmentImage.Tables, key)(build)

private[build] object EnvironmentImage:
  private val Tables = Keep.Shelf[Distribution2D](Some(Distribution2D.Form))

  /** Of images in tiles: their files are those of the texture cache. */
  private val TablesOfTiles = Keep.Shelf[Distribution2D]()

  final class InMemory(image: Image, content: Option[String])
      extends EnvironmentImage(image.width, image.height, content):
    override def withEquator: EnvironmentImage =
      InMemory(LightImages.withEquator(image), content)

    def onSphere(layout: SphereMap, factor: Rgb, smooth: Boolean)(using Site): SphereImage =
      SphereImage(image, layout, factor, smooth, LightImages.conversion)

  /** @param stored makes colours of the scene's basis of the pixels, if they are of another */
  final class InTiles(pixels: MipLevel, stored: Option[Rgb => Rgb], content: String)
      extends EnvironmentImage(pixels.width, pixels.height, Some(content)):
    def onSphere(layout: SphereMap, factor: Rgb, smooth: Boolean)(using Site): SphereImage =
      TiledSphereImage(pixels, stored, layout, factor, smooth, LightImages.conversion)

    override protected def cached(key: String)(made: => Distribution2D)(using
        site: Site
    ): Distribution2D =
      val textures = site.resources.textures
      val table = site.resources.cache(TablesOfTiles, key):
        textures.table(Distribution2D.Form, key)(made)
      textures.warn(site.problems)
      table
