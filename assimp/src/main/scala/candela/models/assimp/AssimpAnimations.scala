package candela.models.assimp

import candela.diagnostics.Code
import candela.models.Session

import org.lwjgl.assimp.*

import scala.collection.mutable

/** Animations of Assimp as those of glTF. */
private[assimp] final class AssimpAnimations(scene: AIScene, session: Session, arrays: Arrays):
  private val all = Arrays.all(scene.mAnimations)(AIAnimation.create)
  val entries: mutable.ArrayBuffer[ujson.Obj] = mutable.ArrayBuffer.empty

  private def channels(a: AIAnimation) = Arrays.all(a.mChannels)(AINodeAnim.create)
  private val moving = all.flatMap(channels).map(_.mNodeName.dataString).toSet

  /** Whether an animation has a channel of the node. */
  def moves(name: String): Boolean = moving(name)

  /** @param named  indices of nodes
    * @param morphed indices of nodes by their names, with their numbers of morph targets
    */
  def read(named: Map[String, Int], morphed: Map[String, Vector[(Int, Int)]]): Unit =
    for (a, i) <- all.zipWithIndex do
      val name = Option(a.mName.dataString).filter(_.nonEmpty).getOrElse(s"$i")
      val at = AssimpScene.position(session, s"animation $name")
      if a.mNumMeshChannels > 0 then
        session.warn(at, "meshes that it replaces by others are not supported; they stay")
      val ticks = if a.mTicksPerSecond > 0 then a.mTicksPerSecond else AssimpAnimations.UsualTicks
      val animation = AnimationEntry(name, ticks, arrays)
      for channel <- channels(a); node <- named.get(channel.mNodeName.dataString) do
        animation.move(channel, node)
      for m <- Arrays.all(a.mMorphMeshChannels)(AIMeshMorphAnim.create) do
        // FBX has a number behind the name
        val target = m.mName.dataString.takeWhile(_ != '*')
        val users = morphed.getOrElse(target, Vector.empty)
        if users.isEmpty then
          session.warn(at, s"there is no mesh `$target` that it morphs", Code.Undefined)
        for (node, targets) <- users do animation.morph(m, node, targets)
      if animation.isEmpty then session.warn(at, "it moves nothing; ignored", Code.Undefined)
      else entries += animation.entry

private[assimp] object AssimpAnimations:
  /** Per second, where a file doesn't say. */
  private val UsualTicks = 25.0

  /** The members of a node that is placed by translation, rotation and scale. */
  def parts(m: AIMatrix4x4): Seq[(String, ujson.Value)] =
    val (scale, place) = (AIVector3D.calloc(), AIVector3D.calloc())
    val turn = AIQuaternion.calloc()
    try
      Assimp.aiDecomposeMatrix(m, scale, turn, place)
      def numbers(values: Float*) = ujson.Arr.from(values.map(_.toDouble))
      Seq(
        "translation" -> numbers(place.x, place.y, place.z),
        "rotation" -> numbers(turn.x, turn.y, turn.z, turn.w),
        "scale" -> numbers(scale.x, scale.y, scale.z)
      )
    finally
      scale.free()
      place.free()
      turn.free()

/** @param ticks per second */
private final class AnimationEntry(name: String, ticks: Double, arrays: Arrays):
  private val channels, samplers = mutable.ArrayBuffer.empty[ujson.Obj]

  def isEmpty: Boolean = channels.isEmpty
  def entry: ujson.Obj = ujson.Obj(
    "name" -> name,
    "channels" -> ujson.Arr.from(channels),
    "samplers" -> ujson.Arr.from(samplers)
  )

  /** Keys whose times increase: of several at one time, the first counts. */
  private def add(node: Int, path: String, kind: String, keys: Seq[(Double, Seq[Float])]): Unit =
    val increasing = mutable.ArrayBuffer.empty[(Float, Seq[Float])]
    for (time, values) <- keys do
      val seconds = (time / ticks).toFloat
      if increasing.lastOption.forall(_._1 < seconds) then increasing += ((seconds, values))
    if increasing.nonEmpty then
      val count = increasing.map(_._2.size).sum
      val times = arrays.floats("SCALAR", increasing.size, increasing.iterator.map(_._1))
      val elements = if kind == "SCALAR" then count else increasing.size
      samplers += ujson.Obj(
        "input" -> times,
        "output" -> arrays.floats(kind, elements, increasing.iterator.flatMap(_._2))
      )
      channels += ujson.Obj(
        "sampler" -> (samplers.size - 1),
        "target" -> ujson.Obj("node" -> node, "path" -> path)
      )

  def move(channel: AINodeAnim, node: Int): Unit =
    def vectors(keys: AIVectorKey.Buffer | Null) = Option(keys).toSeq.flatMap: all =>
      Seq.tabulate(all.remaining): i =>
        val v = all.get(i).mValue
        (all.get(i).mTime, Seq(v.x, v.y, v.z))
    val turns = Option(channel.mRotationKeys).toSeq.flatMap: all =>
      Seq.tabulate(all.remaining): i =>
        val q = all.get(i).mValue
        (all.get(i).mTime, Seq(q.x, q.y, q.z, q.w))
    add(node, "translation", "VEC3", vectors(channel.mPositionKeys))
    add(node, "rotation", "VEC4", turns)
    add(node, "scale", "VEC3", vectors(channel.mScalingKeys))

  def morph(channel: AIMeshMorphAnim, node: Int, targets: Int): Unit =
    val all = channel.mKeys
    val keys = Seq.tabulate(all.remaining): k =>
      val (key, weights) = (all.get(k), new Array[Float](targets))
      for indices <- Option(key.mValues); i <- 0 until indices.remaining do
        val target = indices.get(i)
        if target >= 0 && target < targets then weights(target) = key.mWeights.get(i).toFloat
      (key.mTime, weights.toSeq)
    add(node, "weights", "SCALAR", keys)
