package candela.render

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Scene files of one dialect go in, and images come out that agree with its program's.
  *
  * In every run, each scene of the `scenes` folder that `reference-images` has an image of is
  * rendered with few samples, and its digest compared with that of the image whose full comparison
  * has passed: see [[ImageDigests]]. Where the digest differs, and in the slow tests, the scene is
  * rendered with several seeds and compared as [[Agreement]] says. The seeds are fixed: an
  * unchanged renderer always gets the same answer. Images that disagree are left under
  * `target/render-diff`.
  *
  * @param includes whether a scene is of the dialect
  * @param part     of so many suites of this dialect, which run side by side; counted from 0
  */
abstract class ReferenceSuite(includes: ReferenceScene => Boolean, part: Int = 0, parts: Int = 1)
    extends AnyFunSuite:

  private val scenes = ReferenceScenes.compared
    .filter(includes).zipWithIndex
    .collect { case (scene, i) if i % parts == part => scene }

  for scene <- scenes do
    test(s"${scene.title} is the image that agreed with its reference, or agrees with it"):
      if !ImageDigests.kept.get(scene.title).contains(ImageDigests.of(scene)) then
        assertAgreement(scene)
        info(s"the digest of ${scene.title} differs, its image agrees: ${ImageDigests.Renewal}")

    test(s"${scene.title} agrees with its reference", Slow):
      assertAgreement(scene)

  private def assertAgreement(scene: ReferenceScene): Unit =
    val agreement = ReferenceComparison(scene, scene.text)
    val disagreements = agreement.disagreements(ReferenceComparison.Significance)
    if disagreements.nonEmpty then
      val first = disagreements.take(5).map(_.what).mkString("\n  ")
      val paths = ReferenceComparison.write(scene, agreement).mkString("\n  ")
      fail(s"${disagreements.size} disagreements, first\n  $first\nsee\n  $paths\n" +
        s"If the new image is right, renew the reference, then ${ImageDigests.Renewal}")

class ReferenceV2Suite extends ReferenceSuite(_.name.startsWith("v2-"))
class ReferenceV3Suite extends ReferenceSuite(_.name.startsWith("v3-"))
class ReferenceV4FirstSuite extends ReferenceSuite(_.name.startsWith("v4-"), part = 0, parts = 2)
class ReferenceV4SecondSuite extends ReferenceSuite(_.name.startsWith("v4-"), part = 1, parts = 2)
class ReferenceMitsubaSuite extends ReferenceSuite(_.isMitsubas)
class ReferenceModelsSuite extends ReferenceSuite(_.isModel)
