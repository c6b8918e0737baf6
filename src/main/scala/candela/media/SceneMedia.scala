package candela.media

import candela.geometry.ShadingPoint
import candela.math.Vec3

/** The media on both sides of a surface, as indices; −1: none. Where both are one, the surface is
  * no border: each ray stays in the medium that it is in.
  */
final case class MediumBorder(inside: Int, outside: Int)

/** The media of a scene, and where they are: what is between two surfaces is told by them.
  *
  * @param media         without those that are empty space
  * @param borders       by index of the scene's materials
  * @param camera        index of the medium around the camera, −1: none
  * @param reach         how far the light of infinitely distant lights travels through media: the
  *                      scene's diameter, as in pbrt-v3 and v4
  * @param hasInterfaces are there surfaces that all light passes? Then what is in a light's way
  *                      must be looked at
  */
final class SceneMedia(
    val media: Array[Medium],
    borders: Array[MediumBorder],
    val camera: Int,
    val reach: Float,
    val hasInterfaces: Boolean
):
  private val inside = borders.map(_.inside)
  private val outside = borders.map(_.outside)

  /** Does chance need a colour to decide by? */
  val isChromatic: Boolean = media.exists(_.isChromatic)

  /** Index of the medium into which a ray leaves the surface at `at` in direction `w`, having come
    * through `current`.
    */
  def beyond(at: ShadingPoint, w: Vec3, current: Int): Int =
    val in = inside(at.material)
    val out = outside(at.material)
    if in == out then current else if (w dot at.geometricNormal) > 0f then out else in

  /** For the plan. */
  def describe: String =
    val around = if camera >= 0 then ", one around the camera" else ""
    if media.isEmpty then "none, but surfaces that all light passes"
    else s"${media.length} (${media.map(_.describe).mkString("; ")})$around"
