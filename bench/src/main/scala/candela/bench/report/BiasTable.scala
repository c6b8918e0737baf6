package candela.bench.report

import candela.image.ImageFiles
import candela.measure.{BiasRegion, BiasTest, HeatMap}
import candela.report.{Numbers, Page}

import java.util.Base64

import scalatags.Text.all.*

/** Which programs differ in their expected image from the first one, and where. */
private[report] object BiasTable:

  def apply(biases: Vector[BiasAgainst], hasPictures: Boolean): Frag =
    val head = Vector("program", "p", "whole image: ratio R, G, B", "most different")
    frag(
      h3(s"Bias against ${biases.head.other}"),
      Page.grid(head, biases.map(row)),
      p(
        cls := "soft",
        "Welch's t-test of the seeds' images at the highest sample count, on squares of 8 pixels " +
          "up to the whole image (docs/METRICS.md). p: chance that noise alone makes two " +
          "programs without bias differ as much; bold below 0.05. Ratios with standard error; " +
          "three seeds see large differences only."
      ),
      Option.when(hasPictures):
        div(
          biases.map: b =>
            tag("figure")(
              display := "inline-block",
              margin := "0 1em 1em 0",
              img(src := picture(b.test), alt := s"p-values of ${b.program}", maxWidth := "100%"),
              tag("figcaption")(
                cls := "soft",
                s"${b.program}: p from 1 (black) to 10⁻⁴ or below"
              )
            )
        )
    )

  private def row(b: BiasAgainst): Vector[Frag] =
    val isFound = b.test.p < 0.05
    val chance = Numbers.short(b.test.p)
    val location = b.test.worst.headOption.fold("–"): r =>
      val w = r.window
      s"${r.channel} in x ${w.x0} to ${w.x1}, y ${w.y0} to ${w.y1}: ${ratio(r)}"
    Vector[Frag](
      b.program,
      if isFound then tag("b")(chance) else chance,
      b.test.fullImage.map(ratio).mkString(", "),
      location
    )

  private def ratio(r: BiasRegion): String =
    if r.b == 0 then "–"
    else s"${Numbers.fixed(r.a / r.b, 4)} ±\u00a0${Numbers.fixed(Math.abs(r.error / r.b), 4)}"

  private def picture(test: BiasTest): String =
    val png = ImageFiles.png(HeatMap.of(test.powers, BiasTest.UsualPowers))
    s"data:image/png;base64,${Base64.getEncoder.encodeToString(png)}"
