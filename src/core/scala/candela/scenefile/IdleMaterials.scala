package candela.scenefile

import java.util.IdentityHashMap

import scala.jdk.CollectionConverters.*

/** Materials that no shape has so far: those written in place, and undefined names. Mutable. */
private[scenefile] final class IdleMaterials:
  // Millions of shapes ask
  private val numbers = IdentityHashMap[MaterialRef, Int]()
  private var count = 0

  def add(material: MaterialRef): Unit =
    if numbers.size < Problems.MaxWarnings then
      count += 1
      numbers.put(material, count): Unit

  def markUsed(material: MaterialRef): Unit =
    if !numbers.isEmpty then numbers.remove(material): Unit

  def clear(): Unit = numbers.clear()

  /** In the order of their statements. */
  def all: Vector[MaterialRef] = numbers.asScala.toVector.sortBy(_._2).map(_._1)
