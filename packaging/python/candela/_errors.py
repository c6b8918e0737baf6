"""Errors and warnings of scenes, as exceptions."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Iterable, List, Optional, Tuple


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
    place of the first, or are ``None``.
    """

    def __init__(self, message: str, problems: Tuple[Problem, ...] = (), code: int = 1) -> None:
        super().__init__(message)
        self.problems = problems
        self.code = code
        first = problems[0] if problems else None
        self.file = first.file if first else None
        self.line = first.line if first else None
        self.column = first.column if first else None


class SceneError(CandelaError):
    """A scene, or a file that it names, is invalid."""


class UsageError(CandelaError):
    """An option is unknown, or its value is invalid."""


class InternalError(CandelaError):
    """A bug of the program, or a Java that does not run."""


class CandelaWarning(UserWarning):
    """A warning about a scene."""


_FIRST = re.compile(
    r"^(?:(?P<file>.+?)(?::(?P<line>\d+):(?P<column>\d+)|#(?P<pointer>(?:/\S*?)?)): )?"
    r"(?P<severity>error|warning): (?P<message>.*?)(?: \[(?P<number>E\d{4})\])?$"
)


_OPTION = re.compile(r"`candela [^`]*`|(?<![\w-])--([a-z][a-z0-9-]*)(?: (?=[A-Z]+\b|\d))?")
_HELP = re.compile("`candela help (render|check)` says")
_EXCERPT = re.compile(r"^ +\d* \|")
_BELOW = re.compile(r"^ (?! )|" + _EXCERPT.pattern)  # the first line of a problem
_COUNT = re.compile(r"^(and )?\d+ (more )?errors?$")


# What a list in a dict can be
_LISTS = {
    "must be a colour or a texture, found a vector": 'a colour is {"type": "rgb", "value": […]}',
    "must be a vector, found a string": "a vector is a list of three numbers",
}


def is_note(line: str) -> bool:
    """Whether a message tells of no problem."""
    return not any(p.match(line) for p in (_FIRST, _BELOW, _COUNT))


def in_python(line: str) -> str:
    """A line of a message, with keywords instead of the command line's options."""
    if _EXCERPT.match(line):
        return line
    line = _HELP.sub(r"`help(candela.\1)` and COMMANDS.md say", line)

    def keyword(option: "re.Match[str]") -> str:
        if option[1] is None:  # a command of a shell
            return option[0]
        return option[1].replace("-", "_") + ("=" if option[0].endswith(" ") else "")

    return _OPTION.sub(keyword, line)


def problems_in(lines: Iterable[str], keys: Optional[List[str]] = None) -> List[Problem]:
    """The problems in the program's messages; the lines below each belong to it.

    :param keys: of the lines of the scene, if it is a dict's
    """
    found: List[List[str]] = []
    for line in lines:
        if _FIRST.match(line):
            found.append([line])
        elif _BELOW.match(line) and found:
            found[-1].append(line)
    return [_problem([in_python(line) for line in each], keys) for each in found]


def _problem(lines: List[str], keys: Optional[List[str]]) -> Problem:
    first = _FIRST.match(lines[0])
    assert first is not None
    place = first["file"]
    line = int(first["line"]) if first["line"] else None
    column = int(first["column"]) if first["column"] else None
    key = first["pointer"]
    if keys is not None and line is not None:
        # The user has seen no text
        key = keys[line - 1] if line <= len(keys) else ""
        place = line = column = None
        number = f" [{first['number']}]" if first["number"] else ""
        start = f"{key}: " if key else ""
        lines = [
            f"{start}{first['severity']}: {first['message']}{number}",
            *(below for below in lines[1:] if not _EXCERPT.match(below)),
            *(f" {help}" for end, help in _LISTS.items() if first["message"].endswith(end)),
        ]
    return Problem(
        severity=first["severity"],
        message=first["message"],
        text="\n".join(lines),
        file=place,
        line=line,
        column=column,
        number=first["number"],
        key=key or None,
    )


def error_of(code: int, lines: List[str], keys: Optional[List[str]] = None) -> CandelaError:
    """The exception for an exit code and what was printed."""
    problems = sorted(problems_in(lines, keys), key=lambda p: p.severity)
    errors = [p.text for p in problems if p.severity == "error"]
    message = "\n".join(errors) or "\n".join(lines[-20:])
    kind = {1: SceneError, 2: UsageError}.get(code, InternalError)
    return kind(message or f"candela has ended with exit code {code}", tuple(problems), code)
