package packaging

import java.nio.charset.StandardCharsets.UTF_8

/** The add-on for Blender, an extension: its sources, and the Python module that runs the program.
  *
  * Source: Blender manual, "Creating extensions", schema 1.0.0.
  */
object Addon {

  /** @param sources of the add-on, by their paths in it
    * @param module  files of the Python package, by their paths in it
    */
  def entries(facts: Facts, sources: Seq[Entry], module: Seq[Entry]): Seq[Entry] =
    sources.map(e => if (e.name == Manifest) versioned(facts, e) else e) ++
      module.map(_.in("candela"))

  private val Manifest = "blender_manifest.toml"

  private def versioned(facts: Facts, manifest: Entry): Entry = {
    val text = new String(manifest.content.bytes, UTF_8)
    Entry.text(
      Manifest,
      text.replaceFirst("(?m)^version = .*$", s"""version = "${facts.version}"""")
    )
  }
}
