package candela.cli

/** What `bench` is asked for beside the suite; empty or None is what the suite says.
  *
  * @param references where the references of a folder of scenes are, if not beside them
  * @param pictures   whether the page has all images to look at
  */
final case class BenchOptions(
    samples: Option[Vector[Int]] = None,
    seeds: Option[Int] = None,
    programs: Vector[String] = Vector.empty,
    scenes: Vector[String] = Vector.empty,
    references: Option[String] = None,
    pictures: Boolean = true
)
