package candela.settings

/** Whether the camera sees the sky, which lights the scene in any case. */
enum SkyView:
  case Show, Hide
