package candela.build

import candela.diagnostics.{Code, SourcePos}
import scala.collection.IndexedSeqView

import candela.accel.{Accelerator, Instances, Primitives}
import candela.aov.{Cryptomatte, MediaTransmittance}
import candela.build.integrators.{IntegratorPlan, Surroundings}
import candela.build.lights.{LightPlan, Lights, SkySampling}
import candela.build.options.{AcceleratorPlan, Accelerators, BvhRecipe}
import candela.cameras.Shutter
import candela.color.{CameraSensor, ColorBasis}
import candela.integrators.CausticsMode
import candela.math.{Motion, Vec3}
import candela.lights.LightSelection
import candela.render.{Cost, CostKind, RenderMethod, Sight}
import candela.scene.{Footprints, Instanced, Scene, SurfaceNames, Surfaces}
import candela.scenefile.{Declaration, Dialect, LightDescription, ShapeDescription}
import candela.settings.{ColorMode, LightGrouping}

/** A scene in one colour basis, and the method that renders it. */
private[build] final class LitScene(
    plan: IntegratorPlan,
    val scene: Scene,
    around: Surroundings,
    lightSamples: Array[Int]
):
  val method: RenderMethod = plan.methodIn(around, scene, lightSamples)

  def transmittance: Option[MediaTransmittance] = around.transmittance(scene)

  def seenFrom(eye: Vec3, footprints: => Footprints): LitScene =
    LitScene(plan, scene.withFootprints(footprints), around.seenFrom(eye), lightSamples)

/** The world, ready to render, with a description of its features.
  *
  * @param plain in the basis of the build
  * @param bases in those of spectral rendering; empty without it
  */
private[build] final class World(
    plain: LitScene,
    bases: Vector[LitScene],
    val color: ColorPlan,
    val features: Vector[(String, String)],
    val moves: Boolean,
    val costs: Vector[Cost],
    objectPlaces: Int => Option[SourcePos],
    cameraPlace: Option[SourcePos],
    names: () => SurfaceNames,
    survey: () => CausticSurvey
):
  val scene: Scene = plain.scene

  val method: RenderMethod =
    if bases.isEmpty then plain.method
    else RenderMethod.spectral(color.bases.zip(bases.map(_.method)))

  def transmittance: Option[MediaTransmittance] = plain.transmittance

  def sight: Sight = Sight(scene, objectPlaces, cameraPlace)

  /** The same world as another camera sees it.
    *
    * @param footprints evaluated only if the scene needs them
    */
  def seenFrom(eye: Vec3, footprints: => Footprints): World =
    lazy val evaluated = footprints
    World(
      plain.seenFrom(eye, evaluated),
      bases.map(_.seenFrom(eye, evaluated)),
      color,
      features,
      moves,
      costs,
      objectPlaces,
      cameraPlace,
      names,
      survey
    )

  /** For image layers. */
  def surfaceNames: SurfaceNames = names()

  /** What there is of caustics. */
  def caustics: CausticSurvey = survey()

/** All surfaces of the world and its objects, with their acceleration structures. */
private[build] final class Structure(
    val surfaces: Surfaces,
    val instanced: Instanced,
    val accelerator: Accelerator
):
  def describeMasks: String =
    val masks = (surfaces +: instanced.objects.toVector).map(_.masks)
    val (meshes, shapes) = (masks.map(_.meshes).sum, masks.map(_.shapes).sum)
    if meshes + shapes == 0 then "none" else s"on $meshes meshes and $shapes other shapes"

/** Builds the world of a description in stages: materials, surfaces, lights, acceleration
  * structures, scene, and render method.
  *
  * @param integrator   in the colour basis of `context`
  * @param integratorIn the integrator, in the colour basis of another context
  * @param samples      maximum number of camera samples
  * @param mode         as asked for
  * @param sensor       the camera's, unless it is the standard observer
  * @param grouping     how to group lights, if light is to be divided
  * @param memory       that there is
  */
private[build] final class WorldBuilder(
    context: BuildContext,
    integrator: IntegratorPlan,
    integratorIn: BuildContext => IntegratorPlan,
    shutter: Shutter,
    samples: Long,
    mode: ColorMode,
    sensor: Option[CameraSensor],
    grouping: Option[LightGrouping],
    memory: MemoryCheck
):
  import context.{description, problems}
  import context.resources.clock

  /** @param footprints evaluated only if a texture or a material needs ray differentials */
  def build(footprints: => Footprints): World =
    val uses = ObjectUses(description, context.origin.position, problems)
    memory.estimate(uses)
    memory.during(build(uses, footprints))

  private val textures = SceneTextures(description.textures)

  private def build(uses: ObjectUses, footprints: => Footprints): World =
    clock.during(CostKind.Textures)(textures.define(context))
    for l <- description.lights.headOption do
      context.resources.allowance.countShapes(description.lights.size, Some(l.light.pos))
    val media = MediaBuilder(context, integrator)
    val shapes = uses.world ++ uses.shared.flatMap(_.shapes)
    val materials =
      clock.during(CostKind.Materials)(MaterialTable.of(context, integrator, media, shapes))
    UnusedMaterials.check(context, shapes, uses)(textures)

    var lightCount = 0
    var shapeIndex = 0
    def collected(shapes: Vector[ShapeDescription]) =
      val builder = SurfaceBuilder(context, materials, integrator, lightCount)
      for s <- shapes do
        builder.add(materials.dress(s, shapeIndex))
        shapeIndex += 1
      lightCount = builder.endOfLights
      builder
    val (world, objects) = clock.during(CostKind.Triangles):
      (collected(uses.world), uses.shared.map(o => collected(o.shapes)))
    val lightPlans = clock.during(CostKind.Lights):
      description.lights.map(l => l -> lightPlan(l, context))
    val hierarchies = description.accelerator
      .flatMap(d => Accelerators.all.build(context.site(d)))
      .getOrElse(BvhRecipe.accelerator(context.resources))
    problems.stopAtErrors()

    val (lit, litObjects) = clock.during(CostKind.Triangles):
      (world.result(), objects.map(_.result()))
    def areaLights(context: BuildContext) =
      lit.lights(context) ++ litObjects.flatMap(_.lights(context))
    val skies = skySampling(materials)
    val (shining, lights) = clock.during(CostKind.Lights):
      val shining = lightPlans.flatMap((l, plan) => light(l, plan, skies).map(l -> _))
      (shining, areaLights(context) ++ shining.map(_._2))
    val placed = clock.during(CostKind.Hierarchies):
      structure(lit.surfaces, litObjects.map(_.surfaces), uses.shared, hierarchies)
    val allLights = lights.map(_.light).toArray
    val pool = context.resources.pool
    val selection = clock.during(CostKind.Lights):
      LightSelection.of(allLights, integrator.lights, placed.accelerator.bounds, pool)
    val scene = Scene(
      placed.surfaces,
      placed.instanced,
      placed.accelerator,
      materials.ofScene,
      allLights,
      selection,
      sidesByGeometry = !context.isV4,
      Option.when(context.resources.footprintUses.nonEmpty)(footprints),
      lightGroups =
        grouping.map(LightGroupBuilder.groups(
          _,
          lights.map(_.statement),
          media.isEmissive,
          problems.warn(Code.IdleOption, None, _)
        ))
    )
    warnOfDarkness(scene, media.glows(materials))
    warnOfLightPaths()
    for s <- (world +: objects).flatMap(_.shadowing).headOption if scene.lights.nonEmpty do
      warnOfShadows(s)
    val reach = 2f * placed.accelerator.bounds.radius
    val samples = lights.map(_.samples).toArray
    val (surroundings, inMedia) =
      media.surroundings(scene, shining.map(_._1), materials, reach)
    val plain = LitScene(integrator, scene, surroundings, samples)
    val colorPlan = ColorPlan.of(context, mode, sensor)
    val color = if context.resources.settings.oneColorSet then colorPlan.ofOneSet else colorPlan
    if color.isSpectral then context.resources.census.sayOfSpectral()
    def inBasis(basis: ColorBasis) = context.in(basis)(textures)
    val disperses = color.bases.headOption.map(inBasis).exists: first =>
      materials.disperses(first, integratorIn(first))
    def recolored(basis: ColorBasis): LitScene =
      val basisContext = inBasis(basis)
      val otherLights = areaLights(basisContext) ++
        shining.flatMap((l, _) => light(l, lightPlan(l, basisContext), skies))
      val plan = integratorIn(basisContext)
      val otherMaterials =
        materials.inBasis(color.bases.size, disperses, plan)(() => inBasis(basis))
      val otherScene = scene.recolored(otherMaterials, otherLights.map(_.light).toArray)
      LitScene(plan, otherScene, media.inBasis(surroundings, basisContext), samples)
    val inBases =
      if !color.isSpectral then Vector.empty
      else clock.during(CostKind.Materials)(ofEach(color.bases)(recolored))
    World(
      plain,
      inBases,
      color,
      Vector(
        "accelerator" -> placed.accelerator.describe,
        "triangles" -> placed.surfaces.soup.count.toString,
        "other shapes" -> placed.surfaces.solids.count.toString,
        "instances" -> placed.instanced.describe,
        "masks" -> placed.describeMasks,
        "materials" -> materials.describe,
        "color" -> color.describe,
        "subsurface" -> materials.describeSubsurface(integrator),
        "ray differentials" -> context.resources.footprintsInWords,
        "media" -> inMedia,
        "lights" -> (if allLights.isEmpty then "none" else selection.describe)
      ) ++ scene.lightGroups.map(g => "light groups" -> g.names.mkString(", ")),
      placed.instanced.instances.moving > 0,
      memory.costs,
      objectPlaces(lit, uses.shared),
      description.camera.map(_.pos),
      () => SurfaceNames(objectNames(lit, uses.shared), materials.names, Cryptomatte.id),
      () =>
        val shapeMaterials = shapes.indices.iterator.map(materials.materialOf)
        CausticSurvey(context, materials, shapeMaterials, lights)
    )

  /** The first one finds all problems of lights and media, in the order of the statements; the
    * others are made in parallel.
    */
  private def ofEach(bases: Vector[ColorBasis])(make: ColorBasis => LitScene) =
    val scenes = new Array[LitScene](bases.size)
    scenes(0) = make(bases(0))
    context.resources.pool.forEach(bases.size - 1)(i => scenes(i + 1) = make(bases(i + 1)))
    scenes.toVector

  /** Of the world's shapes, then of instances: static ones come first. */
  private def objectNames(world: LitSurfaces, objects: Vector[PlacedObject]): Vector[String] =
    val instances = stillFirst(objects): (o, i) =>
      if o.name.isEmpty then StatementName(o.shapes.head.shape) else s"${o.name}.${i + 1}"
    world.statements.map(StatementName(_)) ++ instances

  /** Likewise, of their statements. */
  private def objectPlaces(world: LitSurfaces, objects: Vector[PlacedObject]) =
    lazy val positions =
      world.statements.map(_.pos) ++ stillFirst(objects)((o, _) => o.shapes.head.shape.pos)
    (i: Int) => positions.lift(i)

  private def stillFirst[A](objects: Vector[PlacedObject])(of: (PlacedObject, Int) => A) =
    val instances = objects.flatMap: o =>
      o.places.zipWithIndex.map((motion, i) => (motion.moves, of(o, i)))
    val (moving, still) = instances.partition(_._1)
    (still ++ moving).map(_._2)

  private def lightPlan(l: LightDescription, context: BuildContext): Option[LightPlan] =
    Lights.all.build(context.stillSite(l.light, l.lightToWorld, "a light"))

  /** What light samples must find of skies. */
  private def skySampling(materials: MaterialTable): SkySampling =
    val leavesToPhotons = integrator.looksForCaustics && materials.ofScene.hasCasters &&
      takesPhotons(context.resources.settings.choices.caustics)
    // If geometry decides the side, light sampling reaches directions that BSDF sampling misses
    if !integrator.samplesBsdf || !context.isV4 then SkySampling.All
    // Photons begin where light is sampled, and have no other technique beside them. What media
    // scatter they may have to bring of uniform skies, too
    else if leavesToPhotons then
      if description.media.nonEmpty then SkySampling.All else SkySampling.Uneven
    else SkySampling.Bright

  private def takesPhotons(mode: CausticsMode) =
    mode == CausticsMode.Photons || mode == CausticsMode.Auto

  private def light(
      l: LightDescription,
      plan: Option[LightPlan],
      skies: SkySampling
  ): Option[SampledLight] =
    for
      plan <- plan if !l.lightToWorld.start.isFlat
      light <- plan.create(l.lightToWorld.start, skies)
    yield SampledLight(light, plan.samples, l.light)

  private def structure(
      world: Surfaces,
      objects: Vector[Surfaces],
      uses: Vector[PlacedObject],
      plan: AcceleratorPlan
  ) =
    def accelerate(primitives: Primitives): Accelerator = plan(primitives, samples)
    val placements = placesOf(uses)
    for i <- description.instances.headOption do
      context.resources.allowance.countShapes(placements.size, Some(i.pos))
    val accelerators = objects.map(o => accelerate(o.primitives()))
    val pool = context.resources.pool
    val instances =
      Instances.of(accelerators.toArray, placements, shutter.open, shutter.close, pool)
    Structure(world, Instanced(objects.toArray, instances), accelerate(world.primitives(instances)))

  /** The number of the object and the motion of each instance, made when asked for. */
  private def placesOf(uses: Vector[PlacedObject]): IndexedSeqView[(Int, Motion)] =
    val firsts = uses.scanLeft(0)((first, use) => Math.addExact(first, use.places.length)).toArray
    val objectOf = new Array[Int](firsts.last)
    for o <- uses.indices do java.util.Arrays.fill(objectOf, firsts(o), firsts(o + 1), o)
    objectOf.indices.view.map: i =>
      val o = objectOf(i)
      (o, uses(o).places(i - firsts(o)))

  private def warnOfShadows(surface: Declaration): Unit =
    val name = description.integrator.fold("path")(_.name)
    val whose = if context.rules.dialect == Dialect.Mitsuba then "Mitsuba" else "pbrt"
    problems.warn(
      Code.IntegratorLacks,
      surface.pos,
      s"\"$name\" blocks light samples at this surface, though paths pass through it: it casts " +
        s"a shadow, as in $whose",
      Some("\"volpath\" does not block them")
    )

  /** pbrt-v4 divides by the density of a sphere's points as they are sampled from the camera. */
  private def warnOfLightPaths(): Unit =
    def isLamp(s: ShapeDescription) = s.areaLight.nonEmpty && s.shape.name == "sphere"
    val isTraced = description.integrator.exists(_.name == "lightpath")
    if isTraced && context.rules.dialect == Dialect.V4 then
      for lamp <- description.shapes.find(isLamp) do
        val message = "pbrt-v4's \"lightpath\" shows the light of this sphere itself darker, at " +
          "about half of its radiance; what it lights agrees"
        problems.warn(Code.UnlikePbrt, lamp.shape.pos, message)

  private def warnOfDarkness(scene: Scene, mediaGlow: Boolean): Unit =
    val isTold = description.warnings.exists(_.code == Code.DarkScene)
    if scene.lights.isEmpty && !mediaGlow && integrator.isLit && !problems.hasErrors && !isTold then
      val message = "the scene has no light; its image will be black"
      problems.warn(Code.DarkScene, description.camera.map(_.pos), message)
    if !integrator.samplesLights && scene.lights.exists(_.isDelta) then
      for i <- description.integrator do
        problems.warn(
          Code.IntegratorLacks,
          i.pos,
          s"\"${i.name}\" does not sample lights: those that no ray hits, such as point lights, " +
            "do not shine, as in pbrt",
          Some("use \"volpath\"")
        )
