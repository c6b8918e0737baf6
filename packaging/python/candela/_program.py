"""Runs the program."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence, Tuple

from ._errors import InternalError, error_of


@dataclass(frozen=True)
class Progress:
    """How far a rendering is: a fraction, and the program's line about it."""

    done: float
    line: str


def program() -> Path:
    """The file that starts the program; CANDELA_PROGRAM names another one."""
    other = os.environ.get("CANDELA_PROGRAM")
    name = "candela.bat" if os.name == "nt" else "candela"
    path = Path(other) if other else Path(__file__).parent / "program" / "bin" / name
    if not path.is_file():
        raise InternalError(f"there is no program at {path}")
    return path


_PROGRESS = re.compile(r"^render\s+(\d+(?:\.\d+)?)%\s")

Listener = Callable[[Progress], None]


def run(*arguments: "str | os.PathLike[str]", progress: Optional[Listener] = None) -> str:
    """Runs the program with these words, and returns what it prints.

    >>> print(candela.run("compare", "a.exr", "b.exr"))

    Raises ``CandelaError`` if its exit code is not 0. ``KeyboardInterrupt`` ends it, too.
    """
    out, _ = execute([os.fspath(a) for a in arguments], progress)
    return out


def execute(
    arguments: Sequence[str], progress: Optional[Listener] = None
) -> Tuple[str, List[str]]:
    """What the program prints to standard output, and its messages as lines."""
    # The program ends when the pipe to it does, even if this process is killed
    environment: Dict[str, str] = dict(os.environ, CANDELA_PARENT="stdin")
    if progress is not None:
        environment["CANDELA_PROGRESS"] = "lines"
    # In a group of its own: Ctrl-C reaches it once, from here, in notebooks, too
    new_group = (
        {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
        if sys.platform == "win32"
        else {"start_new_session": True}
    )
    child = subprocess.Popen(
        [str(program()), *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
        env=environment,
        **new_group,  # type: ignore[arg-type]
    )
    assert child.stdin is not None
    assert child.stdout is not None and child.stderr is not None
    printed: List[str] = []
    reader = threading.Thread(target=lambda: printed.append(child.stdout.read()), daemon=True)
    reader.start()
    messages: List[str] = []
    try:
        for line in child.stderr:
            text = line.rstrip("\r\n")
            found = _PROGRESS.match(text)
            if found is None:
                messages.append(text)
            elif progress is not None:
                progress(Progress(float(found[1]) / 100, text))
        code = child.wait()
    except BaseException:
        _end(child)
        raise
    finally:
        reader.join(timeout=10)
        child.stdin.close()
        child.stdout.close()
        child.stderr.close()
    if code != 0:
        raise error_of(code, messages)
    return "".join(printed), messages


def _end(child: "subprocess.Popen[str]") -> None:
    """Ends the program as Ctrl-C does, twice if need be, and at last by force."""
    if sys.platform == "win32":
        child.terminate()
        child.wait()
        return
    for seconds in (1.0, 5.0):
        child.send_signal(signal.SIGINT)
        try:
            child.wait(seconds)
            return
        except subprocess.TimeoutExpired:
            pass
    child.kill()
    child.wait()
