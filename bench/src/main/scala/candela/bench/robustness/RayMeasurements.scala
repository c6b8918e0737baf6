package candela.bench.robustness

import candela.bench.report.{Robust, RobustRow}
import candela.math.*

/** Rays that leave closed meshes. */
object Leaks extends Measurement(
      "leaks",
      "Rays that leak from closed meshes",
      1e9,
      "From within a ball of 2,048 triangles, rays are aimed at its edges and corners; all must " +
        "hit. In the rows “seen from within”, the rays are a camera's, so that every renderer " +
        "can be asked: nothing may be seen of the sky around a black ball."
    ):

  def rows(by: Equipment): Iterator[RobustRow] =
    ClosedMesh.all.iterator.map(aimed(by, _)) ++
      ClosedMesh.all.iterator.filterNot(_.isInstance).map(cameraRow(by, _))

  private def aimed(by: Equipment, mesh: ClosedMesh): RobustRow =
    // Those of a needle take as long as 20 others
    val count = if mesh.isSlow then Math.max(1L, by.rays / 10) else by.rays
    val kernelCells = by.kernels.map: kernel =>
      val accelerator = mesh.accelerator(kernel.create)
      kernel.key -> by.counted(count)(LeakingRays.tally(accelerator, mesh, _))
    val embree = by.embree.filterNot(_ => mesh.isInstance).map: e =>
      val aim = LeakingRays.Aim(mesh, Trials(count, 0))
      e.tally("ball", mesh.soup, count): ray =>
        aim.next(ray)
        Double.NaN
    RobustRow(s"a ball ${mesh.name}", kernelCells.toMap ++ embree.getOrElse(Map.empty))

  private def cameraRow(by: Equipment, mesh: ClosedMesh): RobustRow =
    by.painted(s"a ball ${mesh.name}, seen from within", PeerInput.of(scene(mesh, side(by)))):
      Pixels.counted(_)(_ != 0f)

  /** As many pixels as rays are asked for. */
  private[robustness] def side(by: Equipment): Int =
    Math.max(64, Math.min(4096, Math.sqrt(by.rays.toDouble).toInt))

  private def scene(mesh: ClosedMesh, side: Int): PeerScene =
    val ball = Form.facets(mesh.soup)
    // Towards its flattest side, so that a camera's near plane lies within
    val (from, to) = (mesh.toWorld.point(Vec3.Zero), mesh.toWorld.point(Vec3(0f, 1f, 0f)))
    val view = View(Spot.of(from), Spot.of(to), Spot(0.3, 0.5, -0.7), 90)
    PeerScene(view, Vector((ball, Surface.Matte(0))), sky = 1, depth = 1, side = side, spp = 1)

/** Distances of hits. */
object Distances extends Measurement(
      "distances",
      "Wrong distances of hits",
      1e9,
      "Rays meet triangles across an axis, at 0 to 1 along it, from 1e-6 to 4 away. The distance " +
        "must be right to a millionth of itself."
    ):
  def rows(by: Equipment): Iterator[RobustRow] =
    val kernelCells =
      by.kernels.map(k => k.key -> by.counted(by.rays)(HitDistances.tally(k.create, _)))
    val embree = by.embree.map: e =>
      val aim = HitDistances.Aim(Trials(by.rays, 0))
      e.tally("squares", HitDistances.soup, by.rays)(aim.next)
    val cells = kernelCells.toMap ++ embree.getOrElse(Map.empty[String, Robust])
    Iterator(RobustRow("triangles in planes close to zero", cells))

/** Rays that meet the surface that they leave. */
object SelfHits extends Measurement(
      "self-hits",
      "Self-hits of spawned rays",
      1e7,
      "Rays land on a shape of size 1e-6 to 1e6, close to the origin, up to a million sizes " +
        "away, as a ground, in an instance and in a moving one, and leave it to where nothing " +
        "is. In the rows “a mirroring …”, a picture is taken: what is reflected must be the sky."
    ):

  def rows(by: Equipment): Iterator[RobustRow] =
    Kind.all.iterator.map(spawned(by, _)) ++ mirrors.map: (name, scene) =>
      by.painted(s"a mirroring $name", PeerInput.of(scene.copy(side = Leaks.side(by)))):
        Pixels.counted(_)(_ < 0.5f)

  private def spawned(by: Equipment, kind: Kind): RobustRow =
    // Curves take as long as 10 other shapes
    val count = if kind.quick < 2500 then by.rays / 10 else by.rays
    val trialCount = Math.max(1L, count / Place.values.length)
    val all = Place.values.map: place =>
      by.tally(trialCount)(SpawnedRays(kind, place, _).tally())
    val sum = all.reduce(_ and _)
    RobustRow(
      s"a ${kind.name}",
      Map("candela" -> Robust.Counted(sum.faults, sum.trials, sum.first))
    )

  /** Each fills the picture. */
  private def mirrors: Iterator[(String, PeerScene)] =
    def ball(center: Spot, radius: Double) = Form.Ball(center, radius)
    val far = Spot(3e4, -1e4, 2e4)
    def facets(center: Spot, radius: Double) =
      val toWorld = Transform.translate(center.x, center.y, center.z) *
        Transform.scale(radius, radius, radius).get
      Form.facets(Solids.icosphere(ClosedMesh.Levels, toWorld))
    def beside(c: Spot, radius: Double) =
      val from = Spot(c.x + 4 * radius, c.y, c.z)
      View(from, c, Spot(0.1, 0.2, 1), 18)
    val onGround = View(Spot(0, 2, -4), Spot(0, 0, 0), Spot(0, 1, 0), 30)
    val below = Spot(0, -1e6, 0)
    Iterator(
      ("sphere", ball(Spot.Origin, 1), beside(Spot.Origin, 1)),
      ("sphere of radius 1e-5", ball(Spot.Origin, 1e-5), beside(Spot.Origin, 1e-5)),
      ("sphere of radius 1, 37,000 away", ball(far, 1), beside(far, 1)),
      ("sphere of radius 1e6, a ground", ball(below, 1e6), onGround),
      ("cylinder", Form.Tube(1, -1, 1), beside(Spot.Origin, 1)),
      ("ball of triangles", facets(Spot.Origin, 1), beside(Spot.Origin, 1)),
      ("ball of triangles, 37,000 away", facets(far, 1), beside(far, 1))
    ).map: (name, form, view) =>
      name -> PeerScene(view, Vector((form, Surface.Mirror)), sky = 1, depth = 1, spp = 1)

/** BSDFs that are no numbers. */
object BadScattering extends Measurement(
      "bsdf",
      "NaN, infinite and negative BSDFs",
      1e8,
      "Values, densities and samples of each kind of BSDF at the ends of its parameters, for " +
        "pairs of directions down to a cosine of 1e-45. All must be finite, none negative."
    ):
  def rows(by: Equipment): Iterator[RobustRow] = ExtremeBsdfs.all.iterator.map: kind =>
    val trialCount = Math.max(1L, by.rays / kind.variants.size)
    val all = kind.variants.map: (name, bsdf) =>
      val t = by.tally(trialCount)(ExtremeInputs.tally(bsdf, _))
      t.copy(first = t.first.map(words => s"$name: $words"))
    val sum = all.reduce(_ and _)
    RobustRow(kind.name, Map("candela" -> Robust.Counted(sum.faults, sum.trials, sum.first)))
