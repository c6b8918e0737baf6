"""Errors and warnings of scenes, as exceptions."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Iterable, List, Optional, Tuple


@dataclass(frozen=True)
class Problem:
    """An error or a warning.

    ``text`` is the whole of it, with the line of the scene and the advice below it; ``number``
    is that which ``candela explain`` explains, such as ``E0401``.
    """

    severity: str
    message: str
    text: str
    file: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None
    number: Optional[str] = None

    def __str__(self) -> str:
        return self.text


class CandelaError(Exception):
    """The program failed.

    ``problems`` are its errors; ``file``, ``line`` and ``column`` tell the place of the first,
    or are ``None``.
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
    r"^(?:(?P<file>.+?):(?P<line>\d+):(?P<column>\d+): )?"
    r"(?P<severity>error|warning): (?P<message>.*?)(?: \[(?P<number>E\d{4})\])?$"
)


def problems_in(lines: Iterable[str]) -> List[Problem]:
    """The problems in the program's messages; lines that begin with a blank belong to the last."""
    found: List[List[str]] = []
    for line in lines:
        if _FIRST.match(line):
            found.append([line])
        elif line.startswith(" ") and found:
            found[-1].append(line)
    return [_problem(each) for each in found]


def _problem(lines: List[str]) -> Problem:
    first = _FIRST.match(lines[0])
    assert first is not None
    place = first["file"]
    return Problem(
        severity=first["severity"],
        message=first["message"],
        text="\n".join(lines),
        file=place,
        line=int(first["line"]) if place else None,
        column=int(first["column"]) if place else None,
        number=first["number"],
    )


def error_of(code: int, lines: List[str]) -> CandelaError:
    """The exception for an exit code and what was printed."""
    errors = tuple(p for p in problems_in(lines) if p.severity == "error")
    message = "\n".join(p.text for p in errors) or "\n".join(lines[-20:])
    kind = {1: SceneError, 2: UsageError}.get(code, InternalError)
    return kind(message or f"candela has ended with exit code {code}", errors, code)
