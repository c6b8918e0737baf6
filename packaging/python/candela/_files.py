"""Names of files in the texts of scenes, where a text moves to another folder."""

from __future__ import annotations

import gzip
import hashlib
import os
import re
from typing import Dict, List, Optional, Tuple

from ._errors import UsageError

Copies = Dict[str, bytes]  # files to write beside a scene, by their names


def moved(text: str, is_mitsuba: bool, old: str, new: str) -> Tuple[str, Copies]:
    """The text for another folder, where its names mean the same files: relative if one folder is
    in the other, else absolute; and the files that it then includes, which name files, too.
    """
    prefix = _prefix(os.path.abspath(old), os.path.abspath(new))
    if prefix is None:
        return text, {}
    if is_mitsuba:
        return (_searching(text, prefix) if "filename" in text else text), {}
    pbrt = _Pbrt(old, prefix)
    return pbrt.moved(text, old), pbrt.copies


def _prefix(old: str, new: str) -> Optional[str]:
    """The old folder, seen from the new one; None if they are the same."""
    try:
        if os.path.samefile(old, new):
            return None
        if os.path.commonpath([old, new]) in (old, new):
            relative = os.path.relpath(old, new)
            if os.path.samefile(os.path.join(new, relative), old):  # not through a link
                return relative.replace(os.sep, "/")
    except (OSError, ValueError):
        pass  # a folder that is missing, or on another drive
    return old.replace(os.sep, "/")


# Comments, declarations and the root's tag
_ROOT = re.compile(r"<!--.*?-->|<[?!][^>]*>|(<scene\b(?:[^>\"']|\"[^\"]*\"|'[^']*')*(?<!/)>)", re.S)


def _searching(text: str, folder: str) -> str:
    """Mitsuba's XML which looks for files in a folder before its own."""
    for tag in _ROOT.finditer(text):
        if tag[1]:
            escaped = folder.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
            return f'{text[: tag.end()]}<path value="{escaped}"/>{text[tag.end() :]}'
    return text


_PIECE = re.compile(r'#[^\r\n]*|"((?:[^"\\]|\\.)*)"|[\[\]]|[^\s"\[\]#]+')
_PARAMETER = re.compile(r"\s*(\w+)\s+(\S+)\s*")
_FILE = re.compile(r"\w*file(name)?|mapname|normalmap")
# Their names are of the current folder, or of what is written
_OUTPUTS = ("Film", "Option", "PixelFilter")


class _Pbrt:
    """Texts in pbrt's format, whose names are relative to the folder of the scene that is read
    first, in what it includes, too.
    """

    def __init__(self, folder: str, prefix: str) -> None:
        self._folder = folder
        self._prefix = prefix
        self._names: Dict[str, str] = {}  # those of included files, by their paths
        self.copies: Copies = {}

    def moved(self, text: str, folder: str) -> str:
        """:param folder: of the text itself, where included files are looked for at last"""
        pieces: List[str] = []
        end = 0
        directive, is_list = "", False
        parameter: Optional[Tuple[str, str]] = None  # whose values follow
        for piece in _PIECE.finditer(text):
            word, name = piece[0], piece[1]
            if word.startswith("#"):
                continue
            if name is None:
                is_list = word == "[" or is_list and word != "]"
                if not is_list:
                    parameter = None
                    directive = word if word[0].isupper() else directive
                continue
            other = name
            if directive in ("Include", "Import"):
                other = self._included(name, folder)
            elif parameter is not None:
                if directive not in _OUTPUTS and self._is_file(name, *parameter):
                    other = self._placed(name)
                parameter = parameter if is_list else None
            else:
                declared = _PARAMETER.fullmatch(name)
                parameter = (declared[1], declared[2]) if declared else None
            if other != name:
                pieces += [text[end : piece.start(1)], other]
                end = piece.end(1)
        return "".join([*pieces, text[end:]])

    def _is_file(self, value: str, kind: str, name: str) -> bool:
        if kind not in ("string", "spectrum") or not value:
            return False
        is_named = kind == "string" and _FILE.fullmatch(name) is not None
        return is_named or os.path.isfile(os.path.join(self._folder, value.replace("\\", "/")))

    def _placed(self, name: str) -> str:
        return name if os.path.isabs(name) else f"{self._prefix}/{name}"

    def _included(self, name: str, folder: str) -> str:
        """The name of the file, or of a copy that names files itself."""
        local = name.replace("\\", "/")
        paths = [os.path.join(each, local) for each in (self._folder, folder)]
        path = next((each for each in paths if os.path.isfile(each)), None)
        if path is None and "$" in name:
            where = os.path.abspath(self._folder)
            message = f"`{name}` is not known, which the scene includes: save it in {where}"
            raise UsageError(message)
        if path is None:
            return self._placed(name)
        if path not in self._names:
            # That of a file that includes itself, too
            is_placed = path == paths[0]
            self._names[path] = self._placed(name) if is_placed else os.path.abspath(path)
            self._names[path] = self._copied(path) or self._names[path]
        return self._names[path]

    def _copied(self, path: str) -> Optional[str]:
        """The name of a copy, if the file names others."""
        is_packed = path.lower().endswith(".gz")
        try:
            with open(path, "rb") as file:
                data = file.read()
            before = gzip.decompress(data) if is_packed else data
        except (OSError, EOFError) as e:
            raise UsageError(f"can't read `{path}`, which the scene includes: {e}") from None
        text = before.decode("utf-8", "surrogateescape")  # which keeps all bytes
        after = self.moved(text, os.path.dirname(path)).encode("utf-8", "surrogateescape")
        if after == before:
            return None
        stem = re.sub(r"(\.pbrt)?(\.gz)?$", "", os.path.basename(path), flags=re.I)
        name = f"{stem}-{hashlib.blake2b(after, digest_size=8).hexdigest()}.pbrt"
        self.copies[name] = after
        return name
