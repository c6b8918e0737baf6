package candela.diagnostics

import candela.base.loop
import java.nio.file.Path
import java.util.Locale

/** Finds the nearest known name, for "did you mean". */
object Suggest:

  /** The known name with the smallest edit distance to `name`, ignoring case, if it is small enough
    * for a typo: at most a third of the longer name's length. Of very many names, some are looked
    * at.
    */
  def nearest(name: String, known: Iterable[String]): Option[String] =
    val lower = name.toLowerCase(Locale.ROOT)
    var closest = Option.empty[String]
    var bestDistance = Int.MaxValue
    for k <- known.iterator.take(MaxKnownNames) do
      val limit = math.min(bestDistance, math.max(1, math.max(name.length, k.length) / 3))
      // The distance is at least the difference in length, so most names need no table.
      if math.abs(k.length - name.length) <= limit then
        val d = distance(lower, k.toLowerCase(Locale.ROOT), limit)
        if d <= limit && (d < bestDistance || closest.exists(_ > k)) then
          closest = Some(k)
          bestDistance = d
    closest

  /** Help text: the nearest name, else all known names. */
  def help(name: String, known: Iterable[String]): Option[String] =
    nearest(name, known).map(k => s"did you mean `$k`?").orElse {
      Option.when(known.nonEmpty):
        if known.sizeIs <= MaxListedNames then
          known.toVector.sorted.distinct.mkString("known: ", ", ", "")
        else
          known.iterator.take(Examples).mkString(
            "known: ",
            ", ",
            s" and ${known.size - Examples} more"
          )
    }

  /** Of objects and textures there may be millions, and as many names that are none of them. */
  private val MaxKnownNames = 5000

  /** Names that are listed; of more, examples. */
  private val MaxListedNames = 500
  private val Examples = 5

  /** The nearest of the names in the folder of a missing file. A file with another number is not
    * meant: `Mesh090.obj` is not `Mesh000.obj`.
    */
  def file(path: Path, names: Iterable[String]): Option[String] =
    for
      name <- Option(path.getFileName).map(_.toString)
      near <- nearest(name, names.filterNot(differsInNumber(name, _)))
    yield s"did you mean `$near`?"

  /** Whether two names differ in the values of their numbers alone. */
  private def differsInNumber(a: String, b: String): Boolean =
    def words(name: String) = Digits.replaceAllIn(name.toLowerCase(Locale.ROOT), "0")
    def numbers(name: String) = Digits.findAllIn(name).map(BigInt(_)).toVector
    a.exists(_.isDigit) && words(a) == words(b) && numbers(a) != numbers(b)

  private val Digits = "[0-9]+".r

  /** Edit distance (insertion, deletion, substitution, transposition of neighbours) from `a` to
    * `b`.
    *
    * Source: Damerau, "A technique for computer detection and correction of spelling errors", CACM
    * 7(3), 1964 (the restricted form).
    *
    * @param most what is farther is `most` + 1, or exact
    */
  def distance(a: String, b: String, most: Int = Int.MaxValue - 1): Int =
    var older, last, row = new Array[Int](b.length + 1)
    loop(b.length + 1)(j => row(j) = j)
    var rowMin = 0
    var i = 1
    while i <= a.length && rowMin <= most do
      val free = older
      older = last
      last = row
      row = free
      row(0) = i
      rowMin = i
      var j = 1
      while j <= b.length do
        val replace = last(j - 1) + (if a(i - 1) == b(j - 1) then 0 else 1)
        var d = math.min(replace, math.min(last(j), row(j - 1)) + 1)
        val swapped = i > 1 && j > 1 && a(i - 1) == b(j - 2) && a(i - 2) == b(j - 1)
        if swapped then d = math.min(d, older(j - 2) + 1)
        row(j) = d
        if d < rowMin then rowMin = d
        j += 1
      i += 1
    if i > a.length then row(b.length) else most + 1
