package candela.base

import java.util.{ServiceConfigurationError, ServiceLoader}

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
    loaders.iterator.flatMap(named(service, _)).distinctBy(_.getClass.getName)

  private def named[A](service: Class[A], loader: ClassLoader | Null): Iterator[A] =
    val services = ServiceLoader.load(service, loader).iterator
    def next(): Option[Option[A]] =
      try Option.when(services.hasNext)(Some(services.next()))
      catch
        // The thread's loader may have another copy of this program, whose services are others
        case _: ServiceConfigurationError if loader != getClass.getClassLoader => Some(None)
    Iterator.unfold(())(_ => next().map(_ -> ())).flatten
