package candela.report

import scalatags.Text.TypedTag
import scalatags.Text.all.*

import scala.io.{Codec, Source}

/** The frame of a page that is one file and needs no network: style and script are in it. */
private[report] object Page:

  def html(heading: String, subtitle: Frag, version: String)(parts: Frag*): String =
    val page = tag("html")(
      lang := "en",
      tag("head")(
        meta(charset := "utf-8"),
        meta(name := "viewport", content := "width=device-width, initial-scale=1"),
        tag("title")(heading),
        tag("style")(raw(resource("page.css") + chartStyle))
      ),
      body(
        tag("header")(
          div(h1(heading), p(cls := "soft", subtitle)),
          button(id := "theme", "light / dark")
        ),
        parts,
        p(cls := "soft", s"Made by Candela $version. This page is one file and works offline."),
        script(raw(resource("page.js")))
      )
    )
    "<!DOCTYPE html>\n" + page.render

  def chartStyle: String = resource("chart.css")

  /** A large figure and what it is. */
  def tile(figure: String, what: String): Frag = div(cls := "tile", b(figure), span(what))

  /** Rows of names and values. */
  def facts(rows: Vector[(String, String)]): Frag =
    table(cls := "facts", rows.map((what, value) => tr(td(what), td(value))))

  def grid(head: Vector[String], rows: Vector[Vector[Frag]]): TypedTag[String] =
    div(
      cls := "scroll",
      table(thead(tr(head.map(th(_)))), tbody(rows.map(row => tr(row.map(cellOf)))))
    )

  private def cellOf(cell: Frag): Frag = td(cell)

  /** Charts of which one is seen: (metric's word, its title, axis, graphic). */
  def charts(all: Vector[(String, String, String, Svg.Node)]): Frag =
    def choice(key: String, choices: Vector[(String, String)]) =
      if choices.sizeIs < 2 then Vector.empty
      else
        choices.map: (value, words) =>
          button(data("key") := key, data("value") := value, words)
    val metrics = all.map((word, words, _, _) => (word, words)).distinct
    val axes = all.map(_._3).distinct.map(a => (a, s"against $a"))
    div(
      cls := "card charts",
      div(cls := "choice", choice("chart", metrics), span(" "), choice("axis", axes)),
      all.map: (word, _, axis, svg) =>
        div(cls := "chart", data("chart") := word, data("axis") := axis, svg)
    )

  private def resource(name: String): String =
    val stream = getClass.getResourceAsStream(s"/candela/report/$name")
    val source = Source.fromInputStream(stream)(using Codec.UTF8)
    try source.mkString
    finally source.close()
