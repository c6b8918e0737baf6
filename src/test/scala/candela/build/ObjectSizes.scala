package candela.build

import java.lang.reflect.{Array as JavaArray, Field, Modifier}
import java.util.IdentityHashMap
import java.util.concurrent.atomic.{AtomicIntegerArray, AtomicLongArray, AtomicReference}

import scala.collection.mutable
import scala.jdk.CollectionConverters.*

/** Sizes of objects in memory, with all that they refer to, as a Java machine of 64 bits with
  * compressed references lays them out. Objects of the JDK are counted where they hold others.
  */
final class ObjectSizes:
  private val seen = IdentityHashMap[AnyRef, AnyRef]()
  private val layouts = mutable.HashMap.empty[Class[?], ObjectSizes.Layout]

  /** Bytes of `roots` and of what they refer to, without what was counted before. */
  def add(roots: Iterable[AnyRef]): Long =
    var bytes = 0L
    walk(roots)((_, size) => bytes += size)
    bytes

  /** All objects that `root` refers to, for which `is` holds. Counts nothing. */
  def find(root: AnyRef)(is: AnyRef => Boolean): Vector[AnyRef] =
    val found = Vector.newBuilder[AnyRef]
    ObjectSizes().walk(Vector(root))((o, _) => if is(o) then found += o)
    found.result()

  private def walk(roots: Iterable[AnyRef])(visit: (AnyRef, Long) => Unit): Unit =
    val open = mutable.ArrayDeque.empty[AnyRef]
    def meet(o: Any): Unit = o match
      case ref: AnyRef if !ObjectSizes.isOutside(ref) && seen.put(ref, ref) == null => open += ref
      case _ => ()
    roots.foreach(meet)
    while open.nonEmpty do
      val o = open.removeLast()
      visit(o, size(o, meet))

  private def size(o: AnyRef, meet: Any => Unit): Long = o match
    case s: String => ObjectSizes.aligned(24) + ObjectSizes.aligned(16L + s.length)
    case m: java.util.Map[?, ?] =>
      m.asScala.foreach((k, v) =>
        meet(k); meet(v)
      )
      48L + 48L * m.size
    case c: java.util.Collection[?] =>
      c.asScala.foreach(meet)
      48L + 16L * c.size
    case a: AtomicIntegerArray => 32L + 4L * a.length
    case a: AtomicLongArray => 32L + 8L * a.length
    case r: AtomicReference[?] =>
      meet(r.get)
      16L
    case a if a.getClass.isArray =>
      val count = JavaArray.getLength(a)
      val item = a.getClass.getComponentType
      if !item.isPrimitive then a.asInstanceOf[Array[AnyRef]].foreach(meet)
      ObjectSizes.aligned(16L + count.toLong * ObjectSizes.width(item))
    case other =>
      val layout = layouts.getOrElseUpdate(other.getClass, ObjectSizes.layout(other.getClass))
      layout.references.foreach(f => meet(f.get(other)))
      layout.bytes

object ObjectSizes:
  final case class Layout(bytes: Long, references: Vector[Field])

  def aligned(bytes: Long): Long = (bytes + 7) & ~7L

  def width(of: Class[?]): Int =
    if !of.isPrimitive then 4
    else if of == classOf[Long] || of == classOf[Double] then 8
    else if of == classOf[Int] || of == classOf[Float] then 4
    else if of == classOf[Short] || of == classOf[Char] then 2
    else 1

  def layout(of: Class[?]): Layout =
    val classes = Vector.unfold(Option[Class[?]](of))(_.map(c => (c, Option(c.getSuperclass))))
    val fields =
      classes.flatMap(_.getDeclaredFields).filterNot(f => Modifier.isStatic(f.getModifiers))
    val isOurs = !of.getName.startsWith("java.")
    val references =
      if isOurs then fields.filter(f => !f.getType.isPrimitive && f.trySetAccessible())
      else Vector.empty
    Layout(aligned(12L + fields.map(f => width(f.getType)).sum), references)

  /** What belongs to the program rather than to a scene. */
  def isOutside(o: AnyRef): Boolean = o match
    case _: Class[?] | _: Thread | _: ClassLoader | _: java.nio.file.Path => true
    case _ => o.getClass.getName.endsWith("$")
