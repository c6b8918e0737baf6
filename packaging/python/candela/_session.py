"""The Java process that renders: one for each Python process, which stays until it ends."""

from __future__ import annotations

import atexit
import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Callable, Dict, List, Optional, Sequence, Tuple

from ._errors import (
    InternalError,
    Keys,
    Problem,
    UsageError,
    error_of,
    in_python,
    is_note,
    problems_in,
    warn,
)
from ._scene import Scene
from ._values import plain


@dataclass(frozen=True)
class Progress:
    """How far a rendering is.

    ``done`` is the fraction of the samples, or of the time if a goal ends it (``None`` until the
    time left is known); ``samples`` counts camera samples of all pixels; ``error`` is the relative
    error (RMSE, 0.01 is 1 %). What is not known yet is ``None``. ``line`` tells all of it in words.
    """

    done: Optional[float]
    line: str
    seconds: float = 0.0
    samples: int = 0
    samples_per_second: Optional[float] = None
    error: Optional[float] = None
    seconds_left: Optional[float] = None


Listener = Callable[[Progress], None]
Text = Tuple[str, str]  # the name of a scene, and its text

_POLL_SECONDS = 0.1
_CANCEL_SECONDS = 5.0


def program() -> Path:
    """The file that starts the program; CANDELA_PROGRAM names another one."""
    other = os.environ.get("CANDELA_PROGRAM")
    name = "candela.bat" if os.name == "nt" else "candela"
    path = Path(other) if other else Path(__file__).parent / "program" / "bin" / name
    if not path.is_file():
        raise UsageError(
            f"there is no program at {path}: set CANDELA_PROGRAM to bin/candela of a zip or of "
            "`./sbt stage`, or install the wheel"
        )
    return path


def program_environment() -> Dict[str, str]:
    """Without the variable, which may name the command of a wheel: it would start itself."""
    return {name: each for name, each in os.environ.items() if name != "CANDELA_PROGRAM"}


def start(words: Sequence[str], **streams: Any) -> "subprocess.Popen[str]":
    """Starts the program in a process group of its own: Ctrl-C reaches Python alone."""
    new_group: Dict[str, Any] = (
        {"creationflags": getattr(subprocess, "CREATE_NEW_PROCESS_GROUP")}
        if sys.platform == "win32"
        else {"start_new_session": True}
    )
    # The program ends when its input does, even if this process is killed; and it looks for
    # libraries in the packages of this Python, which no shell may have activated
    environment = {**program_environment(), "CANDELA_PARENT": "stdin", "VIRTUAL_ENV": sys.prefix}
    path = program()
    try:
        return subprocess.Popen(
            [str(path), *words],
            stdin=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            env=environment,
            **new_group,
            **streams,
        )
    except OSError as e:
        raise UsageError(f"can't start {path}: {e.strerror}") from e


class Session:
    """A Java process, which answers one request after the other."""

    def __init__(self) -> None:
        self.key = _key()
        self._is_running = False
        self.is_closed = False  # by the user
        self._closing = threading.Lock()
        self._errors: IO[bytes] = tempfile.TemporaryFile()
        try:
            self._child = start(["session"], stdout=subprocess.PIPE, stderr=self._errors)
        except UsageError:
            self._errors.close()
            raise
        self._answers: "queue.Queue[Optional[Dict[str, Any]]]" = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True, name="candela")
        self._reader.start()

    @property
    def pid(self) -> int:
        return self._child.pid

    @property
    def is_usable(self) -> bool:
        """Whether it runs, in the current folder."""
        return self._child.poll() is None and self.key == _key()

    def _read(self) -> None:
        assert self._child.stdout is not None
        try:
            for line in self._child.stdout:
                self._answers.put(json.loads(line))
        except (ValueError, OSError):
            pass  # it is being closed, or has written something else
        self._answers.put(None)

    def _send(self, request: Dict[str, Any]) -> None:
        assert self._child.stdin is not None
        try:
            self._child.stdin.write(json.dumps(request) + "\n")
            self._child.stdin.flush()
        except (OSError, ValueError) as e:
            raise self._lost() from e

    def _answer(self, seconds: Optional[float] = None) -> Dict[str, Any]:
        """The next one. Waits in short steps: Ctrl-C interrupts no wait on Windows."""
        left = seconds
        while left is None or left > 0:
            try:
                answer = self._answers.get(timeout=_POLL_SECONDS)
            except queue.Empty:
                left = None if left is None else left - _POLL_SECONDS
                continue
            if answer is None:
                raise self._lost()
            return answer
        raise TimeoutError

    def _lost(self) -> InternalError:
        """The exception for a process that is no more."""
        self.close(seconds=1)
        code = self._child.returncode
        how = f"was ended by signal {-code}" if code < 0 else f"has ended with exit code {code}"
        how = "was ended by candela.close()" if self.is_closed else how
        told = "".join(f"\n{line}" for line in self._printed.splitlines()[-20:])
        return InternalError(
            f"candela's Java process {how}; the next call starts another one{told}", (), code
        )

    def run(
        self, request: Dict[str, Any], progress: Optional[Listener] = None
    ) -> Tuple[int, str, List[str]]:
        """The exit code of a request, what it prints, and its messages."""
        if self._is_running:
            raise UsageError("a rendering's `progress` can't call candela: the rendering goes on")
        self._is_running = True
        try:
            return self._run(request, progress)
        finally:
            self._is_running = False

    def _run(
        self, request: Dict[str, Any], progress: Optional[Listener]
    ) -> Tuple[int, str, List[str]]:
        messages: List[str] = []
        self._send(request)
        try:
            while True:
                answer = self._answer()
                if "message" in answer:
                    messages.append(answer["message"])
                    if is_note(messages[-1]):
                        print(in_python(messages[-1]), file=sys.stderr, flush=True)
                elif "code" in answer:
                    return answer["code"], answer["output"], messages
                elif progress is not None:
                    progress(_progress(answer["progress"]))
        except InternalError:
            raise
        except BaseException:
            self._cancel()
            raise

    def _cancel(self) -> None:
        """Ends what runs: as Ctrl-C does, or else with the whole process."""
        try:
            self._send({"cancel": True})
            while "code" not in self._answer(_CANCEL_SECONDS):
                pass
        except InternalError:
            pass
        except BaseException:
            self._child.kill()
            self.close()

    def close(self, seconds: float = 5.0) -> None:
        """Ends the process, whatever it does."""
        with self._closing:
            if self._errors.closed:
                return
            assert self._child.stdin is not None and self._child.stdout is not None
            try:
                self._child.stdin.close()
            except OSError:
                pass
            try:
                self._child.wait(seconds)
            except subprocess.TimeoutExpired:
                self._child.kill()
                self._child.wait()
            self._reader.join()
            self._child.stdout.close()
            self._errors.seek(0)
            self._printed = self._errors.read().decode("utf-8", "replace").strip()
            self._errors.close()


def _key() -> Tuple[str, Optional[str]]:
    """What a process belongs to: file names are relative to its folder."""
    return os.getcwd(), os.environ.get("CANDELA_PROGRAM")


def _progress(fields: Dict[str, Any]) -> Progress:
    return Progress(
        done=fields.get("done"),
        line=fields["line"],
        seconds=fields["seconds"],
        samples=int(fields["samples"]),
        samples_per_second=fields.get("samplesPerSecond"),
        error=fields.get("error"),
        seconds_left=fields.get("secondsLeft"),
    )


_lock = threading.RLock()
_session: Optional[Session] = None


def session() -> Session:
    """That of this process, which is started if there is none."""
    global _session
    if _session is None or not _session.is_usable:
        if _session is not None:
            _session.close()
        _session = Session()
    return _session


def close() -> None:
    """Ends the Java process, with a rendering of another thread, and frees its memory; the next
    call starts another one.
    """
    global _session
    ended, _session = _session, None
    if ended is not None:
        ended.is_closed = True
        ended.close()


# Waits for no thread that renders
atexit.register(close)


def cancel() -> None:
    """Ends what runs, early, as Ctrl-C does; another thread waits for it."""
    running = _session
    if running is not None:
        try:
            running._send({"cancel": True})
        except InternalError:
            pass  # it has ended


def _forget() -> None:
    """In a forked process: the Java process is its parent's, as is the thread that has the lock."""
    global _lock, _session
    _lock, _session = threading.RLock(), None


if sys.platform != "win32":
    os.register_at_fork(after_in_child=_forget)


def execute(
    words: Sequence[str],
    text: Optional[Text] = None,
    keys: Optional[Keys] = None,
    progress: Optional[Listener] = None,
    image: Optional[Path] = None,
) -> Tuple[str, List[Problem]]:
    """What a command line prints, and its warnings; threads wait for each other.

    :param keys: of the lines of the text, if it is a dict's
    :param image: that of its files which is there only until it is read
    """
    request: Dict[str, Any] = {"run": list(words)}
    if text is not None:
        request["scene"], request["text"] = text
    if image is not None:
        request["image"] = str(image)
    with _lock:
        code, output, messages = session().run(request, progress)
    problems = problems_in(messages, keys)
    if code != 0:
        raise error_of(code, messages, problems)
    return output, problems


def run(*words: Any) -> str:
    """Runs the program with these words, paths and numbers, in a process of its own, and returns
    what it prints.

    >>> print(candela.run("compare", "a.exr", "b.exr"))

    Raises ``CandelaError`` if its exit code is not 0. Warnings are Python's, of the class
    ``CandelaWarning``. ``KeyboardInterrupt`` ends it, too.
    """
    if any(isinstance(word, (Scene, dict)) for word in words):
        raise UsageError("candela.run takes files: save the scene, as scene.save('scene.xml')")
    is_line = len(words) == 1 and isinstance(words[0], str) and " " in words[0].strip()
    if is_line or any(isinstance(word, (list, tuple)) for word in words):
        raise UsageError(
            "candela.run takes each word as an argument of its own, such as "
            'candela.run("compare", "a.exr", "b.exr")'
        )
    child = start([str(plain(word)) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    outputs: Dict[str, str] = {}

    def drain(name: str, stream: IO[str]) -> None:
        outputs[name] = stream.read()

    readers = [
        threading.Thread(target=drain, args=(name, stream), daemon=True)
        for name, stream in (("out", child.stdout), ("err", child.stderr))
    ]
    for reader in readers:
        reader.start()
    try:
        while child.poll() is None:
            try:
                child.wait(_POLL_SECONDS)
            except subprocess.TimeoutExpired:
                pass
    except BaseException:
        _interrupt(child)
        raise
    finally:
        for reader in readers:
            reader.join(timeout=10)
        for stream in (child.stdin, child.stdout, child.stderr):
            if stream is not None:
                stream.close()
    messages = outputs["err"].splitlines()
    problems = problems_in(messages, in_words=str)
    if child.returncode != 0:
        error = error_of(child.returncode, messages, problems)
        error.output = outputs["out"]
        raise error
    for line in filter(is_note, messages):
        print(line, file=sys.stderr)
    warn(problems)
    return outputs["out"]


def _interrupt(child: "subprocess.Popen[str]") -> None:
    """Ends the program as Ctrl-C does, twice if need be, and at last by force."""
    if sys.platform != "win32":
        for seconds in (1.0, 5.0):
            child.send_signal(signal.SIGINT)
            try:
                child.wait(seconds)
                return
            except subprocess.TimeoutExpired:
                pass
    child.kill()
    child.wait()
