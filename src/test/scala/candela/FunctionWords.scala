package candela

/** Words that say nothing of a thing: a constant needs a name that says what it counts, any other
  * declaration one that says what it is.
  */
object FunctionWords:
  private val words: Set[String] =
    """all any around ask asked asks as at away back be been before begin behind best between
      both bring brings but by can certain come comes each else enough even ever fall few
      find finds first for found from get gets give gives go goes gone good half has have
      here how if in is it its keep keeps kept know knows known last later least leave
      leaves left less let like likely long look looks lose lost made make makes many may
      mean meant meet meets met more most much must near need needs never new next no none
      not now of off often old on once one only open or other others out over own part
      parts past patience pay pays place places put rest said same say says see seen sees
      sent set shall show shown shows silent since so some stand stands still such sure
      take taken takes tell tells than that the their them then there these they thing
      this those told too tried try tries under until up upon use used usual very want
      wants was way were what when where which while who whole why will with within
      without worn worth yet""".split("\\s+").toSet

  /** Those that are a usual name of a thing, or half of a usual pair: `mean`, `Spectrum.of`, the
    * `next` of an iterator, received and `sent`, the `parts` of an EXR file, the `leaves` of a
    * tree, `from` and `to`.
    */
  val terms: Set[String] =
    """all at by first from between get in last leaves left long mean near next none of open out
      part parts sent set take this up""".split("\\s+").toSet

  private val quantifier = "(Most|Least|Fewest)([A-Z0-9].*)".r

  /** A name that begins with a word of quantity, with the usual prefix in its place. */
  def prefixed(name: String): Option[String] = name match
    case quantifier("Most", quantity) => Some(s"Max$quantity")
    case quantifier(_, quantity) => Some(s"Min$quantity")
    case _ => None

  def contains(name: String): Boolean = words(name.toLowerCase)
