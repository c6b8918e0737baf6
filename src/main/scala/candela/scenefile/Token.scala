package candela.scenefile

/** What a token can be: a bare word (directive, number, `true`), a quoted text, `[`, `]`, or the
  * end.
  */
enum Token:
  case Word, Text, Open, Close, End
