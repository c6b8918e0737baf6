package candela.build

import scala.collection.mutable
import scala.collection.mutable.ArrayBuffer

import candela.accel.{Accelerator, Instances, Primitives}
import candela.bsdf.{InterfaceMaterial, Material}
import candela.build.integrators.{Dispersions, IntegratorPlan}
import candela.build.lights.{AreaLightPlan, AreaLights, LightPlan, Lights, MeshLights}
import candela.build.materials.{Materials, ShapeMaterials}
import candela.build.recipe.*
import candela.build.settings.{Accelerators, BvhRecipe}
import candela.build.shapes.{ShapeGeometry, ShapePlan, Shapes}
import candela.build.textures.Textures
import candela.cameras.Shutter
import candela.lights.{Light, LightSelection}
import candela.math.{Motion, Transform}
import candela.media.MediumBorder
import candela.render.RenderMethod
import candela.scene.{Footprints, Instanced, Scene, ShapeInstance, Surfaces}
import candela.scenefile.*
import candela.shapes.{BumpTangents, Shape}

/** The world, ready to render, with what it holds in words. */
final class World(
    val scene: Scene,
    val method: RenderMethod,
    val features: Vector[(String, String)],
    val moves: Boolean
)

/** Makes shapes, materials and lights of a description. */
final class WorldBuilder(
    description: SceneDescription,
    integratorPlan: IntegratorPlan,
    shutter: Shutter,
    resources: Resources,
    problems: Findings
):
  private val materials = ArrayBuffer.empty[Material]
  private val borders = ArrayBuffer.empty[MediumBorder]
  private val materialOf = mutable.HashMap.empty[(MaterialRef, MediumBorder), Int]
  private val madeOf = mutable.HashMap.empty[MaterialRef, Material]
  private val world = SurfaceBuilder()
  private val lights = ArrayBuffer.empty[Light]
  private val lightSamples = ArrayBuffer.empty[Int]

  /** Lights of mesh triangles can be made only when all triangles are known. */
  private val meshLights = ArrayBuffer.empty[MeshLights]

  private val media = MediaBuilder(description, integratorPlan, resources, problems)

  private def site(d: Declaration, toWorld: Transform = Transform.Identity) =
    Site(d, description.dialect, resources, problems, toWorld)

  /** @param footprints made if a texture or a material has asked for them */
  def build(footprints: => Footprints): World =
    for t <- description.textures do
      if t.textureToWorld.isAnimated then problems.warn(t.texture.at, Motions.stands("a texture"))
      Textures.define(t, site(t.texture, t.textureToWorld.start))
    for (name, d) <- description.namedMaterials do
      resources.materials.define(name, () => Materials.build(site(d)))
    val uses = ObjectUses(description, problems)
    for s <- uses.world do add(s, world)
    val objectBuilders = uses.shared.map: placed =>
      val builder = SurfaceBuilder()
      for s <- placed.shapes do add(s, builder)
      builder
    val lightPlans = description.lights.map(plan)
    problems.stopAtErrors()
    val tangents = materials.exists(_.isAnisotropic)
    val surfaces = world.result(tangents)
    val objects = objectBuilders.map(_.result(tangents))
    for (light, k) <- meshLights.flatMap(_.of(surfaces.soup)) do lights(k) = light
    // Where geometry decides on sides, light sampling finds directions that BSDF sampling does not
    val complete = !integratorPlan.samplesBsdf || description.dialect != Dialect.V4
    for (l, made) <- description.lights.zip(lightPlans) do addLight(l, made, complete)
    val instanced = instances(objects, uses.shared.map(_.places))
    val accelerator = accelerate(surfaces, instanced.instances)
    val sources = lights.toArray
    val selection = LightSelection.of(sources, integratorPlan.lights, accelerator.bounds)
    val scene = Scene(
      surfaces,
      instanced,
      accelerator,
      materials.toArray,
      sources,
      selection,
      sidesByGeometry = description.dialect != Dialect.V4,
      Option.when(resources.footprintUses.nonEmpty)(footprints)
    )
    if sources.isEmpty && integratorPlan.isLit && !problems.hasErrors then
      for c <- description.camera do
        problems.warn(c.at, "the scene has no light: its image will be black")
    val (method, inMedia) = media.method(
      scene,
      lightSamples.toArray,
      borders.toArray,
      hasInterfaces = materials.exists(_ eq InterfaceMaterial),
      reach = 2f * accelerator.bounds.radius
    )
    World(
      scene,
      method,
      Vector(
        "accelerator" -> accelerator.describe,
        "triangles" -> surfaces.soup.count.toString,
        "other shapes" -> surfaces.solids.length.toString,
        "instances" -> instanced.describe,
        "masks" -> masked(surfaces +: objects),
        "materials" -> s"${materials.length}, ${materials.count(_.isConstant)} of them constant",
        "subsurface" -> beneath,
        "dispersion" -> Dispersions.describe(scene, method, description, problems),
        "ray differentials" -> resources.footprintsInWords,
        "media" -> inMedia,
        "lights" -> (if sources.isEmpty then "none" else selection.describe)
      ),
      instanced.instances.moving > 0
    )

  private def masked(surfaces: Vector[Surfaces]): String =
    val (meshes, shapes) = (surfaces.map(_.masks.meshes).sum, surfaces.map(_.masks.shapes).sum)
    if meshes + shapes == 0 then "none" else s"on $meshes meshes and $shapes other shapes"

  private def beneath: String =
    val count = materials.count(_.isSubsurface)
    if count == 0 then "none"
    else if integratorPlan.goesBeneath then s"light travels beneath $count materials"
    else s"$count materials show their surface alone: so this integrator does in pbrt, too"

  private def instances(objects: Vector[Surfaces], places: Vector[Vector[Motion]]): Instanced =
    val accelerators = objects.map(accelerate(_, Instances.Empty))
    val all = places.zipWithIndex.flatMap((transforms, o) => transforms.map(t => (o, t)))
    val placed = Instances.of(accelerators.toArray, all, shutter.open, shutter.close)
    Instanced(objects.toArray, placed)

  private def accelerate(surfaces: Surfaces, instances: Instances): Accelerator =
    structure(surfaces.primitives(instances))

  private lazy val structure: Primitives => Accelerator =
    val asked = description.accelerator.flatMap(d => Accelerators.all.build(site(d)))
    asked.getOrElse(BvhRecipe.accelerator(resources))

  private def add(s: ShapeDescription, to: SurfaceBuilder): Unit =
    val toWorld = s.objectToWorld.start
    val (declared, itsMaterial) = shapeMaterials.split(s.shape, s.material)
    val here = site(declared)
    for plan <- Shapes.all.build(here).flatten do
      val material = materialIndex(itsMaterial, media.border(s))
      val light = s.areaLight.flatMap(d => AreaLights.all.build(site(d)).flatten)

      def place(g: ShapeGeometry): Unit = g match
        case mesh: ShapeGeometry.Triangles =>
          addMesh(s, plan, mesh, toWorld, material, light, here, to)
        case ShapeGeometry.Solid(_) if toWorld.isFlat => () // there was a warning
        case ShapeGeometry.Solid(make) =>
          // pbrt-v3 and v4 turn the normals of mirrored quadrics inwards, v2 those of all disks
          val inverted =
            if description.dialect == Dialect.V2 then declared.name == "disk"
            else toWorld.swapsHandedness
          val shape = make(toWorld, s.reverseOrientation)
          addSolids(Vector(shape), plan, material, light, inverted, here, to)
        case ShapeGeometry.Solids(make, emits) =>
          if light.isDefined && !emits then
            here.warn(s"a ${s.shape.name} can't emit light, as in pbrt: it is no lamp")
          val shapes = make(toWorld, s.reverseOrientation)
          addSolids(shapes, plan, material, light.filter(_ => emits), false, here, to)
        case ShapeGeometry.Several(parts) => parts.foreach(place)

      if light.isDefined || !media.isNothing(materials(material)) then place(plan.geometry)

  private def addSolids(
      shapes: Vector[Shape],
      plan: ShapePlan,
      material: Int,
      light: Option[AreaLightPlan],
      inverted: Boolean,
      here: Site,
      to: SurfaceBuilder
  ): Unit =
    for shape <- shapes do
      val index = light.filter(_ => hasArea(shape, here)).fold(-1): lamp =>
        lights += plan.holes.light(lamp.ofShape(shape, inverted), shape)
        lightSamples += lamp.samples
        lights.length - 1
      to.add(ShapeInstance(shape, material, index, inverted), plan.mask)

  private def hasArea(shape: Shape, here: Site): Boolean =
    val hasArea = shape.area > 0f && java.lang.Float.isFinite(shape.area)
    if !hasArea then here.warn("this light has no area: it emits nothing")
    hasArea

  private def addMesh(
      s: ShapeDescription,
      plan: ShapePlan,
      mesh: ShapeGeometry.Triangles,
      toWorld: Transform,
      material: Int,
      light: Option[AreaLightPlan],
      here: Site,
      to: SurfaceBuilder
  ): Unit =
    val count = mesh.indices.length / 3
    if to.soup.triangleCount.toLong + count > WorldBuilder.MostTriangles then
      here.error(s"more than ${WorldBuilder.MostTriangles} triangles in the world or in one object")
    else
      val firstLight = light.fold(-1)(_ => lights.length)
      val flipNormals = description.dialect != Dialect.V2
      val bumps = description.dialect match
        case Dialect.V4 => BumpTangents.Along
        case Dialect.V2 if s.reverseOrientation != toWorld.swapsHandedness =>
          BumpTangents.TurnedSinking
        case _ => BumpTangents.Turned
      val reversed = s.reverseOrientation
      val first = to.soup.add(mesh, toWorld, reversed, flipNormals, material, firstLight, bumps)
      to.maskMesh(plan.mask)
      for lamp <- light do
        meshLights += MeshLights(lamp, plan.holes, first, count, firstLight, here)
        for _ <- 0 until count do
          lights += null // made as soon as all triangles are known
          lightSamples += lamp.samples

  private def plan(l: LightDescription): Option[LightPlan] =
    if l.lightToWorld.isAnimated then problems.warn(l.light.at, Motions.stands("a light"))
    Lights.all.build(site(l.light))

  private def addLight(l: LightDescription, made: Option[LightPlan], complete: Boolean): Unit =
    for
      plan <- made if !l.lightToWorld.start.isFlat
      light <- plan.make(l.lightToWorld.start, complete)
    do
      lights += light
      lightSamples += plan.samples

  /** Index of the material, with its own for each border of media. */
  private def materialIndex(ref: MaterialRef, border: MediumBorder): Int =
    materialOf.getOrElseUpdate(
      (ref, border), {
        materials += madeOf.getOrElseUpdate(ref, material(ref))
        borders += border
        materials.length - 1
      }
    )

  private def material(ref: MaterialRef): Material = ref match
    case MaterialRef.Default => Materials.default
    case MaterialRef.Inline(d) => Materials.build(site(d))
    case MaterialRef.Named(name, at) => resources.materials(name, at, resources, problems)

  private lazy val named: Map[String, Declaration] = description.namedMaterials.toMap
  private lazy val shapeMaterials = ShapeMaterials(description.dialect, named)

object WorldBuilder:
  /** 9 Floats a triangle must fit into one array. */
  private[build] val MostTriangles = 200_000_000
