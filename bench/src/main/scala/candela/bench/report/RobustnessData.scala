package candela.bench.report

import candela.bench.statistics.Statistics
import candela.report.RenderData

/** `candela robustness` as JSON. */
object RobustnessData:
  /** Raised when a field changes its meaning. */
  private final val Format = 1

  def json(r: RobustnessReport): String =
    val report = ujson.Obj(
      "format" -> Format,
      "version" -> r.version,
      "begun" -> r.begun,
      "seconds" -> RenderData.number(r.seconds),
      "rays" -> r.rays.toDouble,
      "command" -> r.command,
      "machine" -> RenderData.machine(r.machine),
      "programs" -> ujson.Arr.from(r.programs.map: p =>
        ujson.Obj("key" -> p.key, "title" -> p.title, "ours" -> p.isOurs)),
      "groups" -> ujson.Arr.from(r.groups.map(group(r, _))),
      "leftOut" -> ujson.Arr.from(r.leftOut.map((what, why) => ujson.Arr(what, why))),
      "kept" -> r.broken.isEmpty
    )
    ujson.write(report, indent = 2) + "\n"

  private def group(r: RobustnessReport, g: RobustGroup): ujson.Obj = ujson.Obj(
    "key" -> g.key,
    "title" -> g.title,
    "words" -> g.words,
    "per" -> RenderData.number(g.per),
    "rows" -> ujson.Arr.from(g.rows.map(row(r, g, _)))
  )

  private def row(r: RobustnessReport, g: RobustGroup, row: RobustRow): ujson.Obj =
    val cells = r.programs.flatMap(p => row.cells.get(p.key).map(c => p.key -> cell(c, g.per)))
    ujson.Obj(
      "what" -> row.what,
      "why" -> row.why.fold(ujson.Null: ujson.Value)(ujson.Str(_)),
      "cells" -> ujson.Obj.from(cells)
    )

  private def cell(c: Robust, per: Double): ujson.Obj =
    val figures = c match
      case Robust.Counted(faults, trials, first) => ujson.Obj(
          "faults" -> faults.toDouble,
          "trials" -> trials.toDouble,
          "rate" -> RenderData.number(faults.toDouble / trials * per),
          "most" -> RenderData.number(Statistics.countLimit(faults) / trials * per),
          "first" -> first.fold(ujson.Null: ujson.Value)(ujson.Str(_))
        )
      case Robust.Mean(found, error, expected, allowed) => ujson.Obj(
          "mean" -> RenderData.number(found),
          "error" -> RenderData.number(error),
          "expected" -> RenderData.number(expected),
          "allowed" -> RenderData.number(allowed)
        )
      case Robust.Absent(why) => ujson.Obj("absent" -> why)
      case Robust.Failed(why) => ujson.Obj("failed" -> why)
    figures("faulty") = c.isFaulty
    figures
