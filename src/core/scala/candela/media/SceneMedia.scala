package candela.media

import java.lang.invoke.VarHandle

import candela.bsdf.PhaseLobe
import candela.geometry.ShadingPoint
import candela.math.Vec3

/** The medium interface of a surface, as indices; −1 for vacuum. If both are equal, the surface is
  * no interface: each ray stays in its current medium.
  */
final case class MediumBorder(inside: Int, outside: Int)

/** The media of a scene and their interfaces: the surfaces define which medium lies between them.
  * Safe for threads. Those of a set of wavelengths are made when a path first enters them.
  *
  * @param layout what all sets share
  * @param maker  makes media by index
  */
final class SceneMedia private (layout: SceneMedia.Layout, maker: Int => Medium):
  export layout.{beyond, camera, describe, eye, isEmissive, lights, lobes, reach}

  // Read without a lock: each is stored behind a fence
  private val media = new Array[Medium | Null](layout.media.length)

  def apply(index: Int): Medium =
    val medium = media(index)
    if medium != null then medium else fresh(index)

  private def fresh(index: Int): Medium = synchronized:
    val existing = media(index)
    if existing != null then existing
    else
      val medium = maker(index)
      VarHandle.releaseFence()
      media(index) = medium
      medium

  /** Whether sampling needs a hero colour. Grey coefficients are grey in all colour bases. */
  val isChromatic: Boolean =
    layout.media.indices.exists(i => layout.media(i).isChromatic && this(i).isChromatic)

  /** The media of another colour basis, in the same order. */
  def inBasis(maker: Int => Medium): SceneMedia = new SceneMedia(layout, maker)

  /** The same media, around a camera elsewhere. */
  def seenFrom(eye: Vec3): SceneMedia = new SceneMedia(layout.seenFrom(eye), this(_))

object SceneMedia:
  /** @param media   media other than vacuum
    * @param borders indexed by the scene's materials
    * @param camera  index of the medium around the camera; −1 for vacuum
    * @param lights  index of the medium declared around each light without a surface; −1: none
    * @param eye     where the camera is, at shutter open
    * @param reach   distance that light from infinity travels through media: the scene's diameter,
    *   as in pbrt-v3 and v4
    */
  def apply(
      media: Array[Medium],
      borders: Array[MediumBorder],
      camera: Int,
      lights: Array[Int],
      eye: Vec3,
      reach: Float
  ): SceneMedia =
    new SceneMedia(Layout(media, borders, camera, lights, eye, reach), media(_))

  private final class Layout(
      val media: Array[Medium],
      borders: Array[MediumBorder],
      val camera: Int,
      val lights: Array[Int],
      val eye: Vec3,
      val reach: Float
  ):
    def seenFrom(eye: Vec3): Layout = Layout(media, borders, camera, lights, eye, reach)

    private val inside = borders.map(_.inside)
    private val outside = borders.map(_.outside)

    /** Phase functions as the BSDFs of vertices. */
    val lobes: Array[PhaseLobe] = media.map(m => PhaseLobe(m.phase))

    def isEmissive: Boolean = media.exists(_.isEmissive)

    /** Index of the medium that a ray enters when it leaves the surface at `at` in direction `w`,
      * having come through `current`.
      */
    def beyond(at: ShadingPoint, w: Vec3, current: Int): Int =
      val inner = inside(at.material)
      val outer = outside(at.material)
      if inner == outer then current
      else if (w dot at.geometricNormal) > 0f then outer
      else inner

    /** Summary for the render plan. */
    def describe: String =
      val cameraText = if camera >= 0 then ", one around the camera" else ""
      if media.isEmpty then "none, but interfaces"
      else Medium.summary(media.toSeq.map(_.describe)) + cameraText
