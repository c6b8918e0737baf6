package candela.models

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.settings.ModelState

/** Where nodes are, and how their meshes are morphed. What it doesn't say is as in the file. */
private[models] final class Pose(values: Map[(Int, String), Vector[Double]]):

  /** The `translation`, `rotation`, `scale` or `weights` of a node, if it is not the file's. */
  def apply(node: Json, property: String): Option[Vector[Double]] =
    values.get((Nodes.index(node), property))

private[models] object Pose:
  val Rest: Pose = Pose(Map.empty)

/** The animations of a model.
  *
  * Source: glTF 2.0 specification, §3.11 and appendix C.
  */
private[models] final class Animations(file: GltfFile, session: Session):
  private val entries = file.root.list("animations")
  private val nodes = file.root.list("nodes")
  private val meshes = file.root.list("meshes")
  private val accessors = Accessors(file, session)

  /** Names, or indices of those that have none. */
  private lazy val labels = entries.zipWithIndex.map((a, i) => a.text("name").getOrElse(s"$i"))
  private def listed = labels.map(n => s"`$n`").mkString(", ")

  /** @param image number of the image: each has its time */
  def pose(state: ModelState, image: Int): Pose = state.times match
    case None =>
      for name <- state.animation do
        refuse(s"no time of the animation `$name` is given", Some("--at TIME is within it"))
      for first <- entries.headOption do
        val message = s"the model is shown at rest; --at TIME shows it within $listed"
        session.warn(first.at, message, Code.SeveralWorlds)
      Pose.Rest
    case Some(times) =>
      if entries.isEmpty then refuse(s"`${session.file}` has no animations, which --at shows", None)
      at(entries(chosen(state.animation)), times(Math.min(image, times.count - 1)))

  private def refuse(message: String, help: Option[String]): Nothing =
    throw SceneError(Problem.general(Code.OptionMisfit, message, help))

  private def chosen(asked: Option[String]): Int = asked.fold {
    if entries.size > 1 then
      val message = s"this is the first of ${entries.size} animations; --animation chooses " +
        s"among $listed"
      session.warn(entries.head.at, message, Code.SeveralWorlds)
    0
  } { name =>
    val index = labels.indexOf(name) match
      case -1 => name.toIntOption.filter(entries.indices.contains)
      case i => Some(i)
    index.getOrElse:
      refuse(s"`${session.file}` has no animation `$name`", Suggest.help(name, labels))
  }

  private def at(animation: Json, time: Double): Pose =
    val samplers = animation.list("samplers")
    val curves = animation.list("channels").flatMap: channel =>
      session.attempt(curve(channel, samplers)).flatten
    for
      start <- curves.map(_._2.start).minOption
      end <- curves.map(_._2.end).maxOption
      if time < start || time > end
    do
      val (edge, nearest) = if time < start then ("begins", start) else ("ends", end)
      val message = s"the animation $edge at ${nearest}s, and is shown as it $edge, not at ${time}s"
      session.warn(animation.at, message, Code.CorrectedValue)
    Pose(curves.map((target, curve) => target -> curve(time)).toMap)

  /** The node and the property of a channel, with its values. */
  private def curve(channel: Json, samplers: Vector[Json]): Option[((Int, String), Curve)] =
    val target = channel.required("target")
    val path = target.required("path")
    path.text match
      case "pointer" =>
        session.warn(target.at, "`KHR_animation_pointer` is not supported; ignored")
        None
      case name @ ("translation" | "rotation" | "scale" | "weights") =>
        target.element("node", nodes, "nodes").map: node =>
          if node("matrix").isDefined && name != "weights" then
            node.fail("an animated node must not have a `matrix`")
          val width = name match
            case "rotation" => 4
            case "weights" => morphTargetCount(node)
            case _ => 3
          val sampler = channel.required("sampler").element(samplers, "samplers")
          (Nodes.index(node), name) -> curve(sampler, width, name == "rotation")
      case other =>
        path.fail(s"expected translation, rotation, scale, weights or pointer, found `$other`")

  private def morphTargetCount(node: Json): Int =
    val mesh = node.required("mesh").element(meshes, "meshes")
    mesh.required("primitives").items.headOption.fold(0)(_.list("targets").size)

  private def curve(sampler: Json, width: Int, isRotation: Boolean): Curve =
    val input = sampler.required("input")
    val times = accessors.floats(input, 1)
    if times.isEmpty then input.fail("an animation without times")
    for i <- 1 until times.length if !(times(i) > times(i - 1)) do
      input.fail(s"times must increase, but ${times(i)} follows ${times(i - 1)}")
    val interpolation = sampler.text("interpolation").getOrElse("LINEAR")
    val kind = Interpolation.values.find(_.word == interpolation).getOrElse:
      val expected = Interpolation.values.map(_.word).mkString(", ")
      sampler.required("interpolation").fail(s"expected $expected, found `$interpolation`")
    val output = sampler.required("output")
    val values = accessors.floats(output)
    val expected = times.length * width * kind.vectors
    if values.length != expected then
      output.fail(
        s"expected $expected numbers for ${times.length} times, found ${values.length}"
      )
    Curve(times, values, width, kind, isRotation)

/** @param vectors of each time: a spline has tangents before and after its value */
private enum Interpolation(val word: String, val vectors: Int):
  case Step extends Interpolation("STEP", 1)
  case Linear extends Interpolation("LINEAR", 1)
  case Cubic extends Interpolation("CUBICSPLINE", 3)

/** Values between times, which increase; before and after these, the first and the last.
  *
  * Source: glTF 2.0 specification, appendix C.
  *
  * @param width      numbers of a value
  * @param isRotation whether values are unit quaternions
  */
private final class Curve(
    times: Array[Float],
    values: Array[Float],
    width: Int,
    interpolation: Interpolation,
    isRotation: Boolean
):
  def start: Float = times.head
  def end: Float = times.last

  private def vector(time: Int, which: Int): Vector[Double] =
    val from = (time * interpolation.vectors + which) * width
    Vector.tabulate(width)(i => values(from + i).toDouble)

  private def value(time: Int): Vector[Double] = vector(time, interpolation.vectors / 2)

  def apply(time: Double): Vector[Double] =
    val after = times.indexWhere(_ > time)
    if after == 0 then value(0)
    else if after < 0 then value(times.length - 1)
    else
      val k = after - 1
      val length = times(after) - times(k).toDouble
      val t = (time - times(k)) / length
      interpolation match
        case Interpolation.Step => value(k)
        case Interpolation.Linear if isRotation => Curve.slerp(value(k), value(after), t)
        case Interpolation.Linear =>
          value(k).zip(value(after)).map((a, b) => a + t * (b - a))
        case Interpolation.Cubic =>
          val (t2, t3) = (t * t, t * t * t)
          val weights = Vector(
            2 * t3 - 3 * t2 + 1,
            length * (t3 - 2 * t2 + t),
            3 * t2 - 2 * t3,
            length * (t3 - t2)
          )
          val terms = Vector(value(k), vector(k, 2), value(after), vector(after, 0))
          Vector.tabulate(width)(i => weights.zip(terms).map((w, v) => w * v(i)).sum)

private object Curve:

  /** Between unit quaternions, along the shorter arc. */
  private def slerp(a: Vector[Double], b: Vector[Double], t: Double): Vector[Double] =
    val product = a.zip(b).map(_ * _).sum
    val angle = Math.acos(Math.min(Math.abs(product), 1.0))
    val (u, v) =
      if angle < 1e-6 then (1 - t, t)
      else (Math.sin((1 - t) * angle) / Math.sin(angle), Math.sin(t * angle) / Math.sin(angle))
    val side = if product < 0 then -1.0 else 1.0
    a.zip(b).map((x, y) => u * x + side * v * y)
