package candela.api

import candela.diagnostics.{Code, Problem as Found, SceneError, SourcePos, Suggest}
import candela.scenefile.{
  Declaration, GivenStatement, MaterialRef, Param, SceneDescription, ShapeDescription
}

import java.nio.ByteBuffer
import java.nio.charset.StandardCharsets.UTF_8
import java.security.MessageDigest
import java.util.{HexFormat, Locale}

/** Changes of what a scene has. */
private[api] object SceneEdits:
  type Edit = SceneDescription => SceneDescription

  /** @throws SceneError if there is none */
  def setting(setting: SceneSetting, params: Vector[Param]): Edit = scene =>
    val previous = current(setting, scene).getOrElse:
      val word = setting.toString.toLowerCase(Locale.ROOT)
      val help = s"call $word(…) to give it one"
      fail(Code.Undefined, params, s"the scene has no $word to change", Some(help))
    val changed = Some(withParams(previous, params))
    setting match
      case SceneSetting.Camera => scene.copy(camera = changed)
      case SceneSetting.Film => scene.copy(film = changed)
      case SceneSetting.Sampler => scene.copy(sampler = changed)
      case SceneSetting.Filter => scene.copy(filter = changed)
      case SceneSetting.Integrator => scene.copy(integrator = changed)

  private def current(setting: SceneSetting, scene: SceneDescription): Option[Declaration] =
    setting match
      case SceneSetting.Camera => scene.camera
      case SceneSetting.Film => scene.film
      case SceneSetting.Sampler => scene.sampler
      case SceneSetting.Filter => scene.filter
      case SceneSetting.Integrator => scene.integrator

  /** What a scene's statement no longer says once a new one replaces it. */
  def dropped(
      setting: SceneSetting,
      params: Vector[Param],
      at: SourcePos,
      scene: SceneDescription
  ): Option[Found] =
    val names = current(setting, scene).toVector.flatMap(_.params.map(_.name))
      .filterNot(params.map(_.name).contains)
    Option.when(names.nonEmpty):
      val word = setting.toString.toLowerCase(Locale.ROOT)
      val verb = if names.size == 1 then "has its default" else "have their defaults"
      val message =
        s"the new $word replaces the scene's: ${names.map(n => s"`$n`").mkString(", ")} $verb"
      val help = s"change(SceneSetting.$setting, …) keeps what it doesn't name"
      Found.warning(Code.IdleParameter, at, message, Some(help))

  /** The resolution that a scene was read with holds for a film of another size, too. */
  def resized(scene: Scene, params: Vector[Param], at: SourcePos): Option[Found] =
    for
      _ <- scene.reading.core.resolution
      p <- params.find(p => p.name == "xresolution" || p.name == "yresolution")
    yield
      val message = s"the scene was read with `resolution`, which replaces or scales `${p.name}`"
      Found.warning(Code.IdleParameter, at, message, Some("read it without `resolution`"))

  /** @throws SceneError if there is no such material */
  def material(name: String, params: Vector[Param]): Edit = scene =>
    val names = scene.namedMaterials.map(_._1)
    if !names.contains(name) then
      fail(Code.Undefined, params, s"unknown material `$name`", Suggest.help(name, names))
    scene.copy(namedMaterials = scene.namedMaterials.map: (other, made) =>
      other -> (if other == name then withParams(made, params) else made))

  /** Gives one shape a changed copy of its material.
    *
    * @throws SceneError if there is no such shape, or it has none
    */
  def materialOf(shape: Int, params: Vector[Param]): Edit = scene =>
    def changed(old: ShapeDescription): ShapeDescription =
      val named = old.material.declared(scene.namedMaterials.toMap).getOrElse:
        val help = "give shapes one by material(…) before them"
        fail(Code.Undefined, params, s"shape $shape has no material to change", Some(help))
      old.copy(material = MaterialRef.Inline(withParams(named, params)))
    shapeAt(shape, params, scene)(changed)

  /** @throws SceneError if there is no such shape */
  def shape(shape: Int, params: Vector[Param]): Edit = scene =>
    shapeAt(shape, params, scene)(old => old.copy(shape = withParams(old.shape, params)))

  /** @throws SceneError if there is no such shape, or it emits no light */
  def areaLightOf(shape: Int, params: Vector[Param]): Edit = scene =>
    shapeAt(shape, params, scene): old =>
      if old.areaLight.isEmpty then
        fail(Code.Undefined, params, s"shape $shape has no area light to change", None)
      old.copy(areaLight = old.areaLight.map(withParams(_, params)))

  /** @throws SceneError if there is no such light */
  def light(light: Int, params: Vector[Param]): Edit = scene =>
    val previous = element("light", scene.lights, light, params)
    scene.copy(lights =
      scene.lights.updated(light, previous.copy(light = withParams(previous.light, params)))
    )

  private def shapeAt(shape: Int, params: Vector[Param], scene: SceneDescription)(
      change: ShapeDescription => ShapeDescription
  ): SceneDescription =
    val previous = element("shape", scene.shapes, shape, params)
    scene.copy(shapes = scene.shapes.updated(shape, change(previous)))

  private def element[A](what: String, all: Vector[A], index: Int, params: Vector[Param]): A =
    all.lift(index).getOrElse:
      val available = if all.isEmpty then "it has none" else s"they are 0 to ${all.size - 1}"
      fail(Code.Undefined, params, s"the scene has no $what $index", Some(available))

  /** @throws SceneError if there is no such texture */
  def texture(name: String, params: Vector[Param]): Edit = scene =>
    val names = scene.textures.map(_.name)
    if !names.contains(name) then
      fail(Code.Undefined, params, s"unknown texture `$name`", Suggest.help(name, names))
    scene.copy(textures = scene.textures.map: t =>
      if t.name == name then t.copy(texture = withParams(t.texture, params)) else t)

  private def withParams(to: Declaration, params: Vector[Param]): Declaration =
    val replaced = params.map(_.name).flatMap(name => name +: axes(name)).toSet
    to.copy(params = to.params.filterNot(old => replaced(old.name)) ++ params)

  /** A roughness replaces those along u and v, which would go before it. */
  private def axes(name: String): Vector[String] =
    if !name.endsWith("roughness") then Vector.empty
    else Vector("u", "v").map(axis => s"${name.stripSuffix("roughness")}${axis}roughness")

  private def fail(
      code: Code,
      params: Vector[Param],
      message: String,
      help: Option[String]
  ): Nothing =
    val pos = params.headOption.fold(SourcePos.Nowhere)(_.pos)
    throw SceneError(Found.error(code, pos, message, help))

/** SHA-256 of statements. Mutable. */
private[api] final class StatementSum:
  private val sum = MessageDigest.getInstance("SHA-256")

  def add(s: GivenStatement): Unit =
    text(s.directive)
    count(s.numbers.size)
    s.numbers.foreach(x => bytes(8)(_.putDouble(x)))
    texts(s.texts)
    count(s.params.size)
    for p <- s.params do
      text(p.paramType.spelling)
      text(p.name)
      floats(p.floats)
      floats(p.rests)
      count(p.ints.length)
      bytes(4 * p.ints.length)(b => p.ints.foreach(b.putInt))
      count(p.bools.size)
      p.bools.foreach(b => count(if b then 1 else 0))
      texts(p.strings)

  /** Of all so far. */
  def digest: String =
    val snapshot = sum.clone().asInstanceOf[MessageDigest]
    HexFormat.of.formatHex(snapshot.digest)

  private def floats(all: Array[Float]): Unit =
    count(all.length)
    bytes(4 * all.length)(b => all.foreach(b.putFloat))

  private def texts(all: Vector[String]): Unit =
    count(all.size)
    all.foreach(text)

  private def text(s: String): Unit =
    val encoded = s.getBytes(UTF_8)
    count(encoded.length)
    sum.update(encoded)

  private def count(n: Int): Unit = bytes(4)(_.putInt(n))

  private def bytes(count: Int)(put: ByteBuffer => Any): Unit =
    val buffer = ByteBuffer.allocate(count)
    val _ = put(buffer)
    sum.update(buffer.array)
