package candela.report

import scalatags.Text.all.*

/** The controls by which viewers move the camera; the script `move.js` acts on them. */
private[report] object CameraControls:

  /** What dragging or a click on the picture does. */
  def tools: Frag =
    def tool(name: String, words: String, isPressed: Boolean = false) =
      button(
        cls := "tool",
        data("tool") := name,
        attr("aria-pressed") := isPressed.toString,
        words
      )
    span(
      cls := "choice",
      attr("role") := "group",
      attr("aria-label") := "what dragging and clicking do",
      tool("orbit", "orbit", isPressed = true),
      tool("pan", "pan"),
      tool("aim", "look at"),
      tool("focus", "focus")
    )

  def all: Frag =
    div(
      id := "camera",
      div(
        cls := "choice",
        label(
          "field of view ",
          input(
            tpe := "range",
            id := "fov",
            attr("min") := "1",
            attr("max") := "170",
            step := "0.1"
          ),
          span(id := "fovtext")
        ),
        label("lens radius ", number("lens")),
        label("in focus at ", span(id := "focustext")),
        button(id := "reset", "reset")
      ),
      p(id := "remarks", cls := "soft", attr("role") := "status"),
      div(
        cls := "choice",
        select(
          id := "form",
          attr("aria-label") := "form of the camera",
          option(value := "statements", "LookAt and Camera")
        ),
        button(id := "copy", "copy"),
        span(id := "copied", cls := "soft", attr("role") := "status")
      ),
      pre(
        id := "cameratext",
        attr("tabindex") := "0",
        attr("role") := "region",
        attr("aria-label") := "the camera as text"
      )
    )

  private def number(name: String): Frag =
    input(tpe := "number", id := name, attr("min") := "0", step := "any")

  val keys: String =
    "Dragging orbits around the surface in the middle; with Shift or the right button, it pans. " +
      "The wheel moves nearer, with Alt it changes the field of view. One finger does what the " +
      "tool says, two pan and pinch. Keys on the image: arrows orbit, w a s d pan, + and − move " +
      "nearer and away, [ and ] change the field of view, o p k f choose the tool, r resets. " +
      "Elsewhere: e and E exposure, c tone curve, l layer."
