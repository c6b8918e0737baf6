package candela.build

import scala.collection.mutable.ArrayBuffer

import candela.accel.{Mask, Masks}
import candela.build.shapes.SoupBuilder
import candela.scene.{ShapeInstance, Surfaces}

/** Collects the surfaces of the world, or those of an object that instances place in it. */
final class SurfaceBuilder:
  val soup: SoupBuilder = SoupBuilder()
  private val solids = ArrayBuffer.empty[ShapeInstance]

  private val meshMasks = ArrayBuffer.empty[Mask]
  private val solidMasks = ArrayBuffer.empty[Mask]

  def add(solid: ShapeInstance, mask: Mask): Unit =
    solids += solid
    solidMasks += mask

  /** The holes of the mesh that was added to `soup` last. */
  def maskMesh(mask: Mask): Unit = meshMasks += mask

  def result(tangents: Boolean): Surfaces =
    val masks = Masks(meshMasks.toArray, solidMasks.toArray)
    Surfaces(soup.result(tangents), solids.toArray, masks)
