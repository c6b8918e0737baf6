import com.typesafe.tools.mima.core.ProblemFilter

/** What the library promises: `candela.api`. The rest of the core may change at any time. */
object Promised {
  private val Name = "candela.api"

  /** Keeps the problems of what is promised. */
  val only: ProblemFilter = _.matchName.exists(name => name == Name || name.startsWith(Name + "."))
}
