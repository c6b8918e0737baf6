package candela.settings

import candela.diagnostics.{Allowance, Limit}
import candela.io.SceneFolder
import java.nio.file.Path
import java.util.concurrent.TimeUnit

/** Limits of scenes.
  *
  * @param sandbox whether the scenes are untrusted
  * @param changed limits that differ; None lifts one
  * @param endsAt  when the time is over, in nanoseconds of the system's clock
  */
final case class SceneLimits(
    sandbox: Boolean = false,
    changed: Map[Limit, Option[Long]] = Map.empty,
    endsAt: Option[Long] = None
):
  /** The limits that hold. */
  def effective: Map[Limit, Long] =
    val defaults = if sandbox then Limit.values.map(l => l -> l.inSandbox).toMap else Map.empty
    changed.foldLeft(defaults):
      case (limits, (limit, Some(most))) => limits + (limit -> most)
      case (limits, (limit, None)) => limits - limit

  /** These, whose time begins now. */
  def started: SceneLimits =
    copy(endsAt = effective.get(Limit.Time).map(System.nanoTime + nanos(_)))

  /** Of a time in milliseconds, at most a century. */
  private def nanos(millis: Long): Long =
    TimeUnit.MILLISECONDS.toNanos(Math.min(millis, TimeUnit.DAYS.toMillis(36_525)))

  /** The folder of a scene, through which it reads its files. */
  def folder(scene: Path): SceneFolder =
    SceneFolder.of(scene, sandbox, Allowance(effective, endsAt))

object SceneLimits:
  /** A limit's value as text; time is in milliseconds. */
  def form(limit: Limit): TextForm[Long] = limit match
    case Limit.Time => TextForm.seconds.map(s => Math.max(1L, (s * 1000).toLong))(_ / 1000.0)
    case Limit.Bytes => TextForm.size
    case _ => TextForm.count
