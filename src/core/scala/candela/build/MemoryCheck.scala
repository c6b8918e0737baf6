package candela.build

import candela.diagnostics.SceneError
import candela.render.{Cost, CostKind, Costs}

/** Ends the building of a scene that the heap can't hold, before it begins if that is known by
  * then.
  *
  * @param heap in bytes
  * @param film of the rendering
  */
private[build] final class MemoryCheck(heap: Long, film: Cost, context: BuildContext):
  private var sceneCosts = Vector.empty[Cost]

  /** What the scene takes, with the seconds until now. */
  def costs: Vector[Cost] =
    val clock = context.resources.clock
    val timed = CostKind.values.toVector.map(k => Cost(k, 0, clock.seconds(k)))
    (Costs(sceneCosts) ++ timed).all.filter(c => c.bytes > 0 || c.seconds > 0)

  /** Estimates what the scene takes.
    *
    * @throws SceneError if that is too much
    */
  def estimate(uses: ObjectUses): Unit =
    val size = SceneSize(context.description, uses, context.resources.textures)
    sceneCosts = size.costs
    val estimates = sceneCosts :+ film
    // What building the largest hierarchy takes is gone before that hierarchy is there
    val withoutHierarchies = estimates.filter(_.kind != CostKind.Hierarchies)
    def lowerBound(costs: Vector[Cost]) = (costs.map(_.bytes).sum * MemoryCheck.CertainShare).toLong
    if Math.max(
        lowerBound(estimates),
        lowerBound(withoutHierarchies) + size.building
      ) > heap && !context.problems.hasErrors
    then
      val building = withoutHierarchies :+ Cost(CostKind.Hierarchies, size.building)
      val peak = Costs(Vector(estimates, building).maxBy(_.map(_.bytes).sum))
      throw SceneError(peak.problem(heap, Some(peak.bytes)))

  /** Builds the scene; says what takes the memory if there is not enough. */
  def during[A](build: => A): A =
    try build
    catch
      case _: OutOfMemoryError => throw SceneError(Costs(sceneCosts :+ film).problem(heap, None))

private object MemoryCheck:
  /** A scene takes at least this share of the estimate. */
  private val CertainShare = 0.8
