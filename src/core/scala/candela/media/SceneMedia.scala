package candela.media

import candela.geometry.ShadingPoint
import candela.math.Vec3

/** The medium interface of a surface, as indices; −1 for vacuum. If both are equal, the surface is
  * no interface: each ray stays in its current medium.
  */
final case class MediumBorder(inside: Int, outside: Int)

/** The media of a scene and their interfaces: the surfaces define which medium lies between them.
  *
  * @param media         media other than vacuum
  * @param borders       indexed by the scene's materials
  * @param camera        index of the medium around the camera; −1 for vacuum
  * @param lights        index of the medium declared around each light without a surface; −1: none
  * @param eye           where the camera is, at shutter open
  * @param reach         distance that light from infinity travels through media: the scene's
  *   diameter, as in pbrt-v3 and v4
  */
final class SceneMedia(
    val media: Array[Medium],
    borders: Array[MediumBorder],
    val camera: Int,
    val lights: Array[Int],
    val eye: Vec3,
    val reach: Float
):
  private val inside = borders.map(_.inside)
  private val outside = borders.map(_.outside)

  /** Whether sampling needs a hero colour. */
  val isChromatic: Boolean = media.exists(_.isChromatic)

  /** Index of the medium that a ray enters when it leaves the surface at `at` in direction `w`,
    * having come through `current`.
    */
  def beyond(at: ShadingPoint, w: Vec3, current: Int): Int =
    val inner = inside(at.material)
    val outer = outside(at.material)
    if inner == outer then current else if (w dot at.geometricNormal) > 0f then outer else inner

  /** Summary for the render plan. */
  def describe: String =
    val cameraText = if camera >= 0 then ", one around the camera" else ""
    if media.isEmpty then "none, but interfaces"
    else s"${media.length} (${media.map(_.describe).mkString("; ")})$cameraText"
