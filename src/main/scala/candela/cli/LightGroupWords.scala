package candela.cli

import candela.build.LightGrouping

/** The value of `--light-groups`. */
private[cli] object LightGroupWords:
  private val name = "[A-Za-z0-9_]+"

  def parse(text: String): Option[LightGrouping] = text match
    case "statement" => Some(LightGrouping.Statements)
    case "type" => Some(LightGrouping.Types)
    case _ =>
      val groups = text.split(",", -1).toVector.map:
        case s"$group=$lights" => (group, lights.split("\\+", -1).toVector)
        case _ => ("", Vector.empty)
      val isValid = groups.forall((group, lights) => (group +: lights).forall(_.matches(name)))
      Option.when(isValid):
        val merged = groups.map(_._1).distinct
        LightGrouping.Named(merged.map(n => n -> groups.filter(_._1 == n).flatMap(_._2)))

  def apply(grouping: LightGrouping): String = grouping match
    case LightGrouping.Statements => "statement"
    case LightGrouping.Types => "type"
    case LightGrouping.Named(groups) =>
      groups.map((group, lights) => s"$group=${lights.mkString("+")}").mkString(",")
