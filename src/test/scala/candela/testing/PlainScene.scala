package candela.testing

import candela.accel.Instances
import candela.accel.tracing.Bvh
import candela.bsdf.{ConstantMaterial, Lambert}
import candela.color.Rgb
import candela.lights.{Light, SingleLight}
import candela.scene.{Instanced, Scene, SceneMaterials, ShapeTable, Surfaces}
import candela.testing.Soups.Triangle

/** Scenes of a few diffuse triangles and one light, without the statements that others come from.
  */
object PlainScene:
  /** @param reflectance of all triangles */
  def apply(reflectance: Rgb, light: Light, triangles: Triangle*): Scene =
    val soup = if triangles.isEmpty then Soups.Empty else Soups.of(triangles)
    val surfaces = Surfaces(soup, ShapeTable.Empty)
    Scene(
      surfaces,
      Instanced(Array.empty, Instances.Empty),
      Bvh(surfaces.primitives(Instances.Empty)),
      SceneMaterials(Array(ConstantMaterial(Lambert(reflectance)))),
      Array(light),
      SingleLight(),
      sidesByGeometry = false
    )
