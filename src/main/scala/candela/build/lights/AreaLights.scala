package candela.build

import candela.color.Rgb
import candela.geometry.Bounds3
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{Shape, SurfaceSampler, TriangleSampler}

/** Recipes of lights that are surfaces. */
object AreaLights:
  val all: Recipes[AreaLightPlan] =
    Recipes("area light", Vector(DiffuseLight("diffuse", every), DiffuseLight("area", untilV3)))

/** What an area light statement says; it applies to the shapes that follow. */
final class AreaLightPlan(emitted: Rgb, power: Float, twoSided: Boolean, val samples: Int):

  /** Emission of the whole shape of `area`: v4's `power` fixes it, whatever the area. */
  private def radiance(area: => Float): Rgb =
    if power > 0f then
      val sides = if twoSided then 2f else 1f
      emitted * (power / (area * Pi * sides))
    else emitted

  def ofTriangle(triangle: TriangleSampler, meshArea: Float): AreaLight =
    AreaLight(
      triangle, radiance(meshArea), twoSided, Bounds3.of(triangle.vertices), triangle.normal, 1f
    )

  /** One of the shapes of a statement, which have `wholeArea` together. */
  def ofShape(shape: Shape, wholeArea: => Float): AreaLight =
    val (axis, cosSpread) = shape.normals
    AreaLight(shape: SurfaceSampler, radiance(wholeArea), twoSided, shape.bounds, axis, cosSpread)

final class DiffuseLight(name: String, dialects: Set[Dialect])
    extends Recipe[AreaLightPlan](name, "every point of the surface emits evenly", dialects)
    with SampleCounts:
  private val radiance =
    color("L", "emitted radiance", SpectrumRole.Emission, unit = "W/(m² sr)")(Rgb.White)
  private val colored =
    color("scale", "factor of `L`", SpectrumRole.Reflectance, untilV3)(Rgb.White)
  private val scale = float("scale", "factor of `L`", onlyV4)(1f)
  private val twoSided = bool("twosided", "does the inside emit too?", sinceV3)(false)
  private val power =
    float("power", "total, instead of the size of `L`", onlyV4, "lm", "none")(-1f)
  notYet("the surface emits `L` all over")(
    string("filename", "image over the surface's uv", onlyV4, shown = "none")("")
  )

  protected def make()(using Site): AreaLightPlan =
    AreaLightPlan(
      radiance() * colored() * scale(),
      power(),
      twoSided(),
      sampleCount()
    )
