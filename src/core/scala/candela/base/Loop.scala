package candela.base

/** Runs `body` for 0 until `count` as a plain `while`, without range or boxing. */
inline def loop(count: Int)(inline body: Int => Unit): Unit =
  var i = 0
  while i < count do
    body(i)
    i += 1

/** Likewise for `from` until `until`. */
inline def loop(from: Int, until: Int)(inline body: Int => Unit): Unit =
  var i = from
  while i < until do
    body(i)
    i += 1

/** The first number below `count` for which this holds, or −1. */
inline def indexWhere(count: Int)(inline holds: Int => Boolean): Int =
  var i = 0
  while i < count && !holds(i) do i += 1
  if i < count then i else -1
