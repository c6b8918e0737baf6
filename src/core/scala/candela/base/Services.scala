package candela.base

import java.util.ServiceLoader

import scala.jdk.CollectionConverters.*

/** What other modules bring. The program knows none: classes that `META-INF/services` names are
  * looked up at run time.
  */
object Services:
  def installed[A](service: Class[A]): Iterator[A] = ServiceLoader.load(service).iterator.asScala
