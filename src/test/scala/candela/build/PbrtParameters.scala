package candela.build

import scala.io.{Codec, Source}
import scala.util.Using

import candela.scenefile.Dialect

/** A parameter as pbrt's own source reads it. */
final case class PbrtParameter(
    dialect: Dialect,
    category: String,
    typeName: String,
    name: String,
    values: String,
    default: String
)

object PbrtParameters:

  /** All that pbrt's three sources read, gathered from them and not from the recipes. */
  lazy val all: Vector[PbrtParameter] =
    val stream = getClass.getResourceAsStream("/candela/build/parameters.tsv")
    Using.resource(Source.fromInputStream(stream)(using Codec.UTF8)): source =>
      source.getLines().filterNot(_.startsWith("#")).map(parsed).toVector

  private def parsed(line: String): PbrtParameter = line.split("\t", -1) match
    case Array(dialect, category, typeName, name, values, default) =>
      PbrtParameter(Dialect.valueOf(dialect.capitalize), category, typeName, name, values, default)
    case _ => throw IllegalArgumentException(line)
