package candela.models

import candela.build.media.Interiors
import candela.diagnostics.Code
import candela.math.Transform
import candela.scenefile.{
  Dialect, GraphicsState, InstanceDescription, InstanceList,
  LightDescription, SceneDescription, ShapeDescription
}
import candela.settings.{ModelState, ReadSettings}

import scala.collection.mutable

/** Reads models in glTF 2.0. */
private[models] object GltfScene:

  /** The model, with what it lacks to be shown: see [[Studio]].
    *
    * @param sensor index of the camera that is asked for, if any is
    * @param world  number of the image of a turntable, or of a time
    * @throws SceneError if the file contains no model at all
    */
  def readable(
      file: GltfFile,
      session: Session,
      reading: ReadSettings,
      sensor: Option[Int],
      world: Int
  ): SceneDescription =
    val times = reading.model.state.times.filter(_.count > 1)
    def reader(image: Int) = GltfScene(file, session, reading.model.state, image)
    val current = reader(world)
    val model = current.result(sensor)
    // All images of an animation have the view of the first
    val framed = Option.when(times.isDefined && world > 0)(reader(0).result(sensor))
    val isWhole = current.environment.isDefined
    val complete = Studio.complete(model, session, reading, world, isWhole, framed)
    val (placed, flaws) = Interiors.bordered(complete)
    flaws.foreach(session.report)
    val scene = times.fold(placed): t =>
      View.numbered(placed, session, world).copy(isFollowed = world + 1 < t.count)
    session.finished(scene)

  /** Those that are read. */
  private[models] val Extensions: Set[String] = Materials.Supported ++ Set(
    "KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform",
    "EXT_mesh_gpu_instancing", Variants.Name, Textures.WebP
  ) ++ GltfFile.Compressions

/** @param image number of the image of several times */
private final class GltfScene(file: GltfFile, session: Session, state: ModelState, image: Int):
  checkVersion()
  private val textures = Textures(file, session)
  private val media = Media(file, session)
  private val materials = Materials(file, session, textures, media)
  private val primitives = Primitives(file, session)
  private val meshes = file.root.list("meshes")
  private val skins = file.root.list("skins")
  private val pose = Animations(file, session).pose(state, image)
  private val nodes = Nodes(file, session, pose)
  private val variants = Variants(file, session, state.variant)
  private val lights = Lights(file, session)

  private val shapes = Vector.newBuilder[ShapeDescription]
  private val objects = mutable.LinkedHashMap.empty[String, Vector[ShapeDescription]]
  private val instances = InstanceList.newBuilder
  private val lit = Vector.newBuilder[LightDescription]

  /** What the model says of what surrounds it; if it does, it is lit as it is. */
  val environment: Option[Extras] = nodes.scene.flatMap(lights.environment)

  private def checkVersion(): Unit =
    val version = file.root.required("asset").required("version").text
    if !version.startsWith("2.") then
      Session.fail(session.at("/asset/version"), s"expected glTF 2, found version $version")
    for name <- file.root.list("extensionsRequired") if !GltfScene.Extensions(name.text) do
      val message = s"the model requires `${name.text}`, which is not supported"
      val help = Remedies.of(name.text)
      session.missing(name.at, message, "the model without it", help, Code.Unsupported)

  def result(sensor: Option[Int]): SceneDescription =
    val users = nodes.placed.filter(p => p.node("mesh").isDefined)
    def meshUse(p: PlacedNode) = (p.node.required("mesh").int, weightsOfNode(p.node))
    val uses = users.groupBy(meshUse)
    for p <- users do session.attempt(addShapes(p, isShared = uses(meshUse(p)).size > 1))
    for p <- nodes.placed do
      session.attempt(lights(p)).flatten.foreach:
        case light: LightDescription => lit += light
        case shape: ShapeDescription => shapes += shape
      session.attempt:
        if p.node("extras").isDefined then
          val transforms = severalTransforms(p).getOrElse(Vector(p.toWorld))
          transforms.flatMap(t => media(p.copy(toWorld = t))).foreach(shapes += _)
    environment.foreach(e => session.attempt(lights.surroundings(e)).flatten.foreach(lit += _))
    val scene = SceneDescription(
      Dialect.Gltf,
      textures = textures.result(),
      namedMaterials = materials.result(),
      lights = lit.result(),
      shapes = shapes.result(),
      objects = objects.toMap,
      instances = instances.result(),
      media = media.result()
    )
    val cameras = nodes.placed.filter(_.node("camera").isDefined)
    if sensor.isEmpty && cameras.size > 1 then
      val message = "this camera is not rendered; --sensor 1 or --sensor all renders it"
      session.warn(cameras(1).node.at, message, Code.Unsupported)
    val index = sensor.getOrElse(0)
    if index >= Math.max(cameras.size, 1) then
      val range = if cameras.size < 2 then "0" else s"0 to ${cameras.size - 1}"
      Session.fail(session.at("/nodes"), s"no camera $index; cameras: $range", Code.OptionMisfit)
    val framed = cameras.lift(index)
      .flatMap(c => session.attempt(Cameras(file, session).addCamera(scene, c))).getOrElse(scene)
    val isOneOfSeveral = sensor.nonEmpty && cameras.size > 1
    val named = if isOneOfSeveral then View.numbered(framed, session, index) else framed
    named.copy(isFollowed = index + 1 < cameras.size)

  private def givenWeights(of: Json): Option[Vector[Double]] =
    of("weights").map(_.items.map(_.number))

  /** By index: each mesh may be that of many nodes. */
  private val weightsOfMeshes = mutable.HashMap.empty[Int, Vector[Double]]

  /** If they differ from the mesh's. */
  private def weightsOfNode(node: Json): Option[Vector[Double]] =
    pose(node, "weights").orElse(givenWeights(node))

  private def weights(node: Json): Vector[Double] =
    weightsOfNode(node).getOrElse:
      val index = node.required("mesh")
      weightsOfMeshes.getOrElseUpdate(
        index.size,
        givenWeights(index.element(meshes, "meshes")).getOrElse(Vector.empty)
      )

  private def addShapes(p: PlacedNode, isShared: Boolean): Unit =
    val skin = p.node.element("skin", skins, "skins").map(jointsOf)
    val instanceTransforms = severalTransforms(p)
    // Skinned vertices are in world space
    val transforms =
      instanceTransforms.getOrElse(Vector(if skin.isEmpty then p.toWorld else Transform.Identity))
    val index = p.node.required("mesh")
    val mesh = index.element(meshes, "meshes")
    def parts(toWorld: Transform) =
      mesh.list("primitives").flatMap(described(_, weights(p.node), skin, toWorld))
    // What emits light is placed by itself: lights of instances are not sampled
    val single =
      if isShared || transforms.size > 1 then local(index, p.node, skin, mesh) else Vector.empty
    if single.isEmpty || single.exists(_.areaLight.isDefined) then
      transforms.foreach(t => shapes ++= parts(t))
    else
      val name = objectName(index, p.node, mesh)
      objects.getOrElseUpdate(name, single): Unit
      for t <- transforms do
        instances += InstanceDescription(name, p.node.at, GraphicsState.constant(t))

  private val locals = mutable.HashMap.empty[String, Vector[ShapeDescription]]

  /** The shapes of a mesh in its own space; empty if it follows joints. */
  private def local(index: Json, node: Json, skin: Option[Skin], mesh: Json) =
    if skin.isDefined then Vector.empty
    else
      locals.getOrElseUpdate(
        objectName(index, node, mesh),
        mesh.list("primitives").flatMap(described(_, weights(node), None, Transform.Identity))
          .map(_.copy(inObject = true))
      )

  private def objectName(index: Json, node: Json, mesh: Json): String =
    val name = mesh.text("name").getOrElse("mesh")
    (s"$name ${index.size}" +: weightsOfNode(node).getOrElse(Vector.empty)).mkString(" ")

  private def described(
      primitive: Json,
      weights: Vector[Double],
      skin: Option[Skin],
      toWorld: Transform
  ): Option[ShapeDescription] =
    val surface = materials(variants.material(primitive), primitives.hasColors(primitive))
    primitives.shape(primitive, weights, skin, surface.shape).map: shape =>
      ShapeDescription(
        shape,
        GraphicsState.constant(toWorld),
        reverseOrientation = false,
        surface.material,
        surface.emission,
        insideMedium = surface.interior
      )

  private def jointsOf(skin: Json): Skin =
    val joints = skin.list("joints")
    val inverses = skin("inverseBindMatrices").map(primitives.matrices)
    for all <- inverses if all.size < joints.size do
      skin.fail(s"expected inverse matrices of ${joints.size} joints, found ${all.size}")
    Skin(joints.zipWithIndex.map: (joint, i) =>
      joint.element(nodes.entries, "nodes"): Unit
      val toWorld = nodes.byIndex.getOrElse(joint.size, joint.fail("the joint is not in the scene"))
      inverses.fold(toWorld): all =>
        toWorld * Transform.fromColumns(all(i).map(_.toDouble).toIndexedSeq)
          .getOrElse(Transform.Identity))

  private def severalTransforms(p: PlacedNode): Option[Vector[Transform]] =
    p.node.extension("EXT_mesh_gpu_instancing").map(several(p, _))

  private def several(p: PlacedNode, instancing: Json): Vector[Transform] =
    val attributes = instancing.required("attributes")
    def numbers(name: String, each: Int) = primitives.instanceNumbers(attributes, name, each)
    val (t, r, s) = (numbers("TRANSLATION", 3), numbers("ROTATION", 4), numbers("SCALE", 3))
    val counts = Vector(t.map(_.length / 3), r.map(_.length / 4), s.map(_.length / 3)).flatten
    if counts.distinct.size > 1 then attributes.fail("its accessors have different counts")
    Vector.tabulate(counts.headOption.getOrElse(0)): i =>
      def item(values: Option[Array[Float]], each: Int, default: Vector[Double]) =
        values.fold(default)(_.slice(each * i, each * i + each).map(_.toDouble).toVector)
      p.toWorld * Nodes.of(
        item(t, 3, Vector(0, 0, 0)),
        item(r, 4, Vector(0, 0, 0, 1)),
        item(s, 3, Vector(1, 1, 1))
      )
