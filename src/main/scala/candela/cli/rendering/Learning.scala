package candela.cli.rendering

import candela.base.Figures
import candela.guiding.GuideOutcome
import candela.report.LearnedFigure

/** What is said of paths that learnt (`--guiding`). */
object Learning:

  def summary(o: GuideOutcome): String =
    if o.gaveUp then
      val gain = o.varianceRatio.fold("")(left => s": variance × ${Figures.fixed(left, 2)}")
      s"guiding: given up at sample ${o.samples}, as it did not pay$gain"
    else
      val rows = figures(o).filter(_.key != "samples").map(f => s"${f.what} ${f.text}")
      s"guiding: learnt until sample ${o.samples}; ${rows.mkString(", ")}"

  def figures(o: GuideOutcome): Vector[LearnedFigure] =
    def count(key: String, what: String, n: Int) = LearnedFigure(key, what, n, n.toString)
    Vector(
      count("samples", "samples to learn from", o.samples),
      count("regions", "guided regions", o.regions),
      count("allRegions", "of all regions", o.allRegions),
      count("lobes", "lobes", o.lobes),
      LearnedFigure("share", "guided bounces", o.share, s"${Figures.fixed(100 * o.share, 1)} %"),
      LearnedFigure("weight", "weight of the last samples", o.weight, Figures.fixed(o.weight, 0))
    ) ++ o.varianceRatio.map: left =>
      val description = "variance of the paths that were compared, relative to unguided ones"
      LearnedFigure("varianceLeft", description, left, Figures.fixed(left, 3))
