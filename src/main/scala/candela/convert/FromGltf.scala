package candela.convert

import candela.diagnostics.{Code, Problem}
import candela.image.{Image, ImageError, ImageFiles}
import candela.io.FileName
import candela.scenefile.{
  Declaration, Dialect, GraphicsState, Param, ParamType, SceneDescription, TextureDescription
}

import scala.collection.mutable

/** Replaces what pbrt-v4 lacks in scenes of glTF models: their material, channels of images, and
  * what vertices have beside u, v and normals. Files within the model become files.
  */
private[convert] object FromGltf:

  def converted(scene: SceneDescription, files: SideFiles): Converted =
    val run = Run(scene, files)
    val plain = Declarations.map(scene)(run.plain)
    val named = plain.namedMaterials.flatMap(run.material)
    val result = plain.copy(
      dialect = Dialect.V4,
      textures = plain.textures ++ run.addedTextures,
      namedMaterials = named
    )
    Converted(result, run.warnings)

  private final class Run(scene: SceneDescription, files: SideFiles) extends MitsubaLosses:
    private val textures = scene.textures.map(t => t.name -> t.texture).toMap
    private val added = mutable.LinkedHashMap.empty[String, TextureDescription]
    def addedTextures: Vector[TextureDescription] = added.values.toVector

    def plain(d: Declaration): Declaration =
      val filed = extracted(d)
      filed.category match
        case "Shape" => shape(filed)
        case "Texture" => texture(filed)
        case "AreaLightSource" => areaLight(filed)
        case "Camera" => withoutParams(filed, "", "nearclip", "farclip")
        case "LightSource" =>
          if d.name == "spot" then warn(d, "a \"spot\" fades along another curve in pbrt")
          filed
        case _ => filed

    /** With the files that are within the model written beside the scene. */
    private def extracted(d: Declaration): Declaration =
      d.copy(params = d.params.map: p =>
        val part = if p.paramType == ParamType.String then p.strings.headOption else None
        part.flatMap(d.folder.part).fold(p): file =>
          val suffix = FileName.suffix(file.path)
          p.withStrings(Vector(relative(d, files.add("image", suffix, file.bytes())))))

    /** A file beside the scene, as the declaration names it. */
    private def relative(d: Declaration, name: String): String =
      val from = d.folder.path.toAbsolutePath.normalize
      from.relativize(files.folder.toAbsolutePath.normalize.resolve(name)).toString
        .replace('\\', '/')

    private def shape(d: Declaration): Declaration =
      for p <- d.param("colors") do warn(p, "pbrt has no colours of vertices; they are left out")
      val cutoff = d.param("alphacutoff").flatMap(_.floats.headOption)
      val cut = cutoff.fold(d)(cutAlpha(d, _))
      withoutParams(
        withoutParams(cut, "it is seen from behind, too", "cullbackfaces"),
        "",
        "colors",
        "uv2",
        "tangents",
        "alphacutoff"
      )

    /** Alpha that is 0 or 1. */
    private def cutAlpha(d: Declaration, from: Float): Declaration =
      d.copy(params = d.params.map: p =>
        if p.name != "alpha" then p
        else if p.paramType != ParamType.Texture then
          Param.float("alpha", p.pos, if p.floats.head >= from then 1f else 0f)
        else
          textures.get(p.strings.head).filter(_.name == "imagemap") match
            case Some(t) =>
              val name = s"${p.strings.head} from ${NumberText.of(from)}"
              add(name, channel(extracted(t), _ >= from))
              Param.texture("alpha", p.pos, name)
            case None =>
              warn(p, "pbrt has no threshold of this alpha; it is used as it is")
              p)

    private def add(name: String, texture: Declaration): Unit =
      added(name) = TextureDescription(name, "float", texture, GraphicsState.Identity)

    private def texture(d: Declaration): Declaration =
      if d.name == "vertexcolor" then
        Declaration("Texture", "constant", Vector.empty, d.pos, d.folder)
      else
        val single = if d.param("channel").isEmpty then d else channel(d, x => x)
        val first = withoutParams(single, "using the first set of u and v", "uv2")
        upright(withoutParams(first, "the texture is left upright", "uskew", "vskew"))

    private def upright(d: Declaration): Declaration =
      d.copy(params = d.params.map: p =>
        if p.name != "wrap" || !p.strings.contains("mirror") then p
        else
          warn(p, "pbrt has no wrap `mirror`; using `repeat`")
          Param.string("wrap", p.pos, "repeat"))

    /** A channel of an image, as an image of its own. */
    private def channel(d: Declaration, change: Float => Float | Boolean): Declaration =
      val names = d.param("channel").fold("a")(_.strings.head)
      val at = d.param("filename").get
      val key = (at.strings.head, names, numberOf(change(0.4f)) + 2 * numberOf(change(0.6f)))
      try
        val name = files.reused(key):
          val image = ImageFiles.load(RewrittenImages.file(d.folder, at)).toImage
          files.add("image", "png", ImageFiles.png(gray(image, names.toUpperCase, change)))
        val otherParams = d.params.filterNot(p => Set("filename", "channel")(p.name))
        d.copy(params = Param.string("filename", at.pos, relative(d, name)) +: otherParams)
      catch
        case e: ImageError =>
          problems += Problem.warning(
            Code.UnconvertedImage,
            at.pos,
            s"can't read the image, leaving it unchanged: ${e.getMessage}"
          )
          d.copy(params = d.params.filterNot(_.name == "channel"))

    private def numberOf(x: Float | Boolean): Float = x match
      case f: Float => f
      case b: Boolean => if b then 1f else 0f

    private def gray(image: Image, name: String, change: Float => Float | Boolean): Image =
      val channelIndex = image.channelNames.indexOf(name)
      val c = if channelIndex >= 0 || name == "A" then channelIndex else image.colorChannels.head
      val data = Array.tabulate(image.width * image.height): i =>
        numberOf(change(if c < 0 then 1f else image.data(i * image.channels + c)))
      Image(image.width, image.height, Vector("Y"), data, image.encoding)

    private def areaLight(d: Declaration): Declaration =
      val isGray = d.param("tint").forall(p => p.floats.distinct.length == 1)
      if !isGray then warn(d, "pbrt has no tint of an area light's image; it is left out")
      withoutParams(
        withoutParams(d, "the image is mapped by u and v directly", "imageuv"),
        "",
        "wrap",
        "filter",
        "tint"
      )

    /** A material of glTF as one of pbrt's, or as a blend of two. */
    def material(name: String, d: Declaration): Vector[(String, Declaration)] =
      if d.name != "gltf" then Vector(name -> d)
      else
        warn(d, "the material of glTF is approximated by pbrt-v4's")
        for
          p <- Vector("clearcoat", "sheencolor", "anisotropy", "specular", "specularcolor")
            .flatMap(d.param)
          if !p.floats.forall(x => x == (if p.name.startsWith("specular") then 1f else 0f))
        do warn(p, s"pbrt has no `${p.name}` of \"gltf\"; it is left out")
        val metallic = d.param("metallic")
        metallic.flatMap(_.floats.headOption).orElse(metallic.fold(Some(1f))(_ => None)) match
          case Some(1f) => Vector(name -> metal(d))
          case Some(0f) => Vector(name -> dielectric(d))
          case _ =>
            val (first, second) = (s"$name, dielectric", s"$name, metal")
            val blend = Vector(
              Param.string("materials", d.pos, first, second),
              metallic.get.renamed("amount")
            )
            Vector(
              first -> dielectric(d),
              second -> metal(d),
              name -> d.copy(name = "mix", params = blend)
            )

    private def metal(d: Declaration): Declaration =
      val color = d.param("color").map(_.renamed("reflectance"))
      d.copy(name = "conductor", params = color.toVector ++ roughness(d) ++ bumps(d))

    private def dielectric(d: Declaration): Declaration =
      val passing = d.param("transmission").flatMap(_.floats.headOption).getOrElse(0f)
      val isThin = !d.param("thin").exists(_.bools.contains(false))
      val eta = d.param("eta").filter(_.floats.exists(_ >= 1f)).toVector
      if passing >= 0.5f then
        warn(d, "pbrt's glass has no colour; it is left out")
        if isThin then d.copy(name = "thindielectric", params = eta)
        else d.copy(name = "dielectric", params = eta ++ roughness(d) ++ bumps(d))
      else
        val color = d.param("color").map(_.renamed("reflectance")).toVector
        val layer = Vector(Param.float("thickness", d.pos, 0f), Param.int("maxdepth", d.pos, 100))
        d.copy(name = "coateddiffuse", params = color ++ eta ++ roughness(d) ++ layer ++ bumps(d))

    private def bumps(d: Declaration): Vector[Param] =
      for p <- d.param("normalscale") do warn(p, "pbrt has no scale of normal maps; using 1")
      for p <- d.param("normalmapuv") do
        warn(p, "pbrt maps normal maps by u and v directly; the transform of this one is dropped")
      d.param("normalmap").toVector

    /** The width of the slopes is the square of the roughness. */
    private def roughness(d: Declaration): Vector[Param] =
      val squared = d.param("roughness").map: p =>
        if p.paramType != ParamType.Texture then
          Param.float("roughness", p.pos, p.floats.head * p.floats.head)
        else
          val name = s"${p.strings.head} squared"
          val square = Vector("tex", "scale").map(Param.texture(_, p.pos, p.strings.head))
          add(name, Declaration("Texture", "scale", square, p.pos, d.folder))
          Param.texture("roughness", p.pos, name)
      .getOrElse(Param.float("roughness", d.pos, 1f))
      Vector(squared, Param.bool("remaproughness", d.pos, false))
