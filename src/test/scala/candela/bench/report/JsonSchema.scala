package candela.bench.report

/** The part of JSON Schema that the repository's schemas use. */
final class JsonSchema(root: ujson.Value):

  /** What is wrong with the value, each with its place; nothing if it is valid. */
  def problems(value: ujson.Value): Vector[String] = problems(root, value, "$")

  private def problems(schema: ujson.Value, value: ujson.Value, at: String): Vector[String] =
    val rules = schema.obj
    rules.toVector.flatMap: (rule, wanted) =>
      (rule, value) match
        case ("$ref", _) => problems(found(wanted.str), value, at)
        case ("const", _) => Vector(s"$at: $value").filter(_ => value != wanted)
        case ("type", _) =>
          val types = wanted.arrOpt.fold(Seq(wanted.str))(_.map(_.str).toSeq)
          Vector(s"$at: $value is no ${types.mkString(" or ")}").filter(_ =>
            !types.exists(is(value, _))
          )
        case ("minimum", ujson.Num(x)) => Vector(s"$at: $x").filter(_ => x < wanted.num)
        case ("minItems", ujson.Arr(all)) => Vector(s"$at: few").filter(_ => all.size < wanted.num)
        case ("maxItems", ujson.Arr(all)) => Vector(s"$at: many").filter(_ => all.size > wanted.num)
        case ("items", ujson.Arr(all)) =>
          all.toVector.zipWithIndex.flatMap((v, i) => problems(wanted, v, s"$at[$i]"))
        case ("required", o: ujson.Obj) =>
          wanted.arr.map(_.str).filterNot(o.value.contains).map(k => s"$at: lacks `$k`").toVector
        case ("properties", o: ujson.Obj) =>
          o.value.toVector.flatMap: (key, inner) =>
            wanted.obj.get(key).toVector.flatMap(problems(_, inner, s"$at.$key"))
        case ("additionalProperties", o: ujson.Obj) if wanted == ujson.False =>
          o.value.keys.filterNot(rules("properties").obj.contains).toVector.map(k => s"$at: `$k`")
        case _ => Vector.empty

  private def found(name: String): ujson.Value =
    name.stripPrefix("#/").split('/').foldLeft(root)(_(_))

  private def is(value: ujson.Value, kind: String): Boolean = (kind, value) match
    case ("object", _: ujson.Obj) | ("array", _: ujson.Arr) | ("string", _: ujson.Str) => true
    case ("number", _: ujson.Num) | ("null", ujson.Null) => true
    case ("integer", ujson.Num(x)) => x == Math.rint(x)
    case _ => false
