package candela.base

import java.util.ServiceLoader

import scala.jdk.CollectionConverters.*

/** What other modules bring. The program knows none: classes that `META-INF/services` names are
  * looked up at run time.
  */
object Services:
  /** Those beside this program, and those that the thread sees: threads of a pool may see others
    * than the thread that started it.
    */
  def installed[A](service: Class[A]): Iterator[A] =
    val loaders =
      Vector(getClass.getClassLoader, Thread.currentThread.getContextClassLoader).distinct
    loaders.iterator.flatMap(ServiceLoader.load(service, _).iterator.asScala)
      .distinctBy(_.getClass.getName)
