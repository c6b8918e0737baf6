package candela.fuzz

import java.nio.file.Path
import scala.util.Random

/** Something hostile that the program is given.
  *
  * @param what  it is, so that people can repeat it
  * @param files that it consists of
  * @param judge gives it to the program, and says what is wrong with the answer, if it is
  */
final case class Attempt(what: String, files: Vector[Path], judge: () => Option[String])

/** Attempts of one kind, one after the other. */
trait Attempts extends AutoCloseable:
  def next(): Attempt
  def close(): Unit = ()

/** What attempts are made of.
  *
  * @param from   a folder of scenes, meshes and pictures to break
  * @param folder for everything that is written
  */
final case class Place(from: Path, folder: Path, random: Random)

/** A kind of hostile input.
  *
  * @param short number of attempts in each run of the tests
  * @param usual number of attempts of a campaign
  * @param start makes the attempts; Left: why there are none on this machine
  */
final case class Kind(
    name: String,
    short: Int,
    usual: Int,
    start: Place => Either[String, Attempts]
)

object Kind:
  val all: Vector[Kind] = FileKind.values.toVector.map(ofFiles) ++ Vector(
    Kind("films", 200, 10000, p => Right(ForgedFilms(p))),
    Kind("options", 200, 10000, p => Right(OddOptions(p))),
    Kind("chains", 15, 1000, p => Right(Chains(p))),
    Kind("devices", 150, 10000, Devices.start),
    Kind("requests", 300, 10000, p => Right(Requests(p))),
    Kind("disks", 20, 1000, FullDisks.start),
    // Each starts a process
    Kind("calls", 1, 100, KilledCalls.start)
  )

  private def ofFiles(kind: FileKind): Kind = Kind(
    kind.name,
    kind.short,
    10000,
    place =>
      val trials = Trials(place.from, place.folder, place.random)
      val attempts: Attempts = () =>
        val file = trials.next(kind)
        Attempt(file.getFileName.toString, Vector(file), () => trials.judge(kind, file))
      Right(attempts)
  )
