package candela.build.recipe

import candela.scenefile.Dialect

import java.util.Locale

// Sets of dialects that support a parameter or a recipe. Mitsuba's scenes have what v4's have, too
private[build] val every: Set[Dialect] = Dialect.ofPbrt.toSet
private[build] val onlyV2: Set[Dialect] = Set(Dialect.V2)
private[build] val onlyV3: Set[Dialect] = Set(Dialect.V3)
private[build] val onlyV4: Set[Dialect] = Set(Dialect.V4)
private[build] val untilV3: Set[Dialect] = Set(Dialect.V2, Dialect.V3)
private[build] val sinceV3: Set[Dialect] = Set(Dialect.V3, Dialect.V4)
private[build] val onlyMitsuba: Set[Dialect] = Set(Dialect.Mitsuba)
private[build] val onlyGltf: Set[Dialect] = Set(Dialect.Gltf)
private[build] val onlyOthers: Set[Dialect] = Dialect.ofOthers

/** Display names of dialects. */
object Dialects:
  def name(dialect: Dialect): String = dialect.toString.toLowerCase(Locale.ROOT)

  /** `v2`, `v2 and v3`, `v2, v3, v4 and mitsuba`. */
  def list(dialects: Set[Dialect]): String =
    val names = Dialect.values.toVector.filter(dialects).map(name)
    if names.size < 2 then names.mkString
    else names.init.mkString(", ") + " and " + names.last

  /** The member of `dialects` nearest to `wanted`; ties go to the older one. */
  def nearest(wanted: Dialect, dialects: Set[Dialect]): Dialect =
    Dialect.ofPbrt.filter(dialects).minBy(d => Math.abs(d.ordinal - wanted.ordinal))
