package candela.report

import candela.image.Image
import candela.measure.MeasuredCurve

/** What one program did with one scene.
  *
  * @param command as it was started, for the first image
  * @param isThin  to be drawn beside another program of the same colour
  * @param picture what it made in its longest run with the first seed
  */
final case class ProgramResult(
    name: String,
    title: String,
    color: Int,
    isThin: Boolean,
    command: String,
    curve: MeasuredCurve,
    picture: Image
)

/** All programs on one scene, by the reference that they were compared with.
  *
  * @param target the relative MSE that the programs race to
  */
final case class SceneResult(
    name: String,
    title: String,
    note: String,
    reference: Image,
    referenceName: String,
    target: Double,
    programs: Vector[ProgramResult]
)

/** All that came out of a suite.
  *
  * @param begun    date and time
  * @param seconds  that all runs took together
  * @param leftOut  what could not be run: (program or scene, why)
  */
final case class SuiteReport(
    title: String,
    version: String,
    machine: Machine,
    begun: String,
    seconds: Double,
    seeds: Int,
    scenes: Vector[SceneResult],
    leftOut: Vector[(String, String)]
)
