package candela.build

import scala.collection.mutable.ArrayBuffer

import candela.scene.{ShapeInstance, Surfaces}

/** Collects the surfaces of the world, or those of an object that instances place in it. */
final class SurfaceBuilder:
  val soup: SoupBuilder = SoupBuilder()
  val solids: ArrayBuffer[ShapeInstance] = ArrayBuffer.empty

  def result(tangents: Boolean, turnsTangents: Boolean): Surfaces =
    Surfaces(soup.result(tangents, turnsTangents), solids.toArray)
