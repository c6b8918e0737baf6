package candela.guiding

import candela.base.{CheckedInput, CheckedOutput}

/** What the paths of one rendering learn, shared by all workers. Passes end after 1, 2, 4, 8, …
  * samples per pixel: the paths of a pass use the field of those before, and record for the next.
  * No path uses what it recorded itself, so every sample is unbiased. After a quarter of the
  * samples nothing more is learnt.
  *
  * @param samples planned per pixel
  * @param pixels  of the image
  */
final class Guide(settings: GuideSettings, samples: Int, pixels: Long):
  import Guide.*

  private val isLongEnough = !settings.adapts || samples >= Least

  @volatile private var current = lesson(GuideField.Start, 0, UsualEvents)

  /** The field to use, and where to record, until the pass ends. */
  def lesson: Lesson = current

  def describe: String =
    if !settings.adapts then "everywhere, learnt while rendering"
    else if isLongEnough then
      s"where it pays, learnt while rendering; none if it does not by sample $Trial"
    else s"none: fewer than $Least samples per pixel"

  /** Called when sample number `sample` begins, and no path of an earlier pass is on its way. */
  def begin(sample: Int): Unit =
    if isOver(current, sample) then
      synchronized:
        if isOver(current, sample) then learn(current, sample)

  private def isOver(lesson: Lesson, sample: Int): Boolean =
    lesson.records != null && sample >= next(lesson.begun)

  private def learn(was: Lesson, sample: Int): Unit =
    val records = was.records
    if records != null then
      val events = records.sorted()
      val growth = GuideGrowth(was.field, events, settings)
      val field = growth.result()
      current =
        if settings.adapts && sample >= Trial && growth.left > WorthIt then
          Lesson(GuideField.Start, sample, null)
        else
          val count = events.length / GuideRecords.Size
          lesson(field, sample, count / (pixels.toDouble * (sample - was.begun) * records.rate))

  /** @param found events per sample that found light */
  private def lesson(field: GuideField, begun: Int, found: Double): Lesson =
    val end = next(begun)
    val expected = pixels * (end - begun) * Math.max(found, 1e-3)
    val rate = Math.min(1.0, settings.records / expected).toFloat
    // The first pass always ends before the samples do
    val goesOn = isLongEnough && end < samples && (begun == 0 || 4 * end <= samples)
    Lesson(field, begun, if goesOn then GuideRecords(rate) else null)

  /** Writes what was learnt; no path may be on its way. */
  def save(to: CheckedOutput): Unit =
    val now = current
    val records = now.records
    to.int(now.begun)
    now.field.save(to)
    to.float(if records == null then 0f else records.rate)
    if records != null then records.save(to)

  /** Continues from what was learnt. */
  def load(from: CheckedInput): Unit =
    val begun = from.int()
    val field = GuideField.load(from)
    val rate = from.float()
    val records = if rate == 0f then null else GuideRecords(rate)
    if records != null then records.load(from)
    current = Lesson(field, begun, records)

object Guide:
  /** @param begun   the first sample that uses it
    * @param records null: nothing more is learnt
    */
  final class Lesson private[guiding] (
      val field: GuideField,
      val begun: Int,
      private[guiding] val records: GuideRecords | Null
  ):
    /** Where a worker records; null: nothing more is learnt. */
    def newPart(): GuideRecords.Part | Null =
      val to = records
      if to == null then null else to.newPart()

  /** Samples per pixel of a rendering in which learning may pay. */
  private val Least = 64

  /** The sample before which it has to show that it pays. */
  private val Trial = 16

  /** It pays if this part of the second moment is left, or less. */
  private val WorthIt = 0.8

  /** Events per sample that find light, before they were counted. */
  private val UsualEvents = 3.0

  /** The sample with which the next pass begins. */
  private def next(begun: Int): Int = Math.max(1, 2 * begun)
