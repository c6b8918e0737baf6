"""Errors and warnings of scenes, as exceptions."""

from __future__ import annotations

import difflib
import os
import re
import sys
import warnings
from dataclasses import dataclass, replace
from typing import Callable, Iterable, List, Optional, Tuple


# Of each line of a dict's text: its place, and the number of values if it is a list
Keys = List[Tuple[str, int]]
OF_DEFINE = -1  # instead of a number of values: a text `$name`


@dataclass(frozen=True)
class Problem:
    """An error or a warning.

    ``text`` is the whole of it, with the line of the scene and the advice below it; ``number``
    is that which ``candela explain`` explains, such as ``E0401``. In a scene of a dict, ``key``
    names its place, such as ``ball.bsdf``; in a model, ``file`` and ``key``, a JSON pointer such as
    ``/materials/0``; in others, ``file``, ``line`` and ``column``.
    """

    severity: str
    message: str
    text: str
    file: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None
    number: Optional[str] = None
    key: Optional[str] = None

    def __str__(self) -> str:
        return self.text


class CandelaError(Exception):
    """The program failed.

    ``problems`` are its errors, and warnings after them; ``file``, ``line`` and ``column`` tell the
    place of the first, or are ``None``. ``output`` is what ``run`` would have returned.
    """

    def __init__(self, message: str, problems: Tuple[Problem, ...] = (), code: int = 1) -> None:
        super().__init__(message)
        self.problems = problems
        self.code = code
        self.output = ""
        first = problems[0] if problems else None
        self.file = first.file if first else None
        self.line = first.line if first else None
        self.column = first.column if first else None

    def renamed(self, old: str, new: str) -> "CandelaError":
        """The same about a file that has another name for the user."""
        problems = tuple(
            replace(p, text=p.text.replace(old, new), message=p.message.replace(old, new))
            for p in self.problems
        )
        return type(self)(str(self).replace(old, new), problems, self.code)


class SceneError(CandelaError):
    """A scene, or a file that it names, is invalid."""


class MissingFileError(SceneError, FileNotFoundError):
    """A file, or the folder of an output, does not exist."""


class UsageError(CandelaError):
    """An option is unknown, or its value is invalid."""


class InternalError(CandelaError):
    """A bug of the program, or a Java that does not run."""


class CandelaWarning(UserWarning):
    """A warning about a scene."""


_FIRST = re.compile(
    r"^(?:(?!(?:error|warning): )(?P<file>.+?)"
    r"(?::(?P<line>\d+):(?P<column>\d+)|#(?P<pointer>(?:/\S*?)?))?: )?"
    r"(?P<severity>error|warning): (?P<message>.*?)(?: \[(?P<number>E\d{4})\])?$"
)


_OPTION = re.compile(r"`candela [^`]*`|(?<![\w-])--([a-z][a-z0-9-]*)(?: (?=[A-Z]+\b|\d))?")
_LONG = re.compile(r"found `([^`]{80})[^`]{20,}`")
_HELP = re.compile("`candela help (render|check)` says")
_EXCERPT = re.compile(r"^ +\d* \|")
_BELOW = re.compile(r"^ (?! )|" + _EXCERPT.pattern)  # the first line of a problem
_COUNT = re.compile(r"^(and )?\d+ (more )?errors?$")


# Words of files and the command line, and those of Python
_WORDS = {
    "--sensor all renders each, --sensor 1": "sensor=0 renders the first, sensor=1",
    "--partial merges": "`candela merge --partial` merges",
    ".npz files store linear light": "`image.rgb` is linear light",
}

_DEFAULT = re.compile(r'write <default name="(\w+)" value="…"/> before it, or use -D\w+=…')
_DEFINE = re.compile(r"-D(\w+)=VALUE")
_COLOR = "must be a colour or a texture, found a vector"
_ELEMENT = re.compile(r'<(\w+) type="(\w+)">')
_LINE = re.compile(r"scene\.xml:(\d+):\d+")
# Temporary files of arrays: at the start of a message, or named in it
_ARRAY = re.compile(r"^[^`]*?\bcandela-\w{8}\.(?:exr|png|ply|vol): ")
_ARRAYS = re.compile(r"`[^`]*\bcandela-\w{8}\.(?:exr|png|ply|vol)`")


def is_note(line: str) -> bool:
    """Whether a message tells of no problem."""
    return not any(p.match(line) for p in (_FIRST, _BELOW, _COUNT))


def in_python(line: str) -> str:
    """A line of a message, with keywords instead of the command line's options."""
    if _EXCERPT.match(line):
        return line
    for words, others in _WORDS.items():
        line = line.replace(words, others)
    line = _DEFAULT.sub(
        r"define={'\1': …} gives its value; of a name that has a `$`, write '$file' and "
        "define={'file': …}",
        line,
    )
    line = _DEFINE.sub(r"define={'\1': …}", line)
    line = _LONG.sub(r"found `\1…`", line)
    line = _HELP.sub(r"`help(candela.\1)` and COMMANDS.md say", line)

    def keyword(option: "re.Match[str]") -> str:
        if option[1] is None:  # a command of a shell
            return option[0]
        return option[1].replace("-", "_") + ("=" if option[0].endswith(" ") else "")

    return _OPTION.sub(keyword, line)


def problems_in(
    lines: Iterable[str], keys: Optional[Keys] = None, in_words: Callable[[str], str] = in_python
) -> List[Problem]:
    """The problems in the program's messages; the lines below each belong to it.

    :param keys: those of the scene, if it is a dict's
    :param in_words: ``str`` keeps the command line's
    """
    found: List[List[str]] = []
    for line in lines:
        if _FIRST.match(line):
            found.append([line])
        elif _BELOW.match(line) and found:
            found[-1].append(line)
    return [_problem([in_words(line) for line in each], keys) for each in found]


def _problem(lines: List[str], keys: Optional[Keys]) -> Problem:
    first = _FIRST.match(lines[0])
    assert first is not None
    place = first["file"]
    line = int(first["line"]) if first["line"] else None
    column = int(first["column"]) if first["column"] else None
    key, message = first["pointer"], first["message"]
    if keys is not None and (line is not None or place is None):
        # The user has seen no text
        key, size = keys[line - 1] if line and line <= len(keys) else ("", 0)
        place = line = column = None
        number = f" [{first['number']}]" if first["number"] else ""
        start = f"{key}: " if key else ""
        below = [line for line in lines[1:] if not _EXCERPT.match(line)]
        below = [_ELEMENT.sub(r'"\1": {"type": "\2"}', line) for line in below]
        message = _ARRAYS.sub("the array", _ARRAY.sub("", message))
        message = _LINE.sub(lambda at: f"`{keys[int(at[1]) - 1][0]}`", message)
        if message.endswith(_COLOR):
            below.append(' a colour is {"type": "rgb", "value": […]}')
        if message.endswith("found a string") and size == OF_DEFINE:
            below.append(" `$name` is a text: `scene.parameters()` sets numbers")
        if message.endswith("found a string") and size > 1:
            message = message.replace("a vector", "3 numbers")
            message = message.replace("found a string", f"found {size} numbers")
        lines = [f"{start}{first['severity']}: {message}{number}", *below]
    return Problem(
        severity=first["severity"],
        message=message,
        text="\n".join(lines),
        file=place,
        line=line,
        column=column,
        number=first["number"],
        key=key or None,
    )


_NAMED = re.compile("`([^`]+)`")
_MISSING = re.compile("^E010[14] |: no such folder: ")
_FORMAT = "E0106"  # of an output, unless the scene names it


def missing(path: str, what: str = "file or folder", number: str = "E0104") -> MissingFileError:
    message = f"no such {what}: `{path}`"
    text = f"error: {message} [{number}]"
    try:
        names = os.listdir(os.path.dirname(path) or ".")
    except OSError:
        names = []
    near = difflib.get_close_matches(os.path.basename(path), names, 1)
    if near:
        text += f"\n did you mean `{os.path.join(os.path.dirname(path), near[0])}`?"
    return MissingFileError(text, (Problem("error", message, text, path, number=number),))


def error_of(code: int, lines: List[str], problems: List[Problem]) -> CandelaError:
    """The exception for an exit code and what was printed, with its problems."""
    problems = sorted(problems, key=lambda p: p.severity)
    errors = [p.text for p in problems if p.severity == "error"]
    message = "\n".join(errors) or "\n".join(lines[-20:])
    kind = {1: SceneError if problems else CandelaError, 2: UsageError}.get(code, InternalError)
    if problems and _MISSING.search(f"{problems[0].number} {problems[0].message}"):
        is_there = problems[0].message.endswith("` is a folder")
        kind = SceneError if is_there else MissingFileError
        first = problems[0]
        named = _NAMED.search(first.message)
        if named and not (first.file or first.key):
            problems[0] = replace(first, file=named[1])
    elif problems and problems[0].number == _FORMAT and not (problems[0].file or problems[0].key):
        kind = UsageError
    return kind(message or f"candela has ended with exit code {code}", tuple(problems), code)


def warn(problems: Iterable[Problem]) -> None:
    """The warnings among them, as Python's, of the line that calls this package."""
    for problem in problems:
        if problem.severity == "warning":
            warnings.warn(problem.text, CandelaWarning, stacklevel=_user_level())


def _user_level() -> int:
    """How far above ``warn`` the call is that is not of this package."""
    frame, level = sys._getframe(2), 2
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    return level
