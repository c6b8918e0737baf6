package candela.scenefile

import candela.diagnostics.{Code, Problem}

/** Notes mixtures of materials, for those that are defined after them. Mutable. */
private[scenefile] final class Mixtures:
  private val open = Vector.newBuilder[(Declaration, Param)]

  /** @param isDefined whether there is a material of a name so far */
  def note(material: Declaration, isDefined: String => Boolean): Unit =
    if material.name == "mix" then
      for p <- material.params if Mixtures.Names(p.name) && p.strings.size == 1 do
        if !isDefined(p.strings.head) then open += (material -> p)

  /** Warnings of materials that are defined after mixtures of them. */
  def ofLaterMaterials(dialect: Dialect, named: Vector[(String, Declaration)]): Vector[Problem] =
    val definitions = named.map((name, material) => name -> material.pos).toMap
    val definitionPositions = named.map((_, material) => material.pos).toSet
    def isNamed(d: Declaration) = definitionPositions(d.pos)
    for
      (mixture, reference) <- open.result()
      // pbrt-v2 looks for the parts of a `Material` when a shape has it
      if dialect == Dialect.V3 || dialect == Dialect.V2 && isNamed(mixture)
      later <- definitions.get(reference.strings.head)
    yield
      val name = reference.strings.head
      Problem.warning(
        Code.DefinedLater,
        reference.valuesAt,
        s"material `$name` is defined only later, at $later; pbrt mixes a grey \"matte\" instead " +
          "and prints an error",
        Some("move its MakeNamedMaterial before this statement")
      )

private object Mixtures:
  private val Names = Set("namedmaterial1", "namedmaterial2")
