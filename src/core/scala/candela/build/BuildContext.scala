package candela.build

import candela.concurrency.Parallel
import candela.diagnostics.{Code, SourcePos}
import candela.io.SceneFolder
import java.util.IdentityHashMap

import candela.build.lights.{AreaLightPlan, AreaLights}
import candela.build.recipe.*
import candela.build.options.OptionRecipe
import candela.color.ColorBasis
import candela.math.Transform
import candela.scenefile.{AnimatedTransform, Declaration, Dialect, InstanceList, SceneDescription}
import candela.settings.{BuildControl, ColorMode, RenderSettings}

/** State shared by all stages of building: the description, around its render origin, its named
  * resources, and the problems found so far.
  */
private[build] final class BuildContext(
    val description: SceneDescription,
    val origin: RenderOrigin,
    val resources: Resources,
    val problems: Findings
):
  /** Of the statements that don't say another. */
  val dialect: Dialect = description.dialect.base

  /** Of the scene's program. */
  val rules: Rules = Rules.of(description.dialect)
  def isV2: Boolean = dialect == Dialect.V2
  def isV4: Boolean = dialect == Dialect.V4
  def defaults: Defaults = Defaults(dialect)

  /** The same scene in another colour basis; textures are defined once they are asked for. */
  def in(basis: ColorBasis)(textures: SceneTextures): BuildContext =
    val context = in(resources.in(basis))
    context.resources.defineLater(textures.in(context))
    context

  /** The same scene with other resources. */
  def in(resources: Resources): BuildContext =
    new BuildContext(description, origin, resources, problems)

  /** The same scene, for what is checked and never rendered. */
  def aside(findings: Findings): BuildContext =
    new BuildContext(description, origin, resources.unread, findings)

  /** The same scene as another camera sees it, with problems of its own. */
  def seenAs(seen: SceneDescription): BuildContext =
    val viewed = description.copy(
      camera = seen.camera,
      worldToCamera = origin.toCamera(seen.worldToCamera),
      cameraMedium = seen.cameraMedium
    )
    new BuildContext(viewed, origin, resources, Findings(text = seen.text))

  private val emissions = IdentityHashMap[Declaration, Option[AreaLightPlan]]()

  private val alike = Alike[Option[AreaLightPlan]](problems)

  /** The area light of a statement. Many shapes may share it, and many statements be alike. */
  def emission(statement: Declaration): Option[AreaLightPlan] =
    alike(statement, _ => true):
      emissions.computeIfAbsent(statement, d => AreaLights.all.build(site(d)).flatten)

  def site(d: Declaration, toWorld: Transform = Transform.Identity): Site =
    Site(d, d.dialect.getOrElse(dialect), resources, problems, toWorld)

  /** Site of a statement that can't be animated: uses the transform at the start.
    *
    * @param what subject of the warning
    */
  def stillSite(d: Declaration, toWorld: AnimatedTransform, what: String): Site =
    if toWorld.isAnimated then problems.warn(Code.NotAnimated, d.pos, Motions.notAnimated(what))
    site(d, toWorld.start)

  /** Builds the statement, or `default` if the statement is missing or invalid. */
  def build[A](statement: Option[Declaration], recipes: Recipes[A], default: String): A =
    statement
      .flatMap(d => recipes.build(site(d)))
      .getOrElse(recipes.build(site(unwritten(recipes.category, default))).get)

  /** A statement that the file does not contain. */
  def unwritten(category: String, name: String): Declaration =
    Declaration(category, name, Vector.empty, start, SceneFolder.Nowhere)

  /** Where a statement is; of one that the file does not contain, where that begins. */
  def placeOf(statement: Option[Declaration]): SourcePos = statement.fold(start)(_.pos)

  private def start: SourcePos = BuildContext.start(description)

private[build] object BuildContext:

  def apply(
      whole: SceneDescription,
      settings: RenderSettings,
      control: BuildControl = BuildControl(),
      pool: Parallel = Parallel.Alone
  ): BuildContext =
    val isBlind = whole.dialect.base == Dialect.V4 && whole.worldToCamera.start.isFlat
    val description = if isBlind then background(whole) else whole
    // pbrt-v4 multiplies spectra, the older ones sRGB components
    val rules = Rules.of(description.dialect)
    val basis = if rules.isSpectral then ColorBasis.Sharp else ColorBasis.Srgb
    val problems = Findings(
      settings.reading.keepGoing,
      description.failedKinds,
      description.errors,
      description.text
    )
    if isBlind then
      problems.warn(
        Code.Transform,
        whole.camera.fold(start(whole))(_.pos),
        "the camera's transform is singular; the image shows the background only, as in pbrt-v4"
      )
    val origin = RenderOrigin.of(description)
    val mode = ColorPlan.mode(settings.colorMode, description)
    val effective = settings.overriding(optionStatements(description, basis, problems))
    val resources = new Resources(
      basis,
      pool,
      settings.seed,
      mayBeSpectral = mode != ColorMode.Rgb,
      effective.copy(unfiltered = effective.unfiltered || !rules.filters),
      rules = Option.when(Dialect.ofOthers(description.dialect))(rules),
      origin = origin.position,
      description.folder.allowance,
      TextureStore.of(description, control.textures, pool, control.cache),
      control.cache,
      isReadable = description.errors.isEmpty
    )
    new BuildContext(origin.recentre(description), origin, resources, problems)

  /** What the scene's `Option` statements set. */
  private def optionStatements(
      scene: SceneDescription,
      basis: ColorBasis,
      problems: Findings
  ): RenderSettings =
    val statement = Declaration("Option", "", scene.options, start(scene), scene.folder)
    OptionRecipe.build(Site(statement, scene.dialect.base, Resources(basis), problems))

  /** The start of the scene's file, if it has one. */
  private def start(scene: SceneDescription): SourcePos =
    scene.sources.headOption.fold(SourcePos.Nowhere)(file => SourcePos(file.toString, 1, 1))

  /** What a camera without a place sees. */
  private def background(scene: SceneDescription): SceneDescription =
    scene.copy(
      worldToCamera = AnimatedTransform(Transform.Identity, Transform.Identity),
      cameraMedium = "",
      shapes = Vector.empty,
      instances = InstanceList.Empty
    )

/** Default types of each dialect. */
private[build] final case class Defaults(
    film: String,
    filter: String,
    sampler: String,
    integrator: String
)

private[build] object Defaults:
  def apply(dialect: Dialect): Defaults = dialect match
    case Dialect.V2 => Defaults("image", "box", "lowdiscrepancy", "directlighting")
    case Dialect.V3 => Defaults("image", "box", "halton", "path")
    case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf =>
      Defaults("rgb", "gaussian", "zsobol", "volpath")
